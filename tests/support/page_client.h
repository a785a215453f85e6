// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "patience.h"

namespace test_support {

/// A browser of the live page that is only a socket: it speaks HTTP and WebSocket (RFC 6455) by
/// hand, also wrongly. Each call waits at most for patience().
class PageClient {
 public:
  /// A message, put together of its frames, or a control frame.
  struct Message {
    int kind =
        0;  ///< 1: text, 2: binary, 8: close, 9: ping, 10: pong, -1: the connection is closed
    std::string contents;
    [[nodiscard]] int close_code() const {
      if (kind != 8 || contents.size() < 2) return 0;
      return static_cast<unsigned char>(contents[0]) * 256 +
             static_cast<unsigned char>(contents[1]);
    }
  };

  /// @param pump  lets a server of the same thread work; is called while waiting.
  explicit PageClient(int port, std::function<void()> pump = {}) : pump_(std::move(pump)) {
    socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
      throw std::runtime_error("cannot connect to the page");
    }
  }
  PageClient(PageClient&& other) noexcept
      : pump_(std::move(other.pump_)),
        socket_(std::exchange(other.socket_, -1)),
        received_(std::move(other.received_)) {}
  PageClient(const PageClient&) = delete;
  PageClient& operator=(const PageClient&) = delete;
  PageClient& operator=(PageClient&&) = delete;
  ~PageClient() { leave(); }

  void leave() {
    if (socket_ >= 0) close(socket_);
    socket_ = -1;
  }

  /// Sends bytes; the server may have closed.
  void send(std::string_view bytes) const {
    static_cast<void>(::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL));
  }

  /// Sends a request with these lines after the first, without line breaks at their ends.
  void request(const std::string& first, const std::string& fields) const {
    send(first + " HTTP/1.1\r\n" + fields + "\r\n\r\n");
  }

  /// The whole answer, up to the end of the connection.
  std::string rest() {
    while (receive()) {
    }
    return std::exchange(received_, "");
  }

  /// Asks for the WebSocket. @return the answer up to its empty line.
  std::string upgrade(const std::string& fields = "Host: localhost") {
    request("GET /live",
            fields +
                "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13"
                "\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==");
    std::size_t end = 0;
    while ((end = received_.find("\r\n\r\n")) == std::string::npos && receive()) {
    }
    if (end == std::string::npos) return std::exchange(received_, "");
    std::string answer = received_.substr(0, end + 4);
    received_.erase(0, end + 4);
    return answer;
  }

  /// Sends a frame. @param first_byte  its opcode, and 0x80 if it is the last of its message.
  void frame(int first_byte, std::string_view contents, bool masked = true) const {
    std::string bytes(1, static_cast<char>(first_byte));
    const int mask_bit = masked ? 0x80 : 0;
    if (contents.size() < 126) {
      bytes += static_cast<char>(mask_bit | static_cast<int>(contents.size()));
    } else {
      bytes += static_cast<char>(mask_bit | 126);
      bytes += static_cast<char>(contents.size() >> 8U);
      bytes += static_cast<char>(contents.size() & 0xFFU);
    }
    const std::string_view mask = "mask";
    if (masked) bytes += mask;
    for (std::size_t i = 0; i < contents.size(); ++i) {
      bytes += masked ? static_cast<char>(contents[i] ^ mask[i % 4]) : contents[i];
    }
    send(bytes);
  }
  void text(std::string_view contents) const { frame(0x81, contents); }

  /// The next message.
  Message message() {
    Message message;
    for (;;) {
      std::string head;
      std::size_t length = 0;
      if (!take(2, head)) return {-1, ""};
      length = static_cast<unsigned char>(head[1]);
      const std::size_t more = length == 126 ? 2 : length == 127 ? 8 : 0;
      if (more > 0) {
        std::string digits;
        if (!take(more, digits)) return {-1, ""};
        length = 0;
        for (const char c : digits) length = length * 256 + static_cast<unsigned char>(c);
      }
      std::string contents;
      if (!take(length, contents)) return {-1, ""};
      const int kind = head[0] & 0x0F;
      if (kind >= 8) return {kind, contents};  // between the frames of a message: not in tests
      if (kind > 0) message.kind = kind;
      message.contents += contents;
      if ((head[0] & 0x80) != 0) return message;
    }
  }

  /// The next close frame's code; -1 if the connection ends without one.
  int close_code() {
    for (;;) {
      const Message next = message();
      if (next.kind < 0) return -1;
      if (next.kind == 8) return next.close_code();
    }
  }

  /// Whether there are bytes to receive.
  [[nodiscard]] bool has_received() const {
    pollfd readable{socket_, POLLIN, 0};
    return !received_.empty() || poll(&readable, 1, 0) == 1;
  }

  /// Receives some bytes. @return whether the connection is open.
  bool receive() {
    const auto end = std::chrono::steady_clock::now() + patience();
    for (;;) {
      if (pump_) pump_();
      std::array<char, 65536> some{};
      const ssize_t count = recv(socket_, some.data(), some.size(), MSG_DONTWAIT);
      if (count > 0) {
        received_.append(some.data(), static_cast<std::size_t>(count));
        return true;
      }
      if (count == 0 || (errno != EAGAIN && errno != EWOULDBLOCK)) return false;
      if (std::chrono::steady_clock::now() > end) throw std::runtime_error("the page is silent");
      pollfd readable{socket_, POLLIN, 0};
      poll(&readable, 1, 1);
    }
  }

 private:
  bool take(std::size_t count, std::string& bytes) {
    while (received_.size() < count) {
      if (!receive()) return false;
    }
    bytes = received_.substr(0, count);
    received_.erase(0, count);
    return true;
  }

  std::function<void()> pump_;
  int socket_ = -1;
  std::string received_;
};

}  // namespace test_support
