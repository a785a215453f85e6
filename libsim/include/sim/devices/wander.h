// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/random_stream.h"
#include "sim/devices/device.h"

namespace sim {

class Laser;

/// Settings of a robot that wanders. The defaults are those of Stage's controller "wander"
/// (examples/ctrl/wander.cc of Stage 4).
struct WanderParams {
  std::string laser = "laser";    ///< name of the robot's laser
  double speed_mps = 0.4;         ///< with free way
  double slow_speed_mps = 0.05;   ///< while it turns away
  double turn_rate_radps = 0.5;   ///< while it turns away
  double front_distance_m = 1.0;  ///< nearer obstacles in front make it turn away [m]
  double stop_distance_m = 0.3;   ///< nearer obstacles anywhere make it stop and turn [m]
};

/// What a scan says to a wandering robot.
struct WanderView {
  bool obstructed = false;  ///< something is near in the middle third of the beams
  bool stop = false;        ///< something is very near
  bool turn_right = false;  ///< the nearest point is on the left
};

/// Judges a scan: the middle third of its beams for front_distance_m, all beams for
/// stop_distance_m, and the nearest range on either side.
/// @param ranges_m  from right to left.
[[nodiscard]] WanderView wander_view(const std::vector<double>& ranges_m,
                                     const WanderParams& params);

/// Drives its robot about by the robot's own laser, until a program commands the robot or the
/// device is deactivated.
///
/// At each scan: with free way it drives straight on. If the view is obstructed, it turns away from
/// the nearest point for 10 to 19 scans (random, uniformly distributed), slowly or, if something is
/// very near, on the spot.
class Wander final : public Actuator {
 public:
  Wander(std::string name, const WanderParams& params, RandomStream random);

  std::optional<std::string> connect(std::string_view robot,
                                     const DeviceDirectory& devices) override;
  void act(RobotControl& robot) override;
  void on_motors_taken() override;
  void archive(StateArchive& archive) override;

 protected:
  void deactivated(RobotControl& robot) override;

 private:
  /// Decides on the target twist for the newest scan.
  void decide(const std::vector<double>& ranges_m);

  WanderParams params_;
  RandomStream random_;
  const Laser* laser_ = nullptr;
  bool started_ = false;    ///< it has taken the motors once
  bool drives_ = false;     ///< the motors are its own
  std::uint64_t scan_ = 0;  ///< sequence number of the last scan that it has judged
  std::int64_t scans_to_turn_ = 0;
  Twist twist_;
};

}  // namespace sim
