// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Thousands of bad clients at the ports of Player's protocol, and good ones among them: 2000 per
// merge, 10 000 in nightly runs.
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "nightly.h"
#include "patience.h"
#include "patient_host.h"
#include "player_wire_client.h"
#include "playerlike/server/server.h"

namespace playerlike::server {
namespace {

using test_support::PlayerMessage;
using test_support::PlayerWireClient;
using test_support::RawClient;

// Many times the limit of connections, which is 300.
int client_count() { return test_support::cases(2'000, 10'000); }
constexpr int kThreads = 4;
constexpr int kAtOnce = 25;  // connections of a thread
constexpr int kKinds = 10;   // of bad clients, see last_words()
constexpr int kTooLong = 4;
constexpr double kScanPeriod_s = 0.1;

std::string request(int subtype, std::string_view payload = "") {
  return PlayerWireClient::message(PLAYER_MSGTYPE_REQ, PLAYER_PLAYER_CODE, 0, subtype, payload);
}

/// A header that announces a payload of another size than it has.
std::string lie(std::uint32_t size, std::string_view payload = "") {
  player::Msghdr header;
  header.addr.interf = PLAYER_LASER_CODE;
  header.type = PLAYER_MSGTYPE_REQ;
  header.subtype = 1;
  std::string bytes;
  player::append_message(bytes, header, std::string_view());
  for (int i = 0; i < 4; ++i) {  // the last field, big endian
    bytes[player::kHeaderBytes - 1 - static_cast<std::size_t>(i)] =
        static_cast<char>(size >> (8 * i) & 0xffU);
  }
  return bytes + std::string(payload);
}

/// What a bad client sends before it drops its connection.
std::string last_words(int client) {
  const std::string pull = request(
      PLAYER_PLAYER_REQ_DATAMODE,
      player::encode(player::DeviceDatamodeReq{static_cast<std::uint8_t>(PLAYER_DATAMODE_PULL)}));
  player::DeviceReq laser;
  laser.addr.interf = PLAYER_LASER_CODE;
  laser.access = PLAYER_OPEN_MODE;
  const std::string open = request(PLAYER_PLAYER_REQ_DEV, player::encode(laser));
  const std::string wish = pull + open + request(PLAYER_PLAYER_REQ_DATA);
  switch (client % kKinds) {
    case 0:
      return "";
    case 1:  // half a header, or more
      return wish.substr(0, static_cast<std::size_t>(client) % wish.size());
    case 2:  // takes part in lockstep, and then no longer
      return wish;
    case 3:  // data come without a request
      return open;
    case kTooLong:
      return lie(0xffff'ffffU);
    case 5:
      return lie(0x8000'0000U, std::string(5000, '\xff'));
    case 6:  // a part of the longest payload
      return lie(1U << 20U, std::string(1U << 16U, 'x'));
    case 7:
      return std::string(10'000, '\xff');
    case 8:
      return "GET / HTTP/1.1\r\nHost: x\r\n\r\n" + std::string(100, '\0');
    default:
      return open + lie(16, "abc");
  }
}

/// Connects several bad clients at once, lets them speak and drops them.
/// @return how many of them the server has cut off as it should.
int drop_clients(int port, int first) {
  std::vector<RawClient> clients;
  for (int i = 0; i < kAtOnce; ++i) {
    clients.emplace_back("127.0.0.1", port);
    static_cast<void>(clients.back().send_if_open(last_words(first + i)));
  }
  // The server closes the connections of those that announce too much.
  int cut_off = 0;
  for (int i = 0; i < kAtOnce; ++i) {
    if ((first + i) % kKinds != kTooLong) continue;
    if (clients[static_cast<std::size_t>(i)].rest() == player::banner()) ++cut_off;
  }
  // Two of three close as a machine that crashes, one as a program that ends.
  for (std::size_t i = 0; i < clients.size(); ++i) {
    if (i % 3 != 0) clients[i].reset();
  }
  return cut_off;
}

/// Whether a message is the scan one period after another.
/// @param last_s  the time of the scan before; receives that of this one.
bool follows(const PlayerMessage& scan, double& last_s) {
  const double wait_s = scan.header.timestamp - last_s;
  last_s = scan.header.timestamp;
  return scan.header.addr.interf == PLAYER_LASER_CODE && std::abs(wait_s - kScanPeriod_s) < 1e-6;
}

/// One direction between two processes.
class Pipe {
 public:
  Pipe() {
    if (pipe(ends_.data()) != 0) throw std::runtime_error("pipe failed");
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    for (const int end : ends_) close(end);
  }
  template <typename T>
  void send(const T& value) const {
    if (write(ends_[1], &value, sizeof value) != sizeof value) {
      throw std::runtime_error("the other process has ended");
    }
  }
  template <typename T>
  [[nodiscard]] T receive() const {
    T value{};
    if (read(ends_[0], &value, sizeof value) != sizeof value) {
      throw std::runtime_error("the other process has ended");
    }
    return value;
  }
  [[nodiscard]] bool has_data() const {
    pollfd readable{ends_[0], POLLIN, 0};
    return poll(&readable, 1, 1) > 0;
  }

 private:
  std::array<int, 2> ends_{};
};

/// The process of the bad clients and of one that listens. All connections of a process count as
/// one thread in lockstep, so the driver needs another process.
/// @return whether the listener got all data and the server did as it should.
bool run_clients(const Pipe& in, const Pipe& out) {
  const std::array<int, 2> ports{in.receive<int>(), in.receive<int>()};
  for (const int port : ports) drop_clients(port, 0);
  out.send('w');

  double last_s = in.receive<double>();
  PlayerWireClient listener(ports[1]);
  if (listener.open(PLAYER_LASER_CODE).header.type != PLAYER_MSGTYPE_RESP_ACK) return false;
  out.send('r');

  std::atomic<int> next{0};
  std::atomic<int> cut_off{0};
  const int count = client_count();
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&] {
      for (int first = next.fetch_add(kAtOnce); first < count; first = next.fetch_add(kAtOnce)) {
        cut_off += drop_clients(ports[static_cast<std::size_t>(first / kAtOnce) % 2], first);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  out.send('d');

  const double end_s = in.receive<double>();
  while (last_s < end_s - kScanPeriod_s / 2) {
    if (!follows(listener.receive(), last_s)) return false;
  }
  return cut_off == count / kKinds;
}

void wait_until(const Server& server, std::size_t connections) {
  const auto end = std::chrono::steady_clock::now() + test_support::patience();
  while (server.connections() != connections && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(server.connections(), connections);
}

// In lockstep, simulated time advances for the driver only. So the time of each scan is known,
// however long the bad clients keep the server busy.
TEST(PlayerLoad, ThousandsOfInvalidClients_DisturbNobody) {
  const Pipe to_clients;
  const Pipe from_clients;
  const pid_t clients = fork();  // before there are threads
  if (clients == 0) {
    bool good = false;
    try {
      good = run_clients(to_clients, from_clients);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "the process of the clients: %s\n", error.what());
    }
    _exit(good ? 0 : 1);
  }
  const auto host = test::patient_host(sim::load_world_text(
      R"({"name": "room", "arena": {"size": [20, 4]}, "robots": [
        {"name": "r1", "pose": {"x": 1, "y": 1}}, {"name": "r2", "pose": {"x": 1, "y": 3}}]})"));
  ServerSettings settings;
  settings.port.reset();
  settings.player_port = 0;
  settings.limits.connections = 300;
  // The machine may be so busy that a good client seems to be slow.
  settings.limits.first_request_s = settings.limits.partial_request_s = 600.0;
  const Server server(host, settings);
  const int port = server.player_ports().at(6665);
  to_clients.send(port);
  to_clients.send(server.player_ports().at(6666));
  // Some bad clients come before descriptors are counted: the first create what all use.
  ASSERT_EQ(from_clients.receive<char>(), 'w');
  wait_until(server, 0);
  const std::size_t files = RawClient::open_files();

  PlayerWireClient driver(port);
  driver.set_mode(PLAYER_DATAMODE_PULL);
  ASSERT_EQ(driver.open(PLAYER_LASER_CODE).header.type, PLAYER_MSGTYPE_RESP_ACK);
  static_cast<void>(driver.round());  // from now on time waits for it
  double last_s = sim::to_seconds(host->now_ns());
  to_clients.send(last_s);
  ASSERT_EQ(from_clients.receive<char>(), 'r');

  // The driver reads meanwhile, but no more than the listener's connection can hold.
  bool done = false;
  for (int round = 0; !done || round < 100; ++round) {
    if (round < 500) {
      const std::vector<PlayerMessage> scans = driver.round();
      ASSERT_EQ(scans.size(), 1U);
      ASSERT_TRUE(follows(scans.front(), last_s)) << "round " << round;
    }
    done = done || (from_clients.has_data() && from_clients.receive<char>() == 'd');
  }
  wait_until(server, 2);
  EXPECT_NEAR(sim::to_seconds(host->now_ns()), last_s, 1e-9) << "time went on by itself";
  to_clients.send(last_s);
  int state = 0;
  ASSERT_EQ(waitpid(clients, &state, 0), clients);
  EXPECT_TRUE(WIFEXITED(state) && WEXITSTATUS(state) == 0);

  driver.socket.close();
  wait_until(server, 0);
  EXPECT_EQ(RawClient::open_files(), files);
  PlayerWireClient last(port);
  EXPECT_EQ(last.request(PLAYER_PLAYER_REQ_DEVLIST).header.type, PLAYER_MSGTYPE_RESP_ACK);
}

}  // namespace
}  // namespace playerlike::server
