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

/// SmoothNearnessDiagram at work: a thread with a PlayerClient of its own that reads laser and
/// position, and commands speeds.
///
/// Lockstep. The thread takes part from the constructor on, as a follower (see
/// Session::open_follower()). Whatever other threads ask for is stamped with the simulated time of
/// the asking, and a round at time r takes what was asked before r: what is asked at r itself may
/// or may not have come in yet. For the same reason state() tells what a round before now has
/// made of it. So results do not hang on which thread is faster.
class SndThread final : public GoalDriver {
 public:
  /// @param session   a follower; not null.
  /// @param position  index of the position2d that tells where the robot is, and drives it.
  /// @param laser     index of the laser.
  /// @throws PlayerCc::PlayerError kNoSuchDevice for an index that the port does not have,
  ///         kNotAvailable if the robot has no motors.
  SndThread(std::unique_ptr<Session> session, int position, int laser, const SndSettings& settings);
  ~SndThread() override;

  void go_to(const Goal& goal) override;
  void cancel() override;
  /// Settings for this goal and those that follow. @pre fault_of(settings) is empty.
  void set_settings(const SndSettings& settings);
  [[nodiscard]] SndSettings settings() const;
  [[nodiscard]] SndState state() const;

 private:
  struct Cancel {};
  /// Something that was asked for.
  struct Request {
    sim::SimTime time_ns;
    std::uint64_t number;
    std::variant<Goal, Cancel, SndSettings> what;
  };
  /// What a round has made of it.
  struct Outcome {
    sim::SimTime time_ns = -1;
    std::uint64_t number = 0;  ///< of the last request that it knew
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

  // Of the thread alone.
  SndSettings in_use_;
  SmoothNearnessDiagram navigation_;
  SndScan scan_;
  std::optional<sim::Vec2> unnoted_;  ///< a goal that the host is to be told of

  mutable std::mutex mutex_;  // over what follows; the host's mutex is taken under it
  std::condition_variable started_changed_;
  bool started_ = false;
  SndSettings settings_;
  std::vector<Request> requests_;
  std::uint64_t last_number_ = 0;
  SndState asked_for_ = SndState::kIdle;  ///< the state that the last request leads to
  Outcome newest_;
  Outcome before_;

  std::thread thread_;
};

}  // namespace playerlike
