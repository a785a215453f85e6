// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "help_format.h"

#include <unistd.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "command_line.h"
#include "terminal.h"

namespace playpen {
namespace {

constexpr std::size_t kNameColumns = 26;
constexpr std::size_t kCommandColumns = 14;
constexpr std::size_t kMostColumns = 100;  // longer lines are hard to read

}  // namespace

HelpFormatter::HelpFormatter(const CommandLine& line)
    : line_(line), columns_(std::min(terminal_columns(STDOUT_FILENO), kMostColumns)) {
  column_width(kNameColumns);
  label("SUBCOMMAND", "COMMAND");
  label("Positionals", "Arguments");
  label("REQUIRED", "(required)");
}

std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const {
  std::string usage = Formatter::make_usage(app, std::move(name));
  if (!line_.with_program.contains(app)) return usage;
  const std::size_t end = usage.find_last_not_of('\n') + 1;
  return usage.substr(0, end) + " -- PROGRAM [ARGUMENT...]" + usage.substr(end);
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  std::string name = "  " + command->get_name();
  name.resize(std::max(name.size() + 1, kCommandColumns), ' ');
  return name + wrapped(command->get_description(), columns_, kCommandColumns) + '\n';
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  return in_lines(option->get_description());
}

/// CLI11 indents the lines that it is given.
std::string HelpFormatter::in_lines(const std::string& text) const {
  return wrapped(text, columns_ - kNameColumns, 0);
}

}  // namespace playpen
