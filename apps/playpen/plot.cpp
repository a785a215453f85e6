// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "command_line.h"
#include "parsed_option.h"
#include "plot_data.h"
#include "plot_page.h"
#include "plot_parts.h"

namespace playpen {

int plot(const PlotRequest& request) {
  std::vector<RunData> runs;
  std::set<std::string> problems;
  std::vector<std::string> folders;
  std::vector<std::string> skipped;
  for (const std::string& folder : request.folders) {
    for (std::string& run : run_folders(folder, skipped)) folders.push_back(std::move(run));
  }
  for (const std::string& folder : skipped) {
    std::cerr << "playpen: left out '" << folder << "': the run has no results\n";
  }
  for (const std::string& folder : folders) {
    RunData& run = runs.emplace_back(read_run(folder));
    measure_clearances(run);
    if (!run.world && problems.insert(run.world_problem).second) {
      std::cerr << "playpen: no clearance and no scene for '" << folder
                << "': " << run.world_problem << '\n';
    }
  }
  write_page(plot_page(runs), request.file, "plot");
  std::cout << "plot: " << request.file << ", of " << runs.size()
            << (runs.size() == 1 ? " run" : " runs") << '\n';
  return kOk;
}

void add_plot(CommandLine& line) {
  const auto request = std::make_shared<PlotRequest>();
  CLI::App& command = line.add_command("plot", "Draw charts and trajectories of runs");
  CLI::Option* const folders =
      command.add_option("folders", request->folders,
                         "Folders of results, as 'playpen run' and 'playpen grade' make them");
  line.takes(folders->required()->type_name(""), ValueKind::Kind::kFolder);
  CLI::Option* const out =
      add_parsed(command, "--out", "Picture to write, .png or .svg [plot.png]", "FILE",
                 "a file ending in .png or .svg", [request](const std::string& text) {
                   request->file = text;
                   return is_file_name(text, ".png") || is_file_name(text, ".svg");
                 });
  line.takes(out, ValueKind::Kind::kFile);
  command.footer(
      "Draws speed, turn rate, clearance and path length over time, and trajectories\n"
      "over the scene of each world. Lines of the second and later runs are dashed.\n"
      "Of a folder of 'playpen grade' it draws all runs. For example:\n"
      "  playpen plot out/first out/second --out compared.png\n"
      "  playpen plot out/grade/par_planning");
  command.callback([request, &line] { line.status = plot(*request); });
}

}  // namespace playpen
