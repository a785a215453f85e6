// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "patience.h"

namespace test_support {

/// A client that is only a TCP socket, for behaviour that no well-behaved client shows. Waiting
/// longer than patience() throws std::runtime_error.
class RawClient {
 public:
  struct Unconnected {};
  /// Opens a socket but does not connect it (IPv4).
  explicit RawClient(Unconnected) : descriptor_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    if (descriptor_ < 0) fail("socket");
  }
  /// @param address  numeric IPv4 or IPv6 address.
  RawClient(const std::string& address, int port)
      : descriptor_(socket(address.find(':') == std::string::npos ? AF_INET : AF_INET6,
                           SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    if (descriptor_ < 0) fail("socket");
    connect(address, port);
  }
  RawClient(RawClient&& other) noexcept
      : descriptor_(std::exchange(other.descriptor_, -1)), input_(std::move(other.input_)) {}
  RawClient& operator=(RawClient&&) = delete;
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;
  ~RawClient() { close(); }

  void connect(const std::string& address, int port) {
    addrinfo hints{};
    hints.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV;
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    if (getaddrinfo(address.c_str(), std::to_string(port).c_str(), &hints, &found) != 0) {
      throw std::runtime_error("no address: " + address);
    }
    const int result = ::connect(descriptor_, found->ai_addr, found->ai_addrlen);
    freeaddrinfo(found);
    if (result != 0) fail("connect");
    const int on = 1;
    setsockopt(descriptor_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  }

  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

  void send(std::string_view bytes) {
    if (!send_if_open(bytes)) fail("send");
  }
  /// @return whether the other end still accepts data.
  [[nodiscard]] bool send_if_open(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t sent = ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent < 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
  }

  /// The next line without its line end; the data so far if the other end closes before.
  [[nodiscard]] std::string line() {
    std::size_t searched = 0;
    for (;;) {
      const std::size_t end = input_.find('\n', searched);
      if (end != std::string::npos) return take(end, 1);
      searched = input_.size();
      if (!receive()) return take(input_.size(), 0);
    }
  }
  /// This many bytes; fewer if the other end closes before.
  [[nodiscard]] std::string bytes(std::size_t count) {
    while (input_.size() < count && receive()) {
    }
    return take(std::min(count, input_.size()), 0);
  }
  /// All data until the other end closes.
  [[nodiscard]] std::string rest() {
    while (receive()) {
    }
    return take(input_.size(), 0);
  }

  void stop_sending() const { shutdown(descriptor_, SHUT_WR); }
  void close() {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
  }
  /// Closes with a TCP reset, like a machine that does not know the connection.
  void reset() {
    const linger at_once{1, 0};
    setsockopt(descriptor_, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
    close();
  }

  [[nodiscard]] static bool has_ipv6() {
    const int probe = socket(AF_INET6, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (probe < 0) return false;
    sockaddr_in6 address{};
    address.sin6_family = AF_INET6;
    address.sin6_addr = in6addr_loopback;
    const bool found = bind(probe, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
    ::close(probe);
    return found;
  }
  /// Number of open descriptors of this process.
  [[nodiscard]] static std::size_t open_files() {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}));
  }

 private:
  [[noreturn]] static void fail(const std::string& what) {
    throw std::runtime_error(what + ": " + std::strerror(errno));
  }
  std::string take(std::size_t count, std::size_t skipped) {
    std::string taken = input_.substr(0, count);
    input_.erase(0, count + skipped);
    return taken;
  }
  /// @return false when the other end has closed.
  bool receive() {
    pollfd readable{descriptor_, POLLIN, 0};
    const std::chrono::milliseconds longest = patience();
    if (poll(&readable, 1, static_cast<int>(longest.count())) <= 0) {
      throw std::runtime_error("nothing comes");
    }
    std::array<char, 65536> buffer{};
    const ssize_t count = recv(descriptor_, buffer.data(), buffer.size(), 0);
    if (count <= 0) return false;
    input_.append(buffer.data(), static_cast<std::size_t>(count));
    return true;
  }

  int descriptor_ = -1;
  std::string input_;
};

}  // namespace test_support
