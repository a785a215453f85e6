// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "commands.h"
#include "end_signals.h"
#include "page_process.h"
#include "playerlike/connect/open_session.h"
#include "playerlike/host/host.h"
#include "playerlike/host/kept_results.h"
#include "playerlike/host/kept_run.h"
#include "playerlike/host/program.h"
#include "playerlike/process/log.h"
#include "playerlike/server/server.h"
#include "run_outputs.h"
#include "shipped.h"
#include "viewer_process.h"

namespace playpen {
namespace {

using Clock = std::chrono::steady_clock;

// How long clients may take to disconnect after the run is over.
constexpr auto kLeavingTime = std::chrono::seconds(5);
constexpr auto kLook = std::chrono::milliseconds(20);
// How long a report that is being written may take after that.
constexpr auto kReportTime = std::chrono::seconds(5);
// The same of all pictures of a canvas with so few cells, which takes long on a busy machine only.
constexpr auto kPictureTime = std::chrono::seconds(60);
constexpr std::size_t kSmallCanvas = std::size_t{1} << 20U;
// Memory of the results that remain if the simulation does not end. Little, since it is written
// after each step: a canvas of more than 4 million cells has no room.
constexpr std::size_t kKeptBytes = std::size_t{16} << 20U;

/// Applies to this process the environment that `playpen run` gives its program. So of the shell's
/// own environment, only the silence limit has an effect.
playerlike::RunSettings with_environment(const playerlike::RunSettings& settings,
                                         const std::string& world_file) {
  for (const auto& [name, value] : playerlike::run_environment(world_file, settings)) {
    if (value) {
      setenv(name.c_str(), value->c_str(), 1);
    } else {
      unsetenv(name.c_str());
    }
  }
  playerlike::RunSettings result = playerlike::RunSettings::from_environment();
  result.open_real_robot = playerlike::open_real_robot;
  result.start_at_once = settings.start_at_once;  // not affected by the environment
  return result;
}

/// The addresses of a server for the user: "127.0.0.1:4000", "unix:/tmp/robots" or both.
std::string listening_on(const playerlike::ServerSettings& settings, int port) {
  std::string text;
  if (settings.port) text = playerlike::address_text(settings.bind, port);
  if (settings.unix_path.empty()) return text;
  return text + (text.empty() ? "" : " and ") + "unix:" + settings.unix_path;
}

/// Serves until a signal arrives or everything is over.
void wait_for_end(const playerlike::Host& host, const playerlike::Server& server,
                  const EndSignals& signals) {
  std::optional<Clock::time_point> finished;
  while (!server.done() && signals.first() == 0) {
    std::this_thread::sleep_for(kLook);
    if (!finished && host.finished()) finished = Clock::now();
    if (finished && Clock::now() - *finished > kLeavingTime) return;
  }
}

/// Ends this process, whose simulation does not end by itself: completes the results from the
/// memory that was kept, unless the simulation is writing them. Returns if it has written them.
void end_without(playerlike::Host& host, const playerlike::KeptRun& kept,
                 const sim::WorldDescription& world, const ServeRequest& request, int signal) {
  try {
    if (host.take_over_results()) {
      playerlike::ProgramEnd end;
      end.request = signal;
      playerlike::complete_results(kept, world, request.settings, end);
      std::cerr << "playpen: the simulation did not end, so the results are those of its last "
                   "complete step\n";
    } else {
      // They are being written, the report first. Pictures of a large canvas take too long.
      const bool is_small = host.with_simulation([](const sim::Simulation& simulation) {
        return simulation.layers().cell_count() <= kSmallCanvas;
      });
      // The report of the last second exists, but it does not say the end.
      const auto is_reported = [&kept] { return playerlike::KeptRun::has_reported(kept.phase()); };
      const auto end = Clock::now() + (is_small ? kPictureTime : kReportTime);
      while (!(is_reported() && (!is_small || has_pictures(request.settings))) &&
             Clock::now() < end) {
        std::this_thread::sleep_for(kLook);
      }
      if (is_small && has_pictures(request.settings)) return;  // it ends in good order
    }
  } catch (const std::exception& e) {
    std::cerr << "playpen: results of the run are missing: " << e.what() << '\n';
  }
  const bool reported = has_report(request.settings);
  if (reported && !has_pictures(request.settings)) {
    std::cerr << "playpen: not all pictures could be written in the time after the signal\n";
  }
  if (reported && !request.quiet) print_results(request.settings);
  std::cout.flush();
  std::_Exit(reported ? kOk : kProgramFailed);
}

}  // namespace

int serve(ServeRequest request) {
  const std::string world_file = find_world(request.world);
  sim::WorldDescription world = load_found_world(world_file);
  playerlike::RunSettings& settings = request.settings;
  if (request.view || request.page.wanted) pace_for_view(settings, world);
  if (!settings.time_mode && !world.simulation.time_mode_given) {
    settings.time_mode = sim::TimeMode::kPaced;
    settings.time_factor = 1.0;
  }
  // As `player -p`: each robot is also served on its port, as for a lowest port of kPlayerPort.
  if (settings.robot_port && !request.server.player_port) {
    request.server.player_port = playerlike::kPlayerPort;
  }
  // People at the page can drive robots without programs.
  if (request.page.wanted) settings.start_at_once = true;
  settings.apply_to(world);
  if (request.own_sensors_only) world.simulation.own_sensors_only = true;
  if (request.clients) {
    world.simulation.start_gate_clients = std::max(*request.clients, 1);
    settings.start_at_once = *request.clients == 0;
  }

  const sim::LogHook log = playerlike::log_to_stderr(request.log_level);
  if (!request.token_file.empty()) {
    request.server.access = playerlike::read_token_file(request.token_file, log);
  }
  // Check this before removing the results of a server that may be using the port.
  playerlike::Server::check(request.server, world);

  prepare_outputs(settings, world_file);
  std::optional<ViewerProcess> viewer;
  if (request.view) {
    settings.view_socket = viewer.emplace("Playpen: " + world.name).copy_of_socket();
  }
  std::optional<PageProcess> page;
  if (request.page.wanted) {
    settings.page_socket =
        page.emplace(request.page, "Playpen: " + world.name, log).copy_of_socket();
  }
  const playerlike::KeptRun kept(kKeptBytes);
  settings.kept_run = kept.file();
  std::shared_ptr<playerlike::Host> host;
  EndSignals signals;  // ends before the host, which it uses
  host = playerlike::Host::create(world, with_environment(settings, world_file), log);
  signals.listen([&](int signal) { host->note_end_request(signal); },
                 [&](int signal) { end_without(*host, kept, world, request, signal); });
  {
    playerlike::Server server(host, request.server, log);
    std::cout << "listening on " << listening_on(request.server, server.port());
    if (request.server.sync_port) std::cout << ", clock synchronisation on " << server.sync_port();
    std::cout << std::endl;
    for (const std::string& line : server.player_port_lines()) std::cout << line << std::endl;
    if (page) std::cout << page->links() << std::endl;
    wait_for_end(*host, server, signals);
    host->finish();
    server.stop();
  }
  viewer.reset();  // the window has nothing left to show
  page.reset();

  if (!has_report(settings)) return kProgramFailed;  // the log contains the reason
  if (!request.quiet) print_results(settings);
  return kOk;
}

}  // namespace playpen
