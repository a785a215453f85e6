// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "playerlike/messages/requests.h"
#include "sim/simulation/simulation.h"

/// The arena and its controller for clients. The callers check the permissions.
namespace playerlike {

/// The name that stands for the arena itself among objects (docs/simulation.md), unless a robot or
/// an obstacle has it.
inline constexpr const char* kArenaName = "arena";

[[nodiscard]] ArenaStatus arena_status(const sim::Simulation& simulation);
/// The dynamic blocks, in the world's order.
[[nodiscard]] std::vector<ArenaBlock> arena_blocks(const sim::Simulation& simulation);
/// The events with numbers greater than `since`, as far as they are kept.
[[nodiscard]] ArenaEventList arena_events(const sim::Simulation& simulation, std::uint64_t since);
/// How the run ended: "passed" or "failed", then the reason; "" if no action has ended it.
[[nodiscard]] std::string verdict_text(const sim::Simulation& simulation);

/// @name Changes
/// All throw SessionError kBadArgument for an unknown name or a refused change, with the reason.
/// @{
void set_configuration(sim::Simulation& simulation, const std::string& name);
void set_block(sim::Simulation& simulation, const std::string& name, bool extended);
void set_timer(sim::Simulation& simulation, const std::string& name, bool enabled);
void set_trap(sim::Simulation& simulation, const std::string& name, bool enabled);
/// @}

}  // namespace playerlike
