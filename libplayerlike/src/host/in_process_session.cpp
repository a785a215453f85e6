// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/in_process_session.h"

#include <algorithm>
#include <utility>

#include "process/thread_end.h"
#include "session/checks.h"

namespace playerlike {
InProcessSession::InProcessSession(std::shared_ptr<Host> host, std::shared_ptr<Client> client)
    : host_(std::move(host)), client_(std::move(client)) {}

InProcessSession::~InProcessSession() { close(); }

InsideCore InProcessSession::core() const noexcept { return InsideCore(*host_->core_); }

void InProcessSession::note_wait() const {
  // When this thread ends, the host must not wait for it.
  if (ThreadEnd* const end = ThreadEnd::mine()) {
    end->say_goodbye(host_,
                     [](void* host) { static_cast<Host*>(host)->thread_ended(this_thread_id()); });
  }
  // Drivers are not threads of the program.
  if (!client_->is_programs() || !virtual_time::active()) return;
  virtual_time::remember_thread();
  virtual_time::note_wait();
}

const std::vector<RobotInfo>& InProcessSession::robots() const noexcept { return core()->robots(); }
int InProcessSession::port() const noexcept { return client_->port; }
bool InProcessSession::connected() const noexcept { return !client_->closed; }

void InProcessSession::wait() {
  note_wait();
  core()->wait(*client_);
}

int InProcessSession::take(ReadingSink& sink) { return core()->take(*client_, sink); }

bool InProcessSession::peek(std::chrono::milliseconds timeout) {
  note_wait();
  return core()->peek(*client_, std::max(timeout, std::chrono::milliseconds(0)));
}

void InProcessSession::send(DeviceId device, const sim::Command& command) {
  require_device(robots(), device);
  require_finite(command);
  core()->send(*client_, device, command);
}

Answer InProcessSession::answer(const Request& request) {
  const bool takes_part = std::holds_alternative<JoinRequest>(request) ||
                          std::holds_alternative<SleepRequest>(request) ||
                          std::holds_alternative<PreferRealTimeRequest>(request);
  if (takes_part) note_wait();
  return core()->answer(*client_, request);
}

std::unique_ptr<Session> InProcessSession::open_follower() {
  // What acts for an onlooker is one, too.
  const EventRole role = client_->onlooker ? EventRole::kOnlooker : EventRole::kFollower;
  return std::make_unique<InProcessSession>(host_, core()->add_client(client_->port, role));
}

const void* InProcessSession::simulation() const noexcept { return host_->clock().get(); }

DrawQueue& InProcessSession::draw_queue() noexcept { return client_->drawings; }

std::uint64_t InProcessSession::canvas_generation() const noexcept {
  return core()->canvas_generation();
}

void InProcessSession::close() noexcept { core()->remove_client(*client_); }

}  // namespace playerlike
