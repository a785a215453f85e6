// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "sim/io/reader.h"

/// Files that are written as worlds are (JSON with comments, unknown keys refused) but hold
/// something else, such as the task files of `playpen grade`.
namespace sim::io {

/// Reads what a file holds out of its root value, which may be of any kind. Records what is wrong
/// with Reader::issue() and its getters, calls finish() on objects it is done with.
using SettingsParser = std::function<void(Reader& root)>;

/// Reads a file and hands its root to `parse`.
/// @param what  what such a file holds, for messages: "task".
/// @throws ConfigError with every issue found, in the order of the file's lines: those of
///         read_world() for the file and its syntax, and those that `parse` recorded.
void read_settings(const std::string& path, const std::string& what, const SettingsParser& parse);

/// As read_settings, from text; `file` is what messages call it.
void read_settings_text(std::string_view text, const std::string& file, const std::string& what,
                        const SettingsParser& parse);

}  // namespace sim::io
