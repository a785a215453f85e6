// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/stepping/lockstep.h"

#include <algorithm>

#include "sim/core/number_text.h"

namespace playerlike {

Lockstep::Lockstep(const Clients& clients, int gate, double silence_limit_s, Warn warn,
                   IsDebugged is_debugged)
    : clients_(clients),
      gate_(gate),
      silence_limit_s_(silence_limit_s),
      warn_(std::move(warn)),
      is_debugged_(std::move(is_debugged)) {}

void Lockstep::adopt(Client& client, ThreadId thread_id) {
  client.owner = thread_id;
  client.joined = true;
  client.silent = false;
  if (client.follower) return;
  if (first_owner_ == 0) first_owner_ = thread_id;
  several_owners_ = several_owners_ || thread_id != first_owner_;
}

void Lockstep::forget(ThreadId thread_id) noexcept {
  for (const auto& client : clients_) {
    if (client->owner != thread_id) continue;
    client->owner = 0;
    client->joined = false;
  }
}

int Lockstep::joined_programs() const {
  return static_cast<int>(std::count_if(clients_.begin(), clients_.end(),
                                        [](const auto& c) { return c->joined && !c->follower; }));
}

bool Lockstep::gate_open() {
  gate_opened_ = gate_opened_ || gate_ <= 1 || joined_programs() >= gate_;
  return gate_opened_;
}

bool Lockstep::program_takes_part() const {
  return std::any_of(clients_.begin(), clients_.end(), [](const auto& c) {
    return c->joined && !c->silent && (!c->follower || c->takes_turns);
  });
}

bool Lockstep::somebody_waits() const {
  return std::any_of(clients_.begin(), clients_.end(), [](const auto& c) { return c->waiting; });
}

// One thread may own many clients: it waits if one of them does.
bool Lockstep::all_wait() const {
  waiting_.clear();
  for (const auto& c : clients_) {
    if (c->waiting) waiting_.push_back(c->owner);
  }
  return std::all_of(clients_.begin(), clients_.end(), [this](const auto& c) {
    return !c->joined || c->silent || c->waiting ||
           std::find(waiting_.begin(), waiting_.end(), c->owner) != waiting_.end();
  });
}

bool Lockstep::others_may_wait(ThreadId thread_id) {
  return std::any_of(clients_.begin(), clients_.end(), [&](const auto& c) {
    if (!c->joined || c->silent || c->follower || c->owner == thread_id) return false;
    return !c->waiting || !gate_open();
  });
}

bool Lockstep::thinks(const Client& client) const {
  return client.joined && !client.silent &&
         std::none_of(clients_.begin(), clients_.end(),
                      [&](const auto& c) { return c->waiting && c->owner == client.owner; });
}

WallClock::time_point Lockstep::silence_deadline(WallClock::time_point now) const {
  const auto limit = wall(silence_limit_s_);
  auto deadline = now + limit;
  if (!gate_opened_) return deadline;
  for (const auto& c : clients_) {
    if (!thinks(*c)) continue;
    const auto half = c->seen() + limit / 2;
    deadline = std::min(deadline, is_debugged_ && half > now ? half : c->seen() + limit);
  }
  return deadline;
}

bool Lockstep::anybody_is_debugged() const {
  return is_debugged_ && std::any_of(clients_.begin(), clients_.end(),
                                     [this](const auto& c) { return is_debugged_(*c); });
}

void Lockstep::note_closed_gate(WallClock::time_point now) {
  if (now - gate_warned_at_ < wall(silence_limit_s_)) return;
  gate_warned_at_ = now;
  if (anybody_is_debugged()) return;
  warn_("the start gate waits for " + std::to_string(gate_) + " clients; " +
        std::to_string(joined_programs()) + " have joined so far");
}

void Lockstep::note_silence(WallClock::time_point now, std::optional<WallClock::time_point> due) {
  // A busy machine delays a thread, too, but not for so long.
  constexpr double kLate_s = 0.25;
  if (!gate_opened_) return note_closed_gate(now);
  const auto limit = wall(silence_limit_s_);
  const bool was_stopped = is_debugged_ && due && now - *due > std::max(limit / 4, wall(kLate_s));
  for (const auto& c : clients_) {
    if (!thinks(*c)) continue;
    if (was_stopped || (is_debugged_ && now - c->seen() >= limit / 2 && is_debugged_(*c))) {
      c->touch(now);
      continue;
    }
    if (now - c->seen() < limit) continue;
    c->silent = true;
    silence_noted_ = true;
    warn_of_silence("client " + std::to_string(c->number + 1) + " (port " +
                    std::to_string(c->port) + ") has not called Read()");
  }
}

void Lockstep::note_silent_thread(ThreadId thread_id) const {
  for (const auto& c : clients_) {
    if (c->owner != thread_id) continue;
    return warn_of_silence("client " + std::to_string(c->number + 1) + " (port " +
                           std::to_string(c->port) + ") has not called Read()");
  }
  warn_of_silence("a thread of the program has neither read nor slept");
}

void Lockstep::warn_of_silence(const std::string& who) const {
  warn_(who + " for " + sim::rounded_text(silence_limit_s_, 6) +
        " s of wall time; simulated time advances without it until it does");
}

WallClock::duration Lockstep::silence_limit() const {
  return gate_opened_ ? wall(silence_limit_s_) : WallClock::duration::max();
}

WallClock::time_point Lockstep::last_seen(ThreadId thread_id, WallClock::time_point seen) const {
  for (const auto& client : clients_) {
    if (client->owner == thread_id) seen = std::max(seen, client->seen());
  }
  return seen;
}

}  // namespace playerlike
