// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/window/viewer_link.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <utility>

#include "virtual_time/program_threads.h"

namespace playerlike {
namespace {

constexpr std::chrono::milliseconds kFramePeriod{33};
constexpr std::size_t kReceiveLimit = 1 << 16;  // a viewer sends 16 bytes per key

bool is_stream_socket(int descriptor) {
  int type = 0;
  socklen_t size = sizeof type;
  return getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &type, &size) == 0 && type == SOCK_STREAM;
}

}  // namespace

ViewerLink::ViewerLink(int socket, ViewedRun& run) : socket_(socket), run_(run) {
  if (!is_stream_socket(socket)) {
    throw std::runtime_error("descriptor " + std::to_string(socket) +
                             ", which should lead to the window, is not a stream socket");
  }
  fcntl(socket_, F_SETFD, fcntl(socket_, F_GETFD) | FD_CLOEXEC);
  fcntl(socket_, F_SETFL, fcntl(socket_, F_GETFL) | O_NONBLOCK);
  stop_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (stop_ < 0) throw std::runtime_error(std::string("eventfd: ") + std::strerror(errno));
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

ViewerLink::~ViewerLink() {
  const std::uint64_t one = 1;
  static_cast<void>(write(stop_, &one, sizeof one));
  thread_.join();
  close(stop_);
}

void ViewerLink::serve() {
  try {
    bool open = true;
    while (open) {
      wait_for_work();
      std::uint64_t stop = 0;
      if (read(stop_, &stop, sizeof stop) == sizeof stop) break;
      open = receive();
      if (open && frame_is_due()) draw_frame();
      if (open) send_some();
      // The last picture is on the screen: closing the connection closes the window.
      if (last_frame_ && shown_ == number_) break;
    }
  } catch (const std::exception& error) {
    run_.on_lost(error.what());
  }
  close(socket_);
}

bool ViewerLink::frame_is_due() const {
  return renderer_ && !last_frame_ && shown_ == number_ && Clock::now() >= next_frame_;
}

void ViewerLink::wait_for_work() {
  const bool sending = sent_ < outgoing_.size();
  std::array<pollfd, 2> polls{
      pollfd{stop_, POLLIN, 0},
      pollfd{socket_, static_cast<short>(sending ? POLLIN | POLLOUT : POLLIN), 0}};
  int timeout_ms = -1;
  if (renderer_ && !last_frame_ && shown_ == number_) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(next_frame_ - Clock::now()).count();
    timeout_ms = static_cast<int>(std::clamp<std::int64_t>(left, 0, kFramePeriod.count()));
  }
  poll(polls.data(), polls.size(), timeout_ms);
}

bool ViewerLink::receive() {
  std::array<char, 4096> buffer{};
  bool ended = false;
  while (!ended && received_.size() <= kReceiveLimit) {
    const ssize_t count = recv(socket_, buffer.data(), buffer.size(), 0);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) break;
    ended = count <= 0;
    if (!ended) received_.append(buffer.data(), static_cast<std::size_t>(count));
  }
  // The viewer's last messages still count, e.g. that the user closed it.
  bool garbage = false;
  while (const auto message = view::take_message(received_, garbage)) {
    if (!handle(*message)) return false;
  }
  if (garbage) run_.on_lost("the window's process sent an invalid message");
  if (ended && !garbage) run_.on_lost("the window's process has ended");
  return !ended && !garbage;
}

bool ViewerLink::handle(const view::ViewerMessage& message) {
  switch (message.kind) {
    case view::ViewerMessageKind::kHello: {
      const auto side =
          std::clamp(std::min(message.a, message.b), view::kLeastSide_px, view::kGreatestSide_px);
      renderer_.emplace(sim::render::RenderOptions{.size_px = static_cast<int>(side)});
      break;
    }
    case view::ViewerMessageKind::kShown:
      // Only a frame that was sent completely can be on the screen.
      if (message.a == number_ && sent_ == outgoing_.size() && shown_ != number_) {
        shown_ = number_;
        run_.on_shown();
      }
      break;
    case view::ViewerMessageKind::kKey: {
      const std::string file = run_.on_key(message.a, (message.b & view::kPressed) != 0,
                                           (message.b & view::kControl) != 0);
      if (!file.empty()) save_picture(file);
      break;
    }
    case view::ViewerMessageKind::kReleaseAll:
      run_.on_keys_released();
      break;
    case view::ViewerMessageKind::kClosed:
      run_.on_closed();
      return false;
  }
  return true;
}

void ViewerLink::draw_frame() {
  next_frame_ = Clock::now() + kFramePeriod;
  const ViewScene view = run_.view_scene();
  image_ = renderer_->draw(view.scene);
  last_frame_ = view.finished;
  std::string text = view.status + '\n' + view.message + '\n';
  for (const std::string& line : view.help) text += line + '\n';
  text.resize(std::min<std::size_t>(text.size(), view::kGreatestText));
  const view::FrameHeader header{.number = ++number_,
                                 .width = static_cast<std::uint32_t>(image_.width),
                                 .height = static_cast<std::uint32_t>(image_.height),
                                 .text_bytes = static_cast<std::uint32_t>(text.size()),
                                 .robot_colour = view.robot_colour,
                                 .paused = view.paused ? 1U : 0U};
  outgoing_.resize(sizeof header);
  std::memcpy(outgoing_.data(), &header, sizeof header);
  outgoing_.append(image_.rgb.begin(), image_.rgb.end());
  outgoing_ += text;
  sent_ = 0;
}

void ViewerLink::send_some() {
  while (sent_ < outgoing_.size()) {
    const ssize_t count =
        send(socket_, outgoing_.data() + sent_, outgoing_.size() - sent_, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    // The buffer is full, or the viewer has closed; receive() detects the latter.
    if (count <= 0) return;
    sent_ += static_cast<std::size_t>(count);
  }
}

void ViewerLink::save_picture(const std::string& file) {
  try {
    if (image_.rgb.empty()) throw std::runtime_error("nothing is shown yet");
    sim::render::write_png(image_, file);
    run_.on_saved(file, "");
  } catch (const std::exception& error) {
    run_.on_saved(file, error.what());
  }
}

}  // namespace playerlike
