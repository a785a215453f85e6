// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "grade/task.h"

/// Fingerprints of what the result of a run depends on. Results are kept under them and used again.
namespace playpen::grade {

/// The fingerprint of some texts in this order: 16 hexadecimal digits.
[[nodiscard]] std::string fingerprint_of_texts(const std::vector<std::string>& texts);

/// The fingerprint of what the runs of a task depend on: its file without rubric and texts. Its
/// worlds, seeds and limits are not part of it.
[[nodiscard]] std::string fingerprint_of(const Task& task);

/// The fingerprint of a command: its words, and the contents of those files that they name.
/// @param command  the first word is a path of the program.
[[nodiscard]] std::string fingerprint_of_command(const std::vector<std::string>& command);

}  // namespace playpen::grade
