// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "patience.h"
#include "playerlike/view/protocol.h"

namespace test_support {

/// The viewer's end of the connection between a run and its window, for tests that act as the
/// viewer.
class FakeViewer {
 public:
  struct Frame {
    playerlike::view::FrameHeader header;
    std::string rgb;
    std::string text;
  };

  FakeViewer() {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
      throw std::runtime_error("socketpair failed");
    }
    ours_ = ends[0];
    theirs_ = ends[1];
  }
  FakeViewer(const FakeViewer&) = delete;
  FakeViewer& operator=(const FakeViewer&) = delete;
  ~FakeViewer() { die(); }

  /// The run's end of the connection; the run closes it.
  [[nodiscard]] int socket_for_run() const { return theirs_; }

  void send_bytes(const std::string& bytes) const {
    if (send(ours_, bytes.data(), bytes.size(), MSG_NOSIGNAL) !=
        static_cast<ssize_t>(bytes.size())) {
      throw std::runtime_error("the run does not take what the viewer sends");
    }
  }
  void say(playerlike::view::ViewerMessageKind kind, std::uint32_t a = 0,
           std::uint32_t b = 0) const {
    send_bytes(bytes_of({.kind = kind, .a = a, .b = b}));
  }
  void hello(std::uint32_t side_px = 200) const {
    say(playerlike::view::ViewerMessageKind::kHello, side_px, side_px);
  }
  void press(std::uint32_t keysym, bool control = false) const {
    say(playerlike::view::ViewerMessageKind::kKey, keysym,
        playerlike::view::kPressed | (control ? playerlike::view::kControl : 0U));
  }
  void release(std::uint32_t keysym) const {
    say(playerlike::view::ViewerMessageKind::kKey, keysym, 0);
  }

  [[nodiscard]] static std::string bytes_of(const playerlike::view::ViewerMessage& message) {
    return {reinterpret_cast<const char*>(&message), sizeof message};
  }

  /// Waits for a frame and confirms that it is shown.
  /// @return nullopt if the run has closed the connection.
  [[nodiscard]] std::optional<Frame> show() const {
    auto frame = receive();
    if (frame) say(playerlike::view::ViewerMessageKind::kShown, frame->header.number);
    return frame;
  }
  /// Waits for a frame.
  [[nodiscard]] std::optional<Frame> receive() const {
    Frame frame;
    std::string bytes;
    if (!read(sizeof frame.header, bytes)) return std::nullopt;
    std::memcpy(&frame.header, bytes.data(), sizeof frame.header);
    if (!playerlike::view::is_valid(frame.header)) throw std::runtime_error("an invalid frame");
    if (!read(playerlike::view::body_bytes(frame.header), bytes)) return std::nullopt;
    frame.text = bytes.substr(bytes.size() - frame.header.text_bytes);
    bytes.resize(bytes.size() - frame.header.text_bytes);
    frame.rgb = std::move(bytes);
    return frame;
  }

  /// Closes the connection without a message.
  void die() {
    if (ours_ >= 0) close(ours_);
    ours_ = -1;
  }

 private:
  // Waits for this many bytes; false at the end of the connection.
  [[nodiscard]] bool read(std::size_t count, std::string& bytes) const {
    bytes.resize(count);
    std::size_t got = 0;
    while (got < count) {
      pollfd readable{ours_, POLLIN, 0};
      const std::chrono::milliseconds longest = patience();
      if (poll(&readable, 1, static_cast<int>(longest.count())) <= 0) {
        throw std::runtime_error("the run sends nothing");
      }
      const ssize_t part = recv(ours_, bytes.data() + got, count - got, 0);
      if (part <= 0) return false;
      got += static_cast<std::size_t>(part);
    }
    return true;
  }

  int ours_ = -1;
  int theirs_ = -1;
};

}  // namespace test_support
