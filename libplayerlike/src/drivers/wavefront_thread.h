// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <variant>

#include "drivers/distance_wave.h"
#include "drivers/driver_thread.h"
#include "drivers/timed_mailbox.h"
#include "libplayerc++/localizeproxy.h"
#include "libplayerc++/position2dproxy.h"
#include "proxies/goal_driver.h"
#include "proxies/planner.h"

namespace playerlike {

/// Plans paths on the world's map in a thread with its own PlayerClient, and hands their waypoints
/// to a driver of the robot.
///
/// Lockstep: the thread takes part from the constructor on, and so does that of the driver.
class WavefrontThread final : public Planner {
 public:
  /// @param session  a follower; not null.
  /// @throws PlayerCc::PlayerError, SessionError if a device is missing or the session may not read
  ///         the map.
  WavefrontThread(std::unique_ptr<Session> session, const PlannerInfo& info);
  ~WavefrontThread() override;

  void set_goal(const sim::Pose& goal) override;
  void set_start(const sim::Pose& start) override;
  void enable(bool on) override;
  [[nodiscard]] PlannerState state() const override;

 private:
  struct NewGoal {
    sim::Pose pose;
  };
  struct NewStart {
    sim::Pose pose;
  };
  struct Enable {
    bool on;
  };
  using Request = std::variant<NewGoal, NewStart, Enable>;

  void round();
  void take(const Request& request);
  [[nodiscard]] std::optional<sim::Pose> measured_pose();
  void plan(double time_s);
  void follow(double time_s);
  void drive_to_waypoint();
  void stop();
  void draw_path();
  void ask(const Request& request);

  const WavefrontSettings settings_;
  DriverThread thread_;
  std::shared_ptr<GoalDriver> driver_;
  PlayerCc::Position2dProxy output_;                     ///< pose in the driver's frame
  std::unique_ptr<PlayerCc::Position2dProxy> position_;  ///< null if it localises
  std::unique_ptr<PlayerCc::LocalizeProxy> localize_;
  std::unique_ptr<DistanceWave> wave_;
  std::optional<sim::LayerId> layer_;

  // Used by the thread only.
  PlannerState now_;
  bool has_goal_ = false;
  bool enabled_ = true;
  bool driving_ = false;            ///< the driver pursues the current waypoint
  bool stops_again_ = false;        ///< the next round repeats the command to stop
  std::optional<sim::Pose> start_;  ///< plans from here, without driving
  bool must_plan_ = false;
  double planned_time_s_ = 0.0;  ///< when it planned last
  sim::Vec2 planned_from_ = sim::Vec2::Zero();

  TimedMailbox<Request, PlannerState> mailbox_;
  // Guarded by the mailbox.
  PlannerState asked_for_;  ///< what state() shows until the last request is taken
  std::uint64_t last_number_ = 0;
};

}  // namespace playerlike
