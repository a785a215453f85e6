// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

#include "fuzz/judgement.h"

namespace playpen::fuzz {

/// A scenario in which a program fails.
struct Finding {
  Scenario scenario;
  Failure failure;
  Base::World world;
  std::size_t after_runs = 0;  ///< number of the run that has found it
  std::size_t things = 0;      ///< elements before it was made simpler
};

/// Makes a finding as simple as possible, step by step, as long as the program fails in the same
/// way (A. Zeller and R. Hildebrandt, "Simplifying and Isolating Failure-Inducing Input", IEEE TSE
/// 28(2), 2002). Of all scenarios that are a step simpler the simplest is taken, so the result does
/// not depend on the number of jobs.
/// @param most_runs  after which no further step begins.
/// @param is_over    asked between runs.
void shrink(Finding& finding, Runner& runner, const Rules& rules, const Base& base,
            std::size_t most_runs, const std::function<bool()>& is_over);

}  // namespace playpen::fuzz
