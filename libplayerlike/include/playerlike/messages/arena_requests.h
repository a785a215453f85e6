// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/time.h"
#include "sim/simulation/arena_event.h"
#include "sim/simulation/arena_state.h"

/// Requests about the arena and its controller; see requests.h for their members.
namespace playerlike {

/// @name The arena and its controller
///
/// See docs/arena_controller.md. Every world answers these requests; a world without a controller
/// has no configurations, timers and traps, but it may have dynamic blocks.
///
/// Permissions: if a server requires tokens, only clients that may command all robots may change
/// the arena. In a private world only these clients may read its state and events, because traps
/// and refusals tell where robots are.
///
/// Errors: SessionError kBadArgument for an unknown name (the text suggests a similar one and lists
/// the known ones) and for a change that was refused, e.g. because a robot stands on a block;
/// kNotAvailable if the world has locked its objects, see
/// sim::SimulationDescription::objects_locked.
/// @{

/// State of a dynamic block.
struct ArenaBlock {
  std::string name;
  /// "extended", "retracted", "rising", "sinking", or "waiting": retracted, and it rises when the
  /// robot that stands on it has left.
  std::string state;
  double height_m = 0.0;  ///< up to which it stands now [m]; 0 if it is retracted
};

/// Score of a robot.
struct ArenaScore {
  std::string robot;    ///< its name
  double points = 0.0;  ///< from timers and traps so far; 0 in a world without a controller
};

/// State of the arena and of its controller.
struct ArenaStatus {
  sim::SimTime time_ns = 0;                 ///< current simulated time
  std::vector<std::string> configurations;  ///< names, in the world's order
  std::string configuration;  ///< the last one that was set since the start or the last reset; "":
                              ///< none
  std::vector<ArenaBlock> blocks;            ///< the dynamic ones, in the world's order
  std::vector<sim::ArenaTrigger> timers;     ///< in the world's order
  std::vector<sim::ArenaTrigger> traps;      ///< in the world's order
  std::vector<ArenaScore> scores;            ///< of all robots, in the world's order
  std::optional<sim::Verdict> verdict = {};  ///< none: no action has ended the run
  std::uint64_t newest = 0;                  ///< number of the newest event; 0: none
};
/// Returns the state of the arena.
struct ArenaRequest {
  using Result = ArenaStatus;
  static constexpr const char* kName = "arena";
  static constexpr bool kTellsTruth = true;
};

/// Events of the arena.
struct ArenaEventList {
  std::vector<sim::ArenaEvent> events;  ///< oldest first
  std::uint64_t newest = 0;             ///< number of the newest event of the run; 0: none
  std::uint64_t lost = 0;  ///< number of events that were requested, but are no longer kept
};
/// Returns the events after one that the client knows. The simulation keeps
/// sim::kKeptArenaEvents events.
struct ArenaEventsRequest {
  using Result = ArenaEventList;
  static constexpr const char* kName = "arena_events";
  static constexpr bool kTellsTruth = true;
  std::uint64_t since = 0;  ///< number of an event; 0: returns all events that are kept
};

/// Puts the arena into a configuration. If a block or an obstacle cannot be changed, the others are
/// changed nevertheless, and the error names it. A block that waits for a robot is no error.
struct SetConfigurationRequest {
  using Result = void;
  static constexpr const char* kName = "set_configuration";
  static constexpr bool kTellsTruth = true;
  std::string name;
};

/// Extends or retracts a dynamic block; see sim::Simulation::set_obstacle_state().
struct SetBlockRequest {
  using Result = void;
  static constexpr const char* kName = "set_block";
  static constexpr bool kTellsTruth = true;
  std::string name;
  bool extended = false;
};

/// Switches a timer on or off. A timer that is switched on counts its times from now.
struct SetTimerRequest {
  using Result = void;
  static constexpr const char* kName = "set_timer";
  static constexpr bool kTellsTruth = true;
  std::string name;
  bool enabled = false;
};

/// Switches a trap on or off. Robots inside a trap that is switched on enter it now.
struct SetTrapRequest {
  using Result = void;
  static constexpr const char* kName = "set_trap";
  static constexpr bool kTellsTruth = true;
  std::string name;
  bool enabled = false;
};
/// @}

}  // namespace playerlike
