// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace playpen {

/// A variable of the environment that Playpen reads.
struct EnvironmentVariable {
  const char* name;
  const char* meaning;  ///< for people, a sentence
  bool run_sets;  ///< `playpen run` and `grade` replace or remove it, whatever the shell holds
};

/// All that users may set, in alphabetical order.
[[nodiscard]] const std::vector<EnvironmentVariable>& environment_variables();

}  // namespace playpen
