// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "sim/devices/device.h"

namespace sim {

/// Settings of a fiducial finder. The default ranges and field of view are those of Stage.
struct FiducialParams {
  double frequency_hz = 10.0;                   ///< [Hz]
  double range_max_m = 8.0;                     ///< [m]
  double range_max_id_m = 5.0;                  ///< marks beyond are seen, not read [m]
  double field_of_view_rad = std::numbers::pi;  ///< full angle, (0, 2 pi]
  Pose X_BS;                                    ///< mounting on the body
  double height_m = 0.1;  ///< above the floor [m]; objects that are not higher are neither seen nor
                          ///< hide others
  double noise_m = 0.0;   ///< standard deviation of a distance [m]
  double noise_bearing_rad = 0.0;  ///< standard deviation of a bearing [rad]
  double noise_yaw_rad = 0.0;      ///< standard deviation of a mark's heading [rad]
  double latency_s = 0.0;          ///< [s]
};

/// Marks in view, nearest first.
struct FiducialReading final : Reading {
  /// An object with a mark.
  struct Mark {
    int id = 0;  ///< the object's number in the world; 0: too far away to be read
    Pose X_ST;   ///< pose of the object's centre and axes in the sensor's frame
  };
  std::vector<Mark> marks;
  Pose X_WS;  ///< pose of the sensor (for pictures; not sent to clients)
};

/// Detects other robots and extended obstacles that have a `fiducial` number in the world, like
/// Stage's model of that name. The centre of the object must be within range and field of view, and
/// no other solid may lie on the straight line to it. The object itself and the robot with the
/// sensor hide nothing.
class FiducialFinder final : public SensorOf<FiducialReading> {
 public:
  FiducialFinder(std::string name, const FiducialParams& params, RandomStream noise);

  void show(SimTime now_ns, RobotSnapshot& shot) const override;
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;
  void archive_reading(StateArchive& archive, FiducialReading& reading) override;

 private:
  FiducialParams params_;
  RandomStream noise_;
};

}  // namespace sim
