// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Load of a server and its paced simulation when clients connect and disconnect, most of them
// abruptly.
//
// Usage: server_load [CLIENTS [AT_ONCE]], by default 10000 and 200. Prints figures. Ends with
// status 1 if a client that should get an answer got none, if resources of the clients remain, or
// if the clock was late by more than 50 ms.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <thread>
#include <vector>

#include "figures.h"
#include "playerlike/server/server.h"
#include "raw_client.h"

namespace {

using Clock = std::chrono::steady_clock;
using test_support::RawClient;

constexpr double kMostLate_ms = 50.0;
constexpr int kThreads = 4;

/// Measures how late the steps of a paced simulation are, compared with the most punctual one.
class Lateness {
 public:
  explicit Lateness(playerlike::Host& host) : host_(host) {
    playerlike::Alarm alarm;
    alarm.condition = [this](const sim::Simulation& simulation) {
      const double wall_s = std::chrono::duration<double>(Clock::now() - begin_).count();
      const double late_s = wall_s - sim::to_seconds(simulation.now_ns());
      least_s_ = std::min(least_s_, late_s);
      most_s_ = std::max(most_s_, late_s);
      return false;
    };
    alarm.notify = [] {};
    alarm_ = host_.set_alarm(alarm);
  }
  /// Stops measuring. @return the greatest lateness of a step [ms].
  [[nodiscard]] double stop() {
    host_.cancel_alarm(alarm_);
    return (most_s_ - least_s_) * 1e3;
  }

 private:
  playerlike::Host& host_;
  playerlike::AlarmId alarm_ = 0;
  Clock::time_point begin_ = Clock::now();
  double least_s_ = 1e9;  // with the simulation locked
  double most_s_ = -1e9;
};

/// What a client sends before it disconnects.
std::string last_words(int client) {
  switch (client % 8) {
    case 0:
      return "";
    case 1:
      return "1 simulation list_rob";
    case 2:
      return "1 r1.pose get_local_data\n2 time sleep [60]\n";
    case 3:
      return "1 playpen hello [{\"version\": 1, \"encoding\": \"cbor\"}]\n" + std::string(7, '\0');
    case 4:
      return "1 playpen hello [{\"version\": 1}]\n{\"id\": 1, \"do\": \"canvas_image\"}\n"
             "{\"id\": 2, \"do\": \"read\", \"wait\": \"data\"}\n";
    case 5:
      return "\x16\x03\x01\x02 GET / HTTP/1.1\r\nHost: x\r\n\r\n" + std::string(10'000, '\xff');
    case 6:
      return std::string(5000, '[') + '\n';
    default:
      return "1 simulation details\n";
  }
}

struct Counts {
  std::atomic<int> answered{0};
  std::atomic<int> unanswered{0};
};

/// Connects this many clients at once, lets them send their messages and disconnects them.
void drop_clients(int port, int first, int count, Counts& counts) {
  std::vector<RawClient> clients;
  for (int i = 0; i < count; ++i) {
    clients.emplace_back("127.0.0.1", port);
    if (!clients.back().send_if_open(last_words(first + i))) ++counts.unanswered;
  }
  for (int i = 7 - first % 8; i < count; i += 8) {
    const std::string answer = clients[static_cast<std::size_t>(i)].line();
    ++(answer.starts_with("1 SUCCESS") ? counts.answered : counts.unanswered);
  }
  // Half of them close like programs that are killed, half like machines that crash.
  for (std::size_t i = 0; i < clients.size(); i += 2) clients[i].reset();
}

void wait_until_empty(const playerlike::Server& server) {
  const auto end = Clock::now() + std::chrono::seconds(20);
  while (server.connections() > 0 && Clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  // Sockets are closed right after their handlers are destroyed.
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
}

int run(int clients, int at_once) {
  playerlike::RunSettings run_settings;
  run_settings.time_mode = sim::TimeMode::kPaced;
  sim::WorldDescription world =
      sim::load_world(PLAYPEN_SOURCE_DIR "/worlds/examples/thirteen_robots.json");
  world.simulation.duration_ns.reset();
  const auto host = playerlike::Host::create(std::move(world), run_settings);
  playerlike::ServerSettings settings;
  settings.port = 0;
  settings.limits.connections = 2 * static_cast<std::size_t>(at_once);
  playerlike::Server server(host, settings);

  Counts counts;
  drop_clients(server.port(), 0, 8, counts);  // warm-up for everything that is created once
  wait_until_empty(server);
  const std::size_t files_before = RawClient::open_files();

  Lateness lateness(*host);
  const auto begin = Clock::now();
  std::vector<std::thread> threads;
  std::atomic<int> next{0};
  const int batch = std::max(1, at_once / kThreads);
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&] {
      for (int first = next.fetch_add(batch); first < clients; first = next.fetch_add(batch)) {
        drop_clients(server.port(), first, std::min(batch, clients - first), counts);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  const double took_s = std::chrono::duration<double>(Clock::now() - begin).count();
  const double late_ms = lateness.stop();
  wait_until_empty(server);
  const std::size_t files_after = RawClient::open_files();

  RawClient last("127.0.0.1", server.port());
  last.send("1 simulation list_robots\n");
  const bool alive = last.line().starts_with("1 SUCCESS");

  sim::bench::figure("server_load_clients_per_s", clients / took_s);
  sim::bench::figure("server_load_late_ms", late_ms);
  sim::bench::figure("server_load_answered", counts.answered);
  sim::bench::figure("server_load_unanswered", counts.unanswered);
  sim::bench::figure("server_load_files_left",
                     static_cast<double>(files_after) - static_cast<double>(files_before));
  return alive && counts.unanswered == 0 && files_after == files_before && late_ms <= kMostLate_ms
             ? 0
             : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const int clients = argc > 1 ? std::atoi(argv[1]) : 10'000;
  const int at_once = argc > 2 ? std::atoi(argv[2]) : 200;
  if (clients < 1 || at_once < 1) {
    std::fprintf(stderr, "Usage: server_load [CLIENTS [AT_ONCE]]\n");
    return 2;
  }
  try {
    return run(clients, at_once);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "server_load: %s\n", e.what());
    return 1;
  }
}
