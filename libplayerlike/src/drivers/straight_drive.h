// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drivers/navigator.h"

namespace playerlike {

/// Drives straight to a goal: turns to it on the spot, then drives and corrects its heading. It
/// uses no sensor and avoids nothing (docs/drivers.md).
///
/// The settings, their defaults, and the angles of 5 and 20 degrees between which it drives and
/// turns, are those of Player's driver `goto`.
class StraightDrive final : public Navigator {
 public:
  explicit StraightDrive(const GotoSettings& settings) { use(settings); }

  void set_settings(const GoalDriverSettings& settings) override {
    use(std::get<GotoSettings>(settings));
  }

 protected:
  void begin() override { turns_ = true; }
  [[nodiscard]] std::optional<sim::Twist> drive(const Situation& now,
                                                const NavigationScan& scan) override;

 private:
  void use(const GotoSettings& settings) {
    settings_ = settings;
    set_limits(settings.limits(), settings.min_angular_vel_radps);
  }

  GotoSettings settings_;
  bool turns_ = true;  ///< whether it turns on the spot
};

}  // namespace playerlike
