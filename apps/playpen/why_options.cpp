// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <string>

#include "command_line.h"
#include "parsed_option.h"

namespace playpen {

void add_why(CommandLine& line) {
  const auto request = std::make_shared<WhyRequest>();
  CLI::App& command = line.add_command("why", "Explain why a run failed, or what was odd in it");
  CLI::Option* const folder = command.add_option(
      "folder", request->folder, "Folder of results of a run, or of 'playpen grade'");
  line.takes(folder->required()->type_name(""), ValueKind::Kind::kFolder);
  command
      .add_option("--robot", request->robot,
                  "Robot to explain [the one with a goal, else the first commanded one]")
      ->type_name("NAME");
  CLI::Option* const out =
      add_parsed(command, "--out", "Picture of the decisive moment [FOLDER/why.png]", "FILE.png",
                 "a file ending in .png", [request](const std::string& text) {
                   request->file = text;
                   return is_file_name(text, ".png");
                 });
  line.takes(out, ValueKind::Kind::kFile);
  CLI::Option* const json =
      command.add_option("--json", request->json_file, "The reasons as JSON [none]");
  line.takes(json->type_name("FILE"), ValueKind::Kind::kFile);
  command.footer(
      "Makes the run again from its recording and looks for reasons: what the robot hit\n"
      "first, since when a sensor had shown it and what the program commanded; reads\n"
      "and commands that failed to come; commands beyond the robot's limits; traps, the\n"
      "goal, stalls, turning on the spot. The most likely reason comes first. Of a\n"
      "grade, each failed run is explained. For example:\n"
      "  playpen why out/run\n"
      "  playpen why out/grade --robot r1\n"
      "Exit status: 0 explained, 2 bad input.");
  command.callback([request, &line] { line.status = explain(*request); });
}

}  // namespace playpen
