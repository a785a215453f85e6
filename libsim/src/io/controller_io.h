// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/core/error.h"
#include "sim/io/reader.h"
#include "sim/world/controller.h"
#include "sim/world/description.h"

/// Reading and checking of a world's arena controller (docs/arena_controller.md).
namespace sim::io {

/// Reads the member "controller" of a world. Names of other parts are not checked.
[[nodiscard]] ControllerDescription read_controller(Reader& root);

/// Checks the names in a world's controller and its combinations of values.
/// @param trusted  see check_world_parts().
[[nodiscard]] std::vector<ConfigIssue> check_controller(
    const WorldDescription& world, const std::function<bool(const std::string&)>& trusted);

}  // namespace sim::io
