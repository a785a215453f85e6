// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <string>

#include "command_line.h"
#include "isolation.h"
#include "parsed_option.h"
#include "run_options.h"

namespace playpen {

void add_isolation(CommandLine& line, CLI::App& command, IsolationSettings& settings) {
  CLI::Option* const option = add_parsed(
      command, "--isolated",
      "Run the program in a sandbox, apart from the simulation: off, best (if this machine can) or "
      "required [" +
          std::string(settings.level == Isolation::kRequired ? "required" : "off") + "]",
      "LEVEL", "off, best or required", [&settings](const std::string& text) {
        if (text == "off") settings.level = Isolation::kOff;
        if (text == "best") settings.level = Isolation::kBest;
        if (text == "required") settings.level = Isolation::kRequired;
        return text == "off" || text == "best" || text == "required";
      });
  line.takes(option, {"off", "best", "required"});
  CLI::Option* const readable =
      command.add_option("--readable", settings.readable,
                         "With --isolated: a file or folder that the program may read besides its "
                         "own; can be repeated");
  line.takes(readable->type_name("PATH")->expected(1)->take_all()->needs(option),
             ValueKind::Kind::kFile);
}

// A command for this program's own use: isolated runs are in a process that is called so.
void add_contain(CommandLine& line) {
  const auto request = std::make_shared<ContainRequest>();
  CLI::App& command = line.add_command("contain", "Run a program in a sandbox");
  command.group("");  // neither help nor completion show it
  line.with_program.insert(&command);
  command.add_option("--preload", request->preloaded);
  command.add_option("--readable", request->readable)->expected(1)->take_all();
  command.add_option("--hidden", request->hidden)->expected(1)->take_all();
  command.add_flag("--unsized", request->unsized);
  command.add_flag("--build", request->build);
  command.callback([request, &line] {
    if (line.program.empty()) throw CLI::RequiredError("-- PROGRAM");
    request->command = line.program;
    line.status = contain(*request);
  });
}

}  // namespace playpen
