// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>

#include "course/class_result.h"

namespace playpen::course {

/// A class in which everybody drives alike has many pairs. Only the most alike have pictures.
inline constexpr std::size_t kMostDrawnPairs = 100;

/// Finds the submissions of a graded class whose robots drive alike (see find_alike()), draws the
/// pairs, and exports the sources of all submissions for tools that compare them: the files
/// pairs/FIRST-SECOND.svg and sources/ID in the output folder.
/// @param result  its pairs are replaced.
/// @param folder  the output folder, with the results of the runs.
/// @throws std::exception if a file cannot be written, or a world of a task not be read.
void compare_submissions(ClassResult& result, const std::filesystem::path& folder);

}  // namespace playpen::course
