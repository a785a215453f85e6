// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "command_line.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <utility>

#include "help_format.h"
#include "sim/core/error.h"

namespace playpen {
namespace {

/// An error of the command line for which CLI11 has no class.
class UnknownWord : public CLI::ParseError {
 public:
  explicit UnknownWord(const std::string& message)
      : ParseError("UnknownWord", message, CLI::ExitCodes::ExtrasError) {}
};

/// "unknown WHAT 'WORD'; did you mean 'NEAREST'?"
std::string unknown_text(const std::string& what, const std::string& word,
                         const std::vector<std::string>& known) {
  const std::string near = sim::nearest_word(word, known);
  return "unknown " + what + " '" + word + "'" +
         (near.empty() ? "" : "; did you mean '" + near + "'?");
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) continue;
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

}  // namespace

CommandLine::CommandLine(std::string name)
    : app("Playpen: a 2D robot arena for Player and CCMorse client programs", "playpen"),
      invocation(std::move(name)) {
  app.set_version_flag("-V,--version", "playpen " PLAYPEN_VERSION, "Print the version and exit");
  app.set_help_flag("-h,--help", "Print this help and exit");
  app.require_subcommand(0, 1);
  app.formatter(std::make_shared<HelpFormatter>(*this));  // commands inherit the formatter
  app.footer(
      "Exit status: 0 success, 1 the program failed, 2 bad input.\n"
      "'playpen help COMMAND' explains a command, 'playpen doc' shows the\n"
      "documentation, 'playpen list' shows worlds, tasks and models, and\n"
      "'playpen doctor' checks whether all features work.");
  add_run(*this);
  add_grade(*this);
  add_class(*this);
  add_batch(*this);
  add_serve(*this);
  add_new(*this);
  add_import(*this);
  add_list(*this);
  add_check(*this);
  add_render(*this);
  add_plot(*this);
  add_diff(*this);
  add_expect(*this);
  add_fuzz(*this);
  add_why(*this);
  add_replay(*this);
  add_token(*this);
  add_doc(*this);
  add_doctor(*this);
  add_contain(*this);
  add_completion(*this);
  add_help(*this);
}

CLI::App& CommandLine::add_command(const std::string& name, const std::string& description) {
  CLI::App& command = *app.add_subcommand(name, description);
  command.group("Commands");
  command.set_help_flag("-h,--help", "Print this help and exit");
  return command;
}

CLI::Option* CommandLine::takes(CLI::Option* option, ValueKind::Kind kind) {
  value_kinds[option] = {kind, {}};
  return option;
}

CLI::Option* CommandLine::takes(CLI::Option* option, std::vector<std::string> choices) {
  value_kinds[option] = {ValueKind::Kind::kChoice, std::move(choices)};
  return option;
}

std::vector<const CLI::App*> CommandLine::commands() const {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

const CLI::App& CommandLine::command(const std::string& name) const {
  std::vector<std::string> names;
  for (const CLI::App* command : commands()) {
    if (command->get_name() == name) return *command;
    names.push_back(command->get_name());
  }
  throw UnknownWord(unknown_text("command", name, names));
}

int CommandLine::run(std::vector<std::string> arguments) {
  // What follows `run ... --` or `grade ... --` belongs to another program. CLI11 must not parse
  // it; it would split "[a,b]".
  const auto takes_program = [&](const CLI::App* command) {
    return !arguments.empty() && command->get_name() == arguments.front();
  };
  if (std::any_of(with_program.begin(), with_program.end(), takes_program)) {
    const auto end = std::find(arguments.begin(), arguments.end(), "--");
    if (end != arguments.end()) program.assign(end + 1, arguments.end());
    arguments.erase(end, arguments.end());
  }
  call = {invocation};
  call.insert(call.end(), arguments.begin(), arguments.end());
  std::reverse(arguments.begin(), arguments.end());  // the order that CLI11 expects
  try {
    app.parse(std::move(arguments));
    if (app.get_subcommands().empty()) std::cout << app.help();
  } catch (const CLI::ParseError& error) {
    return explain(error);
  }
  return status;
}

int CommandLine::explain(const CLI::ParseError& error) const {
  // Help and version are exceptions, too.
  if (error.get_exit_code() == 0) return app.exit(error) == 0 ? kOk : kBadInput;
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  const CLI::App& command = chosen.empty() ? app : *chosen.front();
  const std::string name = chosen.empty() ? "playpen" : "playpen " + command.get_name();

  // An unknown word may be the reason why another argument is missing.
  std::string message = error.what();
  const std::vector<std::string> unknown = app.remaining(true);
  const auto option = std::find_if(unknown.begin(), unknown.end(), [](const std::string& word) {
    return word.size() > 1 && word.front() == '-';
  });
  if (option != unknown.end()) {
    message = unknown_text("option", option->substr(0, option->find('=')), option_names(command));
  } else if (!unknown.empty() && chosen.empty()) {
    std::vector<std::string> names;
    for (const CLI::App* known : commands()) names.push_back(known->get_name());
    message = unknown_text("command", unknown.front(), names);
  } else if (!unknown.empty()) {
    message = "unexpected argument '" + unknown.front() + "'";
    if (with_program.contains(&command)) {
      message +=
          "; the client program follows '--', as in\n  " + name + " ... -- " + unknown.front();
    }
  }
  std::cerr << name << ": " << message << '\n'
            << "'playpen help" << (chosen.empty() ? "" : ' ' + command.get_name())
            << "' tells more.\n";
  return kBadInput;
}

}  // namespace playpen
