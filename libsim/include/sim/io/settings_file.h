// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "sim/io/reader.h"

/// Files in the syntax of world files (JSON with comments, unknown keys refused) with other
/// content, such as the task files of `playpen grade`.
namespace sim::io {

/// Reads the content of a file from its root value, which may be of any type. Records errors with
/// Reader::issue() and the getters, and calls finish() on objects when it is done with them.
using SettingsParser = std::function<void(Reader& root)>;

/// Reads a file and passes its root to `parse`.
/// @param what  the type of the content for messages, e.g. "task".
/// @throws ConfigError with every issue found, in the order of the file's lines: those that
///     read_world() reports for the file and its syntax, and those that `parse` recorded.
void read_settings(const std::string& path, const std::string& what, const SettingsParser& parse);

/// Like read_settings, from text; `file` is its name in messages.
void read_settings_text(std::string_view text, const std::string& file, const std::string& what,
                        const SettingsParser& parse);

}  // namespace sim::io
