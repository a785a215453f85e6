// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <string>
#include <vector>

#include "command_line.h"
#include "expect/expectation.h"
#include "run_options.h"

namespace playpen {

expect::Expectation parsed_expectation(const std::string& option, const std::string& text) {
  try {
    return expect::Expectation::parse(text);
  } catch (const std::invalid_argument& error) {
    throw CLI::ValidationError(option, error.what());
  }
}

void add_expect(CommandLine& line) {
  const auto request = std::make_shared<ExpectRequest>();
  const auto texts = std::make_shared<std::vector<std::string>>();
  CLI::App& command = line.add_command("expect", "Check the figures of a run, such as collisions");
  command.add_option("expectation", *texts, "FIGURE OPERATOR VALUE, such as \"collisions == 0\"")
      ->required()
      ->type_name("");
  CLI::Option* const folder = command.add_option(
      "--in", request->folder, "Folder of results of a run [none: check the expectations' form]");
  line.takes(folder->type_name("DIR"), ValueKind::Kind::kFolder);
  command.footer(
      "Figures are those of report.json by name, of each robot or, as ROBOT.FIGURE, of\n"
      "one. Operators are == != < <= > >=. 'playpen run --expect' checks its own run.\n"
      "For example:\n"
      "  playpen expect \"collisions == 0\" \"r1.path_length > 10\" --in out/run\n"
      "Exit status: 0 all is as expected, 1 not so, 2 bad input.");
  command.callback([request, texts, &line] {
    for (const std::string& text : *texts) {
      request->expectations.push_back(parsed_expectation("expectation", text));
    }
    line.status = check_expectations(*request);
  });
}

}  // namespace playpen
