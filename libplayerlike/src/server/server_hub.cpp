// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "server/server_hub.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <algorithm>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/post.hpp>
#include <asio/steady_timer.hpp>
#include <atomic>
#include <exception>
#include <list>
#include <map>
#include <mutex>
#include <thread>
#include <unordered_set>
#include <utility>

#include "process/short_wait.h"
#include "process/system_threads.h"
#include "server/connection.h"
#include "server/listening.h"
#include "server/player_connection.h"
#include "sim/core/error.h"
#include "virtual_time/virtual_time.h"

namespace playerlike::server {
namespace {

using asio::ip::tcp;
using Clock = Connection::Clock;

// How long lockstep time may advance before sockets get a turn.
constexpr auto kSlice = std::chrono::milliseconds(2);
constexpr auto kTick = std::chrono::milliseconds(100);
// Maximum time that stop() waits until pending output is sent.
constexpr auto kStopTime = std::chrono::milliseconds(700);
// Pause before accepting again after a failure of the system.
constexpr auto kAcceptPause = std::chrono::milliseconds(200);
// Minimum time between equal warnings.
constexpr auto kWarningPause = std::chrono::seconds(10);
// Maximum number of connections that are refused with a message; further ones are closed without
// one.
constexpr std::size_t kRefused = 32;
constexpr int kPortsTried = 1000;
// Limits for the processes of clients: number, threads per process, length of a name.
constexpr std::size_t kProcesses = 4096;
constexpr std::size_t kThreadsOfAProcess = 4096;
constexpr std::size_t kProcessName = 128;

// Half-open connections are detected after about a minute.
constexpr int kKeepAliveIdle_s = 30;
constexpr int kKeepAliveInterval_s = 10;
constexpr int kKeepAliveProbes = 3;

std::string text_of(const tcp::endpoint& endpoint) {
  asio::ip::address ip = endpoint.address();
  if (ip.is_v6() && ip.to_v6().is_v4_mapped()) {
    ip = asio::ip::make_address_v4(asio::ip::v4_mapped, ip.to_v6());
  }
  const std::string address = ip.to_string();
  return (ip.is_v6() ? '[' + address + ']' : address) + ':' + std::to_string(endpoint.port());
}

}  // namespace

class ServerHub::Body final : public Hub, private ConnectionOwner {
 public:
  Body(std::shared_ptr<Host> host, ServerSettings settings, sim::LogHook log, MakeHandler services)
      : host_(std::move(host)),
        settings_(std::move(settings)),
        log_(std::move(log)),
        access_(settings_.access, host_->robots(), host_->own_sensors_only()),
        services_(std::move(services)),
        addresses_(checked_addresses(io_, settings_)) {
    if (settings_.port) {
      Listener services_port;
      services_port.services = true;
      services_port.make = services_;
      open_or_throw(io_, addresses_, settings_, *settings_.port, "port", services_port);
      port_ = add(std::move(services_port));
    }
    warn_if_not_private();
    if (!settings_.unix_path.empty()) listen_on_unix_socket();
    if (settings_.sync_port) {
      Listener clock;
      clock.make = make_sync_handler;
      open_or_throw(io_, addresses_, settings_, *settings_.sync_port, "sync_port", clock);
      sync_port_ = add(std::move(clock));
    }
    std::vector<int> robot_ports;
    for (const RobotInfo& robot : host_->robots()) robot_ports.push_back(robot.port);
    for (const auto& [robot_port, port] : wanted_player_ports(settings_, robot_ports)) {
      Listener player;
      open_or_throw(io_, addresses_, settings_, port, "player_port", player);
      player.make = [robot_port = robot_port, tcp_port = player.port](Peer& peer, Hub& hub) {
        return std::make_unique<PlayerConnection>(peer, hub, robot_port, tcp_port);
      };
      player_ports_[robot_port] = add(std::move(player));
    }
    if (settings_.open_streams) {
      try {
        open_morse_streams(*this);
      } catch (const protocol::ProtocolError& error) {
        throw_issue("server/no-port", "open_streams", "a free port for each of MORSE's streams",
                    error.what(), "give another first port, stream_port");
      }
    }
    tick();
    thread_ = std::thread([this] { serve(); });
  }
  ~Body() override { stop(); }

  [[nodiscard]] int port() const noexcept { return port_; }
  [[nodiscard]] int sync_port() const noexcept { return sync_port_; }
  [[nodiscard]] const std::map<int, int>& player_ports() const noexcept override {
    return player_ports_;
  }
  [[nodiscard]] std::size_t connections() const noexcept override { return open_connections_; }
  [[nodiscard]] bool done() const noexcept {
    return quit_ || (open_connections_ == 0 && host_->finished());
  }

  void adopt(int descriptor) {
    ++open_connections_;  // at once, so that done() does not miss it
    asio::post(io_, [this, descriptor] {
      --open_connections_;
      asio::generic::stream_protocol::socket socket(io_);
      asio::error_code error;
      socket.assign(asio::generic::stream_protocol(AF_UNIX, 0), descriptor, error);
      if (!error && !stopping_) {
        admit(services_, /*services=*/true, std::move(socket), unix_peer_name(descriptor));
      }
    });
  }

  void stop() noexcept {
    if (!thread_.joinable()) return;
    asio::post(io_, [this] { begin_stop(); });
    thread_.join();
  }

  // Hub
  [[nodiscard]] Host& host() noexcept override { return *host_; }
  [[nodiscard]] const ServerSettings& settings() const noexcept override { return settings_; }
  [[nodiscard]] const Access& access() const noexcept override { return access_; }
  void log(sim::LogLevel level, const std::string& text) override {
    if (log_) log_(level, text);
  }
  void post(std::function<void()> task) override;
  std::uint64_t after(std::chrono::microseconds delay, std::function<void()> task) override;
  void cancel(std::uint64_t timer) override { timers_.erase(timer); }
  void work(Job job) override;
  [[nodiscard]] std::shared_ptr<void> claim_room(std::size_t bytes) override;
  void pump() override;
  void expect_soon() override { expects_soon_ = true; }
  int listen(int first, MakeHandler make) override;
  void hand_over(Peer& peer, std::unique_ptr<Handler> handler) override {
    static_cast<Connection&>(peer).hand_over(std::move(handler));
  }
  void quit() override { quit_ = true; }
  [[nodiscard]] ThreadId thread_id(const std::string& process, std::uint64_t thread) override;

 private:
  // ConnectionOwner
  [[nodiscard]] const ServerLimits& limits() const noexcept override { return settings_.limits; }
  void handler_gone() override {
    --open_connections_;
    pump();
  }
  void ended(Connection& connection) override;

  void warn_if_not_private();
  void serve();
  /// Runs the event loop to its end.
  void run_loop();
  int add(Listener listener);
  void accept(Listener& listener, tcp::acceptor& acceptor);
  void accept_later(Listener& listener, tcp::acceptor& acceptor, const asio::error_code& error);
  void warn_of(Clock::time_point& last, const std::string& text);
  void listen_on_unix_socket();
  void accept_on_unix_socket();
  void admit_tcp(const Listener& listener, tcp::socket socket);
  /// Serves a connected socket. @param services  whether it may get a message why it is refused.
  void admit(const MakeHandler& make, bool services, asio::generic::stream_protocol::socket socket,
             const std::string& name);
  void tick();
  void run_tasks();
  void run_tasks_soon();
  void run(const std::function<void()>& task);
  void begin_stop();
  void end_stop_when_closed();

  asio::io_context io_{1};
  std::shared_ptr<Host> host_;
  ServerSettings settings_;
  sim::LogHook log_;
  Access access_;
  MakeHandler services_;  ///< makes the handlers of services
  std::vector<asio::ip::address> addresses_;
  int port_ = 0;
  int sync_port_ = 0;
  std::map<int, int> player_ports_;

  std::vector<std::unique_ptr<Listener>> listeners_;
  std::optional<UnixListener> unix_listener_;
  std::unordered_set<std::shared_ptr<Connection>> connections_;  ///< also those that are closing
  std::size_t refused_ = 0;                                      ///< how many of them were refused
  std::atomic<std::size_t> open_connections_{0};
  std::atomic<std::size_t> claimed_bytes_{0};  ///< see claim_room()
  std::atomic<bool> quit_{false};
  Clock::time_point accept_warned_{};
  Clock::time_point full_warned_{};

  asio::steady_timer ticker_{io_};
  std::map<std::uint64_t, std::unique_ptr<asio::steady_timer>> timers_;
  std::uint64_t next_timer_ = 1;

  std::mutex task_mutex_;  ///< guards the next two
  std::vector<std::function<void()>> tasks_;
  bool run_posted_ = false;
  bool pumping_ = false;
  bool pump_again_ = false;
  bool pump_posted_ = false;
  bool expects_soon_ = false;
  ShortWait short_wait_;

  /// The known threads of a process with clients here.
  struct Process {
    std::map<std::uint64_t, ThreadId> threads;
    std::uint64_t last_use = 0;
  };
  std::map<std::string, Process> processes_;
  std::uint64_t process_uses_ = 0;

  WorkerThread worker_;

  bool stopping_ = false;
  Clock::time_point stop_deadline_{};
  std::atomic<std::thread::id> own_thread_{};
  std::thread thread_;
};

void ServerHub::Body::warn_if_not_private() {
  if (!host_->own_sensors_only()) return;
  for (const RobotInfo& robot : host_->robots()) {
    if (settings_.access.robot_tokens.contains(robot.name)) continue;
    log(sim::LogLevel::kWarning,
        "the world is private (\"privacy\"), but robot " + robot.name +
            " has no token: anybody who connects to its port reads its sensors. `playpen token "
            "WORLD` makes a file with tokens for all robots");
    return;
  }
}

// --- Ports

int ServerHub::Body::listen(int first, MakeHandler make) {
  Listener listener;
  listener.make = std::move(make);
  asio::error_code error;
  const int last = std::min(first == 0 ? 0 : first + kPortsTried, 65535);
  for (int port = first; port <= last; ++port) {
    error = open(io_, addresses_, port, listener);
    if (!error) return add(std::move(listener));
    if (error != asio::error::address_in_use) break;
  }
  throw protocol::ProtocolError(
      "server/no-port",
      "no port can be opened from " + std::to_string(first) + " on: " + error.message());
}

int ServerHub::Body::add(Listener listener) {
  listeners_.push_back(std::make_unique<Listener>(std::move(listener)));
  Listener& added = *listeners_.back();
  for (tcp::acceptor& acceptor : added.acceptors) accept(added, acceptor);
  return added.port;
}

// --- Connections

void ServerHub::Body::accept(Listener& listener, tcp::acceptor& acceptor) {
  acceptor.async_accept(
      [this, &listener, &acceptor](const asio::error_code& error, tcp::socket socket) {
        if (stopping_ || error == asio::error::operation_aborted) return;
        if (!error) admit_tcp(listener, std::move(socket));
        // Connections that the peer aborted before they were accepted are not an error.
        if (!error || error == asio::error::connection_aborted) return accept(listener, acceptor);
        accept_later(listener, acceptor, error);
      });
}

// The system has no resources, perhaps no file descriptors. New connections wait in the backlog; an
// immediate retry would only keep the processor busy.
void ServerHub::Body::accept_later(Listener& listener, tcp::acceptor& acceptor,
                                   const asio::error_code& error) {
  warn_of(accept_warned_, "no connection can be accepted for now: " + error.message());
  after(kAcceptPause, [this, &listener, &acceptor] { accept(listener, acceptor); });
}

// Limits the rate of warnings.
void ServerHub::Body::warn_of(Clock::time_point& last, const std::string& text) {
  const Clock::time_point now = Clock::now();
  if (last != Clock::time_point{} && now - last < kWarningPause) return;
  last = now;
  log(sim::LogLevel::kWarning, text);
}

void ServerHub::Body::listen_on_unix_socket() {
  unix_listener_.emplace(io_, settings_.unix_path);
  accept_on_unix_socket();
}

void ServerHub::Body::accept_on_unix_socket() {
  unix_listener_->accept(
      [this](asio::generic::stream_protocol::socket socket, const std::string& name) {
        if (!stopping_) admit(services_, /*services=*/true, std::move(socket), name);
      },
      [this](const asio::error_code& error) {
        warn_of(accept_warned_, "no connection can be accepted for now: " + error.message());
        after(kAcceptPause, [this] {
          if (!stopping_) accept_on_unix_socket();
        });
      });
}

void ServerHub::Body::admit_tcp(const Listener& listener, tcp::socket socket) {
  asio::error_code error;
  const tcp::endpoint remote = socket.remote_endpoint(error);
  if (error) return;  // disconnected already
  socket.set_option(tcp::no_delay(true), error);
  socket.set_option(asio::socket_base::keep_alive(true), error);
  for (const auto& [option, value] :
       {std::pair(TCP_KEEPIDLE, kKeepAliveIdle_s), std::pair(TCP_KEEPINTVL, kKeepAliveInterval_s),
        std::pair(TCP_KEEPCNT, kKeepAliveProbes)}) {
    setsockopt(socket.native_handle(), IPPROTO_TCP, option, &value, sizeof value);
  }
  admit(listener.make, listener.services, std::move(socket), text_of(remote));
}

void ServerHub::Body::admit(const MakeHandler& make, bool services,
                            asio::generic::stream_protocol::socket socket,
                            const std::string& name) {
  close_on_exec(socket.native_handle());
  asio::error_code error;
  socket.non_blocking(true, error);
  const bool full = connections_.size() - refused_ >= limits().connections;
  if (full) warn_of(full_warned_, "all connections are in use, further ones are refused");
  if (full && (refused_ >= kRefused || !services)) {
    return;
  }
  const auto connection =
      std::make_shared<Connection>(std::move(socket), name, static_cast<ConnectionOwner&>(*this));
  connections_.insert(connection);
  if (full) {
    ++refused_;
    connection->refuse("- FAILED \"server/full: this server has all the " +
                       std::to_string(limits().connections) + " connections that it takes\"\n");
    return;
  }
  log(sim::LogLevel::kDebug, connection->name() + ": connected");
  ++open_connections_;
  try {
    connection->start(make(*connection, *this));
  } catch (const std::exception& e) {
    --open_connections_;
    connection->end(e.what());
  }
}

void ServerHub::Body::ended(Connection& connection) {
  if (connection.refused()) --refused_;
  log(connection.refused() ? sim::LogLevel::kDebug : sim::LogLevel::kInfo, connection.summary());
  connections_.erase(connection.shared_from_this());
  if (stopping_) end_stop_when_closed();
}

void ServerHub::Body::tick() {
  ticker_.expires_after(kTick);
  ticker_.async_wait([this](const asio::error_code& error) {
    if (error) return;
    const Clock::time_point now = Clock::now();
    // A copy, since connections that end are removed.
    const std::vector<std::shared_ptr<Connection>> all(connections_.begin(), connections_.end());
    for (const auto& connection : all) connection->enforce_limits(now);
    if (stopping_ && now >= stop_deadline_) {
      for (const auto& connection : all) connection->end("the server ended");
    }
    if (!settings_.onlookers) host_->check_silence();
    pump();
    tick();
  });
}

// --- The thread

void ServerHub::Body::serve() {
  const virtual_time::Inside inside;  // in a program whose time is virtual, this thread's is real
  leave_signals_to_program();
  own_thread_ = std::this_thread::get_id();
  for (;;) {
    try {
      run_loop();
      break;
    } catch (const std::exception& e) {
      log(sim::LogLevel::kError, std::string("the server's thread: ") + e.what());
    }
  }
  // All handlers are destroyed. Now end the work and the alarms of the shared state, which must not
  // reach a destroyed hub.
  worker_.close();
  morse_state.reset();
  native_state.reset();
}

void ServerHub::Body::run_loop() {
  while (!io_.stopped()) {
    if (std::exchange(expects_soon_, false) &&
        short_wait_.look([this] { return io_.poll() > 0 || io_.stopped(); })) {
      continue;
    }
    io_.run_one();
  }
}

void ServerHub::Body::post(std::function<void()> task) {
  // pump() runs tasks that this thread posts meanwhile, so no further turn is needed.
  const bool done_soon = own_thread_.load() == std::this_thread::get_id() && pumping_;
  {
    const std::lock_guard lock(task_mutex_);
    tasks_.push_back(std::move(task));
  }
  if (!done_soon) run_tasks_soon();
}

void ServerHub::Body::run_tasks_soon() {
  {
    const std::lock_guard lock(task_mutex_);
    if (run_posted_ || tasks_.empty()) return;
    run_posted_ = true;
  }
  asio::post(io_, [this] {
    {
      const std::lock_guard lock(task_mutex_);
      run_posted_ = false;
    }
    run_tasks();
  });
}

// Tasks that are posted meanwhile wait for another turn.
void ServerHub::Body::run_tasks() {
  std::vector<std::function<void()>> tasks;
  {
    const std::lock_guard lock(task_mutex_);
    tasks.swap(tasks_);
  }
  for (const auto& task : tasks) run(task);
}

void ServerHub::Body::run(const std::function<void()>& task) {
  try {
    task();
  } catch (const std::exception& e) {
    log(sim::LogLevel::kError, std::string("the server: ") + e.what());
  }
}

void ServerHub::Body::pump() {
  if (pumping_) {
    pump_again_ = true;
    return;
  }
  if (pump_posted_) return;
  pumping_ = true;
  const Clock::time_point end = Clock::now() + kSlice;
  bool more = false;
  do {
    pump_again_ = false;
    run([&] { more = !settings_.onlookers && host_->advance(kSlice); });
    run_tasks();
  } while (pump_again_ && Clock::now() < end);
  pumping_ = false;
  run_tasks_soon();
  if (more || pump_again_) {
    pump_posted_ = true;
    asio::post(io_, [this] {
      pump_posted_ = false;
      pump();
    });
  }
}

std::uint64_t ServerHub::Body::after(std::chrono::microseconds delay, std::function<void()> task) {
  const std::uint64_t id = next_timer_++;
  auto& timer = timers_[id];
  timer = std::make_unique<asio::steady_timer>(io_, delay);
  timer->async_wait([this, id, task = std::move(task)](const asio::error_code& error) {
    if (error || timers_.erase(id) == 0) return;
    run(task);
  });
  return id;
}

void ServerHub::Body::work(Job job) {
  job.done = [this, done = std::move(job.done)](const std::exception_ptr& error) {
    post([done, error] { done(error); });
  };
  worker_.add(std::move(job));
}

std::shared_ptr<void> ServerHub::Body::claim_room(std::size_t bytes) {
  std::size_t waiting = claimed_bytes_;
  for (const auto& connection : connections_) waiting += connection->queued_bytes();
  if (waiting > 0 && waiting + bytes > limits().all_queued_bytes) {
    throw protocol::ProtocolError(
        "server/busy", "an answer of " + std::to_string(bytes) + " bytes is too large for now: " +
                           std::to_string(waiting) + " wait to be read by clients, and at most " +
                           std::to_string(limits().all_queued_bytes) + " may; ask again later");
  }
  claimed_bytes_ += bytes;
  return {nullptr, [this, bytes](void*) { claimed_bytes_ -= bytes; }};
}

ThreadId ServerHub::Body::thread_id(const std::string& process, std::uint64_t thread) {
  if (process.size() > kProcessName) {
    throw protocol::ProtocolError(
        "protocol/bad-value",
        "the name of a process has at most " + std::to_string(kProcessName) + " bytes");
  }
  // The end of a process is not announced, so the least recently used one is evicted.
  if (processes_.size() >= kProcesses && !processes_.contains(process)) {
    processes_.erase(std::min_element(
        processes_.begin(), processes_.end(),
        [](const auto& a, const auto& b) { return a.second.last_use < b.second.last_use; }));
  }
  Process& known = processes_[process];
  known.last_use = ++process_uses_;
  if (known.threads.size() >= kThreadsOfAProcess && !known.threads.contains(thread)) {
    known.threads.clear();
  }
  ThreadId& id = known.threads[thread];
  if (id == 0) id = new_thread_id();
  return id;
}

// --- The end

void ServerHub::Body::begin_stop() {
  if (stopping_) return;
  stopping_ = true;
  stop_deadline_ = Clock::now() + kStopTime;
  asio::error_code ignored;
  for (const auto& listener : listeners_) {
    for (tcp::acceptor& acceptor : listener->acceptors) acceptor.close(ignored);
  }
  if (unix_listener_) unix_listener_->close();
  const std::vector<std::shared_ptr<Connection>> all(connections_.begin(), connections_.end());
  for (const auto& connection : all) {
    connection->fail(protocol::ProtocolError("server/closing", "the server ends"));
    connection->hurry(stop_deadline_);
  }
  end_stop_when_closed();
}

void ServerHub::Body::end_stop_when_closed() {
  if (connections_.empty()) io_.stop();
}

// --- The hub

ServerHub::ServerHub(std::shared_ptr<Host> host, ServerSettings settings, sim::LogHook log,
                     MakeHandler services)
    : body_(std::make_unique<Body>(std::move(host), std::move(settings), std::move(log),
                                   std::move(services))) {}
ServerHub::~ServerHub() = default;

void ServerHub::check(const ServerSettings& settings, const std::vector<std::string>& robots,
                      const std::vector<int>& robot_ports) {
  std::vector<RobotInfo> infos(robots.size());
  for (std::size_t i = 0; i < robots.size(); ++i) infos[i].name = robots[i];
  const Access access(settings.access, infos);
  asio::io_context io;
  const std::vector<asio::ip::address> addresses = checked_addresses(io, settings);
  Listener services;
  Listener clock;
  if (settings.port) open_or_throw(io, addresses, settings, *settings.port, "port", services);
  if (!settings.unix_path.empty()) UnixListener::check(settings.unix_path);
  if (settings.sync_port) {
    open_or_throw(io, addresses, settings, *settings.sync_port, "sync_port", clock);
  }
  std::list<Listener> players;
  for (const auto& [robot_port, port] : wanted_player_ports(settings, robot_ports)) {
    open_or_throw(io, addresses, settings, port, "player_port", players.emplace_back());
  }
}

int ServerHub::port() const noexcept { return body_->port(); }
int ServerHub::sync_port() const noexcept { return body_->sync_port(); }
const std::map<int, int>& ServerHub::player_ports() const noexcept { return body_->player_ports(); }
std::size_t ServerHub::connections() const noexcept { return body_->connections(); }
bool ServerHub::done() const noexcept { return body_->done(); }
void ServerHub::adopt(int descriptor) { body_->adopt(descriptor); }
void ServerHub::stop() noexcept { body_->stop(); }

}  // namespace playerlike::server
