// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/core/time.h"
#include "sim/devices/device.h"
#include "sim/world/description.h"

namespace sim {

/// Settings of a gripper. The defaults for size and speed are those of Stage's gripper
/// (model_gripper).
struct GripperParams {
  double frequency_hz = 10.0;  ///< [Hz]
  /// Base of the paddles, half-way between them; the paddles point along x. None: the middle of the
  /// robot's front.
  std::optional<Pose> X_BG;
  double length_m = 0.12;      ///< of a paddle [m]
  double thickness_m = 0.03;   ///< of a paddle [m]
  double opening_m = 0.22;     ///< between the open paddles [m]
  double height_m = 0.05;      ///< height of paddles and beams above the floor [m]; objects that
                               ///< are not higher are neither detected nor gripped
  double travel_time_s = 2.0;  ///< from open to closed, and back [s]
  int capacity = 0;            ///< of the store, 0..kMaxStored
  static constexpr int kMaxStored = 100;
};

/// State of the paddles.
enum class GripperState {
  kOpen,    ///< fully open, or stopped on the way
  kClosed,  ///< holding an object, or touching each other
  kMoving,  ///< opening or closing
  kError,  ///< stopped by an object that cannot be gripped, or no room to put the held object down;
           ///< until the next command that succeeds
};

/// "open", "closed", "moving" or "error".
[[nodiscard]] std::string_view to_string(GripperState state) noexcept;

/// A gripper reading.
struct GripperReading final : Reading {
  GripperState state = GripperState::kOpen;
  bool outer_beam = false;  ///< the beam near the paddles' tips is broken
  bool inner_beam = false;  ///< the beam near the robot is broken
  bool holding = false;     ///< an object is between the paddles and moves with the robot
  int stored = 0;           ///< number of objects in the store
  double gap_m = 0.0;       ///< between the paddles now [m]
};

/// Extent of the part of a box that lies in a strip across the gripper.
///
/// Frames: G gripper; T object, its centre and axes.
/// @param X_GT     pose of the box in G.
/// @param size_m   of the box along its own axes [m].
/// @param from_m, to_m  the strip is from_m <= x <= to_m in G [m].
/// @return minimum and maximum y in G [m]; nullopt if no part lies in the strip.
[[nodiscard]] std::optional<std::pair<double, double>> reach_across(const Pose& X_GT,
                                                                    const Vec2& size_m,
                                                                    double from_m, double to_m);

/// Like reach_across() of a box, for an obstacle of any shape.
/// @param X_GT   pose of the obstacle's own frame in G.
/// @param thing  its own position and rotation are not used.
[[nodiscard]] std::optional<std::pair<double, double>> reach_across(
    const Pose& X_GT, const ObstacleDescription& thing, double from_m, double to_m);

/// Two paddles in front of the robot, with two break beams between them. Takes GripCommand.
///
/// When closing, the paddles move towards each other until one of them touches a `portable`
/// obstacle between them. The obstacle is gripped in its current pose and carried
/// (RobotControl::pick_up). Opening puts it down. The paddles themselves collide with nothing. As
/// in Stage, the outer beam is at three quarters of the paddles' length, the inner one at a
/// quarter. The paddles stand still while the robot is suspended or the device is inactive.
class Gripper final : public SensorOf<GripperReading> {
 public:
  /// @param X_BG  base of the paddles; replaces params.X_BG.
  Gripper(std::string name, const GripperParams& params, const Pose& X_BG);

  [[nodiscard]] const GripperParams& params() const noexcept { return params_; }
  [[nodiscard]] const Pose& X_BG() const noexcept { return X_BG_; }
  /// Current distance between the paddles [m].
  [[nodiscard]] double gap_m() const noexcept;
  /// Current outlines of both paddles, left and right, in B [m].
  [[nodiscard]] std::vector<std::vector<Vec2>> paddles() const;

  std::optional<std::string> execute(const Command& command, RobotControl& robot) override;
  void act(RobotControl& robot) override;
  void show(SimTime now_ns, RobotSnapshot& shot) const override;
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  enum class Motion { kStill, kOpening, kClosing };
  // An object between the paddles, or in the store with the pose at which it was held.
  struct Held {
    int obstacle;
    Pose X_BT;
    SimTime closed_ns;
    void archive(StateArchive& archive);
  };

  [[nodiscard]] GripperState state() const noexcept;
  [[nodiscard]] double gap_at(SimTime closed_ns) const noexcept;
  std::optional<std::string> open(RobotControl& robot);
  std::optional<std::string> store(RobotControl& robot);
  std::optional<std::string> retrieve(RobotControl& robot);
  void close_further(RobotControl& robot, const StepContext& now);
  void drop_missing(const StepContext& now);
  [[nodiscard]] bool is_stopped_at(const StepContext& now, double gap_m) const;
  [[nodiscard]] bool is_broken(const StepContext& now, double x_m) const;

  GripperParams params_;
  Pose X_BG_;
  SimTime travel_ns_;
  SimTime closed_ns_ = 0;  // progress of closing, from 0 (open) to travel_ns_
  Motion motion_ = Motion::kStill;
  bool fault_ = false;
  std::optional<Held> held_;
  std::vector<Held> stored_;  // the newest is last
};

}  // namespace sim
