// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <variant>
#include <vector>

#include "drivers/smooth_nearness_diagram.h"
#include "libplayerc++/laserproxy.h"
#include "libplayerc++/playerclient.h"
#include "libplayerc++/position2dproxy.h"
#include "proxies/goal_driver.h"

namespace playerlike {

/// Runs SmoothNearnessDiagram in a thread with its own PlayerClient, which reads laser and position
/// and commands speeds.
///
/// Lockstep: the thread takes part from the constructor on, as a follower (see
/// Session::open_follower()). Requests of other threads are stamped with the simulated time. A
/// round at time r takes the requests made before r, because a request made at r may or may not
/// have arrived yet. For the same reason state() returns the outcome of an earlier round. So
/// results do not depend on the relative speed of threads.
class SndThread final : public GoalDriver {
 public:
  /// @param session   a follower; not null.
  /// @param position  index of the position2d that measures and drives the robot.
  /// @param laser     index of the laser.
  /// @throws PlayerCc::PlayerError kNoSuchDevice for an index that the port does not have,
  /// kNotAvailable if the robot has no motors.
  SndThread(std::unique_ptr<Session> session, int position, int laser, const SndSettings& settings);
  ~SndThread() override;

  void go_to(const Goal& goal) override;
  void cancel() override;
  /// Sets the settings of the current goal and later goals. @pre fault_of(settings) is empty.
  void set_settings(const SndSettings& settings);
  [[nodiscard]] SndSettings settings() const;
  [[nodiscard]] SndState state() const;

 private:
  struct Cancel {};
  /// A request of another thread.
  struct Request {
    sim::SimTime time_ns;
    std::uint64_t number;
    std::variant<Goal, Cancel, SndSettings> what;
  };
  /// The outcome of a round.
  struct Outcome {
    sim::SimTime time_ns = -1;
    std::uint64_t number = 0;  ///< of the last request that the round took
    SndState state = SndState::kIdle;
  };

  void run();
  void round();
  void ask(std::variant<Goal, Cancel, SndSettings> what);
  void take_requests(sim::SimTime before_ns);
  void begin(const Goal& goal);
  void note_goal(const sim::Vec2& goal);
  [[nodiscard]] Session& session() const;

  PlayerCc::PlayerClient client_;
  PlayerCc::Position2dProxy position_;
  PlayerCc::LaserProxy laser_;

  // Used by the thread only.
  SndSettings in_use_;
  SmoothNearnessDiagram navigation_;
  SndScan scan_;
  std::optional<sim::Vec2> unnoted_;  ///< goal that the host has not received yet

  mutable std::mutex mutex_;  // guards the members below; the host's mutex is locked under it
  std::condition_variable started_changed_;
  bool started_ = false;
  SndSettings settings_;
  std::vector<Request> requests_;
  std::uint64_t last_number_ = 0;
  SndState asked_for_ = SndState::kIdle;  ///< the state to which the last request leads
  Outcome newest_;
  Outcome before_;

  std::thread thread_;
};

}  // namespace playerlike
