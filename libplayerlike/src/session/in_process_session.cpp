// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "session/in_process_session.h"

#include <algorithm>
#include <utility>

#include "session/checks.h"
#include "session/farewell.h"

namespace playerlike {
namespace {

// Nobody is to wait for a thread that has ended.
thread_local Farewell<Host> farewell_to_host([](Host& host) {
  host.thinker_ended(this_thinker());
});

// Virtual time, too, is to know when a thread that lives in it ends.
struct VirtualLife {
  VirtualLife() = default;
  VirtualLife(const VirtualLife&) = delete;
  VirtualLife& operator=(const VirtualLife&) = delete;
  ~VirtualLife() {
    if (lived) virtual_time::note_thread_ends();
  }
  bool lived = false;
};
thread_local VirtualLife virtual_life;

}  // namespace

void remember_thread() { virtual_life.lived = true; }

InProcessSession::InProcessSession(std::shared_ptr<Host> host, std::shared_ptr<Client> client)
    : host_(std::move(host)), client_(std::move(client)) {}

InProcessSession::~InProcessSession() { close(); }

InsideCore InProcessSession::core() const noexcept { return InsideCore(*host_->core_); }

void InProcessSession::note_wait() const {
  farewell_to_host.remember(host_);
  // Drivers are Playpen's own.
  if (client_->follower || !virtual_time::active()) return;
  remember_thread();
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
  return std::make_unique<InProcessSession>(host_,
                                            core()->add_client(client_->port, /*follower=*/true));
}

const void* InProcessSession::simulation() const noexcept { return host_.get(); }

DrawQueue& InProcessSession::draw_queue() noexcept { return client_->drawings; }

std::uint64_t InProcessSession::canvas_generation() const noexcept {
  return core()->canvas_generation();
}

void InProcessSession::close() noexcept { core()->remove_client(*client_); }

}  // namespace playerlike
