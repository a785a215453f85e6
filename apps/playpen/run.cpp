// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <csignal>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "commands.h"
#include "playerlike/host/kept_results.h"
#include "playerlike/host/program.h"
#include "playerlike/server/server.h"
#include "preload.h"
#include "run_outputs.h"
#include "shipped.h"
#include "viewer_process.h"

namespace playpen {
namespace {

constexpr const char* kTrajectory = "trajectory.csv";  // created when the program connects

bool in_lockstep(const playerlike::RunSettings& settings, const sim::WorldDescription& world) {
  return settings.time_mode.value_or(world.simulation.time_mode) == sim::TimeMode::kLockstep;
}

// Playpen reports the end of the run to a program by an exception. Programs that treat it as an
// error end with their status for all errors. Other statuses are the program's own result.
bool only_says_that_the_run_is_over(const playerlike::ProgramEnd& end,
                                    const playerlike::RunSettings& settings,
                                    const sim::WorldDescription& world) {
  constexpr int kReturnedMinusOne = 255;
  if (end.signal || (end.status != 1 && end.status != kReturnedMinusOne)) return false;
  std::optional<double> duration_s = settings.duration_s;
  if (!duration_s && world.simulation.duration_ns) {
    duration_s = sim::to_seconds(*world.simulation.duration_ns);
  }
  constexpr double kRounding_s = 1e-6;
  return duration_s && simulated_time(settings) > *duration_s - kRounding_s;
}

bool is_crash(int signal) {
  for (const int crash : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS}) {
    if (signal == crash) return true;
  }
  return false;
}

// Quotes a word for the shell.
std::string shell_word(const std::string& word) {
  constexpr const char* kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=,:+@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

// Prints advice about a program that was ended by a signal.
void tell_more(const RunRequest& request, const std::string& world,
               const playerlike::ProgramEnd& end, bool completed) {
  if (end.forced) {
    std::cerr << "playpen: it had been asked to end, and did not\n";
  }
  if (completed) std::cerr << "playpen: the results are those until then\n";
  if (!end.signal || !is_crash(*end.signal)) return;
  std::string command;
  for (const std::string& word : request.command) command += ' ' + shell_word(word);
  std::cerr << "playpen: to see where it happened: playpen run --real-sleep " << shell_word(world)
            << " -- gdb -ex run --args" << command << '\n';
}

// Prints how the run ended. @return the command's exit code.
int verdict(const RunRequest& request, const sim::WorldDescription& world,
            const playerlike::ProgramEnd& end, bool completed) {
  const playerlike::RunSettings& settings = request.settings;
  const std::string& program = request.command.front();
  const bool reported = has_report(settings);
  if (reported && !has_pictures(settings)) {
    std::cerr << "playpen: not all pictures could be written; the reason is above\n";
    return kProgramFailed;
  }
  if (reported && !request.quiet) print_results(settings);
  if (reported && only_says_that_the_run_is_over(end, settings, world)) {
    if (!request.quiet) {
      std::cerr << "playpen: " << program << ' ' << end.text() << " when the run was over\n";
    }
    return kOk;
  }
  if (!end.success()) {
    std::cerr << "playpen: " << program << ' ' << end.text() << '\n';
    tell_more(request, request.world, end, completed);
    return kProgramFailed;
  }
  if (completed) {
    std::cerr << "playpen: " << program
              << " left in the middle of the run (by _exit?); the results are those until then\n";
    return kProgramFailed;
  }
  if (!reported &&
      std::filesystem::exists(std::filesystem::path(settings.output_folder) / kTrajectory)) {
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

}  // namespace

int run(RunRequest request) {
  if (request.world.starts_with("tcp://") || request.world.starts_with("player://")) {
    throw std::runtime_error(
        "playpen run makes a simulation of its own; for the one of a server, "
        "start the program itself: PLAYPEN_WORLD=" +
        request.world + ' ' + request.command.front());
  }
  const std::string world_file = find_world(request.world);
  sim::WorldDescription world = load_found_world(world_file);
  request.settings.apply_to(world);  // reports settings that do not match the world before the run
  request.command.front() = playerlike::find_program(request.command.front());
  playerlike::RunSettings& settings = request.settings;
  if (settings.player_port) {
    // Before results of an earlier run are removed; the program's simulation opens the ports.
    playerlike::Server::check(playerlike::onlooker_settings(*settings.player_port), world);
  }
  if (request.view) pace_for_view(settings, world);
  settings.progress = !request.quiet;
  settings.quiet_end = true;
  prepare_outputs(settings, world_file);
  if (!request.quiet && !settings.duration_s && !world.simulation.duration_ns) {
    std::cerr << "playpen: the world sets no duration, so the run ends when the program does "
                 "(or give --duration)\n";
  }
  std::optional<ViewerProcess> viewer;
  if (request.view) settings.view_socket = viewer.emplace("Playpen: " + world.name).socket();

  std::optional<PreloadedLibrary> virtual_time;
  settings.virtual_time = !request.real_sleep && in_lockstep(settings, world);
  const playerlike::KeptRun kept;
  settings.kept_run = kept.file();
  playerlike::EnvironmentChanges environment = playerlike::run_environment(world_file, settings);
  add_libraries_folder(environment);
  if (settings.virtual_time) virtual_time.emplace().add_to(environment);
  playerlike::RunWatch watch;
  watch.kept = &kept;
  watch.tell = [](const std::string& text) { std::cerr << "playpen: " << text << '\n'; };
  bool completed = false;
  watch.on_end = [&](const playerlike::ProgramEnd& program_end) {
    try {
      completed = playerlike::complete_results(kept, world, settings, program_end);
    } catch (const std::exception& e) {
      std::cerr << "playpen: results of the run are missing: " << e.what() << '\n';
    }
  };
  const playerlike::ProgramEnd end = playerlike::run_program(request.command, environment, watch);

  viewer.reset();  // the window has nothing left to show

  return verdict(request, world, end, completed);
}

}  // namespace playpen
