// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "diff/run_difference.h"

namespace playpen::diff {

/// A number with a fixed number of decimals; from 1e7 on, with six significant digits.
[[nodiscard]] std::string number_text(double value, int decimals);

/// "1 mm", "10 mm": a limit of kDistances_m.
[[nodiscard]] std::string distance_text(double limit_m);

/// How two runs differ, as lines for a terminal: the conditions that differ, the first difference
/// of the trajectories, where they part, and the figures of both runs. If nothing differs, the
/// lines say so. Control characters in names are replaced.
[[nodiscard]] std::string text_of(const RunDifference& difference, const ComparedRun& first,
                                  const ComparedRun& second);

}  // namespace playpen::diff
