// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

#include "sim/core/time.h"

namespace sim {

/// What happened in the arena. The meaning of the members of ArenaEvent depends on it.
enum class ArenaEventKind {
  kTimer,          ///< timer `what` acts
  kTrap,           ///< robot `who` springs trap `what`; text: "enter", "leave" or "stay"
  kConfiguration,  ///< the arena changes to configuration `what`
  kRising,         ///< block `what` begins to rise
  kExtended,       ///< block `what` is extended
  kSinking,        ///< block `what` begins to sink
  kRetracted,      ///< block `what` is retracted
  kWaiting,        ///< block or robot `what` waits until `who` has left; text: the reason
  kRefused,        ///< something was not done to block, obstacle or robot `what`; text: the reason
  kPlaced,         ///< obstacle `what` was placed
  kMessage,        ///< timer or trap `what` tells `text`
  kText,           ///< timer or trap `what` shows `text`; value: duration [s], 0: no end
  kCanvas,         ///< timer or trap `what` changes the canvas
  kRestart,        ///< robot `who` is back at its start
  kScore,          ///< robot `who` gets `value` points from timer or trap `what`
  kEnabled,        ///< timer or trap `what` is switched on
  kDisabled,       ///< timer or trap `what` is switched off
  kReset,          ///< the world is reset to its start, or restored to a saved state
  kEnd,            ///< timer or trap `what` ends the run; value: 1 passed, 0 failed; text: reason
  kMoving,         ///< the controller moves obstacle `what`
  kArrived,        ///< obstacle `what` is at the end of its path
  kBlocked,        ///< obstacle `what` is stopped by robot `who`, or by the solid `text`
  kPushed,         ///< obstacle `what` is off its path because of robot `who` or the solid `text`
};

/// The last kind.
inline constexpr ArenaEventKind kLastArenaEventKind = ArenaEventKind::kPushed;

/// The name of a kind in reports, e.g. "configuration" for kConfiguration.
[[nodiscard]] std::string_view to_string(ArenaEventKind kind);

/// Something that happened in the arena.
struct ArenaEvent {
  std::uint64_t number = 0;  ///< 1 for the first event of the run, then increasing by one
  SimTime time_ns = 0;       ///< simulated time
  ArenaEventKind kind = ArenaEventKind::kMessage;  ///< what happened
  std::string what;                                ///< name of a timer, trap, block, ...
  std::string who;                                 ///< name of a robot; "": none
  std::string text;                                ///< a message or a reason; "": none
  double value = 0.0;                              ///< points, a duration, ...
};

/// An event in words, e.g. "robot r1 springs trap gate (enter)".
[[nodiscard]] std::string description(const ArenaEvent& event);

/// Number of events that a simulation keeps.
inline constexpr std::size_t kKeptArenaEvents = 1024;

/// The newest events of a run.
struct ArenaEvents {
  std::uint64_t count = 0;        ///< of the whole run: the number of the newest event
  std::deque<ArenaEvent> newest;  ///< oldest first, at most kKeptArenaEvents
};

/// How the arena controller ended the run.
struct Verdict {
  bool passed = false;  ///< or failed
  std::string reason;   ///< for people; may be empty
  SimTime time_ns = 0;  ///< simulated time
};

}  // namespace sim
