// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "commands.h"
#include "playerlike/connect/open_session.h"
#include "playerlike/host/host.h"
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
constexpr long kLook_ns = 50'000'000;

/// Blocks SIGINT, SIGTERM and SIGHUP in all threads that are started afterwards, so that they can
/// be waited for. Signals that this process ignores, as under nohup, remain ignored.
class HeldSignals {
 public:
  HeldSignals() {
    sigemptyset(&held_);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      struct sigaction present {};
      if (sigaction(signal, nullptr, &present) == 0 && present.sa_handler != SIG_IGN) {
        sigaddset(&held_, signal);
      }
    }
    pthread_sigmask(SIG_BLOCK, &held_, &old_mask_);
  }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;
  ~HeldSignals() {
    if (end_on_second_.joinable()) {
      over_ = true;
      end_on_second_.join();
    }
    // The signals stay blocked: the process is about to exit with its status, which a late request
    // to end must not change.
  }

  /// Waits a moment. @return the number of a signal that arrived; 0: none.
  [[nodiscard]] int wait() const {
    const timespec time{0, kLook_ns};
    const int signal = sigtimedwait(&held_, nullptr, &time);
    return signal > 0 ? signal : 0;
  }

  /// After the first signal, the next one ends this process at once. Exceptions: copies of the
  /// first signal (`timeout` sends two), and a SIGHUP after the first signal.
  void end_on_second(int first) {
    end_on_second_ = std::thread([this, first, begin = Clock::now()] {
      while (!over_) {
        const int signal = wait();
        if (signal == 0) continue;
        if (playerlike::is_same_request(first, signal, Clock::now() - begin)) continue;
        std::signal(signal, SIG_DFL);
        pthread_sigmask(SIG_SETMASK, &old_mask_, nullptr);
        raise(signal);
      }
    });
  }

 private:
  sigset_t held_{};
  sigset_t old_mask_{};
  std::atomic<bool> over_{false};
  std::thread end_on_second_;
};

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

/// Serves until a signal arrives or everything is over.
void wait_for_end(playerlike::Host& host, const playerlike::Server& server, HeldSignals& signals) {
  std::optional<Clock::time_point> finished;
  while (!server.done()) {
    if (const int signal = signals.wait(); signal != 0) {
      host.note_end_request(signal);
      return signals.end_on_second(signal);
    }
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
  // As `player -p`: each robot is also served on its port, as for a lowest port of kPlayerPort.
  if (settings.robot_port && !request.server.player_port) {
    request.server.player_port = playerlike::kPlayerPort;
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
  // Check this before removing the results of a server that may be using the port.
  playerlike::Server::check(request.server, world);

  prepare_outputs(settings, world_file);
  std::optional<ViewerProcess> viewer;
  if (request.view) settings.view_socket = viewer.emplace("Playpen: " + world.name).socket();
  HeldSignals signals;
  const auto host =
      playerlike::Host::create(std::move(world), with_environment(settings, world_file), log);
  {
    playerlike::Server server(host, request.server, log);
    std::cout << "listening on " << playerlike::address_text(request.server.bind, server.port());
    if (request.server.sync_port) std::cout << ", clock synchronisation on " << server.sync_port();
    std::cout << std::endl;
    for (const std::string& line : server.player_port_lines()) std::cout << line << std::endl;
    wait_for_end(*host, server, signals);
    host->finish();
    server.stop();
  }
  viewer.reset();  // the window has nothing left to show

  if (!has_report(settings)) return kProgramFailed;  // the log contains the reason
  if (!request.quiet) print_results(settings);
  return kOk;
}

}  // namespace playpen
