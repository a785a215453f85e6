// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

namespace playerlike {

/// Asks `playpen run` where the world of the run is (host/program_desk.h). The process makes itself
/// known when the library is loaded, and after a fork.
/// @return TCP port of the server on this machine with the world; nullopt: this process has its own
///         world, as without `playpen run`.
/// @throws SessionError kNotAvailable if another program has the world.
[[nodiscard]] std::optional<int> served_world_port();

}  // namespace playerlike
