// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/host.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <system_error>
#include <utility>

#include "host/busy_alarm.h"
#include "host/core.h"
#include "host/file_limit_errors.h"
#include "host/in_process_session.h"
#include "host/outputs.h"
#include "process/end_of_program.h"
#include "sim/core/number_text.h"
#include "sim/world/view_mode.h"
#include "virtual_time/virtual_time.h"

namespace playerlike {
namespace {

constexpr std::size_t kQueueLimit = 1000;
// A client may command this much ahead of the next step before it is carried out, so that one that
// never reads does not fill memory.
constexpr std::size_t kCommandLimit = 1 << 12;
constexpr sim::SimTime kEmptyRound_ns = sim::kNanosecondsPerSecond / 10;
// A program that ignores the end of the run this often is ended.
constexpr int kReadsAfterEnd = 1000;
// The same for one that sleeps in virtual time, a millisecond each; it may have others to wait for.
constexpr int kSleepsAfterEnd = 1000;
// How often a program may command or look while simulated time stands still before it is told that
// nobody calls Read(); see IdleCalls. Before the first Read() few have a reason to. Afterwards one
// may well send a command for each beam of a scan, and look at each beam many times; but
// virtual_time::note_looks() lets time pass after three million looks.
constexpr double kCommandsBeforeFirstStep = 1000.0;
constexpr double kCommandsInAStep = 10'000.0;
constexpr double kCommandsAfterSleeps = 20.0;  // a robot; the same for the least of the two above
constexpr double kLooksWithoutData = 1000.0;
constexpr double kLooksInAStep = 2'000'000.0;
// How often the files of the results follow the run, at most.
constexpr std::chrono::seconds kKeepingPeriod(1);
// The same for what `playpen run` is left beside the state of each step.
constexpr std::chrono::milliseconds kLooksPeriod(50);

double seconds(WallClock::duration d) { return std::chrono::duration<double>(d).count(); }

WallClock::duration wall(double seconds) {
  return std::chrono::duration_cast<WallClock::duration>(std::chrono::duration<double>(seconds));
}

bool subscribed_before(const Client::Subscription& s, DeviceId id) {
  return std::pair(s.device.robot, s.device.device) < std::pair(id.robot, id.device);
}

void require_duration(double sleep_s) {
  if (sleep_s >= 0.0 && sleep_s <= 1e9) return;
  throw SessionError(SessionError::Code::kBadArgument,
                     "sleep takes a number of seconds in [0, 1e9]");
}

// Whether a command undoes an earlier one of its kind that has not been carried out yet. Those that
// move a robot by some way, or are counted, do not.
bool replaces_earlier_ones(const sim::Command& command) {
  return std::holds_alternative<sim::TwistCommand>(command) ||
         std::holds_alternative<sim::HeadingCommand>(command) ||
         std::holds_alternative<sim::PositionCommand>(command) ||
         std::holds_alternative<sim::CarCommand>(command) ||
         std::holds_alternative<sim::MotorEnableCommand>(command) ||
         std::holds_alternative<sim::SetPoseCommand>(command);
}

}  // namespace

// --- Construction
// ---------------------------------------------------------------------------------

Host::Core::Core(sim::WorldDescription world, RunSettings settings, sim::LogHook log)
    : settings_(std::move(settings)),
      log_(std::move(log)),
      simulation_((check_drivers(world), check_interfaces(world), settings_.apply_to(world),
                   std::move(world)),
                  log_),
      robots_(describe_robots(simulation_)),
      subscribers_(robots_.size()),
      client_files_(settings_.client_files_limit, settings_.all_files_limit),
      turns_(settings_.virtual_time &&
             simulation_.world().simulation.time_mode == sim::TimeMode::kLockstep),
      mutex_(turns_ ? Turns::instance().mutex() : own_mutex_),
      step_ns_(simulation_.world().simulation.step_ns) {
  if (!settings_.output_folder.empty()) {
    std::filesystem::create_directories(settings_.output_folder);
  }
  for (std::size_t r = 0; r < robots_.size(); ++r) {
    subscribers_[r].resize(robots_[r].devices.size());
  }
  recorder_ = std::make_unique<Recorder>(settings_, simulation_);
  mode_chosen_ = simulation_.world().simulation.time_mode_given;
  time_factor_ = simulation_.world().simulation.time_factor;
  kept_ = KeptWriter::open(settings_.kept_run);
  if (kept_ && !settings_.output_folder.empty()) {
    kept_->keep_looks(report_text(simulation_, {}, RunEnd{}), simulation_);
    kept_->keep_step({}, *recorder_, simulation_);
  }
  if (settings_.quiet_end) note_interrupts(kept_ ? &kept_->noted() : nullptr);
}

Host::Core::~Core() {
  finish();
  stop_viewer();
  stop_pacer();
}

void Host::Core::start_pacer_if_needed() {
  const Lock lock = lock_soon();  // the window's thread may look at paced_ already
  if (simulation_.world().simulation.time_mode != sim::TimeMode::kPaced) return;
  paced_ = true;
  pacer_ = std::thread([this] { pace(); });
}

// --- Clients
// --------------------------------------------------------------------------------------

Host::Core::Lock Host::Core::lock_soon() const {
  knocking_.fetch_add(1);
  Lock lock(mutex_);
  knocking_.fetch_sub(1);
  return lock;
}

std::shared_ptr<Client> Host::Core::add_client(int port, bool follower,
                                               std::function<void()> notify) {
  const Lock lock = lock_soon();
  auto client = std::make_shared<Client>();
  client->notify = std::move(notify);
  client->number = next_number_++;
  client->port = port;
  client->follower = follower;
  client->creator = this_thinker();
  client->empty_round_ns = simulation_.now_ns() + kEmptyRound_ns;
  touch(*client);
  // Most often it is the last, so the search begins there. In virtual time threads may begin at the
  // same moment: the order is that in which they were started, not that in which they come here.
  auto place = clients_.end();
  while (place != clients_.begin()) {
    const Client& before = **std::prev(place);
    const bool after_it = before.follower == follower ? !turns_ || before.creator <= client->creator
                                                      : before.follower;
    if (after_it) break;
    --place;
  }
  clients_.insert(place, client);
  ++unsubscribed_;
  changed_.notify_all();  // a paced clock may wait for its first client
  return client;
}

void Host::Core::remove_client(Client& client) noexcept {
  const Lock lock = lock_soon();
  if (client.closed.exchange(true)) return;
  // What it asked for last still happens.
  if (!ended_) apply_inputs(client);
  client.drawings.close();
  layer_book_.leave(client.number);
  for (const Client::Subscription& s : client.subscriptions) forget_subscriber(client, s.device);
  if (client.subscriptions.empty()) --unsubscribed_;
  client.subscriptions.clear();
  if (turns_) Turns::instance().let_go(&client);
  std::erase_if(clients_, [&](const auto& c) { return c.get() == &client; });
  changed_.notify_all();
}

void Host::Core::thinker_ended(ThinkerId thinker) noexcept {
  if (turns_ && thinker == this_thinker() && virtual_time::process_ends()) return;
  const Lock lock = lock_soon();
  for (const auto& client : clients_) {
    if (client->owner != thinker) continue;
    client->owner = 0;
    client->joined = false;
  }
  if (turns_) Turns::instance().remove(thinker);
  changed_.notify_all();
}

void Host::Core::touch(Client& client) const {
  client.last_seen.store(WallClock::now().time_since_epoch().count(), std::memory_order_relaxed);
}

void Host::Core::require_open(const Client& client) {
  if (client.closed) {
    throw SessionError(SessionError::Code::kDisconnected, "the connection is closed");
  }
}

void Host::Core::adopt(Client& client, ThinkerId thinker) {
  require_open(client);
  if (!turns_) touch(client);  // else it is known when the thread's turn began
  client.owner = thinker;
  client.joined = true;
  client.silent = false;
  if (client.follower) return;
  if (first_owner_ == 0) first_owner_ = thinker;
  several_owners_ = several_owners_ || thinker != first_owner_;
}

void Host::Core::subscribe(Client& client, DeviceId device) {
  const Lock lock = lock_soon();
  require_open(client);
  require_readable(client, device.robot);
  auto it = std::lower_bound(client.subscriptions.begin(), client.subscriptions.end(), device,
                             subscribed_before);
  if (it == client.subscriptions.end() || !(it->device == device)) {
    if (client.subscriptions.empty()) --unsubscribed_;
    it = client.subscriptions.emplace(it);
    it->device = device;
    it->replace = client.replace_by_default;
    subscribers(device).push_back(&client);
  }
  ++it->count;
  if (client.is_programs() && !wants_time_.exchange(true)) start_busy_alarm(lock);
}

void Host::Core::unsubscribe(Client& client, DeviceId device) {
  const Lock lock = lock_soon();
  auto& all = client.subscriptions;
  const auto it =
      std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.device == device; });
  if (it == all.end() || --it->count > 0) return;
  all.erase(it);
  if (all.empty()) ++unsubscribed_;
  forget_subscriber(client, device);
  client.has_data = std::any_of(all.begin(), all.end(),
                                [](const auto& s) { return s.fresh || !s.queue.empty(); });
  client.empty_round_ns = simulation_.now_ns() + kEmptyRound_ns;
}

void Host::Core::set_replace(Client& client, std::optional<DeviceId> device, bool replace) {
  const Lock lock = lock_soon();
  require_open(client);
  if (!device) client.replace_by_default = replace;
  for (Client::Subscription& s : client.subscriptions) {
    if (device && !(s.device == *device)) continue;
    s.replace = replace;
    // What waits keeps waiting, in the form that the new rule takes.
    if (replace && !s.queue.empty()) {
      s.queue.erase(s.queue.begin(), s.queue.end() - 1);
    } else if (!replace && s.fresh) {
      s.fresh = false;
      s.queue.push_back(sensor(s.device).share());
    }
  }
}

// --- Time
// -----------------------------------------------------------------------------------------

bool Host::Core::over() const { return ended_ || simulation_.finished(); }

int Host::Core::joined_programs() const {
  return static_cast<int>(std::count_if(clients_.begin(), clients_.end(),
                                        [](const auto& c) { return c->joined && !c->follower; }));
}

// Whether somebody is there for whom time may go on.
bool Host::Core::program_takes_part() const {
  return step_credit_.has_value() ||
         std::any_of(clients_.begin(), clients_.end(),
                     [](const auto& c) { return c->joined && !c->silent && !c->follower; }) ||
         std::any_of(alarms_.begin(), alarms_.end(),
                     [](const auto& alarm) { return alarm.second.lets_time_pass; });
}

bool Host::Core::gate_open() {
  if (gate_opened_) return true;
  const int wanted = simulation_.world().simulation.start_gate_clients;
  gate_opened_ = wanted <= 1 || joined_programs() >= wanted;
  return gate_opened_;
}

bool Host::Core::thinker_waits(ThinkerId thinker) const {
  return std::any_of(clients_.begin(), clients_.end(),
                     [&](const auto& c) { return c->waiting && c->owner == thinker; });
}

// One thread may read many clients: it waits if one of them does.
bool Host::Core::all_wait() const {
  waiting_.clear();
  for (const auto& c : clients_) {
    if (c->waiting) waiting_.push_back(c->owner);
  }
  return std::all_of(clients_.begin(), clients_.end(), [this](const auto& c) {
    return !c->joined || c->silent || c->waiting ||
           std::find(waiting_.begin(), waiting_.end(), c->owner) != waiting_.end();
  });
}

bool Host::Core::may_advance(bool all_wait_still) {
  return !paced_ && !over() && step_credit_ != 0U && gate_open() && program_takes_part() &&
         (all_wait_still || all_wait());
}

bool Host::Core::wait_is_over(const Client& client) const {
  return over() || (client.wants_data && client.has_data) ||
         (client.wake_ns && simulation_.now_ns() >= *client.wake_ns);
}

void Host::Core::wait_until(Lock& lock, Client& client, bool wants_data,
                            std::optional<sim::SimTime> wake_ns) {
  adopt(client, this_thinker());
  client.wants_data = wants_data;
  client.wake_ns = wake_ns;
  if (in_turns()) wait_for_turn(lock, client);
  // Until somebody is let go, nothing changes about who waits while this thread has the mutex.
  bool all_wait_still = false;
  while (!wait_is_over(client)) {
    require_open(client);
    // Said once: threads that all only tell each other that they wait would never sleep.
    const bool began = !std::exchange(client.waiting, true);
    if (paced_) {
      if (began) changed_.notify_all();
      changed_.wait(lock);
    } else if (may_advance(all_wait_still)) {
      all_wait_still = !advance();
    } else {
      if (began) changed_.notify_all();
      wait_for_others(lock, client);
      all_wait_still = false;
    }
  }
  client.waiting = false;
}

// Waits for a change, and no longer than until a client has been silent for too long.
void Host::Core::wait_for_others(Lock& lock, const Client& client) {
  // A follower does not mind how long programs take.
  if (client.follower) return changed_.wait(lock);
  if (changed_.wait_until(lock, silence_deadline()) == std::cv_status::timeout) note_silence();
}

// When it is to be looked whether a client has been silent for too long, if nothing changes.
WallClock::time_point Host::Core::silence_deadline() const {
  const auto limit = wall(settings_.silence_limit_s);
  auto deadline = WallClock::now() + limit;
  if (!gate_opened_) return deadline;
  for (const auto& c : clients_) {
    if (!c->joined || c->silent || thinker_waits(c->owner)) continue;
    const WallClock::time_point seen{WallClock::duration(c->last_seen.load())};
    deadline = std::min(deadline, seen + limit);
  }
  return deadline;
}

// Says for whom the others wait, and no longer waits for those who have been silent for too long.
void Host::Core::note_silence() {
  const auto now = WallClock::now();
  const auto limit = wall(settings_.silence_limit_s);
  if (!gate_opened_) {
    if (now - gate_told_ < limit) return;
    gate_told_ = now;
    warn("the start gate waits for " +
         std::to_string(simulation_.world().simulation.start_gate_clients) + " clients; " +
         std::to_string(joined_programs()) + " have joined so far");
    return;
  }
  for (const auto& c : clients_) {
    if (!c->joined || c->silent || thinker_waits(c->owner)) continue;
    const WallClock::time_point seen{WallClock::duration(c->last_seen.load())};
    if (now - seen < limit) continue;
    c->silent = true;
    silence_noted_ = true;
    warn_of_silence(*c);
  }
}

void Host::Core::warn_of_silence(const Client& client) const {
  warn("client " + std::to_string(client.number + 1) + " (port " + std::to_string(client.port) +
       ") has not called Read() for " + sim::rounded_text(settings_.silence_limit_s, 6) +
       " s of wall time; simulated time goes on without it until it does");
}

bool Host::Core::advance() {
  const auto now = WallClock::now();
  if (!first_step_) {
    first_step_ = now;
    last_progress_ = now;
    if (watches_program_) dismiss_busy_alarm();
  }
  const bool commanded = commands_wait_.exchange(false);
  if (commanded || somebody_draws_) {
    for (const auto& client : clients_) apply_inputs(*client);
  }
  if (hand_) hand_->before_step(simulation_);
  simulation_.step();
  now_ns_.store(simulation_.now_ns(), std::memory_order_release);
  if (step_credit_) --*step_credit_;
  last_step_ = now;
  recorder_->observe(simulation_);
  for (auto& [port, log] : logs_) {
    if (const auto problem = log.observe(simulation_)) warn(*problem);
  }
  distribute();
  if (simulation_.finished()) last_step_ = WallClock::now();
  if (settings_.progress && simulation_.steps() % 64 == 0) show_progress(false);
  if (simulation_.finished() || (settings_.quiet_end && interrupted() != 0)) {
    end_run();
  } else {
    keep_results(now);
  }
  return release_waiters();
}

void Host::Core::apply_inputs(Client& client) {
  const std::lock_guard input(client.input_mutex);
  for (const auto& [device, command] : client.commands) {
    if (hand_) hand_->note_command(device, command);
    if (const auto refusal = simulation_.apply(device, command)) warn(*refusal);
  }
  client.commands.clear();
  carry_out_drawings(client);
}

// Drawings on layers that are not the client's are left out; one look for each run of drawings on
// the same layer sees to that. Most often all are its own, and are drawn from where they are.
void Host::Core::carry_out_drawings(Client& client) {
  client.drawings.drain([&](std::span<const sim::DrawOperation> operations) {
    std::optional<sim::LayerId> layer;
    const bool all_own = std::all_of(operations.begin(), operations.end(), [&](const auto& o) {
      if (layer == o.layer) return true;
      layer = o.layer;
      return layer_book_.may_use(client.number, o.layer);
    });
    if (all_own) return simulation_.layers().draw(operations);
    std::vector<sim::DrawOperation> own(operations.begin(), operations.end());
    keep_own_drawings(client, own);
    simulation_.layers().draw(own);
  });
}

// Each new reading is given to those who have subscribed to its device, and to nobody else is it
// offered: many clients that want something else cost nothing.
void Host::Core::distribute() {
  if (unsubscribed_ > 0) {
    for (const auto& client : clients_) {
      if (client->subscriptions.empty() && simulation_.now_ns() >= client->empty_round_ns) {
        client->has_data = true;
      }
    }
  }
  std::vector<int> replayed;  // ports whose readings come from a file
  for (auto& [port, log] : logs_) {
    if (!log.replaying()) continue;
    replayed.push_back(port);
    for (const RunLog::Entry* entry : log.due()) {
      for (Client* client : subscribers(entry->device)) {
        if (client->port != port) continue;
        distribute(entry->reading, *find_subscription(*client, entry->device), *client);
      }
    }
  }
  for (const DeviceId& updated : simulation_.updated()) {
    for (Client* client : subscribers(updated)) {
      if (std::find(replayed.begin(), replayed.end(), client->port) != replayed.end()) continue;
      Client::Subscription& s = *find_subscription(*client, updated);
      if (s.replace) {
        client->has_data = true;
        s.fresh = true;
        s.queue.clear();
        continue;
      }
      distribute(sensor(updated).share(), s, *client);
    }
  }
}

Client::Subscription* Host::Core::find_subscription(Client& client, DeviceId device) {
  const auto it = std::lower_bound(client.subscriptions.begin(), client.subscriptions.end(), device,
                                   subscribed_before);
  return it != client.subscriptions.end() && it->device == device ? &*it : nullptr;
}

std::vector<Client*>& Host::Core::subscribers(DeviceId device) {
  return subscribers_[static_cast<std::size_t>(device.robot)]
                     [static_cast<std::size_t>(device.device)];
}

void Host::Core::forget_subscriber(const Client& client, DeviceId device) noexcept {
  std::erase(subscribers(device), &client);
}

const sim::Sensor& Host::Core::sensor(DeviceId device) const {
  return dynamic_cast<const sim::Sensor&>(simulation_.device(device.robot, device.device));
}

void Host::Core::distribute(const sim::SharedReading& reading, Client::Subscription& subscription,
                            Client& client) {
  client.has_data = true;
  if (subscription.replace) {
    subscription.fresh = false;
    subscription.queue.clear();
  } else if (subscription.queue.size() == kQueueLimit) {
    subscription.queue.erase(subscription.queue.begin());
    ++client.overflow;
  }
  subscription.queue.push_back(reading);
}

// A waiting thread that has what it waits for no longer counts as waiting, even before it wakes.
bool Host::Core::release_waiters() {
  if (in_turns()) {
    make_ready();
    return true;
  }
  bool anybody = false;
  bool released = false;
  for (const auto& client : clients_) {
    if (!client->waiting || !wait_is_over(*client)) continue;
    client->waiting = false;
    anybody = true;
    touch(*client);
    if (client->notify) {
      client->notify();
    } else {
      released = released || client->owner != this_thinker();
    }
  }
  if (released) changed_.notify_all();
  if (!alarms_.empty()) ring_alarms();
  return anybody;
}

void Host::Core::ring_alarms() {
  const bool all = over();
  // Those that are not due stay, in their order.
  std::size_t kept = 0;
  for (std::size_t i = 0; i < alarms_.size(); ++i) {
    const Alarm& alarm = alarms_[i].second;
    if (all || (alarm.until_ns && simulation_.now_ns() >= *alarm.until_ns) ||
        (alarm.condition && alarm.condition(simulation_))) {
      alarm.notify();
    } else {
      if (kept != i) alarms_[kept] = std::move(alarms_[i]);
      ++kept;
    }
  }
  alarms_.erase(alarms_.begin() + static_cast<std::ptrdiff_t>(kept), alarms_.end());
}

void Host::Core::wait(Client& client) {
  // Let threads in that only want a quick word, before time goes on.
  while (knocking_.load(std::memory_order_relaxed) > 0) std::this_thread::yield();
  Lock lock(mutex_);
  wait_until(lock, client, /*wants_data=*/true, std::nullopt);
  if (client.has_data) return;
  end_told_ = true;
  if (settings_.quiet_end && ++reads_after_end_ > kReadsAfterEnd) {
    lock.unlock();
    end_program_quietly();
  }
  throw SessionError(SessionError::Code::kFinished, "the simulated run is over");
}

int Host::Core::take(Client& client, ReadingSink& sink) {
  std::vector<std::pair<DeviceId, sim::SharedReading>> taken;
  {
    const Lock lock(mutex_);
    require_open(client);
    client.looks = 0;
    if (!client.has_data) return 0;
    client.has_data = false;
    client.empty_round_ns = simulation_.now_ns() + kEmptyRound_ns;
    taken.reserve(client.subscriptions.size());
    for (Client::Subscription& s : client.subscriptions) {
      if (std::exchange(s.fresh, false)) taken.emplace_back(s.device, sensor(s.device).share());
      for (sim::SharedReading& reading : s.queue) taken.emplace_back(s.device, std::move(reading));
      s.queue.clear();
    }
  }
  for (const auto& [device, reading] : taken) sink.on_reading(device, reading);
  return static_cast<int>(taken.size());
}

bool Host::Core::peek(Client& client, std::chrono::milliseconds timeout) {
  while (knocking_.load(std::memory_order_relaxed) > 0) std::this_thread::yield();
  Lock lock(mutex_);
  require_open(client);
  if (client.has_data || over()) return true;
  if (paced_) {
    adopt(client, this_thinker());
    client.wants_data = true;
    client.wake_ns.reset();
    client.waiting = true;
    changed_.wait_for(lock, timeout,
                      [&] { return client.has_data || over() || client.closed.load(); });
    client.waiting = false;
    return client.has_data || over();
  }
  if (timeout.count() == 0 && ++client.looks < 2) return false;
  wait_until(lock, client, /*wants_data=*/true, end_of_peek(timeout));
  return client.has_data || over();
}

// When a peek of lockstep that begins now is over.
sim::SimTime Host::Core::end_of_peek(std::chrono::milliseconds timeout) const {
  const sim::SimTime step_ns = simulation_.world().simulation.step_ns;
  return simulation_.now_ns() +
         std::max<sim::SimTime>(step_ns, std::chrono::nanoseconds(timeout).count());
}

void Host::Core::sleep(Client& client, double duration_s) {
  require_duration(duration_s);
  Lock lock(mutex_);
  const sim::SimTime wake_ns = simulation_.now_ns() + sim::from_seconds(duration_s);
  wait_until(lock, client, /*wants_data=*/false, wake_ns);
}

// --- Virtual time
// ---------------------------------------------------------------------------------

void Host::Core::begin_turns(sim::SimTime before_ns) {
  const Lock lock = lock_soon();
  Turns::instance().set_clock(this, before_ns, 0);
}

void Host::Core::end_turns(sim::SimTime before_ns) {
  const Lock lock = lock_soon();
  Turns::instance().set_clock(nullptr, 0, before_ns);
}

// One thread at a time: what programs do between two steps, with what their threads share, then
// does not depend on which of them the system lets run first.
void Host::Core::wait_for_turn(Lock& lock, Client& client) {
  Turns& turns = Turns::instance();
  TurnThread& self = turns.self();
  // After the end nobody waits for anything, but each is to have its turn.
  for (bool waited = false; in_turns(); waited = true) {
    require_open(client);
    const bool is_over = wait_is_over(client);
    if (is_over && self.state != TurnThread::State::kAside && (waited || !over())) return;
    self.client = &client;
    self.wake_ns = is_over ? 0 : client.wake_ns;
    static_cast<void>(turns.wait(lock, self));
  }
}

bool Host::Core::step(Lock& lock) {
  if (over() || step_credit_ == 0U || !gate_open() ||
      !Turns::instance().somebody_waits_for_time()) {
    return false;
  }
  advance();
  if (knocking_.load(std::memory_order_relaxed) > 0) {
    lock.unlock();
    std::this_thread::yield();
    lock.lock();
  }
  return true;
}

// Those who wait for data before those who sleep: a program that sleeps while another of its
// threads reads finds the data of that moment.
void Host::Core::make_ready() {
  using State = TurnThread::State;
  Turns& turns = Turns::instance();
  for (const auto& client : clients_) {
    for (const auto& thread : turns.threads()) {
      if (thread->state != State::kWaits || thread->client != client.get()) continue;
      if (wait_is_over(*client)) turns.make_ready(*thread, TurnThread::Wake::kThere);
    }
  }
  for (const auto& thread : turns.threads()) {
    if (thread->state != State::kWaits || thread->client != nullptr || !thread->wake_ns) continue;
    if (has_come(*thread->wake_ns)) turns.make_ready(*thread, TurnThread::Wake::kTime);
  }
}

bool Host::Core::has_come(sim::SimTime wake_ns) const {
  return over() || simulation_.now_ns() >= wake_ns;
}

void Host::Core::look_at_start() {
  if (!gate_open()) note_silence();
}

WallClock::time_point Host::Core::last_seen(const TurnThread& thread) const {
  auto seen = thread.seen;
  for (const auto& client : clients_) {
    if (client->owner != thread.thinker) continue;
    seen = std::max(seen, WallClock::time_point(WallClock::duration(client->last_seen.load())));
  }
  return seen;
}

WallClock::duration Host::Core::silence_limit() const {
  return gate_opened_ ? wall(settings_.silence_limit_s) : WallClock::duration::max();
}

void Host::Core::on_silent(const TurnThread& thread) {
  for (const auto& client : clients_) {
    if (client->owner == thread.thinker) return warn_of_silence(*client);
  }
  warn("a thread of the program has neither read nor slept for " +
       sim::rounded_text(settings_.silence_limit_s, 6) +
       " s of wall time; simulated time goes on without it until it does");
}

bool Host::Core::on_blocked(const TurnThread& thread) {
  if (paced_ || over() || !thread.starts_background || mode_chosen_) return false;
  start_pacing(
      "the program reads in the background (StartThread) while its own thread waits for "
      "something else than simulated time, the keyboard maybe: simulated time now follows the "
      "wall clock (--time lockstep decides otherwise)");
  return true;
}

std::optional<sim::SimTime> Host::Core::pass_time(sim::SimTime target_ns, bool& interrupted) {
  interrupted = false;
  const ThinkerId thinker = this_thinker();
  while (knocking_.load(std::memory_order_relaxed) > 0) std::this_thread::yield();
  Lock lock(mutex_);
  if (!in_turns() || ended_by_program_) return std::nullopt;
  // A program that never reads takes part with the clients it has made.
  for (const auto& client : clients_) {
    if (client->creator == thinker && client->owner == 0 && !client->follower) {
      adopt(*client, thinker);
    }
  }
  const sim::SimTime wake_ns = target_ns - target_ns % step_ns_;
  Turns& turns = Turns::instance();
  TurnThread& self = turns.self();
  self.wake_ns = wake_ns;
  interrupted = turns.wait(lock, self, /*interruptible=*/true) == TurnThread::Wake::kInterrupted;
  const sim::SimTime left_ns = target_ns - simulation_.now_ns();
  if (interrupted) return left_ns;
  if (!over()) return in_turns() ? std::optional(left_ns) : std::nullopt;
  if (simulation_.now_ns() < wake_ns) {
    if (ended_by_program_) return std::nullopt;
    sleep_after_end(lock, thinker);
  }
  return left_ns;
}

void Host::Core::note_timed_wait(Lock& lock, sim::SimTime left_ns) {
  if (!over() || left_ns < step_ns_ || ended_by_program_) return;
  sleep_after_end(lock, this_thinker());
}

// Nobody can throw out of a sleep. A program that only sleeps ends here; one that reads as well, or
// has threads that do, is told by that, and is left some time to end by itself.
void Host::Core::sleep_after_end(Lock& lock, ThinkerId thinker) {
  const auto& threads = Turns::instance().threads();
  const bool others = std::any_of(threads.begin(), threads.end(), [&](const auto& thread) {
    if (thread->thinker == thinker || thread->state == TurnThread::State::kAside) return false;
    return thread->state != TurnThread::State::kWaits || thread->waits_for_time();
  });
  if (settings_.quiet_end && (!(end_told_ || others) || ++sleeps_after_end_ > kSleepsAfterEnd)) {
    if (settings_.progress && log_)
      log_(sim::LogLevel::kInfo, "the run is over: the program was ended in its sleep");
    lock.unlock();
    end_program_quietly();
  }
  lock.unlock();
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

// --- Event clients
// --------------------------------------------------------------------------------

EventClient::Outcome Host::Core::begin(Client& client, ThinkerId thinker, bool wants_data,
                                       std::optional<sim::SimTime> wake_ns) {
  adopt(client, thinker);
  client.wants_data = wants_data;
  client.wake_ns = wake_ns;
  client.waiting = !wait_is_over(client);
  if (client.waiting) changed_.notify_all();
  return outcome(client);
}

EventClient::Outcome Host::Core::begin_wait(Client& client, ThinkerId thinker) {
  const Lock lock = lock_soon();
  return begin(client, thinker, /*wants_data=*/true, std::nullopt);
}

EventClient::Outcome Host::Core::begin_peek(Client& client, ThinkerId thinker,
                                            std::chrono::milliseconds timeout) {
  const Lock lock = lock_soon();
  require_open(client);
  client.wants_data = true;
  client.wake_ns = simulation_.now_ns();  // over at once, unless decided otherwise below
  if (client.has_data || over()) return outcome(client);
  if (paced_) {
    if (timeout.count() == 0) {
      adopt(client, thinker);
      return outcome(client);
    }
    return begin(client, thinker, /*wants_data=*/true, std::nullopt);
  }
  if (timeout.count() == 0 && ++client.looks < 2) return outcome(client);
  return begin(client, thinker, /*wants_data=*/true, end_of_peek(timeout));
}

EventClient::Outcome Host::Core::begin_sleep(Client& client, ThinkerId thinker, double seconds) {
  require_duration(seconds);
  const Lock lock = lock_soon();
  return begin(client, thinker, /*wants_data=*/false,
               simulation_.now_ns() + sim::from_seconds(seconds));
}

EventClient::Outcome Host::Core::outcome(const Client& client) const {
  using Outcome = EventClient::Outcome;
  if (client.waiting) return Outcome::kWaiting;
  if (client.wants_data && client.has_data) return Outcome::kData;
  if (client.wake_ns && simulation_.now_ns() >= *client.wake_ns && !over()) return Outcome::kTime;
  if (client.wants_data || client.wake_ns) return over() ? Outcome::kFinished : Outcome::kIdle;
  return Outcome::kIdle;
}

EventClient::Outcome Host::Core::outcome_of(const Client& client) const {
  const Lock lock = lock_soon();
  return outcome(client);
}

void Host::Core::cancel_wait(Client& client) {
  const Lock lock = lock_soon();
  client.waiting = false;
  client.wants_data = false;
  client.wake_ns.reset();
  touch(client);
}

bool Host::Core::advance_for(std::chrono::microseconds slice) {
  Lock lock = lock_soon();
  if (in_turns() || !may_advance()) return false;
  const auto end = WallClock::now() + slice;
  do {
    advance();
    if (!may_advance()) return false;
    // Others want a word.
    if (knocking_.load(std::memory_order_relaxed) > 0) return true;
  } while (WallClock::now() < end);
  return true;
}

void Host::Core::check_silence() {
  const Lock lock = lock_soon();
  // Nobody waits in vain while time goes on by itself, or while there is nobody for whom it would.
  if (paced_ || over()) return;
  const bool somebody_waits =
      std::any_of(clients_.begin(), clients_.end(), [](const auto& c) { return c->waiting; });
  if (somebody_waits || program_takes_part()) note_silence();
}

AlarmId Host::Core::set_alarm(Alarm alarm) {
  const Lock lock = lock_soon();
  const AlarmId number = next_alarm_++;
  alarms_.emplace_back(number, std::move(alarm));
  ring_alarms();
  changed_.notify_all();  // lockstep time may go on for it
  return number;
}

bool Host::Core::cancel_alarm(AlarmId alarm) {
  const Lock lock = lock_soon();
  return std::erase_if(alarms_, [alarm](const auto& a) { return a.first == alarm; }) > 0;
}

void Host::Core::with_simulation(const std::function<void(sim::Simulation&)>& action) {
  const Lock lock = lock_soon();
  action(simulation_);
}

void Host::Core::set_step_credit(std::optional<std::uint64_t> steps) {
  const Lock lock = lock_soon();
  step_credit_ = steps;
  ++pace_changes_;
  changed_.notify_all();
}

void Host::Core::add_step_credit(std::uint64_t steps) {
  const Lock lock = lock_soon();
  if (!step_credit_) return;
  *step_credit_ += steps;
  ++pace_changes_;
  changed_.notify_all();
}

std::optional<std::string> Host::Core::set_time_factor(double factor) {
  const Lock lock = lock_soon();
  if (!paced_) {
    return "time has no speed in lockstep: it goes on when all clients wait";
  }
  if (!(factor > 0.0 && std::isfinite(factor))) {
    return "expected a factor greater than 0, found " + sim::rounded_text(factor, 6);
  }
  time_factor_ = factor;
  ++pace_changes_;
  changed_.notify_all();
  return std::nullopt;
}

// --- Inputs
// ---------------------------------------------------------------------------------------

void Host::Core::send(Client& client, DeviceId device, const sim::Command& command) {
  require_open(client);
  touch(client);
  const bool is_programs = client.is_programs();
  if (is_programs && !wants_time_.load(std::memory_order_relaxed) && !wants_time_.exchange(true)) {
    start_busy_alarm(lock_soon());
  }
  bool look = false;
  bool full = false;
  {
    const std::lock_guard input(client.input_mutex);
    look = is_programs && note_command(client);
    // Of such commands in a row to the same device only the last counts.
    if (replaces_earlier_ones(command) && !client.commands.empty() &&
        client.commands.back().first == device &&
        client.commands.back().second.index() == command.index()) {
      client.commands.back().second = command;
    } else {
      client.commands.emplace_back(device, command);
      commands_wait_.store(true, std::memory_order_relaxed);
      full = client.commands.size() > kCommandLimit;
    }
  }
  if (look) warn_if_nobody_reads(client);
  if (!full) return;
  const Lock lock = lock_soon();
  apply_inputs(client);
}

// --- Programs that let no time pass
// -----------------------------------------------------------------

bool Host::Core::note_command(Client& client) {
  const sim::SimTime now_ns = this->now_ns();
  const auto robots = static_cast<double>(robots_.size());
  const double share = 1.0 / std::max(now_ns == 0 ? kCommandsBeforeFirstStep : kCommandsInAStep,
                                      kCommandsAfterSleeps * robots);
  // In virtual time sleeps let time pass.
  return turns_ ? client.idle.note(now_ns, share)
                : client.idle.note_command(now_ns, share, 1.0 / (kCommandsAfterSleeps * robots));
}

void Host::Core::note_looks(Client& client, int count, bool has_data) {
  if (!client.is_programs()) return;
  bool look = false;
  {
    const std::lock_guard input(client.input_mutex);
    look = client.idle.note(now_ns(), count / (has_data ? kLooksInAStep : kLooksWithoutData));
  }
  if (look) warn_if_nobody_reads(client);
}

void Host::Core::warn_if_nobody_reads(Client& client) {
  const Lock lock = lock_soon();
  const ThinkerId self = this_thinker();
  if (in_turns() && others_take_turns(self)) {
    const std::lock_guard input(client.input_mutex);
    return client.idle.postpone();
  }
  const bool others_may_read =
      !in_turns() && std::any_of(clients_.begin(), clients_.end(), [&](const auto& c) {
        if (!c->joined || c->silent || c->follower || c->owner == self) return false;
        return !c->waiting || !gate_open();
      });
  {
    const std::lock_guard input(client.input_mutex);
    if (nobody_reads_told_ || paced_ || over() || others_may_read) return client.idle.postpone();
    if (!client.idle.look(simulation_.now_ns())) return;
  }
  nobody_reads_told_ = true;
  if (watches_program_) dismiss_busy_alarm();
  warn(
      "the program goes on commanding robots or looking at their data, but simulated time stands "
      "still: it does not call Read(). " +
      cure_for_standing_time());
}

bool Host::Core::others_take_turns(ThinkerId thinker) const {
  const auto& threads = Turns::instance().threads();
  return std::any_of(threads.begin(), threads.end(), [&](const auto& thread) {
    using State = TurnThread::State;
    if (thread->thinker == thinker) return false;
    return thread->state == State::kReady || thread->state == State::kBeside ||
           (thread->state == State::kWaits && thread->waits_for_time());
  });
}

std::string Host::Core::cure_for_standing_time() const {
  return std::string(
             "Time passes only while the program waits in Read(): call client.Read() in each turn "
             "of its loop (in C: playerc_client_read(client))") +
         (turns_ ? ", or sleep" : "; its sleeps count only under `playpen run`");
}

void Host::Core::watch_program() {
  const Lock lock = lock_soon();
  watches_program_ = true;
}

void Host::Core::start_busy_alarm(const Lock& /*held*/) {
  if (!watches_program_ || paced_ || over() || simulation_.now_ns() > 0) return;
  set_busy_alarm(settings_.silence_limit_s,
                 "the program has been busy for " +
                     sim::rounded_text(settings_.silence_limit_s, 6) +
                     " s of processor time, but no simulated time has passed: it has not called "
                     "Read(). " +
                     cure_for_standing_time());
}

void Host::Core::note_program_ends(int status) {
  const Lock lock = lock_soon();
  program_status_ = status;
  if (watches_program_) dismiss_busy_alarm();
  if (nobody_reads_told_ || busy_alarm_rang() || paced_ || ended_ || !wants_time_) return;
  // A program that gives up because of an error knows why.
  if (simulation_.now_ns() > 0 || status != 0) return;
  warn("nothing was simulated: the program has ended without calling Read(). " +
       cure_for_standing_time());
}

void Host::Core::note_end_request(int signal) {
  const Lock lock = lock_soon();
  if (end_request_ == 0) end_request_ = signal;
}

void Host::Core::require_readable(const Client& client, int robot) const {
  if (!own_sensors_only() || client.served) return;
  const bool own = robot >= 0 && (robots_.size() == 1 ||
                                  robots_[static_cast<std::size_t>(robot)].port == client.port);
  if (own) return;
  throw SessionError(
      SessionError::Code::kNotAvailable,
      robot >= 0
          ? "this world lets a program read the sensors of its own robot only (\"privacy\" in "
            "its \"simulation\"): robot " +
                robots_[static_cast<std::size_t>(robot)].name + " belongs to another port than " +
                std::to_string(client.port)
          : "this world keeps the poses and properties of its objects and its map private "
            "(\"privacy\" in its \"simulation\"): programs know what their sensors tell");
}

void Host::Core::join(Client& client, ThinkerId thinker) {
  const Lock lock = lock_soon();
  adopt(client, thinker);
  if (in_turns()) static_cast<void>(Turns::instance().self());
  changed_.notify_all();  // the start gate may have waited for it
}

// --- Pacing
// ---------------------------------------------------------------------------------------

void Host::Core::prefer_real_time(const std::string& reason) {
  const Lock lock = lock_soon();
  if (in_turns()) {
    // The caller's sleeps are part of the lockstep, from now on.
    Turns::instance().self().starts_background = true;
    virtual_time::note_background();
    return;
  }
  if (mode_chosen_ || ended_ || paced_) return;
  start_pacing(reason +
               ": simulated time now follows the wall clock (under `playpen run` the program's "
               "sleeps move simulated time instead; PLAYPEN_TIME=lockstep, or a time mode in the "
               "world file's \"simulation\", decides otherwise)");
}

void Host::Core::start_pacing(const std::string& warning) {
  paced_ = true;
  if (watches_program_) dismiss_busy_alarm();
  if (turns_) virtual_time::give_up_locked();
  warn(warning);
  pacer_ = std::thread([this] { pace(); });
  changed_.notify_all();
}

void Host::Core::pace() {
  const virtual_time::Inside inside;
  Lock lock(mutex_);
  const double step_s = sim::to_seconds(simulation_.world().simulation.step_ns);
  const auto gate_clients = simulation_.world().simulation.start_gate_clients;
  changed_.wait(lock, [&] {
    if (stop_pacing_) return true;
    return gate_clients <= 1 ? settings_.start_at_once || !clients_.empty() : gate_open();
  });
  // Step number done + 1 since `base` is due at base + (done + 1) * step / factor.
  auto base = WallClock::now();
  std::uint64_t done = 0;
  double factor = time_factor_;
  int changes = pace_changes_;
  while (!stop_pacing_ && !over()) {
    if (paused_) {
      wait_while_paused(lock);
      base = WallClock::now();
      done = 0;
      continue;
    }
    if (changes != pace_changes_) {
      // From the newest step on at the new speed: nothing is caught up with, nothing lost.
      base += wall(static_cast<double>(done) * step_s / factor);
      done = 0;
      factor = time_factor_;
      changes = pace_changes_;
    }
    if (step_credit_ == 0U) {
      wait_for_step_credit(lock);
      // Whoever synchronises the clock may be slow: nothing is caught up with, but the step that
      // was waited for comes at once.
      const auto now = WallClock::now();
      if (now > base + wall(static_cast<double>(done + 1) * step_s / factor)) {
        base = now - wall(step_s / factor);
        done = 0;
      }
      continue;
    }
    const auto due = base + wall(static_cast<double>(done + 1) * step_s / factor);
    const auto now = WallClock::now();
    if (now < due) {
      changed_.wait_until(lock, due, [&] { return stop_pacing_ || changes != pace_changes_; });
      continue;
    }
    // Far behind (a suspended machine, a factor beyond what it can do): go on from here instead
    // of rushing after.
    if (now - due > std::chrono::milliseconds(200)) {
      base = now;
      done = 0;
    }
    advance();
    ++done;
    if (knocking_.load() > 0) {
      lock.unlock();
      std::this_thread::yield();
      lock.lock();
    }
  }
}

void Host::Core::wait_while_paused(Lock& lock) {
  while (paused_ && !stop_pacing_ && !over()) {
    changed_.wait_for(lock, std::chrono::milliseconds(50));
    // Without a step nobody else would see the signal.
    if (settings_.quiet_end && interrupted() != 0 && !ended_) {
      end_run();
      release_waiters();
    }
  }
}

void Host::Core::wait_for_step_credit(Lock& lock) {
  changed_.wait(lock, [&] { return step_credit_ != 0U || paused_ || stop_pacing_ || over(); });
}

void Host::Core::stop_pacer() {
  {
    const Lock lock = lock_soon();
    stop_pacing_ = true;
    changed_.notify_all();
  }
  if (pacer_.joinable() && pacer_.get_id() != std::this_thread::get_id()) pacer_.join();
}

// --- The end
// --------------------------------------------------------------------------------------

void Host::Core::finish() noexcept {
  try {
    const Lock lock = lock_soon();
    if (watches_program_) dismiss_busy_alarm();
    ended_by_program_ = true;
    if (!ended_) {
      for (const auto& client : clients_) apply_inputs(*client);
      end_run();
      release_waiters();
      if (in_turns()) Turns::instance().kick();
    }
    stop_pacing_ = true;
    changed_.notify_all();
  } catch (const std::exception& e) {
    warn(e.what());
  }
}

void Host::Core::end_run() {
  ended_ = true;
  set_phase(KeptRun::Phase::kEnded);
  // Threads that take no part in the lockstep may have drawn since the last step.
  for (const auto& client : clients_) carry_out_drawings(*client);
  if (settings_.progress) show_progress(true);
  write_results();
  set_phase(KeptRun::Phase::kDone);
  if (settings_.quiet_end) end_program_quietly_if_uncaught();
}

// What matters most comes first, and what fails keeps back nothing else.
void Host::Core::write_results() {
  const FileLimitErrors limit_errors;
  const auto attempt = [this](const char* problem, const auto& write) {
    try {
      write();
    } catch (const std::exception& e) {
      warn(std::string(problem) + e.what());
    }
  };
  constexpr const char* kMissing = "results of the run are missing: ";
  const std::string& folder = settings_.output_folder;
  attempt(kMissing, [&] { recorder_->close_trajectory(); });
  if (!folder.empty()) {
    const TimeStatistics time = time_locked();
    const std::string report = report_text(simulation_, time, reason_of_end());
    if (kept_) {
      kept_->keep_step(time, *recorder_, simulation_);
      kept_->keep_looks(report, simulation_);
    }
    attempt(kMissing, [&] { write_report(folder, signed_report(report, settings_.grading)); });
  }
  set_phase(KeptRun::Phase::kReported);
  for (auto& [port, log] : logs_) {
    if (const auto problem = log.close()) warn(*problem);
  }
  if (!folder.empty()) {
    attempt(kMissing,
            [&] { write_pictures(folder, simulation_.layers(), recorder_->scene(simulation_)); });
  }
  attempt("the recording is not complete: ", [&] { recorder_->close_film(); });
}

void Host::Core::keep_results(WallClock::time_point now) {
  if (settings_.output_folder.empty()) return;
  if (kept_) {
    const TimeStatistics time = time_locked();
    kept_->keep_step(time, *recorder_, simulation_);
    if (now - last_looks_ >= kLooksPeriod) {
      last_looks_ = now;
      kept_->keep_looks(report_text(simulation_, time, RunEnd{}), simulation_);
    }
  }
  keep_report(now);
}

void Host::Core::keep_report(WallClock::time_point now) {
  if (!last_kept_) last_kept_ = now;
  if (now - *last_kept_ < kKeepingPeriod) return;
  last_kept_ = now;
  try {
    const FileLimitErrors limit_errors;
    write_report(
        settings_.output_folder,
        signed_report(report_text(simulation_, time_locked(), RunEnd{}), settings_.grading));
  } catch (const std::exception& e) {
    if (!std::exchange(keeping_told_, true)) {
      warn(std::string("results of the run cannot be written at present: ") + e.what());
    }
  }
}

RunEnd Host::Core::reason_of_end() const {
  if (simulation_.finished()) return {.by = RunEnd::By::kDuration};
  const int request = end_request_ != 0 ? end_request_ : settings_.quiet_end ? interrupted() : 0;
  if (request != 0) return {.by = RunEnd::By::kRequest, .signal = request};
  if (window_closed_) return {.by = RunEnd::By::kWindow};
  return {.by = RunEnd::By::kProgram, .status = program_status_};
}

void Host::Core::set_phase(KeptRun::Phase phase) noexcept {
  if (kept_) kept_->set_phase(phase);
}

std::vector<std::string> Host::Core::unrepeatable() const {
  std::vector<std::string> why;
  if (turns_) why = Turns::instance().unrepeatable();
  if (paced_) why.emplace_back("simulated time followed the wall clock");
  if (silence_noted_) {
    why.emplace_back("simulated time went on without a client that did not read for " +
                     std::to_string(settings_.silence_limit_s) + " s of wall time");
  }
  if (driven_by_hand_) why.emplace_back("a robot was driven by hand");
  if (!paced_ && several_owners_ && (!turns_ || !Turns::instance().active())) {
    why.emplace_back(
        "the program has several threads or there were several programs, and time was "
        "not virtual: what they do side by side is chance");
  }
  return why;
}

void Host::Core::show_progress(bool last) {
  const auto now = WallClock::now();
  if (!last && now - last_progress_ < std::chrono::milliseconds(100)) return;
  if (last && !progress_shown_) return;
  if (isatty(STDERR_FILENO) == 0) return;
  last_progress_ = now;
  progress_shown_ = true;
  const TimeStatistics t = time_locked();
  const double sim_s = sim::to_seconds(t.sim_time_ns);
  if (t.duration_s) {
    constexpr int kCells = 30;
    const double share = std::min(1.0, sim_s / *t.duration_s);
    const int full = static_cast<int>(share * kCells);
    const double left_s =
        t.real_time_factor > 0.0 ? (*t.duration_s - sim_s) / t.real_time_factor : 0.0;
    std::fprintf(stderr, "\r[%.*s%.*s] %7s / %s s simulated, %s x real time, %s s left ", full,
                 "##############################", kCells - full, "..............................",
                 sim::fixed_text(sim_s, 1).c_str(), sim::fixed_text(*t.duration_s, 0).c_str(),
                 sim::fixed_text(t.real_time_factor, 0).c_str(),
                 sim::fixed_text(std::ceil(std::max(0.0, left_s)), 0).c_str());
  } else {
    std::fprintf(stderr, "\r%9s s simulated, %s x real time ", sim::fixed_text(sim_s, 1).c_str(),
                 sim::fixed_text(t.real_time_factor, 0).c_str());
  }
  if (last) std::fputc('\n', stderr);
  std::fflush(stderr);
}

TimeStatistics Host::Core::time_locked() const {
  TimeStatistics t;
  const sim::SimulationDescription& s = simulation_.world().simulation;
  t.sim_time_ns = simulation_.now_ns();
  t.steps = simulation_.steps();
  t.step_s = sim::to_seconds(s.step_ns);
  if (s.duration_ns) t.duration_s = sim::to_seconds(*s.duration_ns);
  t.mode = paced_ ? sim::TimeMode::kPaced : sim::TimeMode::kLockstep;
  t.finished = ended_ || simulation_.finished();
  t.unrepeatable = unrepeatable();
  if (first_step_) {
    t.wall_time_s = seconds((ended_ ? *last_step_ : WallClock::now()) - *first_step_);
    if (t.wall_time_s > 0.0) t.real_time_factor = sim::to_seconds(t.sim_time_ns) / t.wall_time_s;
  }
  return t;
}

TimeStatistics Host::Core::time() const {
  const Lock lock = lock_soon();
  return time_locked();
}

bool Host::Core::is_sensor(DeviceId device) const {
  const Lock lock = lock_soon();
  return dynamic_cast<const sim::Sensor*>(&simulation_.device(device.robot, device.device)) !=
         nullptr;
}

bool Host::Core::finished() const {
  const Lock lock = lock_soon();
  return over();
}

sim::RobotStatistics Host::Core::statistics(int robot) const {
  const Lock lock = lock_soon();
  return simulation_.statistics(robot);
}

std::uint64_t Host::Core::state_hash() const {
  const Lock lock = lock_soon();
  return simulation_.state_hash();
}

void Host::Core::warn(const std::string& text) const {
  if (log_) log_(sim::LogLevel::kWarning, text);
}

// --- The window
// ---------------------------------------------------------------------------------------

void Host::Core::start_viewer_if_needed() {
  if (!settings_.view_socket) return;
  hand_.emplace(robots_);
  viewer_ = std::make_unique<ViewerLink>(*settings_.view_socket, static_cast<ViewedRun&>(*this));
}

void Host::Core::stop_viewer() {
  std::unique_ptr<ViewerLink> viewer;
  {
    const Lock lock = lock_soon();
    viewer = std::move(viewer_);
  }
}

ViewScene Host::Core::view_scene() {
  const Lock lock = lock_soon();
  ViewScene view;
  view.scene = recorder_->scene(simulation_);
  view.finished = over();
  view.paused = paused_;
  if (hand_->chosen() >= 0) {
    const auto index = static_cast<std::size_t>(hand_->chosen());
    const sim::Colour colour = robots_[index].colour;
    view.scene.robots[index].marked = true;
    view.robot_colour = static_cast<std::uint32_t>(colour.r) << 16U |
                        static_cast<std::uint32_t>(colour.g) << 8U | colour.b;
    view.status = robots_[index].name + (hand_->active() ? " by hand    " : "    ");
  }
  view.status += "t " + sim::fixed_text(sim::to_seconds(simulation_.now_ns()), 1) + " s    ";
  view.status += (paced_ ? factor_text(time_factor_) : "lockstep") + "    ";
  view.status += sim::to_string(simulation_.view_mode());
  if (paused_) view.status += "    paused";
  if (WallClock::now() < message_end_) view.message = message_;
  if (help_) view.help = view_help();
  return view;
}

std::string Host::Core::on_key(std::uint32_t keysym, bool pressed, bool control) {
  // A key that went down without Ctrl may come up with it.
  const auto action = view_action(keysym, control && pressed);
  if (!action) return "";
  if (*action == ViewAction::kEnd) {
    if (pressed) on_closed();
    return "";
  }
  const Lock lock = lock_soon();
  if (*action <= ViewAction::kRight) {
    hand_->hold(*action, pressed);
    driven_by_hand_ = true;
    if (pressed && paused_) tell("paused: the robot moves when time does (Space)");
    return "";
  }
  if (!pressed) return "";
  if (*action == ViewAction::kSave) return next_picture_file();
  act(*action);
  return "";
}

void Host::Core::act(ViewAction action) {
  switch (action) {
    case ViewAction::kNextMode:
      return change_view_mode(+1);
    case ViewAction::kPreviousMode:
      return change_view_mode(-1);
    case ViewAction::kNextRobot:
      hand_->choose_next(simulation_);
      return;
    case ViewAction::kPause:
      return change_pause();
    case ViewAction::kFaster:
    case ViewAction::kSlower:
      return change_speed(action == ViewAction::kFaster);
    case ViewAction::kHelp:
      help_ = !help_;
      return;
    default:
      return;  // driving, saving and ending are done by on_key
  }
}

void Host::Core::change_view_mode(int by) {
  const auto& modes = sim::kViewModes;
  const auto count = static_cast<int>(modes.size());
  const auto now = std::find(modes.begin(), modes.end(), simulation_.view_mode()) - modes.begin();
  const auto next = static_cast<std::size_t>((static_cast<int>(now) + by + count) % count);
  if (const auto refusal = simulation_.set_view_mode(modes.at(next))) tell(*refusal);
}

void Host::Core::change_speed(bool faster) {
  if (!paced_) return tell("lockstep: time goes as fast as the program");
  const double factor = next_time_factor(time_factor_, faster);
  if (factor == time_factor_) {
    return tell(std::string("no ") + (faster ? "faster" : "slower") + " than " +
                factor_text(factor));
  }
  time_factor_ = factor;
  ++pace_changes_;
  changed_.notify_all();
}

void Host::Core::change_pause() {
  if (!paced_) return tell("lockstep: time cannot be paused");
  paused_ = !paused_;
  ++pace_changes_;
  changed_.notify_all();
}

std::string Host::Core::next_picture_file() {
  if (settings_.output_folder.empty()) {
    tell("no picture: the run has no output folder");
    return "";
  }
  std::array<char, 32> name{};
  std::filesystem::path file;
  std::error_code ignored;  // in a folder that cannot be looked at writing fails, and says why
  do {
    std::snprintf(name.data(), name.size(), "view_%06d.png", ++pictures_);
    file = std::filesystem::path(settings_.output_folder) / name.data();
  } while (std::filesystem::exists(file, ignored));
  return file.string();
}

void Host::Core::on_keys_released() {
  const Lock lock = lock_soon();
  hand_->release_all();
}

void Host::Core::on_saved(const std::string& file, const std::string& problem) {
  const Lock lock = lock_soon();
  tell(problem.empty() ? "saved " + std::filesystem::path(file).filename().string() : problem);
}

void Host::Core::on_closed() {
  {
    const Lock lock = lock_soon();
    window_closed_ = true;
  }
  finish();
}

void Host::Core::on_lost(const std::string& reason) {
  const Lock lock = lock_soon();
  hand_->release_all();
  if (paused_) change_pause();
  if (!over()) warn("there is no window any more (" + reason + "); the run goes on without it");
}

void Host::Core::tell(const std::string& text) {
  message_ = text;
  message_end_ = WallClock::now() + std::chrono::seconds(4);
}

// --- Host
// -----------------------------------------------------------------------------------------

Host::Host(std::unique_ptr<Core> core) : core_(std::move(core)) {}
Host::~Host() = default;

std::shared_ptr<Host> Host::create(sim::WorldDescription world, RunSettings settings,
                                   sim::LogHook log) {
  const virtual_time::Inside inside;
  auto core = std::make_unique<Core>(std::move(world), std::move(settings), std::move(log));
  core->start_viewer_if_needed();
  core->start_pacer_if_needed();
  return std::shared_ptr<Host>(new Host(std::move(core)));
}

void Host::require_port(int port) const {
  const auto& robots = core_->robots();
  if (!is_open(robots, port)) {
    std::string ports = std::to_string(kMorsePort) + " (all robots)";
    for (const RobotInfo& robot : robots) {
      ports += ", " + std::to_string(robot.port) + " (" + robot.name + ')';
    }
    throw SessionError(
        SessionError::Code::kNoSuchDevice,
        "no robot of this world has port " + std::to_string(port) + "; ports it has: " + ports);
  }
}

std::unique_ptr<Session> Host::connect(int port) {
  require_port(port);
  return std::make_unique<InProcessSession>(shared_from_this(), core_->add_client(port));
}

std::unique_ptr<EventClient> Host::connect_events(int port, std::function<void()> notify,
                                                  bool follower) {
  require_port(port);
  auto client = core_->add_client(port, follower, std::move(notify));
  client->served = true;
  return std::make_unique<EventClient>(shared_from_this(), std::move(client));
}

bool Host::advance(std::chrono::microseconds slice) { return core_->advance_for(slice); }
void Host::check_silence() { core_->check_silence(); }
void Host::watch_program() { core_->watch_program(); }
void Host::note_program_ends(int status) { InsideCore(*core_)->note_program_ends(status); }
void Host::note_end_request(int signal) { core_->note_end_request(signal); }
void Host::thinker_ended(ThinkerId thinker) noexcept { InsideCore(*core_)->thinker_ended(thinker); }
AlarmId Host::set_alarm(Alarm alarm) { return core_->set_alarm(std::move(alarm)); }
bool Host::cancel_alarm(AlarmId alarm) { return core_->cancel_alarm(alarm); }
void Host::with_simulation(const std::function<void(sim::Simulation&)>& action) {
  core_->with_simulation(action);
}
void Host::set_step_credit(std::optional<std::uint64_t> steps) { core_->set_step_credit(steps); }
void Host::add_step_credit(std::uint64_t steps) { core_->add_step_credit(steps); }
std::optional<std::string> Host::set_time_factor(double factor) {
  return core_->set_time_factor(factor);
}
const std::vector<RobotInfo>& Host::robots() const noexcept { return core_->robots(); }
bool Host::own_sensors_only() const noexcept { return core_->own_sensors_only(); }

void Host::finish() noexcept {
  InsideCore(*core_)->finish();
  InsideCore(*core_)->stop_viewer();
  InsideCore(*core_)->stop_pacer();
}

bool Host::finished() const { return InsideCore(*core_)->finished(); }
TimeStatistics Host::time() const { return InsideCore(*core_)->time(); }
sim::RobotStatistics Host::statistics(int robot) const {
  return InsideCore(*core_)->statistics(robot);
}
std::shared_ptr<TurnClock> Host::clock() { return {shared_from_this(), &core_->clock()}; }
std::uint64_t Host::state_hash() const { return InsideCore(*core_)->state_hash(); }

}  // namespace playerlike
