// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "command_line.h"
#include "isolation.h"
#include "parsed_option.h"
#include "playerlike/host/run_settings.h"

namespace playpen {

/// Adds the options of a run: --duration, --seed, --time, --out, --record..., --snapshot-every,
/// --view-mode and --realism. Call require_something_to_show() when all options are known.
/// @param settings  receives the values; must outlive the command.
/// @param default_time  default of --time, for the help.
void add_run_settings(CommandLine& line, CLI::App& command, playerlike::RunSettings& settings,
                      const std::string& default_time);

/// @throws CLI::ParseError if --record-from was given, but neither --record nor --view.
void require_something_to_show(const playerlike::RunSettings& settings, bool view);

/// Adds --port.
/// @param expected   description of its values, for messages.
/// @param free_port  of a server: what becomes 0 by the value 0, which is no robot's port; or
/// nullptr.
void add_robot_port(CLI::App& command, playerlike::RunSettings& settings,
                    const std::string& expected, std::optional<int>* free_port = nullptr);

/// Adds the options for the contents of pictures and films: --follow, --crop, --hide and
/// --colour-by.
void add_picture_options(CommandLine& line, CLI::App& command,
                         sim::render::RenderOptions& pictures);

/// Adds --view-mode.
void add_view_mode(CommandLine& line, CLI::App& command, std::optional<sim::ViewMode>& mode);

/// Adds --realism.
void add_realism(CommandLine& line, CLI::App& command, std::optional<sim::Realism>& level);

/// An expectation that the user wrote. @throws CLI::ParseError with the reason.
/// @param option  where it was written, for the message.
[[nodiscard]] expect::Expectation parsed_expectation(const std::string& option,
                                                     const std::string& text);

/// Adds --isolated and --readable.
void add_isolation(CommandLine& line, CLI::App& command, IsolationSettings& settings);

/// Adds an option that takes a TCP port, 0..65535.
/// @param port  an int or an optional int that receives the value; must outlive the command.
template <typename Port>
CLI::Option* add_port(CLI::App& command, const std::string& name, const std::string& description,
                      Port& port) {
  return add_parsed(command, name, description, "PORT", playerlike::kTcpPortExpected,
                    [&port](const std::string& text) {
                      int parsed = 0;
                      const bool good = playerlike::parse_tcp_port(text, parsed);
                      if (good) port = parsed;
                      return good;
                    });
}

/// Adds the argument for the world's name, see find_world().
CLI::Option* add_world(CommandLine& line, CLI::App& command, std::string& world);

/// Whether a page can have this name: it ends in .html.
[[nodiscard]] bool is_page_name(const std::string& name);

/// Adds the option --replay-size. @param most_megabytes  must outlive the command.
CLI::Option* add_replay_size(CLI::App& command, double& most_megabytes);

}  // namespace playpen
