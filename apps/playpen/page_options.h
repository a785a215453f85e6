// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include "command_line.h"
#include "page_process.h"

namespace playpen {

/// Adds --page and the options about it: --page-port, --page-bind, --page-open, --page-name and
/// --page-token-file, which need it.
/// @param page  receives the values; must outlive the command.
void add_page(CommandLine& line, CLI::App& command, PageRequest& page);

}  // namespace playpen
