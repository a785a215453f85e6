// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <optional>

#include "commands.h"
#include "playerlike/host/host.h"
#include "playerlike/host/log.h"
#include "playerlike/host/program.h"
#include "playerlike/server/server.h"
#include "run_outputs.h"
#include "shipped.h"
#include "viewer_process.h"

namespace playpen {
namespace {

using Clock = std::chrono::steady_clock;

// How long clients may take to leave when the run is over.
constexpr auto kLeavingTime = std::chrono::seconds(5);
constexpr long kLook_ns = 50'000'000;

/// Holds SIGINT and SIGTERM back in all threads that are started afterwards, so that they can be
/// waited for.
class HeldSignals {
 public:
  HeldSignals() {
    sigemptyset(&held_);
    sigaddset(&held_, SIGINT);
    sigaddset(&held_, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &held_, &old_mask_);
  }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;
  ~HeldSignals() { release(); }

  /// Waits a moment. @return whether one came.
  [[nodiscard]] bool wait() const {
    const timespec time{0, kLook_ns};
    return sigtimedwait(&held_, nullptr, &time) > 0;
  }
  /// From now on they end this process as they do others.
  void release() const { pthread_sigmask(SIG_SETMASK, &old_mask_, nullptr); }

 private:
  sigset_t held_{};
  sigset_t old_mask_{};
};

/// What `playpen run` passes on to its program, by way of the environment, holds here too: so of
/// what the shell holds only the silence limit counts.
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
  result.start_at_once = settings.start_at_once;  // no matter of the environment
  return result;
}

std::string address_text(const std::string& bind, int port) {
  return (bind.find(':') != std::string::npos ? '[' + bind + ']' : bind) + ':' +
         std::to_string(port);
}

/// Serves until a signal comes, or all is over.
void wait_for_end(const playerlike::Host& host, const playerlike::Server& server,
                  const HeldSignals& signals) {
  std::optional<Clock::time_point> finished;
  while (!server.done()) {
    if (signals.wait()) return signals.release();  // a second one ends the process at once
    if (!finished && host.finished()) finished = Clock::now();
    if (finished && Clock::now() - *finished > kLeavingTime) return;
  }
}

}  // namespace

int serve(ServeRequest request) {
  const std::string world_file = find_world(request.world);
  sim::WorldDescription world = load_found_world(world_file);
  playerlike::RunSettings& settings = request.settings;
  if (request.view) pace_for_view(settings, world);
  if (!settings.time_mode && !world.simulation.time_mode_given) {
    settings.time_mode = sim::TimeMode::kPaced;
    settings.time_factor = 1.0;
  }
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
  std::vector<std::string> robots;
  for (const sim::RobotDescription& robot : world.robots) robots.push_back(robot.name);
  // Before the results of a server that may hold the port are removed.
  playerlike::Server::check(request.server, robots);

  prepare_outputs(settings, world_file);
  std::optional<ViewerProcess> viewer;
  if (request.view) settings.view_socket = viewer.emplace("Playpen: " + world.name).socket();
  const HeldSignals signals;
  const auto host =
      playerlike::Host::create(std::move(world), with_environment(settings, world_file), log);
  {
    playerlike::Server server(host, request.server, log);
    std::cout << "listening on " << address_text(request.server.bind, server.port());
    if (request.server.sync_port) std::cout << ", clock synchronisation on " << server.sync_port();
    std::cout << std::endl;
    wait_for_end(*host, server, signals);
    signals.release();
    host->finish();
    server.stop();
  }
  viewer.reset();  // it has nothing to show any more

  if (!has_report(settings)) return kProgramFailed;  // the log says why
  if (!request.quiet) print_results(settings);
  return kOk;
}

}  // namespace playpen
