// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/embedded.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <string_view>
#include <utility>

#include "playerlike/host/log.h"
#include "session/socket_session.h"
#include "sim/render/render.h"
#include "virtual_time/virtual_time.h"

namespace playerlike {
namespace {

// The process's embedded simulations. Never destroyed: clients at namespace scope may outlive any
// static object. The results of runs are written by an exit handler instead.
struct Registry {
  std::mutex mutex;
  std::map<std::string, std::shared_ptr<Host>> hosts;  // by the world file's full path
  int results = 0;                                     // hosts that write results
  std::set<std::string> replaced_hosts;                // that meant the run's world
  const pid_t process = getpid();

  static Registry& instance() {
    static Registry* registry = [] {
      auto* made = new Registry;
      finish_at_exit();
      return made;
    }();
    return *registry;
  }

  static void finish_at_exit() {
    on_exit([](int status, void*) { finish_all(status); }, nullptr);
  }

  static void finish_all(int status) {
    Registry& registry = instance();
    if (getpid() != registry.process) return;  // a forked child: the run is not its own
    const std::lock_guard lock(registry.mutex);
    for (const auto& [key, host] : registry.hosts) {
      host->note_program_ends(status);
      host->finish();
    }
  }
};

/// What draws the pictures of a run must outlive the exit handler that may draw the last of them:
/// it is loaded now, and the handler registered again, so that it runs first. Twice does no harm.
void prepare_drawing(const RunSettings& settings) {
  const bool draws = !settings.output_folder.empty() || settings.view_socket;
  if (!draws && settings.film.empty()) return;
  sim::render::prepare_pictures();
  if (!settings.film.empty()) sim::render::prepare_films();
  Registry::finish_at_exit();
}

std::string full_path(const std::string& file) {
  return file.empty() ? file : std::filesystem::absolute(file).lexically_normal().string();
}

std::shared_ptr<Host> host_of(const std::string& file) {
  Registry& registry = Registry::instance();
  const std::lock_guard lock(registry.mutex);
  std::shared_ptr<Host>& host = registry.hosts[full_path(file)];
  if (host) return host;
  try {
    RunSettings settings = RunSettings::from_environment();
    // The first world of a program writes its results into the folder that was asked for, each
    // further one into a numbered folder in it; only the first can be filmed or watched.
    if (registry.results > 0) {
      settings.film.clear();
      settings.view_socket.reset();
      settings.kept_run.clear();
      settings.progress = false;
      if (!settings.output_folder.empty()) {
        settings.output_folder += "/world" + std::to_string(registry.results + 1);
      }
    }
    prepare_drawing(settings);
    // A program has one clock, the first world's.
    const bool virtual_time_wanted = settings.virtual_time && registry.results == 0;
    settings.virtual_time = virtual_time_wanted && virtual_time::active();
    // The window is this process's own: programs that it starts must not take it for theirs.
    unsetenv("PLAYPEN_VIEW");
    const sim::LogHook log = log_to_stderr();
    host = Host::create(sim::load_world(file), settings, log);
    host->watch_program();
    ++registry.results;
    if (settings.virtual_time) {
      if (host->time().mode == sim::TimeMode::kLockstep) {
        virtual_time::attach(host);
      } else {
        virtual_time::give_up();
      }
    } else if (virtual_time_wanted) {
      log(sim::LogLevel::kWarning,
          "the library that makes time virtual is not loaded into this program (is it linked "
          "statically?), so its sleeps take real time");
    }
  } catch (...) {
    registry.hosts.erase(full_path(file));
    throw;
  }
  return host;
}

constexpr std::string_view kFilePrefix = "sim:";

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

std::unique_ptr<Session> connect_to_server(const std::string& server, int port) {
  // What the server does takes the time it takes.
  if (virtual_time::active()) virtual_time::give_up();
  SocketSettings settings = SocketSettings::from_environment(parse_server_address(server), port);
  const std::string_view run = variable("PLAYPEN_RUN");
  settings.quiet_end =
      (!run.empty() && run != "0") || variable("PLAYPEN_WORLD").starts_with(kTcpPrefix);
  return std::make_unique<SocketSession>(std::move(settings));
}

// Whether a host is named as programs for real robots do: no "tcp://", no port of a server.
bool is_plain_name(std::string_view host) { return host.find_first_of(":/[") == host.npos; }

// Once for each host.
void warn_of_host(const std::string& host, const std::string& world) {
  Registry& registry = Registry::instance();
  {
    const std::lock_guard lock(registry.mutex);
    if (!registry.replaced_hosts.insert(host).second) return;
  }
  log_to_stderr()(sim::LogLevel::kWarning, "the program asks for a robot at \"" + host +
                                               "\" and gets that of this run's world, " + world +
                                               "; for a server there, name it tcp://" + host);
}

}  // namespace

std::unique_ptr<Session> open_session(const std::string& host, int port) {
  const virtual_time::Inside inside;
  if (host.starts_with(kFilePrefix)) {
    const std::string file = host.substr(kFilePrefix.size());
    if (file.empty()) {
      throw SessionError(SessionError::Code::kBadArgument,
                         "\"sim:\" must be followed by the name of a world file");
    }
    return host_of(file)->connect(port);
  }
  const std::string file(variable("PLAYPEN_WORLD"));
  if (host != "localhost" && host != "127.0.0.1") {
    if (file.empty() || !is_plain_name(host)) return connect_to_server(host, port);
    warn_of_host(host, file);
  }
  if (file.starts_with(kTcpPrefix)) return connect_to_server(file, port);
  return host_of(file)->connect(port);
}

void close_embedded_hosts() {
  Registry& registry = Registry::instance();
  const std::lock_guard lock(registry.mutex);
  for (const auto& [key, host] : registry.hosts) {
    virtual_time::detach(*host);
    host->finish();
  }
  registry.hosts.clear();
  registry.results = 0;
}

}  // namespace playerlike
