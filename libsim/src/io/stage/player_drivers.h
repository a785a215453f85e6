// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "io/stage/draft.h"

namespace sim::io::stage {

/// Whether a driver of Player is also one of Playpen that drives to goals: snd, vfh, nd, goto.
[[nodiscard]] bool is_goal_driver(std::string_view name);
/// Whether a driver of Player is also one of Playpen that makes scans: lasercspace,
/// laserposeinterpolator.
[[nodiscard]] bool is_scan_driver(std::string_view name);

/// The settings of a driver's entry in a world, from the options in a configuration file. Options
/// that Playpen's driver lacks are notes.
/// @param name   a goal driver, a scan driver, wavefront or amcl.
/// @param units  of the configuration file.
[[nodiscard]] Json driver_settings(std::string_view name, const Properties& driver,
                                   const Units& units, Report& report);

}  // namespace sim::io::stage
