// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <string>

#include "command_line.h"
#include "parsed_option.h"
#include "run_options.h"

namespace playpen {

bool is_page_name(const std::string& name) { return is_file_name(name, ".html"); }

CLI::Option* add_replay_size(CLI::App& command, double& most_megabytes) {
  return add_parsed(command, "--replay-size",
                    "Size of a replay at most; it says what is left out to meet it [5]", "MB",
                    "a number of megabytes in [0.2, 1000]", [&most_megabytes](const auto& text) {
                      return parse_number(text, most_megabytes) && most_megabytes >= 0.2 &&
                             most_megabytes <= 1000.0;
                    });
}

void add_replay(CommandLine& line) {
  const auto request = std::make_shared<ReplayRequest>();
  CLI::App& command = line.add_command("replay", "Write a run as one page for a browser");
  CLI::Option* const first = command.add_option(
      "first", request->first, "Folder of results of a run, or of 'playpen grade'");
  line.takes(first->required()->type_name(""), ValueKind::Kind::kFolder);
  CLI::Option* const second = command.add_option("second", request->second,
                                                 "Folder of another run, shown beside the first");
  line.takes(second->type_name(""), ValueKind::Kind::kFolder);
  CLI::Option* const html =
      add_parsed(command, "--html", "Page to write [FIRST/replay.html]", "FILE",
                 "a file ending in .html", [request](const std::string& text) {
                   request->file = text;
                   return is_page_name(text);
                 });
  line.takes(html, ValueKind::Kind::kFile);
  add_parsed(command, "--at", "Simulated time at which the printed address opens the page [s] [0]",
             "SECONDS", "a number of seconds of at least 0", [request](const std::string& text) {
               double time_s = 0.0;
               const bool good = parse_number(text, time_s) && time_s >= 0.0 && time_s <= 1e9;
               if (good) request->time_s = time_s;
               return good;
             });
  command.add_option("--robot", request->robot, "Robot that the printed address chooses [none]")
      ->type_name("NAME");
  add_replay_size(command, request->most_megabytes);
  CLI::Option* const mcap =
      add_parsed(command, "--mcap", "Write the run as an MCAP file instead of a page", "FILE",
                 "a file ending in .mcap", [request](const std::string& text) {
                   request->mcap_file = text;
                   return is_file_name(text, ".mcap");
                 });
  line.takes(mcap, ValueKind::Kind::kFile);
  for (const char* of_page : {"--html", "--at", "--robot", "--replay-size"}) {
    mcap->excludes(command.get_option(of_page));
  }
  mcap->excludes(second);
  command.footer(
      "Makes the run again from its recording and writes one HTML file, which needs no\n"
      "network and no other file: robots, scans, layers, commands, readings, events and\n"
      "printed lines at each moment. Of a grade, each run gets its page. For example:\n"
      "  playpen replay out/run\n"
      "  playpen replay out/before out/after --html compared.html\n"
      "  playpen replay out/run --at 31.4 --robot r1\n"
      "  playpen replay out/run --mcap run.mcap\n"
      "Exit status: 0 written, 2 bad input.");
  command.callback([request, &line] { line.status = make_replay(*request); });
}

}  // namespace playpen
