// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace playpen {

/// An environment variable that Playpen reads.
struct EnvironmentVariable {
  const char* name;
  const char* meaning;  ///< a sentence for the user
  bool run_sets;        ///< `playpen run` and `grade` overwrite or remove it
};

/// All variables that users may set, in alphabetical order.
[[nodiscard]] const std::vector<EnvironmentVariable>& environment_variables();

}  // namespace playpen
