// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "commands.h"

namespace playpen {

/// The kinds of value that an option or argument takes, for shell completion.
struct ValueKind {
  enum class Kind { kAnything, kFile, kFolder, kWorld, kTask, kNamedFile, kPage, kChoice };
  Kind kind = Kind::kAnything;
  std::vector<std::string> choices;  ///< of kChoice
};

/// The description of the whole command line: its commands, their options and what they do. Help,
/// manual page, completion and the hints for misspelt words are generated from it.
struct CommandLine {
  /// @param invocation  how the user calls this program, "playpen" or a path.
  explicit CommandLine(std::string invocation);
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  CLI::App app;
  std::string invocation;
  /// the client program and its arguments: everything after "--"
  std::vector<std::string> program;
  /// what the user wrote before that: the invocation, the command and its arguments
  std::vector<std::string> call;
  int status = kOk;  ///< exit status of the command that has run

  std::set<const CLI::App*> with_program;  ///< commands that are followed by "-- PROGRAM"
  std::map<const CLI::Option*, ValueKind> value_kinds;  ///< without those of kAnything

  /// Adds a command. `action` runs it and returns its exit status.
  CLI::App& add_command(const std::string& name, const std::string& description);
  /// Sets the kind of an option's values. @return the option.
  CLI::Option* takes(CLI::Option* option, ValueKind::Kind kind);
  /// Sets the possible values of an option. @return the option.
  CLI::Option* takes(CLI::Option* option, std::vector<std::string> choices);
  /// The visible commands, in order.
  [[nodiscard]] std::vector<const CLI::App*> commands() const;
  /// The command with that name.
  /// @throws CLI::ParseError that suggests the most similar name if there is none.
  [[nodiscard]] const CLI::App& command(const std::string& name) const;

  /// Parses the arguments (without the program's own name) and runs the command that they name.
  /// @return the exit status.
  /// @throws what the commands throw (commands.h).
  [[nodiscard]] int run(std::vector<std::string> arguments);

 private:
  [[nodiscard]] int explain(const CLI::ParseError& error) const;
};

/// Each adds one command to the command line.
void add_run(CommandLine& line);
void add_serve(CommandLine& line);
void add_grade(CommandLine& line);
void add_class(CommandLine& line);
void add_batch(CommandLine& line);
void add_import(CommandLine& line);
void add_check(CommandLine& line);
void add_render(CommandLine& line);
void add_plot(CommandLine& line);
void add_diff(CommandLine& line);
void add_expect(CommandLine& line);
void add_fuzz(CommandLine& line);
void add_why(CommandLine& line);
void add_replay(CommandLine& line);
void add_list(CommandLine& line);
void add_new(CommandLine& line);
void add_token(CommandLine& line);
void add_doc(CommandLine& line);
void add_doctor(CommandLine& line);
void add_help(CommandLine& line);
void add_completion(CommandLine& line);
void add_contain(CommandLine& line);

}  // namespace playpen
