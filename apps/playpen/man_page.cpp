// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "man_page.h"

#include <sstream>
#include <vector>

#include "environment.h"

namespace playpen {
namespace {

/// Escapes a text for roff: a minus that can be copied, and no line that looks like a request.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const bool starts_line = result.empty() || result.back() == '\n';
    if (starts_line && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
  }
  return result;
}

/// "-h, --help" or "--duration S".
std::string option_heading(const CLI::Option& option) {
  std::string names;
  for (const std::string& name : option.get_snames()) {
    names += (names.empty() ? "" : ", ") + std::string("\\fB") + escaped('-' + name) + "\\fR";
  }
  for (const std::string& name : option.get_lnames()) {
    names += (names.empty() ? "" : ", ") + std::string("\\fB") + escaped("--" + name) + "\\fR";
  }
  const bool has_value = option.get_items_expected_max() > 0 && !option.get_type_name().empty();
  return has_value ? names + " \\fI" + escaped(option.get_type_name()) + "\\fR" : names;
}

bool takes_many(const CLI::Option& option) { return option.get_items_expected_max() > 1; }

/// "playpen run [OPTION...] world -- PROGRAM [ARGUMENT...]".
std::string synopsis(const CommandLine& line, const CLI::App& command) {
  std::string text = "\\fBplaypen " + escaped(command.get_name()) + "\\fR [\\fIOPTION\\fR...]";
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group().empty()) continue;
    if (!option->get_positional()) {
      if (option->get_required()) text += ' ' + option_heading(*option);
      continue;
    }
    const std::string name =
        "\\fI" + escaped(option->get_name()) + "\\fR" + (takes_many(*option) ? "..." : "");
    text += option->get_required() ? ' ' + name : " [" + name + ']';
  }
  if (line.with_program.contains(&command)) {
    text += " \\fB\\-\\-\\fR \\fIPROGRAM\\fR [\\fIARGUMENT\\fR...]";
  }
  return text;
}

void write_options(std::ostream& page, const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;  // hidden
    page << ".TP\n"
         << (option->get_positional() ? "\\fI" + escaped(option->get_name()) + "\\fR"
                                      : option_heading(*option))
         << '\n'
         << escaped(option->get_description()) << ".\n";
  }
}

/// A footer, line by line, because it is laid out for terminals.
void write_footer(std::ostream& page, const std::string& footer) {
  if (footer.empty()) return;
  page << ".PP\n.nf\n" << escaped(footer) << "\n.fi\n";
}

}  // namespace

std::string man_page(const CommandLine& line) {
  std::ostringstream page;
  page << ".\\\" Written by 'playpen help --man'.\n"
       << ".TH PLAYPEN 1 \"\" \"playpen " PLAYPEN_VERSION "\" \"User Commands\"\n"
       << ".SH NAME\nplaypen \\- "
       << escaped("a 2D robot arena for Player and CCMorse client programs") << "\n.SH SYNOPSIS\n";
  const std::vector<const CLI::App*> commands = line.commands();
  for (const CLI::App* command : commands) {
    page << (command == commands.front() ? "" : ".br\n") << synopsis(line, *command) << '\n';
  }
  page << ".SH DESCRIPTION\n"
       << escaped(
              "Playpen simulates robots in a plane, for client programs that use Player's or "
              "CCMorse's interface. A program that is linked with Playpen drives them in its own "
              "process: nothing needs to be started beside it, and no display is needed.")
       << "\n.PP\nThe command \\fBplaypen\\fR runs such programs on worlds, judges them, and shows "
          "what there is.\n.SH OPTIONS\n";
  write_options(page, line.app);
  page << ".SH COMMANDS\n";
  for (const CLI::App* command : commands) {
    page << ".SS " << synopsis(line, *command) << '\n'
         << escaped(command->get_description()) << ".\n";
    write_options(page, *command);
    write_footer(page, command->get_footer());
  }
  page << ".SH EXIT STATUS\n";
  write_footer(page, line.app.get_footer());
  page << ".SH ENVIRONMENT\n"
       << escaped(
              "'playpen run' and 'playpen grade' set those that are marked with * for the "
              "program, whatever the shell holds.")
       << '\n';
  for (const EnvironmentVariable& variable : environment_variables()) {
    page << ".TP\n\\fB" << variable.name << "\\fR" << (variable.run_sets ? " *" : "") << '\n'
         << escaped(variable.meaning) << '\n';
  }
  page << ".SH FILES\n.TP\n\\fIPREFIX/share/playpen/worlds\\fR\nThe worlds, tasks and robot models "
          "that have names.\n.TP\n\\fIPREFIX/share/playpen/templates\\fR\nWhat 'playpen new' "
          "copies.\n.TP\n\\fIPREFIX/share/playpen/docs\\fR\nThe pages of 'playpen "
          "doc'.\n.TP\n\\fIout/WORLD\\fR\nThe results of a run: pictures, report and "
          "trajectory.\n";
  return page.str();
}

}  // namespace playpen
