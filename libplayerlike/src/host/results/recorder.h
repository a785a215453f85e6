// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/mirror/mirror.h"
#include "host/results/goal_book.h"
#include "host/results/picture_thread.h"
#include "host/results/refusal_book.h"
#include "host/results/seen_floor.h"
#include "host/results/travel_meter.h"
#include "host/stepping/command_book.h"
#include "playerlike/host/run_settings.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

/// Records a run for its results: trails of the robots, trajectory.csv, the film, and the pictures
/// in snapshots/. The thread that steps calls it after each step; another thread draws and writes
/// film and pictures.
///
/// Frame k of a film shows the scene at from + k * film_speed / film_fps simulated seconds,
/// or after the next step if that time lies between two steps; "from" is film_from_s, or the time
/// at which the run begins if that is later. So a run of D seconds has
/// floor((D - from) * fps / speed) + 1 frames. Pictures are taken at multiples of snapshot_period_s
/// in the same way, but at most one per step.
class Recorder {
 public:
  /// @throws std::runtime_error if a file or folder cannot be created.
  /// @param mirror  of the real robots; null: there are none.
  /// @param commands  of the clients; null: they are not known.
  Recorder(const RunSettings& settings, const sim::Simulation& simulation,
           const Mirror* mirror = nullptr, const CommandBook* commands = nullptr);

  void observe(const sim::Simulation& simulation);

  [[nodiscard]] const Mirror* mirror() const noexcept { return mirror_; }
  [[nodiscard]] const CommandBook* commands() const noexcept { return commands_; }
  /// The path of a robot; see kMostTrailPoints.
  [[nodiscard]] const std::vector<sim::Vec2>& trail(std::size_t robot) const {
    return trails_[robot].points;
  }
  /// Returns the goals of the robots so far.
  [[nodiscard]] GoalBook& goals() noexcept { return goals_; }
  [[nodiscard]] const GoalBook& goals() const noexcept { return goals_; }
  /// Returns the time during which a robot's motors were commanded to move it [s]; none if the run
  /// records nothing.
  [[nodiscard]] std::optional<double> driven_time_s(std::size_t robot) const {
    if (!active_ || robot >= trails_.size()) return std::nullopt;
    return sim::to_seconds(trails_[robot].driven_ns);
  }
  /// How far a robot has got; null if the run records nothing.
  [[nodiscard]] const TravelMeter* travel(std::size_t robot) const {
    return active_ && robot < trails_.size() ? &trails_[robot].travel : nullptr;
  }
  /// The floor that the robot named by TaskRules::seen_by has seen; null: it is not recorded.
  [[nodiscard]] const SeenFloor* seen_floor() const noexcept {
    return seen_floor_ ? &*seen_floor_ : nullptr;
  }
  /// What was refused to the program so far.
  [[nodiscard]] RefusalBook& refusals() noexcept { return refusals_; }
  [[nodiscard]] const RefusalBook& refusals() const noexcept { return refusals_; }
  /// The current scene, with trails, goals and collisions.
  /// @param with_canvas  see sim::Simulation::snapshot().
  [[nodiscard]] sim::SceneSnapshot scene(const sim::Simulation& simulation,
                                         bool with_canvas = true) const;

  /// Completes trajectory.csv. observe() must not be called afterwards. @throws std::runtime_error
  /// with the reason if rows are missing; the rows before them are complete.
  void close_trajectory();
  /// Completes the film and the pictures in snapshots/. observe() must not be called afterwards.
  /// @throws std::runtime_error if writing fails or the run has ended before the film begins.
  void close_film();

 private:
  struct Trail {
    std::vector<sim::Vec2> points;
    double spacing_m = 0.01;
    sim::SimTime driven_ns = 0;  // updated in each step, like the trail
    TravelMeter travel;
  };
  void extend_trails(const sim::Simulation& simulation);
  [[nodiscard]] std::string rows(const sim::Simulation& simulation) const;
  /// Writes whole rows. After the first failure, nothing is written any more.
  void write_to_trajectory(const std::string& rows, sim::SimTime now_ns);

  /// Times from + k * period, k = 0, 1, ...
  class Clock {
   public:
    Clock() = default;
    explicit Clock(double period_s, double from_s = 0.0) : period_s_(period_s), from_s_(from_s) {}
    /// Number of these times that have come since the last call.
    [[nodiscard]] std::uint64_t due(sim::SimTime now_ns);

   private:
    double period_s_ = 0.0;  // 0: never due
    double from_s_ = 0.0;
    std::uint64_t reported_ = 0;
  };
  [[nodiscard]] std::string picture_file(sim::SimTime now_ns) const;

  const Mirror* mirror_;
  const CommandBook* commands_;
  bool active_ = false;
  std::string trajectory_file_;
  std::ofstream trajectory_;
  std::uintmax_t trajectory_size_ = 0;  // of its whole rows [bytes]
  std::string trajectory_problem_;      // why the rest is missing; "": nothing is missing
  std::string snapshot_folder_;
  std::unique_ptr<PictureThread> pictures_;  // null without film and pictures
  std::vector<Trail> trails_;
  std::optional<SeenFloor> seen_floor_;
  RefusalBook refusals_;
  GoalBook goals_;
  sim::SimTime next_row_ns_ = 0;
  Clock film_clock_;
  std::optional<double> film_begin_s_;  // until the first frame
  Clock snapshot_clock_;
};

}  // namespace playerlike
