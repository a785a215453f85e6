// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "sim/devices/device.h"

namespace sim {

/// Settings of a fiducial finder; ranges and field of view are those of Stage's.
struct FiducialParams {
  double frequency_hz = 10.0;                   ///< (0, 1000]
  double range_max_m = 8.0;                     ///< (0, 1000] [m]
  double range_max_id_m = 5.0;                  ///< farther marks are seen, not read, [0, 1000] [m]
  double field_of_view_rad = std::numbers::pi;  ///< full angle, (0, 2 pi]
  Pose X_BS;                                    ///< mounting on the body
  double height_m = 0.1;  ///< above the floor [m]; what is not higher neither hides nor is seen
  double noise_m = 0.0;   ///< standard deviation of a distance [m], >= 0
  double noise_bearing_rad = 0.0;  ///< of a direction [rad], >= 0
  double noise_yaw_rad = 0.0;      ///< of the heading of what is seen [rad], >= 0
};

/// Marks in view, nearest first.
struct FiducialReading final : Reading {
  /// A thing that bears a mark.
  struct Mark {
    int id = 0;  ///< the number that the world gives it; 0: too far away to be read
    Pose X_ST;   ///< of its middle and its own axes, seen from the sensor
  };
  std::vector<Mark> marks;
  Pose X_WS;  ///< where the sensor was (for pictures; not told to clients)
};

/// Sees other robots and extended obstacles to which the world gave a `fiducial` number, as Stage's
/// model of that name: the middle of the thing must be within range and field of view, and nothing
/// else solid on the straight line to it. The thing itself, and the robot that bears the sensor,
/// hide nothing.
class FiducialFinder final : public SensorOf<FiducialReading> {
 public:
  FiducialFinder(std::string name, const FiducialParams& params, RandomStream noise);

  void show(SimTime now_ns, RobotSnapshot& shot) const override;
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  FiducialParams params_;
  RandomStream noise_;
};

}  // namespace sim
