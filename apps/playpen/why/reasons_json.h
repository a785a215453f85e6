// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "why/reasons.h"

namespace playpen::why {

/// An explained run for reasons_json().
struct ExplainedRun {
  std::string folder;  ///< of its results, as the user named it
  std::string robot;
  double end_s = 0.0;          ///< simulated time at the end of the recording
  bool complete = false;       ///< see Story::complete
  std::optional<bool> passed;  ///< of a graded run
  std::vector<std::string> faults;
  std::vector<Reason> reasons;
};

/// The text of the file of `playpen why --json`, see docs/why.md. Bytes that are not UTF-8 are
/// replaced by U+FFFD.
[[nodiscard]] std::string reasons_json(const std::vector<ExplainedRun>& runs);

}  // namespace playpen::why
