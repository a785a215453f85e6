// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "sim/devices/device.h"

namespace sim {

/// Settings of the orientation actuator.
struct OrientationParams {
  double speed_radps = 0.0;     ///< maximum rate of each angle [rad/s]; 0: at once
  double tolerance_rad = 0.02;  ///< an angle nearer to its goal than this stays [rad]
};

/// Turns its robot to a commanded roll, pitch and yaw (MORSE's Orientation).
///
/// Takes OrientCommand. Each angle that is not at its goal causes a turn rate, at most the maximum
/// one, on the short way. As in MORSE, the three rates act about the body's axes. So with a pitch,
/// a turn towards the yaw changes the roll, too, which is corrected when it exceeds the tolerance.
/// The robot is placed at its new heading in each step (see RobotControl::place), so it does not
/// drive while it turns. If something is in the way, it waits.
class Orientation final : public Actuator {
 public:
  Orientation(std::string name, const OrientationParams& params);

  std::optional<std::string> apply(const Command& command) override;
  void act(RobotControl& robot) override;
  void archive(StateArchive& archive) override;

 private:
  OrientationParams params_;
  bool has_goal_ = false;
  OrientCommand goal_;
};

}  // namespace sim
