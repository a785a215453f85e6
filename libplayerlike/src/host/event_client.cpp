// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/event_client.h"

#include <utility>

#include "host/core.h"
#include "host/in_process_session.h"

namespace playerlike {

EventClient::EventClient(std::shared_ptr<Host> host, std::shared_ptr<Client> client)
    : host_(std::move(host)),
      client_(std::move(client)),
      session_(std::make_unique<InProcessSession>(host_, client_)) {}

EventClient::~EventClient() = default;

EventClient::Outcome EventClient::begin_wait(ThreadId thread_id) {
  return host_->core_->begin_wait(*client_, thread_id);
}

EventClient::Outcome EventClient::begin_peek(ThreadId thread_id,
                                             std::chrono::milliseconds timeout) {
  return host_->core_->begin_peek(*client_, thread_id, timeout);
}

EventClient::Outcome EventClient::begin_sleep(ThreadId thread_id, double seconds) {
  return host_->core_->begin_sleep(*client_, thread_id, seconds);
}

void EventClient::join(ThreadId thread_id) { host_->core_->join(*client_, thread_id); }

bool EventClient::draw_some(DrawWork& work, std::size_t cells) {
  return host_->core_->draw_some(*client_, work, cells);
}

EventClient::Outcome EventClient::outcome() const { return host_->core_->outcome_of(*client_); }

void EventClient::cancel() { host_->core_->cancel_wait(*client_); }

Commander::Commander(std::shared_ptr<Host> host) : host_(std::move(host)) {}

Commander::~Commander() { host_->core_->commander_gone(this); }

std::optional<std::string> Commander::command(DeviceId device, const sim::Command& command) {
  return host_->core_->command(this, device, command);
}

}  // namespace playerlike
