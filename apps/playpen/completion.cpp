// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Shell completion scripts, generated from the description of the command line.
#include <algorithm>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "command_line.h"

namespace playpen {
namespace {

using Kind = ValueKind::Kind;

ValueKind kind_of(const CommandLine& line, const CLI::Option& option) {
  const auto found = line.value_kinds.find(&option);
  return found == line.value_kinds.end() ? ValueKind{} : found->second;
}

bool has_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

bool is_shown(const CLI::Option& option) { return !option.get_group().empty(); }

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  return names;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

/// A text in single quotes, in the shell's syntax; `inner_quote` replaces a quote in the text.
std::string quoted(const std::string& text, const std::string& inner_quote = "'\\''") {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? inner_quote : std::string(1, c);
  return result + '\'';
}

/// The first line of a description; shells show one line per word.
std::string summary(const CLI::Option& option) { return option.get_description(); }

std::vector<const CLI::Option*> options_of(const CLI::App& app, bool positional) {
  std::vector<const CLI::Option*> options;
  for (const CLI::Option* option : app.get_options()) {
    if (is_shown(*option) && option->get_positional() == positional) options.push_back(option);
  }
  return options;
}

std::vector<std::string> command_names(const CommandLine& line) {
  std::vector<std::string> names;
  for (const CLI::App* command : line.commands()) names.push_back(command->get_name());
  return names;
}

// --- bash ---------------------------------------------------------------------------------------

/// The call that completes values of this kind.
std::string bash_call(const ValueKind& kind) {
  switch (kind.kind) {
    case Kind::kFile:
      return "_playpen_files";
    case Kind::kFolder:
      return "_playpen_folders";
    case Kind::kWorld:
      return "_playpen_named worlds";
    case Kind::kTask:
      return "_playpen_named tasks";
    case Kind::kNamedFile:
      return "_playpen_named";
    case Kind::kPage:
      return "_playpen_words \"$(\"$playpen\" doc --names 2>/dev/null)\"";
    case Kind::kChoice:
      return "_playpen_words " + quoted(joined(kind.choices, " "));
    case Kind::kAnything:
      break;
  }
  return ":";
}

std::string bash_options(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options_of(app, false)) {
    for (const std::string& name : names_of(*option)) names.push_back(name);
  }
  return "_playpen_words " + quoted(joined(names, " "));
}

void write_bash_command(std::ostream& out, const CommandLine& line, const CLI::App& command) {
  out << "    " << command.get_name() << ")\n      case $previous in\n";
  for (const CLI::Option* option : options_of(command, false)) {
    if (!has_value(*option)) continue;
    out << "        " << joined(names_of(*option), " | ") << ") "
        << bash_call(kind_of(line, *option)) << "; return ;;\n";
  }
  out << "      esac\n      if [[ $current == -* ]]; then\n        " << bash_options(command)
      << "\n        return\n      fi\n";
  const std::vector<const CLI::Option*> arguments = options_of(command, true);
  if (!arguments.empty()) {
    out << "      case $place in\n";
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      const bool takes_rest = arguments[i]->get_items_expected_max() > 1;
      out << "        " << (takes_rest ? "*" : std::to_string(i)) << ") "
          << bash_call(kind_of(line, *arguments[i])) << " ;;\n";
    }
    out << "      esac\n";
  }
  out << "      ;;\n";
}

std::string bash_script(const CommandLine& line) {
  std::vector<std::string> with_value;
  std::vector<std::string> with_program;
  for (const CLI::App* command : line.commands()) {
    for (const CLI::Option* option : options_of(*command, false)) {
      if (!has_value(*option)) continue;
      for (const std::string& name : names_of(*option)) {
        if (std::find(with_value.begin(), with_value.end(), name) == with_value.end()) {
          with_value.push_back(name);
        }
      }
    }
    if (line.with_program.contains(command)) with_program.push_back(command->get_name());
  }
  std::ostringstream out;
  out << R"bash(# Completion of playpen for bash, written by 'playpen completion bash'. To use it:
#   source <(playpen completion bash)

_playpen_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$current"); }
_playpen_files() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -f -- "$current")
}
_playpen_folders() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -d -- "$current")
}
# The names of shipped files, and files of the folder.
_playpen_named() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(
    compgen -W "$("$playpen" list "$@" --names 2>/dev/null)" -- "$current"
    compgen -f -X '!*.json' -- "$current"
    compgen -d -- "$current"
  )
}

_playpen() {
  local playpen=$1 current=$2 previous=$3 command='' place=0 i word takes_value=''
  COMPREPLY=()
  # The shell takes --option=value for three words.
  if [[ $current == '=' ]]; then
    current=''
  elif [[ $previous == '=' ]]; then
    previous=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  for ((i = 1; i < COMP_CWORD; ++i)); do
    word=${COMP_WORDS[i]}
    if [[ $word == '--' ]]; then
      case $command in
)bash";
  if (!with_program.empty()) {
    out << "        " << joined(with_program, " | ") << R"bash()
          # The client program and its arguments.
          if ((i + 1 == COMP_CWORD)) && [[ $current != */* ]]; then
            mapfile -t COMPREPLY < <(compgen -c -- "$current"; compgen -d -- "$current")
          else
            _playpen_files
          fi
          return
          ;;
)bash";
  }
  out << "      esac\n    elif [[ $takes_value || $word == '=' ]]; then\n"
         "      [[ $word == '=' ]] || takes_value=''\n"
         "    elif [[ $word == -* ]]; then\n      case $word in\n        "
      << joined(with_value, " | ") << R"bash() takes_value=1 ;;
      esac
    elif [[ ! $command ]]; then
      command=$word
    else
      ((++place))
    fi
  done
  case $command in
    '')
      if [[ $current == -* ]]; then
        )bash"
      << bash_options(line.app) << "\n      else\n        _playpen_words "
      << quoted(joined(command_names(line), " ")) << "\n      fi\n      ;;\n";
  for (const CLI::App* command : line.commands()) write_bash_command(out, line, *command);
  out << "  esac\n}\ncomplete -F _playpen playpen\n";
  return out.str();
}

// --- zsh ----------------------------------------------------------------------------------------

/// The leading blank makes zsh pass exactly these words to the function.
std::string zsh_action(const ValueKind& kind) {
  switch (kind.kind) {
    case Kind::kFile:
      return "_files";
    case Kind::kFolder:
      return "_files -/";
    case Kind::kWorld:
      return " _playpen_named worlds";
    case Kind::kTask:
      return " _playpen_named tasks";
    case Kind::kNamedFile:
      return " _playpen_named";
    case Kind::kPage:
      return " _playpen_pages";
    case Kind::kChoice:
      return '(' + joined(kind.choices, " ") + ')';
    case Kind::kAnything:
      break;
  }
  return " ";
}

/// Escapes a text for a specification of zsh's _arguments, where some characters are special.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

std::string zsh_script(const CommandLine& line) {
  std::ostringstream out;
  out << "#compdef playpen\n"
         "# Completion of playpen for zsh, written by 'playpen completion zsh'.\n\n"
         "_playpen_named() {\n"
         "  local -a names\n"
         "  names=(${(f)\"$($playpen list \"$@\" --names 2>/dev/null)\"})\n"
         "  compadd -a names\n"
         "  _files -g '*.json'\n"
         "}\n"
         "_playpen_pages() {\n"
         "  local -a names\n"
         "  names=(${(f)\"$($playpen doc --names 2>/dev/null)\"})\n"
         "  compadd -a names\n"
         "}\n\n"
         "_playpen() {\n"
         "  local context state line playpen=$words[1]\n"
         "  local -a commands\n"
         "  commands=(\n";
  for (const CLI::App* command : line.commands()) {
    out << "    " << quoted(command->get_name() + ':' + zsh_text(command->get_description()))
        << '\n';
  }
  out << "  )\n  _arguments -C \\\n";
  for (const CLI::Option* option : options_of(line.app, false)) {
    for (const std::string& name : names_of(*option)) {
      out << "    " << quoted(name + '[' + zsh_text(summary(*option)) + ']') << " \\\n";
    }
  }
  out << "    '1:command:->command' '*::argument:->argument'\n"
         "  case $state in\n"
         "    command) _describe command commands ;;\n"
         "    argument)\n"
         "      case $words[1] in\n";
  for (const CLI::App* command : line.commands()) {
    out << "        " << command->get_name() << ")\n          _arguments";
    for (const CLI::Option* option : options_of(*command, false)) {
      for (const std::string& name : names_of(*option)) {
        std::string specification = name + (has_value(*option) && name.size() > 2 ? "=" : "") +
                                    '[' + zsh_text(summary(*option)) + ']';
        if (has_value(*option)) {
          specification +=
              ':' + zsh_text(option->get_type_name()) + ':' + zsh_action(kind_of(line, *option));
        }
        out << " \\\n            " << quoted(specification);
      }
    }
    std::size_t place = 1;
    for (const CLI::Option* option : options_of(*command, true)) {
      const bool takes_rest = option->get_items_expected_max() > 1;
      out << " \\\n            "
          << quoted((takes_rest ? "*" : std::to_string(place++)) + ':' +
                    zsh_text(option->get_name()) + ':' + zsh_action(kind_of(line, *option)));
    }
    out << "\n          ;;\n";
  }
  out << "      esac\n"
         "      ;;\n"
         "  esac\n"
         "}\n\n"
         "if [[ $zsh_eval_context[-1] == loadautofunc ]]; then\n"
         "  _playpen \"$@\"\n"
         "else\n"
         "  compdef _playpen playpen\n"
         "fi\n";
  return out.str();
}

// --- fish ---------------------------------------------------------------------------------------

std::string fish_quoted(const std::string& text) { return quoted(text, "\\'"); }

/// The options of fish's `complete` for a value of this kind; "" for files.
std::string fish_values(const ValueKind& kind) {
  const auto command = [](const std::string& text) {
    return "-a " + fish_quoted('(' + text + ')');
  };
  switch (kind.kind) {
    case Kind::kFile:
      return "";
    case Kind::kFolder:
      return "-f " + command("__fish_complete_directories");
    case Kind::kWorld:
      return command("playpen list worlds --names");
    case Kind::kTask:
      return command("playpen list tasks --names");
    case Kind::kNamedFile:
      return command("playpen list --names");
    case Kind::kPage:
      return "-f " + command("playpen doc --names");
    case Kind::kChoice:
      return "-f -a " + fish_quoted(joined(kind.choices, " "));
    case Kind::kAnything:
      break;
  }
  return "-f";
}

void write_fish_option(std::ostream& out, const CommandLine& line, const CLI::Option& option,
                       const std::string& condition) {
  out << "complete -c playpen -n " << fish_quoted(condition);
  for (const std::string& name : option.get_lnames()) out << " -l " << name;
  for (const std::string& name : option.get_snames()) out << " -s " << name;
  if (has_value(option)) {
    const std::string values = fish_values(kind_of(line, option));
    out << " -r" << (values.empty() ? " -F" : ' ' + values);
  }
  out << " -d " << fish_quoted(summary(option)) << '\n';
}

std::string fish_script(const CommandLine& line) {
  std::ostringstream out;
  out << "# Completion of playpen for fish, written by 'playpen completion fish'.\n"
         "complete -c playpen -n __fish_use_subcommand -f\n";
  for (const CLI::Option* option : options_of(line.app, false)) {
    write_fish_option(out, line, *option, "__fish_use_subcommand");
  }
  for (const CLI::App* command : line.commands()) {
    out << "complete -c playpen -n __fish_use_subcommand -f -a " << command->get_name() << " -d "
        << fish_quoted(command->get_description()) << '\n';
  }
  for (const CLI::App* command : line.commands()) {
    const std::string condition = "__fish_seen_subcommand_from " + command->get_name();
    for (const CLI::Option* option : options_of(*command, false)) {
      write_fish_option(out, line, *option, condition);
    }
    for (const CLI::Option* option : options_of(*command, true)) {
      const std::string values = fish_values(kind_of(line, *option));
      if (!values.empty()) {
        out << "complete -c playpen -n " << fish_quoted(condition) << ' ' << values << '\n';
      }
    }
  }
  return out.str();
}

}  // namespace

void add_completion(CommandLine& line) {
  const auto shell = std::make_shared<std::string>();
  CLI::App& command =
      line.add_command("completion", "Print the script by which a shell completes this command");
  CLI::Option* const option = command.add_option("shell", *shell, "bash, zsh or fish");
  line.takes(option->required()->type_name(""), {"bash", "zsh", "fish"});
  option->check([](const std::string& text) {
    const bool good = text == "bash" || text == "zsh" || text == "fish";
    return good ? "" : "must be bash, zsh or fish, but is '" + text + "'";
  });
  command.footer(
      "'cmake --install' puts these scripts where shells look for them. To try one:\n"
      "  source <(playpen completion bash)");
  command.callback([shell, &line] {
    std::cout << (*shell == "bash"  ? bash_script(line)
                  : *shell == "zsh" ? zsh_script(line)
                                    : fish_script(line));
  });
}

}  // namespace playpen
