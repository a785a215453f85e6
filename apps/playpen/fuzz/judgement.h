// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "expect/expectation.h"
#include "fuzz/runner.h"
#include "fuzz/scenario.h"
#include "grade/task.h"

namespace playpen::fuzz {

/// How a program can fail.
enum class Kind {
  kCrash,        ///< a signal ended it
  kSanitizer,    ///< a sanitizer has reported something
  kBadStatus,    ///< it ended with another status than 0
  kHang,         ///< it did not end in its wall time
  kCollision,    ///< it drove against something
  kVerdict,      ///< the arena controller's verdict is "failed"
  kGoal,         ///< it did not reach the goal, although there is a way with clearance
  kStall,        ///< it pushed against something for a while
  kStuck,        ///< it stayed at one place for the rest of the run
  kExpectation,  ///< a figure is not as expected
};

/// Name of a kind for users: "crash", "sanitizer", "bad-status", "hang", "collision", "verdict",
/// "goal", "stall", "stuck", "expectation".
[[nodiscard]] std::string_view name_of(Kind kind);
/// All of them.
[[nodiscard]] const std::vector<Kind>& all_kinds();

/// What counts as a failure.
struct Rules {
  std::vector<Kind> kinds = all_kinds();
  std::optional<grade::Goal> goal;  ///< of the robot, in all worlds
  std::vector<expect::Expectation> expectations;
  bool must_move = true;  ///< whether a robot that stays at one place is stuck
};

/// A failure of a run.
struct Failure {
  Kind kind = Kind::kCrash;
  std::string text;     ///< a sentence without a full stop: "hits found1 at 4.20 s, (1.2, 0.5)"
  std::string with;     ///< of a collision: what it drove against
  double time_s = 0.0;  ///< simulated time [s]
};

/// The gravest failure of a run; nullopt: there is none.
/// @param world  in which it ran.
[[nodiscard]] std::optional<Failure> failure_of(const RunResult& result, const Rules& rules,
                                                const Base& base, const Base::World& world);

/// The least distance of the robot to anything solid [m]; infinite without a report.
[[nodiscard]] double least_clearance_m(const RunResult& result, const Base& base);

}  // namespace playpen::fuzz
