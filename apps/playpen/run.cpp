// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <exception>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "commands.h"
#include "debug_call.h"
#include "debugger_hint.h"
#include "page_process.h"
#include "playerlike/connect/open_session.h"
#include "playerlike/host/host.h"
#include "playerlike/host/kept_results.h"
#include "playerlike/host/program.h"
#include "playerlike/host/program_desk.h"
#include "playerlike/host/real_robots.h"
#include "playerlike/process/log.h"
#include "playerlike/server/server.h"
#include "preload.h"
#include "run_outputs.h"
#include "run_start.h"
#include "shipped.h"
#include "sim/core/number_text.h"
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

// Prints advice about a program that was ended by a signal.
void tell_more(const RunRequest& request, const playerlike::ProgramEnd& end, bool completed) {
  if (end.forced) {
    std::cerr << "playpen: it had been asked to end, and did not\n";
  }
  if (completed) std::cerr << "playpen: the results are those until then\n";
  if (!end.signal || !is_crash(*end.signal)) return;
  std::cerr << "playpen: to see where it happened: "
            << debugger_command(request.call, request.command) << '\n';
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
    tell_more(request, end, completed);
    return kProgramFailed;
  }
  if (completed && request.debug) {
    std::cerr << "playpen: gdb has ended the program in the middle of the run; the results are "
                 "those until then\n";
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

/// Writes the replay of the run if it is wanted and there are results.
/// @return whether it is there if it is wanted.
bool write_replay_of(const RunRequest& request) {
  if (request.replay_file.empty() || !has_report(request.settings)) return true;
  try {
    const std::string page =
        write_replay(request.settings.output_folder, request.replay_file, request.replay_megabytes);
    if (!request.quiet) std::cerr << "playpen: replay: " << page << '\n';
    return true;
  } catch (const std::exception& e) {
    std::cerr << "playpen: there is no replay: " << e.what() << '\n';
    return false;
  }
}

/// The world of a run with several programs: this process serves it.
class ServedWorld {
 public:
  /// @param world  with the settings applied.
  ServedWorld(const sim::WorldDescription& world, const playerlike::RunSettings& settings)
      : world_(world), settings_(settings) {}

  /// Starts the server. @return its TCP port.
  int serve() {
    // The terminal of the programs is not the place for a line about each connection.
    const sim::LogHook log = playerlike::log_to_stderr(sim::LogLevel::kWarning);
    playerlike::RunSettings settings = settings_;
    settings.virtual_time = false;  // that is for programs
    settings.quiet_end = false;
    settings.kept_run.clear();
    settings.silence_limit_s = playerlike::silence_limit_s_of_environment();
    settings.open_real_robot = playerlike::open_real_robot;
    if (!settings.time_mode && !world_.simulation.time_mode_given) {
      settings.time_mode = sim::TimeMode::kPaced;
      settings.time_factor = 1.0;
      std::cerr << "playpen: several programs share the world of this run, so simulated time "
                   "follows the wall clock (--time lockstep decides otherwise)\n";
    }
    host_ = playerlike::Host::create(world_, settings, log);
    playerlike::ServerSettings server;
    server.port = 0;
    server.player_port = settings.player_port;
    server_.emplace(host_, server, log);
    for (const std::string& line : server_->player_port_lines()) std::cerr << line << '\n';
    return server_->port();
  }

  /// Ends the run, if there is one. @return whether there is one.
  bool finish(const playerlike::ProgramEnd& end) {
    if (!host_) return false;
    if (end.request) host_->note_end_request(*end.request);
    if (!end.signal) host_->note_program_ends(end.status);
    host_->finish();
    server_.reset();
    return true;
  }

 private:
  const sim::WorldDescription& world_;
  const playerlike::RunSettings& settings_;
  std::shared_ptr<playerlike::Host> host_;
  std::optional<playerlike::Server> server_;
};

bool stops_in_gdb(const RunRequest& request) {
  return request.until && request.until->then == RunUntil::Then::kDebug;
}

/// @throws std::runtime_error if the run is over before the time of --until, or begins after it,
///     or if gdb cannot stop there.
/// @param start_s  simulated time at which the run begins [s].
void require_time_of_until(const RunRequest& request, const sim::WorldDescription& world,
                           double start_s) {
  if (!request.until) return;
  const auto refuse = [&request](const std::string& reason) {
    throw std::runtime_error("--until " + sim::shortest_text(request.until->time_s) + ": " +
                             reason);
  };
  if (request.until->time_s < start_s) {
    refuse("the run begins later, at " + sim::shortest_text(start_s) + " s (--from)");
  }
  if (stops_in_gdb(request) && request.settings.clients.value_or(1) > 1) {
    refuse(
        "with --clients, the world is not in the program's process, so that its debugger cannot "
        "stop there");
  }
  const auto& duration_ns = world.simulation.duration_ns;
  if (!request.settings.stop || !duration_ns) return;
  const double end_s = sim::to_seconds(*duration_ns);
  if (end_s <= request.until->time_s) {
    refuse("the run is over at " + sim::shortest_text(end_s) + " s (--duration)");
  }
}

/// Says what the user may not expect of the run.
void tell_before(const RunRequest& request, const sim::WorldDescription& world) {
  const playerlike::RunSettings& settings = request.settings;
  if (!request.quiet && !settings.duration_s && !world.simulation.duration_ns) {
    std::cerr << "playpen: the world sets no duration, so the run ends when the program does "
                 "(or give --duration)\n";
  }
  if (request.debug && !in_lockstep(settings, world)) {
    std::cerr << "playpen: time is real in this run, so it does not stand still at breakpoints "
                 "(--time lockstep decides otherwise)\n";
  }
}

/// The processes that show the run while it goes on.
class Displays {
 public:
  /// Starts those that the request wants, and sets their sockets in its settings.
  Displays(RunRequest& request, const std::string& world) {
    const std::string title = "Playpen: " + world;
    if (request.view) request.settings.view_socket = viewer_.emplace(title).socket();
    if (!request.page.wanted) return;
    page_.emplace(request.page, title, playerlike::log_to_stderr());
    request.settings.page_socket = page_->socket();
    std::cout << page_->links() << std::endl;
  }

 private:
  std::optional<ViewerProcess> viewer_;
  std::optional<PageProcess> page_;
};

/// Says where the user sees why something was not as expected.
void tell_of_results(RunRequest request) {
  const std::string& folder = request.settings.output_folder;
  std::cerr << "playpen: results: " << folder << '\n';
  if (request.replay_file.empty()) {
    request.replay_file = folder + "/replay.html";
    request.quiet = false;
    static_cast<void>(write_replay_of(request));
  }
  std::cerr << "playpen: reasons: playpen why " << folder << '\n';
}

/// Says how to go on from the end of a run of --then save.
void tell_start(const RunRequest& request) {
  if (!request.until || request.until->then != RunUntil::Then::kSave || request.quiet) return;
  std::cout << "from here: playpen run --from " << request.settings.output_folder << '@'
            << sim::shortest_text(request.until->time_s) << " --out DIR -- PROGRAM\n";
}

}  // namespace

bool names_server(const std::string& world) {
  return world.starts_with("tcp://") || world.starts_with("player://") ||
         world.starts_with("unix:");
}

int run_at_server(const RunRequest& request) {
  const std::string gdb = request.debug ? find_gdb() : std::string();
  playerlike::EnvironmentChanges environment = playerlike::run_environment("", {});
  environment["PLAYPEN_WORLD"] = request.world;
  environment["PLAYPEN_RUN"] = "1";
  add_libraries_folder(environment);
  std::optional<PreloadedLibrary> virtual_time;
  if (!request.real_sleep && !request.world.starts_with("player://")) {
    virtual_time.emplace().add_to(environment);
    environment["PLAYPEN_VIRTUAL_TIME"] = "1";
  }
  std::vector<std::string> command = request.command;
  command.front() = playerlike::find_program(command.front());
  playerlike::RunWatch watch;
  watch.is_debugger = request.debug;
  if (request.debug) command = debug_call(gdb, command, environment);
  const playerlike::ProgramEnd end = playerlike::run_program(command, environment, watch);
  if (end.success()) return kOk;
  std::cerr << "playpen: " << command.front() << ' ' << end.text() << '\n';
  return kProgramFailed;
}

int run(RunRequest request) {
  std::optional<StartState> start;
  if (request.from) start.emplace(*request.from, request.world, request.settings);
  const std::string world_file = start ? start->world_file() : find_world(request.world);
  sim::WorldDescription world = load_found_world(world_file);
  request.settings.apply_to(world);  // reports settings that do not match the world before the run
  for (const expect::Expectation& one : request.expectations) one.require_robot_of(world);
  require_time_of_until(request, world, start ? start->time_s() : 0.0);
  request.command.front() = playerlike::find_program(request.command.front());
  const std::string gdb = request.debug ? find_gdb() : std::string();
  playerlike::RunSettings& settings = request.settings;
  const IsolatedPrograms isolated(request.isolation);
  if (settings.player_port) {
    // Before results of an earlier run are removed; the program's simulation opens the ports.
    playerlike::Server::check(playerlike::onlooker_settings(*settings.player_port), world);
  }
  if (request.view || request.page.wanted) pace_for_view(settings, world);
  settings.progress = !request.quiet && !request.debug;  // it would mix with gdb's prompt
  settings.quiet_end = true;
  if (request.from) {
    choose_output_folder(settings, world_file);
    refuse_same_folder(*request.from, settings.output_folder);
  }
  prepare_outputs(settings, world_file);
  tell_before(request, world);
  std::optional<Displays> displays(std::in_place, request, world.name);

  std::optional<PreloadedLibrary> virtual_time;
  settings.virtual_time = !request.real_sleep && in_lockstep(settings, world);
  const playerlike::KeptRun kept;
  settings.kept_run = kept.file();
  playerlike::EnvironmentChanges environment = playerlike::run_environment(world_file, settings);
  add_libraries_folder(environment);
  if (settings.virtual_time) {
    virtual_time.emplace();
    if (!isolated.isolated()) virtual_time->add_to(environment);
  }
  ServedWorld served(world, settings);
  playerlike::ProgramDesk desk(settings.clients.value_or(1) > 1 || !in_lockstep(settings, world),
                               [&served] { return served.serve(); });
  environment["PLAYPEN_DESK"] = desk.name();
  playerlike::RunWatch watch;
  watch.kept = &kept;
  watch.desk = &desk;
  watch.is_debugger = request.debug;
  // With a window or page, the program's process shows the run also while time is paused.
  watch.standstill_s = request.view || request.page.wanted
                           ? std::numeric_limits<double>::infinity()
                           : playerlike::silence_limit_s_of_environment();
  watch.tell = [](const std::string& text) { std::cerr << "playpen: " << text << '\n'; };
  bool completed = false;
  watch.on_end = [&](const playerlike::ProgramEnd& program_end) {
    playerlike::stop_real_robots(kept, playerlike::open_real_robot, watch.tell);
    try {
      if (served.finish(program_end)) return;
      completed = playerlike::complete_results(kept, world, settings, program_end);
    } catch (const std::exception& e) {
      std::cerr << "playpen: results of the run are missing: " << e.what() << '\n';
    }
  };
  std::vector<std::string> command = isolated.launcher(
      virtual_time ? virtual_time->file() : std::string(), {settings.output_folder, world_file});
  command.insert(command.end(), request.command.begin(), request.command.end());
  if (request.debug) command = debug_call(gdb, command, environment, stops_in_gdb(request));
  const playerlike::ProgramEnd end = playerlike::run_program(command, environment, watch);

  displays.reset();  // they have nothing left to show

  const bool replayed = write_replay_of(request);
  int status = verdict(request, world, end, completed);
  if (status == kOk) tell_start(request);
  if (status == kOk && !request.expectations.empty() &&
      print_unmet(request.expectations, settings.output_folder) > 0) {
    tell_of_results(request);
    status = kProgramFailed;
  }
  return desk.conflict().empty() && replayed ? status : kProgramFailed;
}

}  // namespace playpen
