// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "command_line.h"

namespace playpen {

/// The manual page playpen(1), generated from the description of the command line, with man(7)'s
/// macros.
[[nodiscard]] std::string man_page(const CommandLine& line);

}  // namespace playpen
