// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>
#include <thread>

namespace playerlike {

/// A run's end of the connection to a process that shows it: the window or the page.
///
/// Its thread handles the other process's messages. At most 30 times per wall-clock second, and
/// only when that process is ready for it, it asks for a frame and sends it. Sending never blocks,
/// so a process that hangs gets no further frames. If it ends or sends an invalid message, the run
/// is notified (on_lost) and the connection is closed.
class FrameLink {
 public:
  FrameLink(const FrameLink&) = delete;
  FrameLink& operator=(const FrameLink&) = delete;
  virtual ~FrameLink();

 protected:
  using Clock = std::chrono::steady_clock;

  /// @param socket  a connected stream socket, owned by the link from now on; close-on-exec is set.
  /// @param what    the other process, for messages: "the window".
  /// @throws std::runtime_error if it is not a socket.
  FrameLink(int socket, std::string what);
  /// Starts the thread. The functions below are called from it. Call it at the end of the
  /// constructor.
  void start();
  /// Closes the connection and ends the thread. Call it first in the destructor. May be called
  /// again, and from any other thread.
  void stop() noexcept;

  /// Handles the complete messages in the received bytes and removes them.
  /// @param[out] garbage  set if they are not valid messages.
  /// @return false if the connection is over.
  [[nodiscard]] virtual bool handle_messages(std::string& received, bool& garbage) = 0;
  /// Whether the other process waits for a frame.
  [[nodiscard]] virtual bool wants_frame() const = 0;
  /// The next frame, as it is sent; "": there is nothing new.
  [[nodiscard]] virtual std::string make_frame() = 0;
  /// Whether the last frame was shown, so that the connection ends.
  [[nodiscard]] virtual bool is_done() const { return false; }
  /// What is sent when the link ends, whether or not the other process waits for it.
  [[nodiscard]] virtual std::string last_frame() { return ""; }
  /// Called at least 30 times per second while awake_until() lies ahead.
  virtual void tick() {}
  [[nodiscard]] virtual Clock::time_point awake_until() const { return {}; }
  /// The process has ended without the user's request; the run continues.
  virtual void on_lost(const std::string& reason) = 0;

  /// Whether the last frame was sent completely.
  [[nodiscard]] bool is_sent() const noexcept { return sent_ == outgoing_.size(); }
  /// Sends bytes after what is being sent. Called by the link's thread.
  void append(const std::string& bytes) { outgoing_ += bytes; }

 private:
  void serve();
  /// Waits until the socket is readable or writable, a frame is due, or the thread must end.
  void wait_for_work();
  /// @return false if the connection is over.
  [[nodiscard]] bool receive();
  void send_some();
  void send_last();

  int socket_ = -1;
  int stop_ = -1;  ///< eventfd: readable when the thread must end
  const std::string what_;
  std::string received_;
  std::string outgoing_;  ///< what is being sent
  std::size_t sent_ = 0;  ///< bytes of it sent so far
  Clock::time_point next_frame_{};
  std::mutex ending_;  ///< for stop()
  std::thread thread_;
};

}  // namespace playerlike
