// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// The robot's battery. All values are of the newest reading; before the first they are 0.
class PowerProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if there is no such device; the text names those there are.
  PowerProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~PowerProxy() override;

  double GetCharge() const;   ///< voltage, as Player has it [V]
  double GetPercent() const;  ///< what is left of the capacity, [0, 100]
  double GetJoules() const;   ///< energy that is left [J]
  double GetWatts() const;    ///< power that goes into the battery; negative: that it gives [W]
  bool GetCharging() const;   ///< whether it stands in a dock and is not full yet
  bool IsValid() const;       ///< whether there has been a reading
};

}  // namespace PlayerCc

namespace std {
/// Prints voltage, percent, energy, power and whether it is being charged.
std::ostream& operator<<(std::ostream& os, const PlayerCc::PowerProxy& c);
}  // namespace std
