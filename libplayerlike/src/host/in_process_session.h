// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "host/core.h"
#include "playerlike/session/session.h"

namespace playerlike {

/// A session with a simulation in this process; it calls the host directly.
class InProcessSession final : public Session {
 public:
  InProcessSession(std::shared_ptr<Host> host, std::shared_ptr<Client> client);
  ~InProcessSession() override;

  const std::vector<RobotInfo>& robots() const noexcept override;
  int port() const noexcept override;
  bool connected() const noexcept override;

  void wait() override;
  int take(ReadingSink& sink) override;
  bool peek(std::chrono::milliseconds timeout) override;
  void send(DeviceId device, const sim::Command& command) override;
  Answer answer(const Request& request) override;
  DrawQueue& draw_queue() noexcept override;
  std::uint64_t canvas_generation() const noexcept override;
  std::unique_ptr<Session> open_follower() override;
  const void* simulation() const noexcept override;
  void close() noexcept override;

 private:
  [[nodiscard]] InsideCore core() const noexcept;
  void note_wait() const;

  std::shared_ptr<Host> host_;
  std::shared_ptr<Client> client_;
};

}  // namespace playerlike
