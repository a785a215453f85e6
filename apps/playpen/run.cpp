// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "commands.h"
#include "grade/task.h"
#include "playerlike/host/program.h"
#include "playerlike/host/report_summary.h"
#include "playerlike/host/results.h"
#include "sim/simulation/simulation.h"
#include "viewer_process.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReport = "report.json";
constexpr const char* kTrajectory = "trajectory.csv";  // made when the program connects

/// Makes the output folder and takes results of earlier runs out of it, so that what lies there
/// afterwards is of this run.
void prepare_outputs(const playerlike::RunSettings& settings) {
  std::error_code error;
  fs::create_directories(settings.output_folder, error);
  if (error || !fs::is_directory(settings.output_folder, error)) {
    throw std::runtime_error("the output folder '" + settings.output_folder +
                             "' can't be made: " + error.message());
  }
  playerlike::remove_results(settings.output_folder);
  if (settings.film.empty()) return;
  // A film that is a folder of pictures ends in a slash, maybe.
  const fs::path film = fs::absolute(settings.film);
  const fs::path film_folder = (film.has_filename() ? film : film.parent_path()).parent_path();
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
            << (folder / "canvas.png").string() << ", " << (folder / "layers").string() << '/';
  if (settings.snapshot_period_s) std::cout << ", " << (folder / "snapshots").string() << '/';
  std::cout << '\n';
  if (!settings.film.empty()) std::cout << "film: " << settings.film << '\n';
}

/// Lets time follow the wall clock, as people need it who watch.
/// @throws std::runtime_error if lockstep was asked for.
void pace(playerlike::RunSettings& settings, const sim::WorldDescription& world) {
  if (settings.time_mode == sim::TimeMode::kLockstep) {
    throw std::runtime_error(
        "--view shows a run in real time, so it can't go with --time lockstep; leave that out, or "
        "give a factor such as --time 4");
  }
  if (settings.time_mode || world.simulation.time_mode == sim::TimeMode::kPaced) return;
  settings.time_mode = sim::TimeMode::kPaced;
  settings.time_factor = 1.0;
}

}  // namespace

int run(RunRequest request) {
  const std::string world_file = find_world(request.world);
  sim::WorldDescription world = sim::load_world(world_file);
  request.settings.apply_to(world);  // says what does not go with the world before the run
  request.command.front() = playerlike::find_program(request.command.front());
  playerlike::RunSettings& settings = request.settings;
  if (settings.output_folder.empty())
    settings.output_folder = "out/" + grade::world_name(world_file);
  if (request.view) pace(settings, world);
  settings.progress = !request.quiet;
  settings.quiet_end = true;
  prepare_outputs(settings);
  if (!request.quiet && !settings.duration_s && !world.simulation.duration_ns) {
    std::cerr << "playpen: the world sets no duration, so the run ends when the program does "
                 "(or give --duration)\n";
  }
  std::optional<ViewerProcess> viewer;
  if (request.view) settings.view_socket = viewer.emplace("Playpen: " + world.name).socket();

  const std::string& program = request.command.front();
  const playerlike::ProgramEnd end =
      playerlike::run_program(request.command, playerlike::run_environment(world_file, settings));

  viewer.reset();  // it has nothing to show any more

  const bool reported = fs::exists(fs::path(settings.output_folder) / kReport);
  if (reported && !request.quiet) print_results(settings);
  if (!end.success()) {
    std::cerr << "playpen: " << program << ' ' << end.text() << '\n';
    return kProgramFailed;
  }
  if (!reported && fs::exists(fs::path(settings.output_folder) / kTrajectory)) {
    std::cerr << "playpen: there is no report: " << program
              << " was cut short in the middle of the run, or the results could not be written\n";
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
