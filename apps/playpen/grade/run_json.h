// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include "grade/evaluation.h"

namespace playpen::grade {

/// A run as it is in the JSON file of a grading (docs/grading.md).
[[nodiscard]] nlohmann::ordered_json json_of(const GradedRun& run);

}  // namespace playpen::grade
