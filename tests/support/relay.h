// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace test {

/// A socket that listens on any free port of loopback.
class ListeningSocket {
 public:
  explicit ListeningSocket(bool v6 = false) : socket_(::socket(v6 ? AF_INET6 : AF_INET, kType, 0)) {
    if (socket_ < 0) throw std::runtime_error("no socket");
    sockaddr_storage storage{};
    socklen_t size = 0;
    if (v6) {
      auto& address = reinterpret_cast<sockaddr_in6&>(storage);
      address.sin6_family = AF_INET6;
      address.sin6_addr = in6addr_loopback;
      size = sizeof address;
    } else {
      auto& address = reinterpret_cast<sockaddr_in&>(storage);
      address.sin_family = AF_INET;
      address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
      size = sizeof address;
    }
    auto* plain = reinterpret_cast<sockaddr*>(&storage);
    if (bind(socket_, plain, size) != 0 || listen(socket_, 16) != 0 ||
        getsockname(socket_, plain, &size) != 0) {
      close(socket_);
      throw std::runtime_error("cannot listen on loopback");
    }
    port_ = ntohs(v6 ? reinterpret_cast<sockaddr_in6&>(storage).sin6_port
                     : reinterpret_cast<sockaddr_in&>(storage).sin_port);
  }
  ListeningSocket(const ListeningSocket&) = delete;
  ListeningSocket& operator=(const ListeningSocket&) = delete;
  ~ListeningSocket() { close(socket_); }

  [[nodiscard]] int descriptor() const noexcept { return socket_; }
  [[nodiscard]] int port() const noexcept { return port_; }

 private:
  static constexpr int kType = SOCK_STREAM | SOCK_CLOEXEC;
  int socket_;
  int port_ = 0;
};

/// A proxy between clients and a server on loopback that can inject faults of networks and servers.
/// Its own thread forwards bytes.
class Relay {
 public:
  /// @param server_port  port of the server.
  explicit Relay(int server_port) : server_port_(server_port), thread_([this] { run(); }) {}
  /// Without a server: answers each connection with this text and then sends nothing.
  explicit Relay(std::string text) : text_(std::move(text)), thread_([this] { run(); }) {}
  Relay(const Relay&) = delete;
  Relay& operator=(const Relay&) = delete;
  ~Relay() {
    stop_ = true;
    thread_.join();
  }

  [[nodiscard]] int port() const noexcept { return listening_.port(); }
  /// Forwards new connections to another server; 0: closes them at once.
  void set_server(int port) noexcept { server_port_ = port; }
  /// Stops forwarding until it is undone.
  void freeze(bool frozen = true) noexcept { frozen_ = frozen; }
  /// Cuts all connections after this many further bytes from servers.
  void cut_after(int bytes) noexcept { bytes_left_ = bytes; }
  /// Number of connections so far.
  [[nodiscard]] int connections() const noexcept { return connections_; }

 private:
  struct Pair {
    int client;
    int server;
  };

  void run() {
    std::vector<Pair> pairs;
    while (!stop_) {
      std::vector<pollfd> polled{{listening_.descriptor(), POLLIN, 0}};
      for (const Pair& pair : pairs) {
        // poll() ignores a negative descriptor.
        polled.push_back({frozen_ ? -1 : pair.client, POLLIN, 0});
        polled.push_back({frozen_ ? -1 : pair.server, POLLIN, 0});
      }
      if (poll(polled.data(), polled.size(), 5) <= 0) continue;
      for (std::size_t i = pairs.size(); i-- > 0;) {
        const bool good =
            (polled[2 * i + 1].revents == 0 || pass(pairs[i].client, pairs[i].server)) &&
            (polled[2 * i + 2].revents == 0 || answer(pairs[i]));
        if (!good) {
          end(pairs[i]);
          pairs.erase(pairs.begin() + static_cast<std::ptrdiff_t>(i));
        }
      }
      if (polled[0].revents != 0) accept_one(pairs);
    }
    for (const Pair& pair : pairs) end(pair);
  }

  void accept_one(std::vector<Pair>& pairs) {
    const int client = accept(listening_.descriptor(), nullptr, nullptr);
    if (client < 0) return;
    ++connections_;
    Pair pair{client, -1};
    if (!text_.empty()) {
      static_cast<void>(send_all(client, text_));
    } else {
      pair.server = connect_to_server();
      if (pair.server < 0) return end(pair);
    }
    pairs.push_back(pair);
  }

  [[nodiscard]] int connect_to_server() const {
    if (server_port_ == 0) return -1;
    const int server = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(server_port_.load()));
    if (connect(server, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) return server;
    close(server);
    return -1;
  }

  static void end(const Pair& pair) {
    close(pair.client);
    if (pair.server >= 0) close(pair.server);
  }

  static bool send_all(int to, std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t count = send(to, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (count <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
  }

  static bool pass(int from, int to) {
    std::array<char, 65536> buffer;
    const ssize_t count = recv(from, buffer.data(), buffer.size(), 0);
    if (count <= 0) return false;
    // Without a server, the bytes are discarded.
    return to < 0 || send_all(to, {buffer.data(), static_cast<std::size_t>(count)});
  }

  bool answer(const Pair& pair) {
    const int left = bytes_left_;
    if (left < 0) return pass(pair.server, pair.client);
    std::array<char, 4096> buffer;
    const std::size_t most = std::min(buffer.size(), static_cast<std::size_t>(left));
    const ssize_t count = most == 0 ? 0 : recv(pair.server, buffer.data(), most, 0);
    if (count <= 0) {
      bytes_left_ = -1;
      return false;
    }
    bytes_left_ = left - static_cast<int>(count);
    return send_all(pair.client, {buffer.data(), static_cast<std::size_t>(count)});
  }

  ListeningSocket listening_;
  std::string text_;
  std::atomic<int> server_port_{0};
  std::atomic<bool> frozen_{false};
  std::atomic<int> bytes_left_{-1};  ///< remaining bytes before the cut; -1: no cut
  std::atomic<int> connections_{0};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace test
