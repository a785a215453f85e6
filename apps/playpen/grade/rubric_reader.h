// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "grade/figures.h"
#include "grade/rubric.h"
#include "sim/io/reader.h"

namespace playpen::grade {

/// Reads the key "rubric" of a task file, which may be missing. Records the errors.
/// @param check_need  records an issue at the key "figure" of an item if the task cannot give this
///     figure a value.
[[nodiscard]] std::vector<RubricItem> read_rubric(
    sim::io::Reader& root,
    const std::function<void(sim::io::Reader& item, FigureNeed need)>& check_need);

}  // namespace playpen::grade
