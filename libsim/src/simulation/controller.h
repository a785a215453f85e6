// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/controller_work.h"
#include "sim/core/random_stream.h"
#include "simulation/simulation_impl.h"
#include "simulation/trap_watch.h"

namespace sim {

/// The arena controller of a running world: timers, traps and their actions. It works at the end of
/// each step, after the sensors, and before the first step.
class Simulation::Impl::Controller {
 public:
  /// @pre the names in the world's controller exist, see io::check_world.
  explicit Controller(Impl& owner);

  /// Must be called before each step.
  void before_step() {
    if (!started_) start();
  }
  /// Must be called after each step.
  void after_step();
  /// Starts anew in the next step, like that of a new simulation.
  void reset();
  /// Continues at another time, with the scores and the verdict of the one before.
  void take_over_from(Controller& before, SimTime later_ns);

  std::optional<std::string> configure(const std::string& name);
  std::optional<std::string> set_timer_enabled(const std::string& name, bool enabled);
  std::optional<std::string> set_trap_enabled(const std::string& name, bool enabled);
  [[nodiscard]] std::optional<bool> is_enabled(const std::string& name) const;

  [[nodiscard]] const std::vector<double>& scores() const noexcept { return scores_; }
  [[nodiscard]] const std::optional<Verdict>& verdict() const noexcept { return verdict_; }
  [[nodiscard]] ArenaState state() const;
  void show(SceneSnapshot& scene) const;
  void archive(StateArchive& archive);

 private:
  static constexpr SimTime kNever = SimTime{1} << 60;

  struct Timer {
    bool enabled = false;
    bool begun = false;       // switched on since run_timers() has last looked at it
    SimTime begin_ns = 0;     // when it was switched on
    SimTime first_ns = 0;     // its first time, after begin_ns
    std::int64_t moment = 0;  // number of the next time
    SimTime due_ns = kNever;  // the next time, with jitter
    std::int64_t acted = 0;   // since it was switched on
    std::uint64_t count = 0;  // since the start
    std::optional<RandomStream> random;
  };
  // A robot in a trap that springs when it has stayed.
  struct Stay {
    std::uint32_t trap;
    std::uint32_t robot;
    SimTime due_ns;
  };
  struct Text {
    Vec2 place;
    std::string text;
    Colour colour;
    SimTime end_ns;  // kNever: none
  };
  // Who acts: a timer, or a trap and the robot that sprang it.
  struct Cause {
    const std::string& name;
    int robot;  // -1: none
  };

  void start();
  void work();
  // Counts operations of the present step. If there are too many, ends the run and returns false.
  bool may_work(std::int64_t operations, const std::string& name);
  void begin_timer(std::size_t i);
  void plan_timer(std::size_t i);
  void run_timers();
  void act_timer(std::size_t i);
  void run_traps();
  bool spring(std::size_t trap, std::size_t robot, const char* how);
  void end_texts();
  void retry_restarts();
  void switch_timer(std::size_t i, bool enabled);
  void switch_trap(std::size_t i, bool enabled);
  // After due times have changed.
  void find_next_time();

  // --- Conditions and actions (controller_actions.cpp)
  [[nodiscard]] bool hold(const std::vector<ArenaCondition>& conditions, int robot) const;
  [[nodiscard]] bool holds(const TimeCondition& condition, int robot) const;
  [[nodiscard]] bool holds(const CountCondition& condition, int robot) const;
  [[nodiscard]] bool holds(const BlockCondition& condition, int robot) const;
  [[nodiscard]] bool holds(const QuantityCondition& condition, int robot) const;
  [[nodiscard]] bool holds(const FiducialCondition& condition, int robot) const;
  [[nodiscard]] std::optional<double> quantity(RobotQuantity quantity, std::size_t robot) const;
  void act(const std::vector<ArenaAction>& actions, const Cause& cause);
  /// Specialised in controller_actions.cpp for each kind of action.
  template <typename Action>
  void act(const Action& action, const Cause& cause);
  std::optional<std::string> change_block(const std::string& name, BlocksAction::Change change);
  std::optional<std::string> place(const std::string& name, const Pose& pose);
  bool restart(std::size_t robot);
  [[nodiscard]] int robot_of(const std::string& name, int cause) const;

  Impl& impl_;
  const ControllerDescription& description_;
  std::map<std::string, std::size_t, std::less<>> timer_of_;
  std::map<std::string, std::size_t, std::less<>> trap_of_;
  std::map<std::string, std::size_t, std::less<>> robot_of_;
  std::vector<int> batteries_;  // index of each robot's first battery; -1: none
  std::vector<int> fiducials_;  // index of each robot's first fiducial device; -1: none

  io::ControllerWork cost_;
  std::int64_t work_ = 0;  // operations in the present step

  bool started_ = false;
  SimTime origin_ns_ = 0;      // time of the start or of the last reset
  std::string configuration_;  // the last one; "": none
  std::vector<Timer> timers_;
  SimTime next_time_ns_ = kNever;  // when the next timer is due or a text ends
  TrapWatch watch_;
  std::vector<std::uint64_t> trap_counts_;
  std::vector<Stay> stays_;
  std::vector<std::size_t> waiting_;  // robots to be put back to their start
  std::vector<Text> texts_;           // oldest first
  std::vector<double> scores_;        // of the robots
  std::optional<Verdict> verdict_;
};

}  // namespace sim
