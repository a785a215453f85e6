// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "sim/render/render.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

/// Keeps a run's past for its results: the trails of the robots, trajectory.csv and the film.
/// Called after each step by the thread that steps.
class Recorder {
 public:
  /// Records nothing when both names are empty.
  /// @param trajectory_file  CSV to write, or "".
  /// @param film_file        film to write, or "".
  /// @throws std::runtime_error if a file cannot be made.
  Recorder(const std::string& trajectory_file, const std::string& film_file,
           const sim::Simulation& simulation);

  void observe(const sim::Simulation& simulation);

  /// The scene now, with trails.
  [[nodiscard]] sim::SceneSnapshot scene(const sim::Simulation& simulation) const;

  /// Completes the files. observe() must not be called afterwards.
  /// @throws std::runtime_error if something could not be written.
  void close();

 private:
  struct Trail {
    std::vector<sim::Vec2> points;
    double spacing_m = 0.01;
  };
  void extend_trails(const sim::Simulation& simulation);
  void write_rows(const sim::Simulation& simulation);

  bool active_;
  std::string trajectory_file_;
  std::ofstream trajectory_;
  std::unique_ptr<sim::render::FilmWriter> film_;
  std::vector<Trail> trails_;
  sim::SimTime next_row_ns_ = 0;
  sim::SimTime next_frame_ns_ = 0;
};

}  // namespace playerlike
