// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <variant>

#include "drivers/driver_thread.h"
#include "drivers/navigator.h"
#include "drivers/timed_mailbox.h"
#include "libplayerc++/laserproxy.h"
#include "libplayerc++/position2dproxy.h"
#include "proxies/goal_driver.h"

namespace playerlike {

/// Runs a Navigator in a thread with its own PlayerClient, which reads laser and position and
/// commands speeds.
///
/// Lockstep: the thread takes part from the constructor on. TimedMailbox describes when requests
/// take effect; results do not depend on the relative speed of threads.
class GoalThread final : public GoalDriver {
 public:
  /// @param session   a follower; not null.
  /// @param position  index of the position2d that measures and drives the robot.
  /// @param laser     index of the laser; not used by drivers without a sensor.
  /// @param settings  they choose the method.
  /// @param fun       function that errors name, e.g. "SndDriver::SndDriver".
  /// @throws PlayerCc::PlayerError kNoSuchDevice for an index that the port does not have,
  /// kNotAvailable if the robot has no motors.
  GoalThread(std::unique_ptr<Session> session, int position, int laser,
             const GoalDriverSettings& settings, const char* fun);
  ~GoalThread() override;

  void go_to(const Goal& goal) override;
  void cancel() override;
  [[nodiscard]] GoalState state() const override;
  /// Sets the settings of the current goal and later goals.
  /// @pre of the same kind as before, and fault_of() them is empty.
  void set_settings(const GoalDriverSettings& settings);
  [[nodiscard]] GoalDriverSettings settings() const;

 private:
  struct Cancel {};
  using Request = std::variant<Goal, Cancel, GoalDriverSettings>;

  void round();
  void ask(const Request& request, GoalState leads_to);
  void begin(const Goal& goal);
  void note_goal(const sim::Vec2& goal);

  DriverThread thread_;
  PlayerCc::Position2dProxy position_;
  std::unique_ptr<PlayerCc::LaserProxy> laser_;  ///< null if the method needs none

  // Used by the thread only.
  GoalDriverSettings in_use_;
  std::unique_ptr<Navigator> navigator_;
  NavigationScan scan_;
  std::optional<sim::Vec2> unnoted_;  ///< goal that the host has not received yet

  TimedMailbox<Request, GoalState> mailbox_;
  // Guarded by the mailbox.
  GoalDriverSettings settings_;
  GoalState asked_for_ = GoalState::kIdle;  ///< the state to which the last request leads
  std::uint64_t last_number_ = 0;           ///< of the last request that changes the state
};

}  // namespace playerlike
