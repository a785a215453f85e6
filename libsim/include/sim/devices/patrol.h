// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/pose.h"
#include "sim/core/random_stream.h"
#include "sim/devices/device.h"

namespace sim {

/// A straight way between two junctions of a patrol.
struct PatrolWay {
  Vec2 from_m = Vec2::Zero();  ///< in W [m]
  Vec2 to_m = Vec2::Zero();    ///< in W [m]
};

/// Settings of a robot that patrols.
struct PatrolParams {
  double speed_mps = 0.2;        ///< on its way
  double turn_gain_radps = 3.0;  ///< turn rate for an angle of one radian to its way
  double turn_first_rad = 0.3;   ///< it drives only while that angle is smaller, (0, pi]
  double tolerance_m = 0.05;     ///< distance at which it has reached a junction
  std::vector<PatrolWay> ways;   ///< equal ends are one junction; none: it stands still

  static constexpr std::size_t kMaxWays = 1000;
};

/// The junctions of a patrol and the ways between them.
struct PatrolMap {
  /// A place where ways meet or end.
  struct Junction {
    Vec2 place_m = Vec2::Zero();    ///< in W [m]
    std::vector<std::size_t> next;  ///< the junctions to which ways lead, in the order of the ways
  };
  std::vector<Junction> junctions;  ///< in the order in which the ways name them

  explicit PatrolMap(const std::vector<PatrolWay>& ways);
  /// Index of the junction nearest to a point. @pre There is one.
  [[nodiscard]] std::size_t nearest(const Vec2& p_W) const;
};

/// Drives its robot along given ways, from junction to junction, until a program commands the robot
/// or the device is deactivated. It begins at the junction nearest to the robot's start. At each
/// junction it chooses the next way at random, but turns back only at a dead end. It does not look
/// out for obstacles.
class Patrol final : public Actuator {
 public:
  Patrol(std::string name, const PatrolParams& params, RandomStream random);

  void act(RobotControl& robot) override;
  void on_motors_taken() override { drives_ = false; }
  void archive(StateArchive& archive) override;

 protected:
  void deactivated(RobotControl& robot) override;

 private:
  void choose_way();

  PatrolParams params_;
  PatrolMap map_;
  RandomStream random_;
  bool started_ = false;    ///< it has taken the motors once
  bool drives_ = false;     ///< the motors are its own
  std::uint64_t last_ = 0;  ///< junction from which it comes
  std::uint64_t goal_ = 0;  ///< junction to which it drives
};

}  // namespace sim
