// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <system_error>

#include "commands.h"
#include "playerlike/host/program.h"
#include "playerlike/host/report_summary.h"
#include "sim/simulation/simulation.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReport = "report.json";

/// Where results go unless the user says so: a folder of the world's name in out/.
std::string default_output_folder(const std::string& world_file) {
  return "out/" + (world_file.empty() ? "default" : fs::path(world_file).stem().string());
}

/// Makes the output folder and takes results of earlier runs out of it, so that what lies there
/// afterwards is of this run.
void prepare_outputs(const playerlike::RunSettings& settings) {
  std::error_code error;
  fs::create_directories(settings.output_folder, error);
  if (error || !fs::is_directory(settings.output_folder, error)) {
    throw std::runtime_error("the output folder '" + settings.output_folder +
                             "' can't be made: " + error.message());
  }
  for (const char* name : {kReport, "scene.png", "canvas.png", "trajectory.csv"}) {
    const fs::path file = fs::path(settings.output_folder) / name;
    fs::remove(file, error);
    if (error) throw fs::filesystem_error("an earlier result can't be removed", file, error);
  }
  if (settings.film.empty()) return;
  const fs::path film_folder = fs::absolute(settings.film).parent_path();
  if (!fs::is_directory(film_folder, error)) {
    throw std::runtime_error("the folder of the film, '" + film_folder.string() +
                             "', does not exist");
  }
  if (fs::is_regular_file(settings.film, error)) fs::remove(settings.film, error);
}

void print_results(const playerlike::RunSettings& settings) {
  const fs::path folder(settings.output_folder);
  std::cout << playerlike::summarize_report(folder / kReport)
            << "pictures: " << (folder / "scene.png").string() << ", "
            << (folder / "canvas.png").string() << '\n';
  if (!settings.film.empty()) std::cout << "film: " << settings.film << '\n';
}

}  // namespace

int run(RunRequest request) {
  const std::string world_file = find_world(request.world);
  const sim::WorldDescription world = sim::load_world(world_file);
  request.command.front() = playerlike::find_program(request.command.front());
  playerlike::RunSettings& settings = request.settings;
  if (settings.output_folder.empty()) settings.output_folder = default_output_folder(world_file);
  settings.progress = !request.quiet;
  settings.quiet_end = true;
  prepare_outputs(settings);
  if (!request.quiet && !settings.duration_s && !world.simulation.duration_ns) {
    std::cerr << "playpen: the world sets no duration, so the run ends when the program does "
                 "(or give --duration)\n";
  }

  const std::string& program = request.command.front();
  const playerlike::ProgramEnd end =
      playerlike::run_program(request.command, playerlike::run_environment(world_file, settings));

  const bool reported = fs::exists(fs::path(settings.output_folder) / kReport);
  if (reported && !request.quiet) print_results(settings);
  if (!end.success()) {
    std::cerr << "playpen: " << program << ' ' << end.text() << '\n';
    return kProgramFailed;
  }
  if (!reported) {
    std::cerr << "playpen: " << program
              << " never connected to a simulation, so there is no report; does it make a "
                 "PlayerClient for \"localhost\", and is it linked with Playpen?\n";
    return kProgramFailed;
  }
  return kOk;
}

}  // namespace playpen
