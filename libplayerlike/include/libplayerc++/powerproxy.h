// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// The robot's battery. All values come from the newest reading; before the first reading they are
/// 0.
class PowerProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  PowerProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~PowerProxy() override;

  double GetCharge() const;   ///< voltage [V]; the name is Player's
  double GetPercent() const;  ///< charge in percent of the capacity, in [0, 100]
  double GetJoules() const;   ///< remaining energy [J]
  double GetWatts() const;    ///< charging power [W]; negative while the battery discharges
  bool GetCharging() const;   ///< whether the robot is in a dock and the battery is not full
  bool IsValid() const;       ///< whether a reading has arrived
};

}  // namespace PlayerCc

namespace std {
/// Prints voltage, percent, energy, power and whether the battery is charging.
std::ostream& operator<<(std::ostream& os, const PlayerCc::PowerProxy& c);
}  // namespace std
