// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "io/stage/entity.h"
#include "io/stage/report.h"

namespace sim::io::stage {

/// Whether an entity describes Stage's window.
[[nodiscard]] inline bool is_window(const std::string& type) {
  return type == "window" || type == "gui";
}

/// Finds out for which version of Stage a world is, and notes what follows from it.
/// Stage 2 is flat: sizes [x y], poses [x y heading]. Later versions have sizes [x y z], poses
/// [x y z heading], and refuse a size of two numbers (Worldfile::ReadTuple() of
/// libstage/worldfile.cc).
/// @param units  gets three_number_poses_turn and flat.
void read_version(const Entity& root, Units& units, Report& report);

}  // namespace sim::io::stage
