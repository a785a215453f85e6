// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <memory>
#include <variant>
#include <vector>

#include "playerlike/session/session.h"
#include "server/request_guard.h"

namespace playerlike::server {

/// A session for code that acts for a client of a server: forwards to another session, and checks
/// each request and command with a guard. Drawing requires the right to change the shared canvas.
/// It cannot wait. Its followers, which drivers use in threads of their own, are not checked:
/// whoever has a driver act checks the client's rights first. Used by the server's thread only.
///
/// Errors: besides those of the other session, ProtocolError as RequestGuard.
class GuardedSession final : public Session {
 public:
  /// Both must outlive this session.
  GuardedSession(Session& session, const RequestGuard& guard) : session_(session), guard_(guard) {}

  [[nodiscard]] const std::vector<RobotInfo>& robots() const noexcept override {
    return session_.robots();
  }
  [[nodiscard]] int port() const noexcept override { return session_.port(); }
  [[nodiscard]] bool connected() const noexcept override { return session_.connected(); }
  void wait() override { refuse_to_wait(); }
  int take(ReadingSink& sink) override { return session_.take(sink); }
  [[nodiscard]] bool peek(std::chrono::milliseconds /*timeout*/) override { refuse_to_wait(); }
  void send(DeviceId device, const sim::Command& command) override {
    guard_.check_command(device);
    session_.send(device, command);
  }
  Answer answer(const Request& request) override {
    guard_.check(request);
    // Without the right to draw there is a queue that is always full, see draw_queue().
    if (std::holds_alternative<FlushDrawingsRequest>(request)) guard_.check_canvas();
    return session_.answer(request);
  }
  [[nodiscard]] DrawQueue& draw_queue() noexcept override {
    return guard_.may_draw() ? session_.draw_queue() : closed_;
  }
  [[nodiscard]] std::uint64_t canvas_generation() const noexcept override {
    return session_.canvas_generation();
  }
  [[nodiscard]] std::unique_ptr<Session> open_follower() override {
    return session_.open_follower();
  }
  [[nodiscard]] const void* simulation() const noexcept override { return session_.simulation(); }
  void close() noexcept override { session_.close(); }

 private:
  [[noreturn]] static void refuse_to_wait() {
    throw SessionError(SessionError::Code::kNotAvailable, "a server's thread does not wait");
  }

  Session& session_;
  const RequestGuard& guard_;
  DrawQueue closed_;  ///< never has room
};

}  // namespace playerlike::server
