// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/picture_thread.h"
#include "playerlike/host/run_settings.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

/// Keeps a run's past for its results: the trails of the robots, trajectory.csv, the film and the
/// pictures in snapshots/. Called after each step by the thread that steps; film and pictures are
/// drawn and written on another.
///
/// A film's frame k shows the scene at k * film_speed / film_fps simulated seconds or, if that lies
/// between two steps, after the later one. So a run of D seconds has floor(D * fps / speed) + 1
/// frames. Pictures are made likewise every snapshot_period_s, but one a step at most.
class Recorder {
 public:
  /// @throws std::runtime_error if a file or folder cannot be made.
  Recorder(const RunSettings& settings, const sim::Simulation& simulation);

  void observe(const sim::Simulation& simulation);

  /// Where a robot has been; see kMostTrailPoints.
  [[nodiscard]] const std::vector<sim::Vec2>& trail(std::size_t robot) const {
    return trails_[robot].points;
  }
  /// How long a robot's motors were commanded to move it [s]; none where nothing is recorded.
  [[nodiscard]] std::optional<double> driven_time_s(std::size_t robot) const {
    if (!active_ || robot >= trails_.size()) return std::nullopt;
    return sim::to_seconds(trails_[robot].driven_ns);
  }
  /// The scene now, with trails.
  [[nodiscard]] sim::SceneSnapshot scene(const sim::Simulation& simulation) const;

  /// Completes trajectory.csv. observe() must not be called afterwards.
  /// @throws std::runtime_error if it could not be written.
  void close_trajectory();
  /// Completes the film and the pictures in snapshots/. observe() must not be called afterwards.
  /// @throws std::runtime_error if something could not be written.
  void close_film();

 private:
  struct Trail {
    std::vector<sim::Vec2> points;
    double spacing_m = 0.01;
    sim::SimTime driven_ns = 0;  // here because both are followed in each step
  };
  void extend_trails(const sim::Simulation& simulation);
  void write_rows(const sim::Simulation& simulation);
  void flush_trajectory();

  /// What recurs at times k * period, k = 0, 1, ...
  class Clock {
   public:
    Clock() = default;
    explicit Clock(double period_s) : period_s_(period_s) {}
    /// How many of the times have come since the last call.
    [[nodiscard]] std::uint64_t due(sim::SimTime now_ns);

   private:
    double period_s_ = 0.0;  // 0: it never recurs
    std::uint64_t told_ = 0;
  };
  [[nodiscard]] std::string picture_file(sim::SimTime now_ns) const;

  bool active_ = false;
  std::string trajectory_file_;
  std::ofstream trajectory_;
  std::string snapshot_folder_;
  std::unique_ptr<PictureThread> pictures_;  // none without film and pictures
  std::vector<Trail> trails_;
  sim::SimTime next_row_ns_ = 0;
  Clock film_clock_;
  Clock snapshot_clock_;
};

}  // namespace playerlike
