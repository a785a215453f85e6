// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/connect/open_session.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <string_view>
#include <utility>

#include "connect/named_hosts.h"
#include "connect/prepared_process.h"
#include "connect/run_desk.h"
#include "host/stepping/onlookers.h"
#include "playerlike/process/log.h"
#include "remote/player_session.h"
#include "remote/socket_session.h"
#include "sim/render/render.h"
#include "virtual_time/virtual_time.h"

namespace playerlike {
namespace {

// The process's embedded simulations. The object is never destroyed, because clients at namespace
// scope may outlive any static object. An exit handler writes the results of runs instead.
struct Registry {
  std::mutex mutex;
  std::map<std::string, std::shared_ptr<Host>> hosts;  // key: full path of the world file
  std::unique_ptr<Onlookers> onlookers;                // at the first host, if they are wanted
  int results = 0;                       // number of hosts so far, which write results
  const Host* clock_host = nullptr;      // whose time is that of the program's sleeps
  std::set<std::string> replaced_hosts;  // host names that the run's world replaced
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
    if (getpid() != registry.process) return;  // a forked child does not own the run
    const std::lock_guard lock(registry.mutex);
    for (const auto& [key, host] : registry.hosts) {
      host->note_program_ends(status);
      host->finish();
    }
    registry.onlookers.reset();
  }
};

/// Loads the drawing libraries now, and registers the exit handler again, so that it runs before
/// their static destructors: it may draw the last pictures. Registering it twice is harmless.
void prepare_drawing(const RunSettings& settings) {
  const bool draws =
      !settings.output_folder.empty() || settings.view_socket || settings.page_socket;
  if (!draws && settings.film.empty()) return;
  sim::render::prepare_pictures();
  if (!settings.film.empty()) sim::render::prepare_films();
  Registry::finish_at_exit();
}

std::string full_path(const std::string& file) {
  return file.empty() ? file : std::filesystem::absolute(file).lexically_normal().string();
}

/// The simulation of a world file. The caller has locked the registry.
/// @param renew    replaces a simulation that all clients have left by a new one.
/// @param watches  whether the program is in this process.
std::shared_ptr<Host> host_of(Registry& registry, const std::string& file, bool renew,
                              bool watches = true) {
  std::shared_ptr<Host>& host = registry.hosts[full_path(file)];
  if (host && !(renew && host->is_abandoned())) return host;
  if (host) {
    virtual_time::detach(*host->clock());
    host->finish();
    if (registry.clock_host == host.get()) registry.clock_host = nullptr;
    host.reset();
  }
  try {
    RunSettings settings = RunSettings::from_environment();
    // The first world of a program writes its results into the requested folder. Each further world
    // uses a numbered subfolder and is neither filmed nor watched.
    if (registry.results > 0) {
      settings.film.clear();
      settings.view_socket.reset();
      settings.page_socket.reset();
      settings.kept_run.clear();
      settings.player_port.reset();
      settings.progress = false;
      if (!settings.output_folder.empty()) {
        settings.output_folder += "/world" + std::to_string(registry.results + 1);
      }
    }
    settings.open_real_robot = open_real_robot;
    prepare_drawing(settings);
    // A program has one virtual clock, which belongs to the first world that still exists.
    const bool virtual_time_wanted = settings.virtual_time && registry.clock_host == nullptr;
    settings.virtual_time = virtual_time_wanted && virtual_time::active();
    // Window, page and Player ports belong to this process: programs that it starts must not use
    // them.
    unsetenv("PLAYPEN_VIEW");
    unsetenv("PLAYPEN_PAGE");
    unsetenv("PLAYPEN_PLAYER_PORT");
    const sim::LogHook log = log_to_stderr();
    sim::WorldDescription world = sim::load_world(file);
    // `playpen run` has printed the notes of its world, `playpen grade` has not.
    if (settings.kept_run.empty() || !settings.grading.nonce.empty()) {
      for (const std::string& note : world.notes) log(sim::LogLevel::kInfo, note);
    }
    if (!settings.grading.nonce.empty()) {
      sim::WorldDescription as_run = world;
      settings.apply_to(as_run);
      settings.grading = grading_of(settings.grading.nonce, settings.grading.rules, as_run);
    }
    host = Host::create(std::move(world), settings, log);
    if (settings.player_port) {
      registry.onlookers = open_onlookers(host, *settings.player_port, log);
    }
    if (watches) host->watch_program();
    ++registry.results;
    if (virtual_time_wanted) registry.clock_host = host.get();
    if (settings.virtual_time) {
      if (host->time().mode == sim::TimeMode::kLockstep) {
        virtual_time::attach(host->clock());
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

std::unique_ptr<Session> connect_embedded(const std::string& file, int port, bool renew) {
  Registry& registry = Registry::instance();
  const std::lock_guard lock(registry.mutex);
  return host_of(registry, file, renew)->connect(port);
}

constexpr std::string_view kFilePrefix = "sim:";

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

// Whether a name, such as that of PLAYPEN_WORLD, is that of a Playpen server.
bool names_server(std::string_view name) {
  return name.starts_with(kTcpPrefix) || name.starts_with(kUnixPrefix);
}

// For what runs in real time: this program cannot use virtual time then.
void use_real_time() {
  if (virtual_time::active()) virtual_time::give_up();
}

// Time stays virtual if that of the server is lockstep.
std::unique_ptr<Session> connect_to_server(const std::string& server, int port) {
  SocketSettings settings = SocketSettings::from_environment(parse_server_address(server), port);
  const std::string_view run = variable("PLAYPEN_RUN");
  settings.quiet_end = (!run.empty() && run != "0") || names_server(variable("PLAYPEN_WORLD"));
  if (virtual_time::active() && variable("PLAYPEN_VIRTUAL_TIME") == "1") {
    settings.virtual_time = true;
    settings.silence_limit_s = silence_limit_s_of_environment();
  }
  auto session = std::make_unique<SocketSession>(std::move(settings));
  if (!session->in_turns()) use_real_time();
  return session;
}

// MORSE's port is no Player server's, so programs that name it mean Player's default port.
int player_tcp_port(int port) { return port == kMorsePort ? kPlayerPort : port; }

// The server that "player://HOST[:PORT]" names for a client's port.
ServerAddress player_server(const std::string& text, int port) {
  return parse_server_address(text, player_tcp_port(port));
}

// The address of PLAYPEN_WORLD stands for all ports that a program names: its port is that of the
// robot on Player's default port, and other robots have the same distance to it.
ServerAddress player_server_of_world(const std::string& world, int port) {
  constexpr int kNone = 0;
  ServerAddress server = parse_server_address(world, kNone);
  const int first = server.tcp_port == kNone ? kPlayerPort : server.tcp_port;
  server.tcp_port = first + player_tcp_port(port) - kPlayerPort;
  constexpr int kMaxPort = 65535;
  if (server.tcp_port >= 1 && server.tcp_port <= kMaxPort) return server;
  throw SessionError(SessionError::Code::kBadArgument,
                     "PLAYPEN_WORLD=" + world + " has no robot on port " + std::to_string(port) +
                         ": that would be TCP port " + std::to_string(server.tcp_port));
}

PlayerSettings player_settings(ServerAddress server, int port) {
  PlayerSettings settings;
  settings.server = std::move(server);
  settings.tokens = SocketSettings::from_environment(settings.server, port).tokens;
  return settings;
}

std::unique_ptr<Session> connect_to_player(ServerAddress server, int port) {
  use_real_time();
  return std::make_unique<PlayerSession>(player_settings(std::move(server), port));
}

// For a host without a protocol: a Player server speaks first, a Playpen server does not.
std::unique_ptr<Session> connect_to_host(const std::string& host, int port) {
  if (port == kMorsePort) return connect_to_server(host, port);
  use_real_time();
  constexpr double kConnect_s = 3.0;
  constexpr double kGreeting_s = 2.0;
  std::string no_player;
  try {
    PlayerSettings settings = player_settings(parse_server_address(host, port), port);
    settings.connect_timeout_s = kConnect_s;
    settings.banner_timeout_s = kGreeting_s;
    return std::make_unique<PlayerSession>(std::move(settings));
  } catch (const SessionError& e) {
    if (e.code() != SessionError::Code::kDisconnected) throw;
    no_player = e.what();
  }
  try {
    return connect_to_server(host, port);
  } catch (const SessionError& e) {
    if (e.code() != SessionError::Code::kDisconnected) throw;
    throw SessionError(e.code(), no_player + "; and as a Playpen server: " + e.what());
  }
}

// Whether a variable may change after the start. The library itself removes PLAYPEN_VIEW and
// PLAYPEN_PAGE; the others do not affect the simulation.
bool may_change(std::string_view name) {
  return name == "PLAYPEN_VIEW" || name == "PLAYPEN_PAGE" || name == "PLAYPEN_TOKEN" ||
         name == "PLAYPEN_ENCODING" || name == "PLAYPEN_LIBRARIES";
}

// The PLAYPEN_ variables that affect runs.
std::map<std::string, std::string> run_variables() {
  std::map<std::string, std::string> variables;
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    const std::size_t equals = text.find('=');
    if (!text.starts_with("PLAYPEN_") || equals == text.npos) continue;
    if (may_change(text.substr(0, equals))) continue;
    variables.emplace(text.substr(0, equals), text.substr(equals + 1));
  }
  return variables;
}

// Copies of a prepared process began before, with their own environment.
[[maybe_unused]] const bool kIsNoPreparedProcess = serve_if_prepared();

// The values at the start of the program, read before main(), where programs may change them. Never
// destroyed, since clients at namespace scope may need them.
const std::map<std::string, std::string>& variables_at_start() {
  static const auto* const variables = new std::map(run_variables());
  return *variables;
}
[[maybe_unused]] const bool kVariablesAreRead = !variables_at_start().empty();

// Whether this is the world that `playpen run` has chosen.
bool is_world_of_run(const std::string& file) {
  const auto world = variables_at_start().find("PLAYPEN_WORLD");
  return file == (world == variables_at_start().end() ? "" : world->second);
}

[[noreturn]] void refuse_while_graded(const std::string& what) {
  const std::string message =
      "this program is run by 'playpen grade', and " + what +
      ". A grade counts only for the world and the settings of the task: connect to \"localhost\", "
      "and leave the PLAYPEN_ variables alone. 'playpen run WORLD -- PROGRAM' tries other worlds";
  log_to_stderr()(sim::LogLevel::kError, message);
  throw SessionError(SessionError::Code::kBadArgument, message);
}

// Under `playpen grade` the grader has chosen the world and its settings; a program must not change
// them.
void refuse_other_worlds(const std::string& host) {
  const std::map<std::string, std::string>& before = variables_at_start();
  if (!before.contains("PLAYPEN_GRADE")) return;
  const std::map<std::string, std::string> now = run_variables();
  const auto text_of = [](const std::map<std::string, std::string>& variables,
                          const std::string& name) {
    const auto variable = variables.find(name);
    return variable == variables.end() ? "nothing" : '"' + variable->second + '"';
  };
  for (const auto* variables : {&before, &now}) {
    for (const auto& [name, value] : *variables) {
      if (name == "PLAYPEN_GRADE" || text_of(before, name) == text_of(now, name)) continue;
      refuse_while_graded("it has changed " + name + " from " + text_of(before, name) + " to " +
                          text_of(now, name));
    }
  }
  if (host.starts_with(kFilePrefix)) refuse_while_graded("it opens the world \"" + host + '"');
  if (host.find_first_of(":/[") != std::string::npos) {
    refuse_while_graded("it connects to the server \"" + host + '"');
  }
}

// Whether a host is named as in programs for real robots: without a protocol and without a port.
bool is_plain_name(std::string_view host) { return host.find_first_of(":/[") == host.npos; }

// Warns once for each host.
void warn_of_host(const std::string& host, const std::string& world) {
  Registry& registry = Registry::instance();
  {
    const std::lock_guard lock(registry.mutex);
    if (!registry.replaced_hosts.insert(host).second) return;
  }
  log_to_stderr()(sim::LogLevel::kWarning, "the program asks for a robot at \"" + host +
                                               "\" and gets that of this run's world, " + world +
                                               "; for a server there, name it player://" + host +
                                               " (Player) or tcp://" + host + " (Playpen)");
}

}  // namespace

std::unique_ptr<Session> open_session(const std::string& host, int port) {
  const virtual_time::Inside inside;
  refuse_other_worlds(host);
  if (const std::shared_ptr<Host> named = named_host(host)) return named->connect(port);
  if (host.starts_with(kFilePrefix)) {
    const std::string file = host.substr(kFilePrefix.size());
    if (file.empty()) {
      throw SessionError(SessionError::Code::kBadArgument,
                         "\"sim:\" must be followed by the name of a world file");
    }
    return connect_embedded(file, port, /*renew=*/true);
  }
  if (host.starts_with(kPlayerPrefix)) {
    return connect_to_player(player_server(host, port), port);
  }
  const std::string file(variable("PLAYPEN_WORLD"));
  if (host != "localhost" && host != "127.0.0.1") {
    if (!is_plain_name(host)) return connect_to_server(host, port);
    if (file.empty()) return connect_to_host(host, port);
    warn_of_host(host, file);
  }
  if (file.starts_with(kPlayerPrefix)) {
    return connect_to_player(player_server_of_world(file, port), port);
  }
  if (names_server(file)) return connect_to_server(file, port);
  if (is_world_of_run(file)) {
    if (const std::optional<int> server = served_world_port()) {
      use_real_time();
      return connect_to_server("tcp://127.0.0.1:" + std::to_string(*server), port);
    }
  }
  return connect_embedded(file, port, /*renew=*/false);
}

std::unique_ptr<Session> open_real_robot(const RealRobotPlace& place) {
  const virtual_time::Inside inside;
  const auto& [server, port, timeout_s] = place;
  if (server.starts_with(kPlayerPrefix)) {
    PlayerSettings settings = player_settings(player_server(server, port), port);
    settings.connect_timeout_s = settings.banner_timeout_s = timeout_s;
    return std::make_unique<PlayerSession>(std::move(settings));
  }
  if (!server.starts_with(kTcpPrefix)) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "a real robot is named " + std::string(sim::kRealServerExpected));
  }
  SocketSettings settings = SocketSettings::from_environment(parse_server_address(server), port);
  settings.connect_timeout_s = timeout_s;
  return std::make_unique<SocketSession>(std::move(settings));
}

std::shared_ptr<Host> open_host_of_run() {
  const virtual_time::Inside inside;
  const std::string world(variable("PLAYPEN_WORLD"));
  if (names_server(world) || world.starts_with(kPlayerPrefix)) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "PLAYPEN_WORLD=" + world + " is a server, not the file of a world");
  }
  Registry& registry = Registry::instance();
  const std::lock_guard lock(registry.mutex);
  return host_of(registry, world, /*renew=*/false, /*watches=*/false);
}

void close_embedded_hosts() {
  Registry& registry = Registry::instance();
  const std::lock_guard lock(registry.mutex);
  registry.onlookers.reset();
  for (const auto& [key, host] : registry.hosts) {
    virtual_time::detach(*host->clock());
    host->finish();
  }
  registry.hosts.clear();
  registry.results = 0;
  registry.clock_host = nullptr;
}

}  // namespace playerlike
