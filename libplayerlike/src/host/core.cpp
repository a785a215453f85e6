// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/core.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "host/launch/busy_alarm.h"
#include "host/launch/start_of_run.h"
#include "host/stepping/virtual_clock.h"
#include "host/window/page.h"
#include "host/window/window.h"
#include "process/end_of_program.h"
#include "sim/core/number_text.h"
#include "virtual_time/program_threads.h"

namespace playerlike {
namespace {

// The program is ended after so many reads beyond the end of the run.
constexpr int kReadsAfterEnd = 1000;
// Cells of a canvas whose pictures are written so quickly that nobody has to be served meanwhile.
constexpr std::size_t kQuicklyWritten = std::size_t{1} << 20U;

void require_duration(double sleep_s) {
  if (sleep_s >= 0.0 && sleep_s <= 1e9) return;
  throw SessionError(SessionError::Code::kBadArgument,
                     "sleep takes a number of seconds in [0, 1e9]");
}

}  // namespace

// --- Construction and the mutex

Host::Core::Core(sim::WorldDescription world, RunSettings settings, sim::LogHook log)
    : settings_(std::move(settings)),
      log_(std::move(log)),
      warn_([this](const std::string& text) {
        if (log_) log_(sim::LogLevel::kWarning, text);
      }),
      simulation_(simulation_at_start(std::move(world), settings_, log_)),
      robots_(robots_for(settings_.grading.rules.may_use, describe_robots(simulation_))),
      permissions_(settings_.grading.rules.may_use, robots_),
      step_ns_(simulation_.world().simulation.step_ns),
      turns_(settings_.virtual_time &&
             simulation_.world().simulation.time_mode == sim::TimeMode::kLockstep),
      mutex_(turns_ ? Turns::instance().mutex() : own_mutex_),
      client_files_(settings_.client_files_limit, settings_.all_files_limit),
      mirror_(Mirror::open(simulation_, robots_, settings_.open_real_robot, warn_)),
      clients_(simulation_, robots_, turns_, mirror_.get()),
      lockstep_(clients_, simulation_.world().simulation.start_gate_clients,
                settings_.silence_limit_s, warn_,
                excuses_debuggers() ? Lockstep::IsDebugged(is_debugged) : Lockstep::IsDebugged()),
      pace_(sim::to_seconds(step_ns_), simulation_.world().simulation.time_factor),
      inputs_(simulation_, robots_, warn_, mirror_.get()),
      stalled_time_warning_(robots_.size(), turns_, settings_.silence_limit_s, warn_),
      results_(
          settings_, simulation_, [this] { return time_locked(); }, warn_, inputs_.commands,
          mirror_.get()),
      clock_(std::make_unique<VirtualClock>(*this)),
      mode_chosen_(simulation_.world().simulation.time_mode_given) {
  if (settings_.stop) stop_ns_ = sim::from_seconds(settings_.stop->time_s);
  if (settings_.start) inputs_.registry = settings_.start->layers;
}

Host::Core::~Core() { stop(); }

void Host::Core::start() {
  if (settings_.view_socket || settings_.page_socket) {
    inputs_.hand.emplace(robots_, [this](DeviceId device, const sim::Command& command) {
      static_cast<void>(inputs_.execute(device, command));
    });
  }
  if (settings_.view_socket) window_ = std::make_unique<Window>(*this, *settings_.view_socket);
  if (settings_.page_socket) page_ = std::make_unique<Page>(*this, *settings_.page_socket);
  const Lock lock = lock_with_priority();  // their threads may be running already
  if (window_) pace_.watch_from(sim::from_seconds(settings_.film_from_s));
  if (window_ && settings_.stop && settings_.stop->then == RunStop::Then::kView) {
    pace_.watch_from(sim::from_seconds(settings_.stop->time_s));
  }
  if (simulation_.world().simulation.time_mode != sim::TimeMode::kPaced) return;
  pace_.follow_wall_clock();
  pacer_ = std::thread([this] { pace(); });
}

void Host::Core::stop() noexcept {
  finish();
  if (window_) window_->close();
  page_.reset();
  locked([this] {
    stop_pacing_ = true;
    changed_.notify_all();
  });
  for (std::thread* const thread : {&pacer_, &ender_}) {
    if (thread->joinable() && thread->get_id() != std::this_thread::get_id()) thread->join();
  }
}

Host::Core::Lock Host::Core::lock_with_priority() const {
  priority_waiters_.fetch_add(1);
  Lock lock(mutex_);
  priority_waiters_.fetch_sub(1);
  return lock;
}

Host::Core::Lock Host::Core::lock_for_stepping() const {
  while (priority_waiters_.load(std::memory_order_relaxed) > 0) std::this_thread::yield();
  return Lock(mutex_);
}

void Host::Core::give_way(Lock& lock) const {
  if (priority_waiters_.load(std::memory_order_relaxed) == 0) return;
  lock.unlock();
  std::this_thread::yield();
  lock.lock();
}

// --- Clients

std::shared_ptr<Client> Host::Core::add_client(int port, EventRole role,
                                               std::function<void()> notify,
                                               const CreationOrder& order) {
  const Lock lock = lock_with_priority();
  auto client = clients_.add(port, role, std::move(notify), order);
  had_client_ = had_client_ || !client->onlooker;
  changed_.notify_all();  // a paced clock may wait for its first client
  return client;
}

void Host::Core::remove_client(Client& client, bool abandoned) noexcept {
  const Lock lock = lock_with_priority();
  if (client.closed.exchange(true)) return;
  // Its last commands are still applied.
  if (!ended_) inputs_.apply(client);
  const std::vector<int> left = inputs_.commanders.note_gone(&client);
  client.drawings.close();
  inputs_.registry.leave(client.number);
  if (turns_) Turns::instance().resume_client_thread(&client);
  clients_.remove(client);
  if (!ended_) abandoned ? inputs_.stop_at_next_step(left) : inputs_.stop(left);
  changed_.notify_all();
}

void Host::Core::thread_ended(ThreadId thread_id) noexcept {
  if (turns_ && thread_id == this_thread_id() && virtual_time::process_ends()) return;
  const Lock lock = lock_with_priority();
  lockstep_.forget(thread_id);
  if (turns_) Turns::instance().remove(thread_id);
  changed_.notify_all();
}

void Host::Core::adopt(Client& client, ThreadId thread_id) {
  client.require_open();
  if (client.onlooker) return;
  if (!turns_) client.touch();  // in virtual time, Turns knows when the thread began to run
  lockstep_.adopt(client, thread_id);
}

void Host::Core::join(Client& client, ThreadId thread_id) {
  const Lock lock = lock_with_priority();
  adopt(client, thread_id);
  if (in_turns() && !client.onlooker) static_cast<void>(Turns::instance().self());
  changed_.notify_all();  // the start gate may have waited for it
}

void Host::Core::subscribe(Client& client, DeviceId device) {
  const Lock lock = lock_with_priority();
  client.require_open();
  require_readable(client, device.robot);
  require_permission(permissions_.forbids_device(device));
  clients_.subscribe(client, device);
  inputs_.commanders.note_opened(client, device);
  if (client.is_programs() && stalled_time_warning_.note_needs_time()) set_busy_alarm();
}

void Host::Core::send(Client& client, DeviceId device, const sim::Command& command) {
  client.require_open();
  client.touch();
  if (const auto what = permissions_.forbids_command(device, command)) {
    const Lock lock = lock_with_priority();
    require_permission(what);
  }
  const bool is_programs = client.is_programs();
  if (is_programs && stalled_time_warning_.note_needs_time()) locked([this] { set_busy_alarm(); });
  bool must_check = false;
  bool full = false;
  {
    const std::lock_guard input(client.input_mutex);
    must_check = is_programs && stalled_time_warning_.note_command(client, now_ns());
    full = inputs_.add(client, device, command);
  }
  if (must_check) check_stalled_time(client);
  if (!full) return;
  const Lock lock = lock_with_priority();
  inputs_.apply(client);
}

// --- Waiting

bool Host::Core::program_takes_part() const {
  return pace_.limited() || lockstep_.program_takes_part() || alarms_.let_time_pass();
}

bool Host::Core::may_advance(bool all_known_waiting) {
  return !paced() && !stands_still() && !pace_.step_limit_reached() && lockstep_.gate_open() &&
         program_takes_part() && (all_known_waiting || lockstep_.all_wait());
}

bool Host::Core::is_due(const Client& client) const {
  return (client.wants_data && client.has_data) || !client.lost_robot.empty() ||
         (client.wake_ns && simulation_.now_ns() >= *client.wake_ns) ||
         std::any_of(client.waits_for.begin(), client.waits_for.end(),
                     [](const auto& other) { return other->has_data; });
}

void Host::Core::wait_until(Lock& lock, Client& client, bool wants_data,
                            std::optional<sim::SimTime> wake_ns) {
  adopt(client, this_thread_id());
  client.wants_data = wants_data;
  client.wake_ns = wake_ns;
  if (in_turns() && !client.onlooker) clock_->wait_for_turn(lock, client);
  // While this thread holds the mutex, the set of waiting clients changes only when
  // release_waiters() ends a wait.
  bool all_known_waiting = false;
  while (!wait_is_over(client)) {
    client.require_open();
    // Notified once: otherwise threads would keep waking each other and never sleep.
    const bool began = !std::exchange(client.waiting, true);
    if (paced()) {
      if (began) changed_.notify_all();
      changed_.wait(lock);
    } else if (!client.onlooker && may_advance(all_known_waiting)) {
      if (is_too_early()) {
        wait_for_next_step(lock);
        all_known_waiting = false;
      } else {
        all_known_waiting = !advance(lock);
      }
    } else {
      if (began) changed_.notify_all();
      wait_for_others(lock, client);
      all_known_waiting = false;
    }
  }
  client.waiting = false;
}

// Waits for a change, at most until the silence limit of a client.
void Host::Core::wait_for_others(Lock& lock, const Client& client) {
  // A follower or onlooker waits for programs without a time limit, and all wait for the results.
  if (!client.is_programs() || writing_) return changed_.wait(lock);
  const auto deadline = lockstep_.silence_deadline(WallClock::now());
  if (changed_.wait_until(lock, deadline) == std::cv_status::timeout) {
    lockstep_.note_silence(WallClock::now(), deadline);
  }
}

bool Host::Core::is_too_early() {
  if (!pace_.watched(simulation_.now_ns())) return false;
  if (settings_.quiet_end && interrupted() != 0) return false;  // the step ends the run
  return pace_.is_too_early(simulation_.now_ns(), WallClock::now());
}

void Host::Core::wait_for_next_step(Lock& lock) {
  // A signal that ends the run wakes nobody.
  constexpr std::chrono::milliseconds kLook(50);
  changed_.wait_until(lock, std::min(pace_.due(), WallClock::now() + kLook));
}

void Host::Core::wait(Client& client) {
  Lock lock = lock_for_stepping();
  if (client.lost_robot.empty()) client.lost_robot = clients_.reason_not_to_wait(client);
  wait_until(lock, client, /*wants_data=*/true, std::nullopt);
  tell_of_loss(client);
  if (client.has_data) return;
  end_reported_ = true;
  if (settings_.quiet_end && ++reads_after_end_ > kReadsAfterEnd) {
    lock.unlock();
    end_program_quietly();
  }
  throw SessionError(SessionError::Code::kFinished, "the simulated run is over");
}

void Host::Core::tell_of_loss(Client& client) {
  if (client.lost_robot.empty() || over()) return;
  throw SessionError(SessionError::Code::kDisconnected, std::exchange(client.lost_robot, {}));
}

int Host::Core::take(Client& client, ReadingSink& sink) {
  std::vector<std::pair<DeviceId, sim::SharedReading>> taken;
  {
    const Lock lock(mutex_);
    client.require_open();
    taken = clients_.take(client);
    results_.note_read(client, taken);
  }
  for (const auto& [device, reading] : taken) sink.on_reading(device, reading);
  return static_cast<int>(taken.size());
}

bool Host::Core::peek(Client& client, std::chrono::milliseconds timeout) {
  Lock lock = lock_for_stepping();
  client.require_open();
  if (client.has_data || over() || !client.lost_robot.empty()) return true;
  if (paced()) {
    adopt(client, this_thread_id());
    client.wants_data = true;
    client.wake_ns.reset();
    client.waiting = true;
    changed_.wait_for(lock, timeout, [&] {
      return client.has_data || over() || client.closed.load() || !client.lost_robot.empty();
    });
    client.waiting = false;
    return client.has_data || over() || !client.lost_robot.empty();
  }
  if (timeout.count() == 0 && ++client.zero_peeks < 2) return false;
  wait_until(lock, client, /*wants_data=*/true, end_of_peek(timeout));
  return client.has_data || over();
}

sim::SimTime Host::Core::end_of_peek(std::chrono::milliseconds timeout) const {
  return simulation_.now_ns() +
         std::max<sim::SimTime>(step_ns_, std::chrono::nanoseconds(timeout).count());
}

void Host::Core::sleep(Client& client, double duration_s) {
  require_duration(duration_s);
  Lock lock(mutex_);
  const sim::SimTime wake_ns = simulation_.now_ns() + sim::from_seconds(duration_s);
  wait_until(lock, client, /*wants_data=*/false, wake_ns);
}

// --- Event clients

EventClient::Outcome Host::Core::begin(Client& client, ThreadId thread_id, bool wants_data,
                                       std::optional<sim::SimTime> wake_ns) {
  adopt(client, thread_id);
  client.takes_turns = false;
  client.waits_for.clear();
  return begin_adopted(client, wants_data, wake_ns);
}

EventClient::Outcome Host::Core::begin_adopted(Client& client, bool wants_data,
                                               std::optional<sim::SimTime> wake_ns) {
  client.wants_data = wants_data;
  client.wake_ns = wake_ns;
  client.lost_robot = wants_data ? clients_.reason_not_to_wait(client) : "";
  client.waiting = !wait_is_over(client);
  if (client.waiting) changed_.notify_all();
  return outcome(client);
}

EventClient::Outcome Host::Core::begin_wait(Client& client, ThreadId thread_id) {
  const Lock lock = lock_with_priority();
  return begin(client, thread_id, /*wants_data=*/true, std::nullopt);
}

EventClient::Outcome Host::Core::begin_peek(Client& client, ThreadId thread_id,
                                            std::chrono::milliseconds timeout) {
  const Lock lock = lock_with_priority();
  client.require_open();
  client.wants_data = true;
  client.wake_ns = simulation_.now_ns();  // over at once, unless it is set below
  if (client.has_data || over()) return outcome(client);
  if (paced()) {
    if (timeout.count() == 0) {
      adopt(client, thread_id);
      return outcome(client);
    }
    return begin(client, thread_id, /*wants_data=*/true, std::nullopt);
  }
  if (timeout.count() == 0 && ++client.zero_peeks < 2) return outcome(client);
  return begin(client, thread_id, /*wants_data=*/true, end_of_peek(timeout));
}

EventClient::Outcome Host::Core::begin_sleep(Client& client, ThreadId thread_id, double seconds) {
  require_duration(seconds);
  const Lock lock = lock_with_priority();
  return begin(client, thread_id, /*wants_data=*/false,
               simulation_.now_ns() + sim::from_seconds(seconds));
}

EventClient::Outcome Host::Core::outcome(const Client& client) const {
  using Outcome = EventClient::Outcome;
  if (client.waiting) return Outcome::kWaiting;
  if (client.wants_data && client.has_data) return Outcome::kData;
  if (client.wants_data && !client.lost_robot.empty()) return Outcome::kFinished;
  if (client.wake_ns && simulation_.now_ns() >= *client.wake_ns && !over()) return Outcome::kTime;
  if (client.wants_data || client.wake_ns) return over() ? Outcome::kFinished : Outcome::kIdle;
  return Outcome::kIdle;
}

EventClient::Outcome Host::Core::outcome_of(const Client& client) const {
  const Lock lock = lock_with_priority();
  return outcome(client);
}

void Host::Core::cancel_wait(Client& client) {
  const Lock lock = lock_with_priority();
  client.waiting = false;
  client.wants_data = false;
  client.wake_ns.reset();
  client.waits_for.clear();
  client.touch();
}

bool Host::Core::advance_for(std::chrono::microseconds slice) {
  Lock lock = lock_with_priority();
  if (in_turns() || !may_advance()) return false;
  ends_elsewhere_ = true;  // the caller has other clients to answer
  const auto end = WallClock::now() + slice;
  do {
    // The server asks again ten times a second.
    if (is_too_early()) return false;
    advance(lock);
    if (!may_advance()) return false;
    // Another thread waits in lock_with_priority().
    if (priority_waiters_.load(std::memory_order_relaxed) > 0) return true;
  } while (WallClock::now() < end);
  return true;
}

AlarmId Host::Core::set_alarm(Alarm alarm) {
  const Lock lock = lock_with_priority();
  const AlarmId number = alarms_.set(std::move(alarm));
  alarms_.ring(simulation_, over());
  changed_.notify_all();  // lockstep time may advance for it
  return number;
}

// --- Steps

ThreadId Host::Core::blackboard_thread(const Client& client) const {
  if (paced() || in_turns() || !lockstep_.several_owners()) return 0;
  return client.joined && !client.silent ? client.owner : 0;
}

void Host::Core::publish_blackboard() {
  if (!blackboard_.has_waiting_changes()) return;
  std::vector<ThreadId> order;
  for (const auto& client : clients_) order.push_back(client->owner);
  blackboard_.publish(order);
}

bool Host::Core::advance(Lock& lock) {
  const auto now = WallClock::now();
  if (progress_.note_step(now)) stalled_time_warning_.note_first_step(!paced());
  if (tells_of_endless_run_) tell_of_endless_run(now);
  if (mirror_) mirror_->before_step();
  inputs_.before_step(clients_);
  stop_unwatched(now);
  publish_blackboard();
  simulation_.step();
  if (mirror_) note_losses();
  now_ns_.store(simulation_.now_ns(), std::memory_order_release);
  if (watches_program_) note_step_for_alarm(simulation_.now_ns());
  pace_.count_step();
  if (step_watch_) step_watch_(simulation_);
  results_.observe();
  clients_.distribute(results_.logs);
  const bool finished = simulation_.finished();
  if (finished) progress_.note_end();
  if (settings_.progress && simulation_.steps() % 64 == 0) progress_.show(time_locked(), false);
  if (finished || results_.real_robot_lost || (settings_.quiet_end && interrupted() != 0)) {
    if (ends_elsewhere_ && simulation_.layers().cell_count() > kQuicklyWritten) {
      end_run_elsewhere();
    } else {
      end_run(lock);
    }
  } else {
    results_.keep(now);
    if (stop_ns_ && now_ns() >= *stop_ns_) make_stop();
  }
  return release_waiters();
}

void Host::Core::note_losses() {
  for (const Mirror::Loss& loss : mirror_->after_step()) {
    warn_(loss.text + (loss.ends_run     ? "; the run ends"
                       : loss.is_passing ? "; the mirror reconnects as soon as possible"
                                         : "; the run continues without it"));
    if (loss.ends_run) results_.real_robot_lost = true;
    if (!loss.is_passing) clients_.note_loss(loss);
  }
}

// A thread whose wait is over no longer counts as waiting, even before it wakes up.
bool Host::Core::release_waiters() {
  // Clients of threads that take turns do not count as waiting, but event clients do.
  const bool turns = in_turns();
  if (turns) clock_->make_ready();
  bool anybody = turns;
  bool released = false;
  const bool all = over();
  for (const auto& client : clients_) {
    if (!client->waiting || !(all || is_due(*client))) continue;
    client->waiting = false;
    anybody = true;
    client->touch();
    if (client->notify) {
      client->notify();
    } else {
      released = released || client->owner != this_thread_id();
    }
  }
  if (released) changed_.notify_all();
  alarms_.ring(simulation_, all);
  return anybody;
}

// --- Pacing

std::optional<std::string> Host::Core::set_time_factor(double factor) {
  const Lock lock = lock_with_priority();
  if (mirror_) return "the speed cannot be changed: a robot mirrors a real one";
  if (!paced()) {
    return "the speed cannot be changed in lockstep: time advances when all clients wait";
  }
  if (!(factor > 0.0 && std::isfinite(factor))) {
    return "expected a factor greater than 0, found " + sim::rounded_text(factor, 6);
  }
  pace_.set_factor(factor);
  changed_.notify_all();
  return std::nullopt;
}

void Host::Core::change_step_limit(const std::function<void(Pace&)>& change) {
  const Lock lock = lock_with_priority();
  change(pace_);
  changed_.notify_all();
}

void Host::Core::prefer_real_time(const std::string& reason) {
  const Lock lock = lock_with_priority();
  if (in_turns()) {
    // The caller's sleeps are part of the lockstep from now on.
    Turns::instance().self().starts_background = true;
    virtual_time::note_background();
    return;
  }
  if (mode_chosen_ || ended_ || paced()) return;
  start_pacing(reason +
               ": simulated time now follows the wall clock (under `playpen run` the program's "
               "sleeps move simulated time instead; PLAYPEN_TIME=lockstep, or a time mode in the "
               "world file's \"simulation\", decides otherwise)");
}

void Host::Core::start_pacing(const std::string& warning) {
  pace_.follow_wall_clock();
  stalled_time_warning_.dismiss_alarm();
  if (turns_) virtual_time::give_up_locked();
  warn_(warning);
  pacer_ = std::thread([this] { pace(); });
  changed_.notify_all();
}

void Host::Core::pace() {
  const virtual_time::Inside inside;
  Lock lock(mutex_);
  const bool gated = simulation_.world().simulation.start_gate_clients > 1;
  changed_.wait(lock, [&] {
    if (stop_pacing_) return true;
    return gated ? lockstep_.gate_open() : settings_.start_at_once || clients_.any_but_onlookers();
  });
  pace_.begin_at(WallClock::now());
  while (!stop_pacing_ && !stands_still()) {
    if (pace_.paused()) {
      wait_while_paused(lock);
      pace_.begin_at(WallClock::now());
      continue;
    }
    if (pace_.step_limit_reached()) {
      changed_.wait(lock, [this] {
        return !pace_.step_limit_reached() || pace_.paused() || stop_pacing_ || stands_still();
      });
      // The client that synchronises the clock may be slow.
      pace_.skip_lost_time(WallClock::now());
      continue;
    }
    const auto due = pace_.due();
    const auto now = WallClock::now();
    if (now < due) {
      const int changes = pace_.changes();
      changed_.wait_until(lock, due, [&] { return stop_pacing_ || changes != pace_.changes(); });
      continue;
    }
    pace_.begin_step(now);
    advance(lock);
    give_way(lock);
  }
}

void Host::Core::wait_while_paused(Lock& lock) {
  if (mirror_) mirror_->halt();
  while (pace_.paused() && !stop_pacing_ && !stands_still()) {
    changed_.wait_for(lock, std::chrono::milliseconds(50));
    // No step follows that would notice the signal.
    if (settings_.quiet_end && interrupted() != 0 && !ended_) {
      end_run(lock);
      release_waiters();
    }
  }
}

// --- End of the run

void Host::Core::finish() noexcept {
  try {
    Lock lock = lock_with_priority();
    stalled_time_warning_.dismiss_alarm();
    ended_by_program_ = true;
    if (!ended_) {
      for (const auto& client : clients_) inputs_.apply(*client);
      end_run(lock);
      release_waiters();
      if (in_turns()) Turns::instance().schedule_next();
    }
    changed_.wait(lock, [this] { return !writing_; });
    stop_pacing_ = true;
    changed_.notify_all();
    lock.unlock();
    if (page_) page_->end();
  } catch (const std::exception& e) {
    warn_(e.what());
  }
}

void Host::Core::end_run(Lock& lock) {
  ended_ = writing_ = true;
  write_results(lock);
}

void Host::Core::end_run_elsewhere() {
  ended_ = writing_ = true;
  ender_ = std::thread([this] {
    const virtual_time::Inside inside;
    Lock lock = lock_with_priority();
    write_results(lock);
    release_waiters();
  });
}

// While threads take turns, nobody else uses the simulation, and the mutex belongs to the turns.
void Host::Core::write_results(Lock& lock) {
  const bool may_unlock = !in_turns();
  try {
    if (mirror_) mirror_->stop();
    results_.begin_end();
    // Threads outside of the lockstep may have drawn since the last step.
    for (const auto& client : clients_) inputs_.apply_drawings(*client);
    if (settings_.progress) progress_.show(time_locked(), true);
    std::optional<sim::LayerStack> layers;
    if (!settings_.output_folder.empty()) {
      sim::LayerCopy copy;
      copy_layers(lock, copy, may_unlock);
      layers = copy.take();
    }
    const std::function<void()> write = results_.prepare(std::move(layers));
    if (may_unlock) lock.unlock();
    write();
  } catch (const std::exception& e) {
    warn_(std::string("results of the run are missing: ") + e.what());
  }
  if (!lock.owns_lock()) lock = lock_with_priority();
  writing_ = false;
  changed_.notify_all();
  if (settings_.quiet_end) end_program_quietly_if_uncaught();
}

TimeStatistics Host::Core::time_locked() const {
  TimeStatistics t;
  const sim::SimulationDescription& s = simulation_.world().simulation;
  t.sim_time_ns = simulation_.now_ns();
  t.steps = simulation_.steps();
  t.step_s = sim::to_seconds(s.step_ns);
  if (s.duration_ns) t.duration_s = sim::to_seconds(*s.duration_ns);
  t.mode = paced() ? sim::TimeMode::kPaced : sim::TimeMode::kLockstep;
  t.finished = over();
  t.unrepeatable = unrepeatable();
  progress_.add_times(t, ended_);
  return t;
}

}  // namespace playerlike
