// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <memory>
#include <string>

#include "command_line.h"
#include "man_page.h"

namespace playpen {

void add_help(CommandLine& line) {
  struct Request {
    std::string command;
    bool man = false;
  };
  const auto request = std::make_shared<Request>();
  CLI::App& command =
      line.add_command("help", "Print the help of playpen or of one of its commands");
  CLI::Option* const about =
      command.add_option("command", request->command, "The command to tell more of");
  about->type_name("");
  std::vector<std::string> names;
  for (const CLI::App* known : line.commands()) names.push_back(known->get_name());
  line.takes(about, names);
  command.add_flag("--man", request->man, "Print the manual page, for man(1)")->excludes(about);
  command.callback([request, &line] {
    if (request->man) {
      std::cout << man_page(line);
    } else if (request->command.empty()) {
      // App::help() shows the chosen command, which is this one.
      std::cout << line.app.get_formatter()->make_help(&line.app, line.app.get_name(),
                                                       CLI::AppFormatMode::Normal);
    } else {
      std::cout << line.command(request->command).help(line.app.get_name());
    }
  });
}

}  // namespace playpen
