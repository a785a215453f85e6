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

void EventClient::abandon() noexcept { host_->core_->remove_client(*client_, /*abandoned=*/true); }

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

EventClient::Outcome EventClient::begin_turns_wait(ThreadId thread_id, const TurnsWait& what) {
  return host_->core_->begin_turns_wait(*client_, thread_id, what);
}

void EventClient::set_process_search(std::function<std::optional<int>()> find) {
  host_->core_->locked([&] { client_->find_process = std::move(find); });
}

bool EventClient::has_data() const {
  return host_->core_->locked([this] { return client_->has_data; });
}

EventClient::Outcome Host::Core::begin_turns_wait(Client& client, ThreadId thread_id,
                                                  const EventClient::TurnsWait& what) {
  const Lock lock = lock_with_priority();
  adopt(client, thread_id);
  client.takes_turns = true;
  for (const EventClient* const joined : what.joined) {
    if (!joined->client_->closed) adopt(*joined->client_, thread_id);
  }
  client.waits_for.clear();
  for (const EventClient* const other : what.others) client.waits_for.push_back(other->client_);
  return begin_adopted(client, what.wants_data, what.until_ns);
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
