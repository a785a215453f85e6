// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <utility>

#include "host/core.h"
#include "playerlike/host/event_client.h"
#include "session/in_process_session.h"

namespace playerlike {

/// An event loop's client of a simulation in this process.
class InProcessEventClient final : public EventClient {
 public:
  InProcessEventClient(const std::shared_ptr<Host>& host, std::shared_ptr<Client> client)
      : core_(*host->core_), client_(std::move(client)), session_(host, client_) {}

  Session& session() noexcept override { return session_; }
  Outcome begin_wait(ThinkerId thinker) override { return core_.begin_wait(*client_, thinker); }
  Outcome begin_peek(ThinkerId thinker, std::chrono::milliseconds timeout) override {
    return core_.begin_peek(*client_, thinker, timeout);
  }
  Outcome begin_sleep(ThinkerId thinker, double seconds) override {
    return core_.begin_sleep(*client_, thinker, seconds);
  }
  void join(ThinkerId thinker) override { core_.join(*client_, thinker); }
  bool draw_some(DrawWork& work, std::size_t cells) override {
    return core_.draw_some(*client_, work, cells);
  }
  Outcome outcome() const override { return core_.outcome_of(*client_); }
  void cancel() override { core_.cancel_wait(*client_); }

 private:
  Host::Core& core_;  // as long as the session, which holds the host
  std::shared_ptr<Client> client_;
  InProcessSession session_;
};

}  // namespace playerlike
