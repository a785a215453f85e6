// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Speed of remote clients on loopback: the server is a separate process, the clients run here.
#include <benchmark/benchmark.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "figures.h"
#include "libCCMorse/CCMorse.h"
#include "libplayerc++/playerc++.h"
#include "playerlike/host/host.h"
#include "playerlike/server/server.h"
#include "realtime.h"

namespace sim::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kWidth = 172;
constexpr int kHeight = 186;

/// A server in a separate process, which ends with this object.
class ServerProcess {
 public:
  explicit ServerProcess(const char* world, double time_factor = 0.0) {
    std::array<int, 2> ports{};
    std::array<int, 2> life{};
    if (pipe(ports.data()) != 0 || pipe(life.data()) != 0) throw std::runtime_error("no pipe");
    child_ = fork();
    if (child_ == 0) {
      close(life[1]);
      serve(world, time_factor, ports[1], life[0]);
    }
    close(ports[1]);
    close(life[0]);
    life_ = life[1];
    const bool told = read(ports[0], told_.data(), sizeof told_) == sizeof told_;
    close(ports[0]);
    if (!told) throw std::runtime_error("the server does not start");
  }
  ~ServerProcess() {
    close(life_);
    waitpid(child_, nullptr, 0);
  }
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  [[nodiscard]] int port() const { return told_[0]; }
  [[nodiscard]] std::string host() const { return "tcp://127.0.0.1:" + std::to_string(port()); }
  /// The first robot for clients of Player's protocol.
  [[nodiscard]] std::string player_host() const {
    return "player://127.0.0.1:" + std::to_string(told_[1]);
  }

 private:
  [[noreturn]] static void serve(const char* world, double time_factor, int ports, int life) {
    playerlike::RunSettings run;
    if (time_factor > 0.0) {
      run.time_mode = TimeMode::kPaced;
      run.time_factor = time_factor;
      run.start_at_once = true;
    }
    const auto host = playerlike::Host::create(endless(world), run);
    playerlike::ServerSettings settings;
    settings.port = 0;
    settings.stream_port = 0;
    settings.player_port = 0;
    {
      const playerlike::Server server(host, settings);
      const std::array<int, 2> told{server.port(), server.player_ports().begin()->second};
      if (write(ports, told.data(), sizeof told) != sizeof told) std::_Exit(1);
      char byte = 0;
      while (read(life, &byte, 1) > 0) {
      }
    }
    std::_Exit(0);
  }

  pid_t child_ = -1;
  int life_ = -1;
  std::array<int, 2> told_{};  ///< ports of the services and of the first robot
};

/// A plain connection.
class Connection {
 public:
  explicit Connection(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
      throw std::runtime_error("cannot connect");
    }
    const int on = 1;
    setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  }
  ~Connection() { close(socket_); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void write_all(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t count = ::write(socket_, text.data(), text.size());
      if (count <= 0) throw std::runtime_error("the server has gone");
      text.remove_prefix(static_cast<std::size_t>(count));
    }
  }
  /// Reads until this many lines have arrived.
  void read_lines(int lines) const {
    std::array<char, 65536> buffer{};
    while (lines > 0) {
      const ssize_t count = ::read(socket_, buffer.data(), buffer.size());
      if (count <= 0) throw std::runtime_error("the server has gone");
      lines -= static_cast<int>(std::count(buffer.data(), buffer.data() + count, '\n'));
    }
  }
  [[nodiscard]] int descriptor() const { return socket_; }

 private:
  int socket_;
};

/// Read() rounds per second of Player's protocol with pose and laser.
double player_read_rounds(const std::string& host) {
  PlayerCc::PlayerClient client(host, 6665);
  PlayerCc::Position2dProxy pose(&client, 0);
  PlayerCc::LaserProxy laser(&client, 0);
  for (int i = 0; i < 200; ++i) client.Read();
  return 1.0 / seconds_per_call([&] { client.Read(); }, 1000, 9);
}

/// Read() rounds per second with pose, odometry and laser.
double read_rounds(const std::string& host, const char* encoding) {
  setenv("PLAYPEN_ENCODING", encoding, 1);
  PlayerCc::PlayerClient client(host, 6665);
  PlayerCc::Position2dProxy pose(&client, 0);
  PlayerCc::Position2dProxy odometry(&client, 1);
  PlayerCc::LaserProxy laser(&client, 0);
  for (int i = 0; i < 200; ++i) client.Read();
  return 1.0 / seconds_per_call([&] { client.Read(); }, 1000, 9);
}

void read_figures() {
  const double in_process = read_rounds(std::string("sim:") + kOne, "cbor");
  const ServerProcess server(kOne);
  const double cbor = read_rounds(server.host(), "cbor");
  const double json = read_rounds(server.host(), "json");
  const double player = player_read_rounds(server.player_host());
  figure("read_rounds_per_s_in_process", in_process);
  figure("read_rounds_per_s_cbor", cbor);
  figure("read_rounds_per_s_json", json);
  figure("player_wire_reads_per_second", player);
}

/// Whole canvases per second: each one is sent, and the last one is read back.
double canvases(const std::string& host, const char* encoding) {
  setenv("PLAYPEN_ENCODING", encoding, 1);
  PlayerCc::PlayerClient client(host, 4000);
  CCMorse::WindowProxy& window = CCMorse::WindowProxy::GetInstance(&client, kWidth, kHeight);
  std::array<std::vector<std::uint8_t>, 2> images;  // RGBA
  for (std::size_t i = 0; i < images.size(); ++i) {
    for (int cell = 0; cell < kWidth * kHeight; ++cell) {
      images[i].insert(images[i].end(),
                       {static_cast<std::uint8_t>(cell + 7 * static_cast<int>(i)), 100, 200, 255});
    }
  }
  constexpr int kCanvases = 100;
  std::size_t turn = 0;
  const double round_s = seconds_per_call(
      [&] {
        for (int i = 0; i < kCanvases; ++i) {
          turn = 1 - turn;
          window.SetImage(images[turn]);
        }
        benchmark::DoNotOptimize(window.GetPixel(0, 0));
      },
      1, 15);
  delete &window;
  return kCanvases / round_s;
}

/// Whole canvases per second, pixel by pixel through MORSE's set_pixel. With in_flight = 1 it waits
/// for each answer, otherwise it keeps that many requests in flight.
double canvases_by_set_pixel(int port, int in_flight) {
  const Connection connection(port);
  const int pixels = 2000 * in_flight;
  const auto draw = [&] {
    for (int i = 0; i < pixels; i += in_flight) {
      std::string requests;
      for (int k = i; k < i + in_flight; ++k) {
        requests += std::to_string(k) + " r1.pen set_pixel [" + std::to_string(k % kWidth) + ", " +
                    std::to_string(k / kWidth % kHeight) + ", 255, 0, 0]\n";
      }
      connection.write_all(requests);
      connection.read_lines(in_flight);
    }
  };
  const double pixel_s = seconds_per_call(draw, 1, 5) / pixels;
  return 1.0 / (pixel_s * kWidth * kHeight);
}

void canvas_figures() {
  const ServerProcess server(kOne);
  const double cbor = canvases(server.host(), "cbor");
  const double json = canvases(server.host(), "json");
  const double single = canvases_by_set_pixel(server.port(), 1);
  const double many = canvases_by_set_pixel(server.port(), 64);
  figure("canvases_per_s_cbor", cbor);
  figure("canvases_per_s_json", json);
  figure("canvases_per_s_set_pixel", single);
  figure("canvases_per_s_set_pixel_64_in_flight", many);
  figure("canvas_speedup_over_set_pixel", cbor / single);
  figure("canvas_speedup_over_set_pixel_64_in_flight", cbor / many);
}

/// Watching clients in a separate process, which ends with this object.
class Watchers {
 public:
  Watchers(int port, int count) : child_(count > 0 ? fork() : -1) {
    if (child_ == 0) watch(port, count);
  }
  ~Watchers() {
    if (child_ <= 0) return;
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
  }
  Watchers(const Watchers&) = delete;
  Watchers& operator=(const Watchers&) = delete;

 private:
  [[noreturn]] static void watch(int port, int count) {
    std::vector<std::unique_ptr<Connection>> connections;
    std::vector<pollfd> polls;
    for (int i = 0; i < count; ++i) {
      connections.push_back(std::make_unique<Connection>(port));
      connections.back()->write_all("1 playpen hello [{\"version\": 1, \"encoding\": \"cbor\"}]\n");
      connections.back()->read_lines(1);
      // {"id": 1, "do": "watch", "rate": 10, "canvas": true} as CBOR
      constexpr std::string_view kWatch =
          "\x00\x00\x00\x22\xa4\x62id\x01\x62"
          "do\x65watch\x64rate\x0a\x66"
          "canvas\xf5";
      std::string frame(kWatch.data(), kWatch.size());
      frame[3] = static_cast<char>(frame.size() - 4);
      connections.back()->write_all(frame);
      polls.push_back({connections.back()->descriptor(), POLLIN, 0});
    }
    std::vector<char> buffer(std::size_t{1} << 20U);
    for (;;) {
      poll(polls.data(), polls.size(), -1);
      for (const pollfd& ready : polls) {
        if (ready.revents != 0 && read(ready.fd, buffer.data(), buffer.size()) <= 0) std::_Exit(1);
      }
    }
  }

  pid_t child_;
};

/// Steps per wall second of a paced simulation of 13 wandering robots whose requested speed is
/// higher than possible.
double paced_steps(int watchers) {
  const ServerProcess server(kThirteen, 1e6);
  PlayerCc::PlayerClient client(server.host(), 4000);
  const CCMorse::MorseTime time(client);
  std::vector<std::unique_ptr<PlayerCc::Position2dProxy>> robots;
  for (unsigned i = 0; i < 13; ++i) {
    robots.push_back(std::make_unique<PlayerCc::Position2dProxy>(&client, i));
    robots.back()->SetSpeed(0.3, 0.5);
  }
  const Watchers audience(server.port(), watchers);
  sleep(1);
  const double sim_begin = time.Now();
  const auto begin = Clock::now();
  sleep(4);
  const double simulated_s = time.Now() - sim_begin;
  const std::chrono::duration<double> took = Clock::now() - begin;
  return simulated_s / took.count() * 100.0;
}

void watch_figures() {
  double alone = 0.0;
  double watched = 0.0;
  for (int round = 0; round < 3; ++round) {
    alone = std::max(alone, paced_steps(0));
    watched = std::max(watched, paced_steps(100));
  }
  figure("paced_steps_per_s", alone);
  figure("paced_steps_per_s_100_watchers", watched);
  figure("slowdown_by_100_watchers", 1.0 - watched / alone);
}

}  // namespace
}  // namespace sim::bench

int main() {
  sim::bench::read_figures();
  sim::bench::canvas_figures();
  sim::bench::watch_figures();
}
