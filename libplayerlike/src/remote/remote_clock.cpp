// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "remote/remote_clock.h"

#include <algorithm>
#include <utility>

#include "playerlike/process/log.h"
#include "protocol/codec.h"
#include "sim/core/number_text.h"

namespace playerlike {
namespace {

using nlohmann::json;

// Number by which the server knows the thread that all of this program's threads together are.
constexpr ThreadId kProgram = 0;
// Most steps of one message: then signals and waits for objects of other processes are looked at.
constexpr sim::SimTime kMostSteps = 64;
// How long to wait for an answer before the same is done.
constexpr std::chrono::milliseconds kLookEvery(100);

}  // namespace

/// The wait of a session at a server.
class RemoteClock::Wait final : public SessionWait {
 public:
  Wait(const RemoteClock& clock, const Client& client) : clock_(clock), client_(client) {}
  [[nodiscard]] bool is_over() const override { return RemoteClock::is_over(clock_, client_); }
  [[nodiscard]] std::optional<sim::SimTime> wake_ns() const override { return client_.wake_ns; }
  void require_open() const override {
    if (!client_.closed) return;
    throw SessionError(SessionError::Code::kDisconnected, "the connection is closed");
  }

 private:
  const RemoteClock& clock_;
  const Client& client_;
};

RemoteClock::RemoteClock(const Settings& settings) : settings_(settings) {}

// --- Sessions

RemoteClock::ClientPointer RemoteClock::add(std::shared_ptr<MessageSender> sender,
                                            std::uint64_t number, bool follower,
                                            sim::SimTime server_ns) {
  auto client = std::make_shared<Client>();
  client->sender = std::move(sender);
  client->number = number;
  client->follower = follower;
  client->creator = this_thread_id();
  client->seen = std::chrono::steady_clock::now();
  const Lock lock = lock_shortly();
  // Without a session the server's time may have passed for others.
  if (clients_.empty()) start_ns_ = server_ns - now_ns();
  // The order in which the host has them: see Clients::add().
  const auto place =
      std::find_if(clients_.begin(), clients_.end(), [&](const ClientPointer& other) {
        if (other->follower != client->follower) return client->follower;
        return other->creator > client->creator;
      });
  clients_.insert(place, client);
  return client;
}

bool RemoteClock::remove(const ClientPointer& client) noexcept {
  const Lock lock = lock_shortly();
  client->closed = true;
  std::erase(clients_, client);
  Turns::instance().resume_client_thread(client.get());
  if (!clients_.empty() || !client->usable || last_ || over_ || !in_turns()) return false;
  last_ = client;
  return true;
}

void RemoteClock::adopt(Client& client, ThreadId thread_id) {
  if (client.owner == 0) client.must_join = true;
  client.owner = thread_id;
}

void RemoteClock::adopt_sessions_of(ThreadId thread_id) {
  for (const ClientPointer& client : clients_) {
    if (client->creator == thread_id && client->owner == 0 && !client->follower) {
      adopt(*client, thread_id);
    }
  }
}

void RemoteClock::join(Client& client) {
  const Lock lock = lock_shortly();
  adopt(client, this_thread_id());
  if (in_turns()) static_cast<void>(Turns::instance().self());
}

bool RemoteClock::has_data(const Client& client) const {
  const Lock lock = lock_shortly();
  return client.has_data;
}

std::optional<json> RemoteClock::take_round(Client& client) {
  const Lock lock = lock_shortly();
  return std::exchange(client.round, std::nullopt);
}

void RemoteClock::note_taken(Client& client) {
  const Lock lock = lock_shortly();
  client.has_data = client.fetched = client.round.has_value();
  client.zero_peeks = 0;
}

void RemoteClock::touch(Client& client) {
  const Lock lock = lock_shortly();
  client.seen = std::chrono::steady_clock::now();
}

void RemoteClock::note_background() {
  const Lock lock = lock_shortly();
  if (in_turns()) Turns::instance().self().starts_background = true;
}

void RemoteClock::note_end_reported() {
  const Lock lock = lock_shortly();
  end_reported_ = true;
}

void RemoteClock::thread_ended() noexcept {
  const ThreadId thread_id = this_thread_id();
  const Lock lock = lock_shortly();
  for (const ClientPointer& client : clients_) {
    if (client->owner == thread_id) client->owner = 0;
  }
  Turns::instance().remove(thread_id);
}

// --- Waiting

bool RemoteClock::is_over(const RemoteClock& clock, const Client& client) {
  return clock.over_ || client.lost.has_value() || (client.wants_data && client.has_data) ||
         (client.wake_ns && clock.now_ns() >= *client.wake_ns);
}

void RemoteClock::note_reconnected(Client& client, std::uint64_t number) {
  const Lock lock = lock_shortly();
  client.number = number;
  client.lost.reset();
  client.usable = true;
  client.must_join = client.owner != 0;
}

RemoteClock::Outcome RemoteClock::wait(Client& client) {
  Lock lock = lock_shortly();
  client.fetches = true;
  const Outcome outcome = wait_until(lock, client, /*wants_data=*/true, std::nullopt);
  client.fetches = false;
  return outcome;
}

RemoteClock::Outcome RemoteClock::sleep(Client& client, sim::SimTime duration_ns) {
  Lock lock = lock_shortly();
  return wait_until(lock, client, /*wants_data=*/false, now_ns() + duration_ns);
}

RemoteClock::Outcome RemoteClock::wait_until(Lock& lock, Client& client, bool wants_data,
                                             std::optional<sim::SimTime> wake_ns) {
  if (!in_turns()) return Outcome::kRetry;
  adopt(client, this_thread_id());
  client.wants_data = wants_data;
  client.wake_ns = wake_ns;
  wait_for_turn(lock, &client, Wait(*this, client));
  if (client.lost) throw *std::exchange(client.lost, std::nullopt);
  return is_over(*this, client) ? Outcome::kOver : Outcome::kRetry;
}

RemoteClock::Outcome RemoteClock::peek(Client& client, std::chrono::milliseconds timeout,
                                       bool& result) {
  Lock lock = lock_shortly();
  if (!in_turns()) return Outcome::kRetry;
  result = client.has_data || over_;
  if (result || (timeout.count() == 0 && ++client.zero_peeks < 2)) return Outcome::kOver;
  const sim::SimTime timeout_ns = std::chrono::nanoseconds(timeout).count();
  const Outcome outcome =
      wait_until(lock, client, /*wants_data=*/true, now_ns() + std::max(step_ns(), timeout_ns));
  result = client.has_data || over_;
  return outcome;
}

// --- Steps

std::optional<sim::SimTime> RemoteClock::earliest_wake() const {
  std::optional<sim::SimTime> earliest;
  for (const auto& thread : Turns::instance().threads()) {
    if (thread->state != TurnThread::State::kWaits || !thread->wake_ns) continue;
    earliest = std::min(*thread->wake_ns, earliest.value_or(*thread->wake_ns));
  }
  return earliest;
}

bool RemoteClock::prepare(Advance& advance) {
  const auto& threads = Turns::instance().threads();
  json others = json::array();
  json joined = json::array();
  for (const ClientPointer& client : clients_) {
    if (!client->usable) continue;
    const bool waits =
        client->wants_data && std::any_of(threads.begin(), threads.end(), [&](const auto& thread) {
          return thread->state == TurnThread::State::kWaits && thread->client == client.get();
        });
    if (waits && !advance.fetches && client->fetches) {
      if (advance.carrier && advance.wants_data) others.push_back(advance.carrier->number);
      advance.carrier = client;
      advance.wants_data = advance.fetches = true;
    } else if (waits && !advance.wants_data) {
      advance.carrier = client;
      advance.wants_data = true;
    } else if (waits) {
      others.push_back(client->number);
    } else if (!advance.wants_data) {
      advance.carrier = client;  // rather one of the program than a follower, which come first
    }
    if (std::exchange(client->must_join, false)) joined.push_back(client->number);
  }
  if (!advance.carrier) {
    if (!last_ || !last_->usable) return false;
    advance.carrier = last_;
  }
  const sim::SimTime most_ns = now_ns() + kMostSteps * step_ns();
  const sim::SimTime until_ns = std::min(earliest_wake().value_or(most_ns), most_ns);
  json& request = advance.request;  // member by member, since a list of pairs is copied
  request["do"] = "read";
  request["wait"] = "turns";
  request["thread"] = kProgram;
  request["until"] = start_ns_ + until_ns;
  request["data"] = advance.wants_data;
  request["take"] = advance.fetches;
  if (!others.empty()) advance.request["others"] = std::move(others);
  if (!joined.empty()) advance.request["joined"] = std::move(joined);
  const std::vector<std::string> reasons = Turns::instance().unrepeatable();
  if (reasons.size() > reasons_told_) {
    advance.request["unrepeatable"] =
        std::vector(reasons.begin() + static_cast<std::ptrdiff_t>(reasons_told_), reasons.end());
    reasons_told_ = reasons.size();
  }
  return true;
}

bool RemoteClock::pass_alone() {
  const std::optional<sim::SimTime> wake_ns = earliest_wake();
  if (!wake_ns) return false;
  const sim::SimTime passed_ns = *wake_ns - now_ns();
  // The server's time stands still meanwhile.
  start_ns_ -= passed_ns;
  now_ns_.store(*wake_ns, std::memory_order_release);
  make_waiters_ready();
  return true;
}

void RemoteClock::make_waiters_ready() {
  make_ready(clients_, [this](const Client& client) { return is_over(*this, client); });
}

std::optional<json> RemoteClock::answer_to(Advance& advance, std::optional<ConnectionLost>& lost) {
  try {
    if (!advance.connection) {
      advance.id = advance.carrier->sender->begin_wait(advance.request, advance.connection);
    }
    return advance.connection->answer_within(advance.id, kLookEvery);
  } catch (const ConnectionLost& e) {
    lost = e;
  } catch (const SessionError& e) {
    lost = ConnectionLost(e.what());
  }
  return std::nullopt;
}

// Other threads may run meanwhile only if they do not take turns, or if somebody interrupts a wait.
bool RemoteClock::step(Lock& lock) {
  if (busy_ || over_ || !Turns::instance().somebody_waits_for_time()) return false;
  if (!advance_) {
    Advance next;
    if (!prepare(next)) return pass_alone();
    advance_ = std::move(next);
  }
  busy_ = true;
  Advance advance = std::move(*advance_);
  std::optional<ConnectionLost> lost;
  lock.unlock();
  std::optional<json> answer = answer_to(advance, lost);
  lock.lock();
  busy_ = false;
  advance_.reset();
  if (answer) {
    apply(advance, std::move(*answer));
  } else if (lost) {
    advance.carrier->lost = lost;
    advance.carrier->usable = false;
    make_waiters_ready();
  } else {
    advance_ = std::move(advance);
    return false;
  }
  return true;
}

void RemoteClock::apply(const Advance& advance, json answer) {
  Client& carrier = *advance.carrier;
  try {
    constexpr std::int64_t kMost = std::int64_t{1} << 62U;
    const sim::SimTime server_ns = protocol::require_integer(answer, "t", 0, kMost);
    now_ns_.store(std::max(now_ns(), server_ns - start_ns_), std::memory_order_release);
    over_ = over_ || protocol::require_bool(answer, "finished");
    const json& ready = protocol::require(answer, "ready");
    const bool alone = protocol::require_bool(answer, "alone");
    for (const ClientPointer& client : clients_) {
      client->sender->hold_back(alone);
      client->has_data =
          client->fetched || std::find(ready.begin(), ready.end(), client->number) != ready.end();
    }
    if (advance.fetches && protocol::require_bool(answer, "data")) {
      carrier.has_data = carrier.fetched = true;
      carrier.round = std::move(answer);
    }
  } catch (const protocol::ProtocolError& e) {
    carrier.lost =
        ConnectionLost(std::string("the server's answer cannot be understood: ") + e.what());
    carrier.usable = false;
  }
  make_waiters_ready();
}

// --- Rules of the wall clock and the end

std::chrono::steady_clock::time_point RemoteClock::last_seen(const TurnThread& thread) const {
  auto seen = thread.seen;
  for (const ClientPointer& client : clients_) {
    if (client->owner == thread.thread_id) seen = std::max(seen, client->seen);
  }
  return seen;
}

std::chrono::steady_clock::duration RemoteClock::silence_limit() const {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(settings_.silence_limit_s));
}

void RemoteClock::on_silent(const TurnThread& /*thread*/) {
  log_to_stderr()(sim::LogLevel::kWarning,
                  "a thread of the program has neither read nor slept for " +
                      sim::rounded_text(settings_.silence_limit_s, 6) +
                      " s of wall time; simulated time advances without it until it does");
}

ProgramClock::EndRules RemoteClock::end_rules() const {
  return {settings_.quiet_end, end_reported_};
}

}  // namespace playerlike
