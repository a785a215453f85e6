// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <string>
#include <string_view>
#include <system_error>

namespace playpen {

/// Parses a whole text as a number.
template <typename T>
[[nodiscard]] bool parse_number(const std::string& text, T& value) {
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && rest == end;
}

/// Whether a text is the name of a file with this ending, and not the ending alone.
[[nodiscard]] inline bool is_file_name(const std::string& text, std::string_view ending) {
  return text.size() > ending.size() && text.ends_with(ending);
}

/// Adds an option whose text `parse` turns into a setting; `parse` returns false for an invalid
/// text.
template <typename Parse>
CLI::Option* add_parsed(CLI::App& command, const std::string& name, const std::string& description,
                        const std::string& value_name, const std::string& expected, Parse parse) {
  return command
      .add_option_function<std::string>(
          name,
          [name, expected, parse](const std::string& text) {
            if (!parse(text)) {
              throw CLI::ValidationError(name, "must be " + expected + ", but is '" + text + "'");
            }
          },
          description)
      ->type_name(value_name);
}

}  // namespace playpen
