// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/window/frame_link.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <utility>

#include "virtual_time/program_threads.h"

namespace playerlike {
namespace {

constexpr std::chrono::milliseconds kFramePeriod{33};
constexpr std::size_t kReceiveLimit = 1 << 16;  // the other process sends little

bool is_stream_socket(int descriptor) {
  int type = 0;
  socklen_t size = sizeof type;
  return getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &type, &size) == 0 && type == SOCK_STREAM;
}

}  // namespace

FrameLink::FrameLink(int socket, std::string what) : socket_(socket), what_(std::move(what)) {
  if (!is_stream_socket(socket)) {
    throw std::runtime_error("descriptor " + std::to_string(socket) + ", which should lead to " +
                             what_ + ", is not a stream socket");
  }
  fcntl(socket_, F_SETFD, fcntl(socket_, F_GETFD) | FD_CLOEXEC);
  fcntl(socket_, F_SETFL, fcntl(socket_, F_GETFL) | O_NONBLOCK);
  stop_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (stop_ < 0) throw std::runtime_error(std::string("eventfd: ") + std::strerror(errno));
}

void FrameLink::start() {
  // Signals are left to the program's own threads.
  sigset_t all;
  sigset_t old;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, &old);
  {
    const StartsOwnThreads starts;
    thread_ = std::thread([this] { serve(); });
  }
  pthread_sigmask(SIG_SETMASK, &old, nullptr);
}

FrameLink::~FrameLink() {
  stop();
  close(stop_);
}

void FrameLink::stop() noexcept {
  const std::lock_guard lock(ending_);
  if (!thread_.joinable()) return;
  const std::uint64_t one = 1;
  static_cast<void>(write(stop_, &one, sizeof one));
  thread_.join();
}

void FrameLink::serve() {
  try {
    bool open = true;
    while (open) {
      wait_for_work();
      std::uint64_t stop = 0;
      if (read(stop_, &stop, sizeof stop) == sizeof stop) break;
      open = receive();
      tick();
      if (open && wants_frame() && is_sent() && Clock::now() >= next_frame_) {
        next_frame_ = Clock::now() + kFramePeriod;
        outgoing_ = make_frame();
        sent_ = 0;
      }
      if (open) send_some();
      if (is_done()) break;
    }
    if (open) send_last();
  } catch (const std::exception& error) {
    on_lost(error.what());
  }
  close(socket_);
}

void FrameLink::wait_for_work() {
  std::array<pollfd, 2> polls{
      pollfd{stop_, POLLIN, 0},
      pollfd{socket_, static_cast<short>(is_sent() ? POLLIN : POLLIN | POLLOUT), 0}};
  int timeout_ms = -1;
  const Clock::time_point now = Clock::now();
  if (awake_until() > now) timeout_ms = static_cast<int>(kFramePeriod.count());
  if (wants_frame() && is_sent()) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(next_frame_ - now).count();
    timeout_ms = static_cast<int>(std::clamp<std::int64_t>(left, 0, kFramePeriod.count()));
  }
  poll(polls.data(), polls.size(), timeout_ms);
}

bool FrameLink::receive() {
  std::array<char, 4096> buffer{};
  bool ended = false;
  while (!ended && received_.size() <= kReceiveLimit) {
    const ssize_t count = recv(socket_, buffer.data(), buffer.size(), 0);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) break;
    ended = count <= 0;
    if (!ended) received_.append(buffer.data(), static_cast<std::size_t>(count));
  }
  // The process's last messages still count, e.g. that the user closed the window.
  bool garbage = false;
  if (!handle_messages(received_, garbage)) return false;
  if (garbage) on_lost(what_ + "'s process sent an invalid message");
  if (ended && !garbage) on_lost(what_ + "'s process has ended");
  return !ended && !garbage;
}

void FrameLink::send_last() {
  constexpr int kPatience_ms = 500;
  append(last_frame());
  send_some();
  if (is_sent()) return;
  pollfd writable{socket_, POLLOUT, 0};
  if (poll(&writable, 1, kPatience_ms) == 1) send_some();
}

void FrameLink::send_some() {
  while (!is_sent()) {
    const ssize_t count =
        send(socket_, outgoing_.data() + sent_, outgoing_.size() - sent_, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    // The buffer is full, or the other process has closed; receive() detects the latter.
    if (count <= 0) return;
    sent_ += static_cast<std::size_t>(count);
  }
}

}  // namespace playerlike
