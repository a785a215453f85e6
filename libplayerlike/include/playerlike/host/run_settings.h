// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sim/core/log.h"
#include "sim/world/description.h"

namespace playerlike {

/// How a world is run: what overrides the world file, and where results go.
struct RunSettings {
  std::optional<std::uint64_t> seed;
  std::optional<double> duration_s;  ///< > 0
  std::optional<sim::TimeMode> time_mode;
  double time_factor = 1.0;      ///< with kPaced: simulated seconds a wall second
  std::string output_folder;     ///< "": nothing is written
  std::string film;              ///< "": no film
  bool progress = false;         ///< a progress line on stderr, if that is a terminal
  bool quiet_end = false;        ///< an uncaught end-of-run error ends the program with status 0
  double silence_limit_s = 5.0;  ///< wall time after which a thinking client stops counting

  /// From the environment: PLAYPEN_SEED, PLAYPEN_DURATION, PLAYPEN_TIME (lockstep, real or a
  /// factor), PLAYPEN_OUT, PLAYPEN_RECORD, PLAYPEN_PROGRESS, PLAYPEN_RUN, PLAYPEN_SILENCE_LIMIT.
  /// @throws sim::ConfigError naming the variable, what it should be and what it is.
  [[nodiscard]] static RunSettings from_environment();

  /// Puts seed, duration and time mode into the world.
  void apply_to(sim::WorldDescription& world) const;
};

/// Reads "lockstep", "real" or a factor > 0 (e.g. "10") into mode and factor.
/// @return whether the text is one of these.
[[nodiscard]] bool parse_time_mode(const std::string& text, sim::TimeMode& mode, double& factor);

}  // namespace playerlike
