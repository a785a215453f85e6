// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "run_outputs.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <system_error>

#include "grade/task.h"
#include "playerlike/host/report_summary.h"
#include "playerlike/host/results.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;

fs::path report_of(const playerlike::RunSettings& settings) {
  return fs::path(settings.output_folder) / "report.json";
}

// Creates a folder for results, unless it exists. @throws std::runtime_error with the reason.
void make_writable(const std::string& folder) {
  const auto refuse = [&folder](const char* what, const std::string& reason) {
    throw std::runtime_error("the output folder '" + folder + "' can't be " + what + ": " + reason +
                             "; --out DIR chooses another one");
  };
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder, error)) {
    refuse("made", error ? error.message() : "it is a file");
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0) refuse("written", std::strerror(errno));
}

}  // namespace

void choose_output_folder(playerlike::RunSettings& settings, const std::string& world_file) {
  if (settings.output_folder.empty()) {
    settings.output_folder = "out/" + grade::world_name(world_file);
  }
}

void prepare_outputs(playerlike::RunSettings& settings, const std::string& world_file) {
  choose_output_folder(settings, world_file);
  make_writable(settings.output_folder);
  std::error_code error;
  playerlike::remove_results(settings.output_folder);
  if (settings.film.empty()) return;
  // The name of a film that is a folder of pictures may end in a slash.
  const fs::path film = fs::absolute(settings.film);
  const fs::path film_folder = (film.has_filename() ? film : film.parent_path()).parent_path();
  if (!fs::is_directory(film_folder, error)) {
    throw std::runtime_error("the folder of the film, '" + film_folder.string() +
                             "', does not exist");
  }
  if (fs::is_regular_file(settings.film, error)) fs::remove(settings.film, error);
}

bool has_report(const playerlike::RunSettings& settings) { return fs::exists(report_of(settings)); }

bool has_pictures(const playerlike::RunSettings& settings) {
  const fs::path folder(settings.output_folder);
  return fs::is_regular_file(folder / "scene.png") && fs::is_regular_file(folder / "canvas.png");
}

double simulated_time(const playerlike::RunSettings& settings) {
  return playerlike::simulated_time_of_report(report_of(settings));
}

void print_results(const playerlike::RunSettings& settings) {
  const fs::path folder(settings.output_folder);
  std::cout << playerlike::summarize_report(report_of(settings))
            << "pictures: " << (folder / "scene.png").string() << ", "
            << (folder / "canvas.png").string() << ", " << (folder / "layers").string() << '/';
  if (settings.snapshot_period_s) std::cout << ", " << (folder / "snapshots").string() << '/';
  std::cout << '\n';
  if (!settings.film.empty() && fs::exists(settings.film)) {
    std::cout << "film: " << settings.film << '\n';
  }
}

void pace_for_view(playerlike::RunSettings& settings, const sim::WorldDescription& world) {
  if (settings.time_mode || world.simulation.time_mode == sim::TimeMode::kPaced) return;
  settings.time_mode = sim::TimeMode::kPaced;
  settings.time_factor = 1.0;
}

}  // namespace playpen
