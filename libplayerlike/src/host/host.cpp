// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/host.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <utility>

#include "host/core.h"
#include "host/end_of_program.h"
#include "host/outputs.h"
#include "session/in_process_session.h"

namespace playerlike {
namespace {

constexpr std::size_t kQueueLimit = 1000;
// A client may draw and command this much ahead of the next step before it is carried out, so that
// one that never reads does not fill memory.
constexpr std::size_t kDrawingLimit = 1 << 16;
constexpr std::size_t kCommandLimit = 1 << 12;
constexpr sim::SimTime kEmptyRound_ns = sim::kNanosecondsPerSecond / 10;
// A program that ignores the end of the run this often is ended.
constexpr int kReadsAfterEnd = 1000;

double seconds(WallClock::duration d) { return std::chrono::duration<double>(d).count(); }

WallClock::duration wall(double seconds) {
  return std::chrono::duration_cast<WallClock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

// --- Construction
// ---------------------------------------------------------------------------------

Host::Core::Core(sim::WorldDescription world, RunSettings settings, sim::LogHook log)
    : settings_(std::move(settings)),
      log_(std::move(log)),
      simulation_((settings_.apply_to(world), std::move(world)), log_),
      robots_(describe_robots(simulation_)) {
  const sim::CanvasDescription& canvas = simulation_.world().canvas;
  canvas_info_ = {canvas.width, canvas.height, canvas.cell_size_m, canvas.origin.x(),
                  canvas.origin.y()};
  std::string trajectory;
  if (!settings_.output_folder.empty()) {
    const std::filesystem::path folder(settings_.output_folder);
    std::filesystem::create_directories(folder);
    trajectory = (folder / "trajectory.csv").string();
  }
  recorder_ = std::make_unique<Recorder>(trajectory, settings_.film, simulation_);
  mode_chosen_ = simulation_.world().simulation.time_mode_given;
  if (settings_.quiet_end) note_interrupts();
}

Host::Core::~Core() {
  finish();
  stop_pacer();
}

void Host::Core::start_pacer_if_needed() {
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

std::shared_ptr<Client> Host::Core::add_client(int port) {
  const Lock lock = lock_soon();
  auto client = std::make_shared<Client>();
  client->number = next_number_++;
  client->port = port;
  client->empty_round_ns = simulation_.now_ns() + kEmptyRound_ns;
  touch(*client);
  clients_.push_back(client);
  changed_.notify_all();  // a paced clock may wait for its first client
  return client;
}

void Host::Core::remove_client(Client& client) noexcept {
  const Lock lock = lock_soon();
  if (client.closed.exchange(true)) return;
  // What it asked for last still happens.
  if (!ended_) apply_inputs(client);
  client.subscriptions.clear();
  std::erase_if(clients_, [&](const auto& c) { return c.get() == &client; });
  changed_.notify_all();
}

void Host::Core::thread_ended(std::thread::id thread) noexcept {
  const Lock lock = lock_soon();
  for (const auto& client : clients_) {
    // Its number may be given to a new thread, so it must not stay the owner.
    if (client->owner != thread) continue;
    client->owner = {};
    client->joined = false;
  }
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

void Host::Core::adopt(Client& client) {
  require_open(client);
  touch(client);
  client.owner = std::this_thread::get_id();
  client.joined = true;
  client.silent = false;
}

void Host::Core::subscribe(Client& client, DeviceId device) {
  const Lock lock = lock_soon();
  require_open(client);
  const auto less = [](const Client::Subscription& s, DeviceId id) {
    return std::pair(s.device.robot, s.device.device) < std::pair(id.robot, id.device);
  };
  auto it =
      std::lower_bound(client.subscriptions.begin(), client.subscriptions.end(), device, less);
  if (it == client.subscriptions.end() || !(it->device == device)) {
    it = client.subscriptions.emplace(it);
    it->device = device;
    it->replace = client.replace_by_default;
  }
  ++it->count;
}

void Host::Core::unsubscribe(Client& client, DeviceId device) {
  const Lock lock = lock_soon();
  auto& all = client.subscriptions;
  const auto it =
      std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.device == device; });
  if (it == all.end() || --it->count > 0) return;
  all.erase(it);
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
      s.queue.clear();
      s.fresh = true;
    } else if (!replace && s.fresh) {
      s.fresh = false;
      const auto& sensor =
          dynamic_cast<const sim::Sensor&>(simulation_.device(s.device.robot, s.device.device));
      s.queue.push_back(sensor.reading().clone());
    }
  }
}

std::uint32_t Host::Core::overflow(const Client& client) const {
  const Lock lock = lock_soon();
  return client.overflow;
}

// --- Time
// -----------------------------------------------------------------------------------------

bool Host::Core::over() const { return ended_ || simulation_.finished(); }

bool Host::Core::gate_open() {
  if (gate_opened_) return true;
  const auto joined =
      std::count_if(clients_.begin(), clients_.end(), [](const auto& c) { return c->joined; });
  gate_opened_ = joined >= simulation_.world().simulation.start_gate_clients;
  return gate_opened_;
}

bool Host::Core::thread_waits(std::thread::id thread) const {
  return std::any_of(clients_.begin(), clients_.end(),
                     [&](const auto& c) { return c->waiting && c->owner == thread; });
}

bool Host::Core::all_wait() const {
  return std::all_of(clients_.begin(), clients_.end(), [this](const auto& c) {
    return !c->joined || c->silent || c->waiting || thread_waits(c->owner);
  });
}

bool Host::Core::wait_is_over(const Client& client) const {
  return over() || (client.wants_data && client.has_data) ||
         (client.wake_ns && simulation_.now_ns() >= *client.wake_ns);
}

void Host::Core::wait_until(Lock& lock, Client& client, bool wants_data,
                            std::optional<sim::SimTime> wake_ns) {
  adopt(client);
  client.wants_data = wants_data;
  client.wake_ns = wake_ns;
  while (!wait_is_over(client)) {
    require_open(client);
    client.waiting = true;
    if (paced_) {
      changed_.notify_all();
      changed_.wait(lock);
    } else if (gate_open() && all_wait()) {
      advance();
    } else {
      changed_.notify_all();
      wait_for_others(lock);
    }
  }
  client.waiting = false;
}

// Waits for a change, and no longer than until a client has been silent for too long.
void Host::Core::wait_for_others(Lock& lock) {
  const auto limit = wall(settings_.silence_limit_s);
  auto deadline = WallClock::now() + limit;
  if (gate_opened_) {
    for (const auto& c : clients_) {
      if (!c->joined || c->silent || thread_waits(c->owner)) continue;
      const WallClock::time_point seen{WallClock::duration(c->last_seen.load())};
      deadline = std::min(deadline, seen + limit);
    }
  }
  if (changed_.wait_until(lock, deadline) != std::cv_status::timeout) return;
  if (!gate_opened_) {
    const auto joined =
        std::count_if(clients_.begin(), clients_.end(), [](const auto& c) { return c->joined; });
    warn("the start gate waits for " +
         std::to_string(simulation_.world().simulation.start_gate_clients) + " clients; " +
         std::to_string(joined) + " have joined so far");
    return;
  }
  const auto now = WallClock::now();
  for (const auto& c : clients_) {
    if (!c->joined || c->silent || thread_waits(c->owner)) continue;
    const WallClock::time_point seen{WallClock::duration(c->last_seen.load())};
    if (now - seen < limit) continue;
    c->silent = true;
    warn("client " + std::to_string(c->number + 1) + " (port " + std::to_string(c->port) +
         ") has not called Read() for " + std::to_string(settings_.silence_limit_s) +
         " s of wall time; simulated time goes on without it until it does");
  }
}

void Host::Core::advance() {
  const auto now = WallClock::now();
  if (!first_step_) {
    first_step_ = now;
    last_progress_ = now;
  }
  for (const auto& client : clients_) apply_inputs(*client);
  simulation_.step();
  last_step_ = now;
  recorder_->observe(simulation_);
  distribute();
  if (simulation_.finished()) last_step_ = WallClock::now();
  if (settings_.progress && simulation_.steps() % 64 == 0) show_progress(false);
  if (simulation_.finished() || (settings_.quiet_end && interrupted())) end_run();
  release_waiters();
}

void Host::Core::apply_inputs(Client& client) {
  const std::lock_guard input(client.input_mutex);
  for (const auto& [device, command] : client.commands) {
    if (const auto refusal = simulation_.apply(device, command)) warn(*refusal);
  }
  client.commands.clear();
  flush_drawings(client);
}

void Host::Core::flush_drawings(Client& client) {
  for (const sim::CanvasOperation& operation : client.drawings) {
    operation.draw(simulation_.canvas());
  }
  client.drawings.clear();
}

void Host::Core::distribute() {
  for (const auto& client : clients_) {
    if (client->subscriptions.empty()) {
      if (simulation_.now_ns() >= client->empty_round_ns) client->has_data = true;
      continue;
    }
    for (Client::Subscription& s : client->subscriptions) {
      for (const DeviceId& updated : simulation_.updated()) {
        if (!(updated == s.device)) continue;
        client->has_data = true;
        if (s.replace) {
          s.fresh = true;
          continue;
        }
        if (s.queue.size() == kQueueLimit) {
          s.queue.erase(s.queue.begin());
          ++client->overflow;
        }
        const auto& sensor =
            dynamic_cast<const sim::Sensor&>(simulation_.device(s.device.robot, s.device.device));
        s.queue.push_back(sensor.reading().clone());
      }
    }
  }
}

// A waiting thread that has what it waits for no longer counts as waiting, even before it wakes.
void Host::Core::release_waiters() {
  bool released = false;
  for (const auto& client : clients_) {
    if (!client->waiting || !wait_is_over(*client)) continue;
    client->waiting = false;
    touch(*client);
    released = released || client->owner != std::this_thread::get_id();
  }
  if (released) changed_.notify_all();
}

void Host::Core::wait(Client& client) {
  // Let threads in that only want a quick word, before time goes on.
  while (knocking_.load(std::memory_order_relaxed) > 0) std::this_thread::yield();
  Lock lock(mutex_);
  wait_until(lock, client, /*wants_data=*/true, std::nullopt);
  if (client.has_data) return;
  if (settings_.quiet_end && ++reads_after_end_ > kReadsAfterEnd) {
    lock.unlock();
    end_program_quietly();
  }
  throw SessionError(SessionError::Code::kFinished, "the simulated run is over");
}

int Host::Core::take(Client& client, ReadingSink& sink) {
  const Lock lock(mutex_);
  require_open(client);
  client.looks = 0;
  if (!client.has_data) return 0;
  client.has_data = false;
  client.empty_round_ns = simulation_.now_ns() + kEmptyRound_ns;
  int count = 0;
  for (Client::Subscription& s : client.subscriptions) {
    if (s.fresh) {
      s.fresh = false;
      const auto& sensor =
          static_cast<const sim::Sensor&>(simulation_.device(s.device.robot, s.device.device));
      sink.on_reading(s.device, sensor.reading());
      ++count;
    }
    for (const auto& reading : s.queue) sink.on_reading(s.device, *reading);
    count += static_cast<int>(s.queue.size());
    s.queue.clear();
  }
  return count;
}

bool Host::Core::peek(Client& client, std::chrono::milliseconds timeout) {
  while (knocking_.load(std::memory_order_relaxed) > 0) std::this_thread::yield();
  Lock lock(mutex_);
  require_open(client);
  if (client.has_data || over()) return true;
  if (paced_) {
    adopt(client);
    client.wants_data = true;
    client.wake_ns.reset();
    client.waiting = true;
    changed_.wait_for(lock, timeout,
                      [&] { return client.has_data || over() || client.closed.load(); });
    client.waiting = false;
    return client.has_data || over();
  }
  if (timeout.count() == 0 && ++client.looks < 2) return false;
  const sim::SimTime step_ns = simulation_.world().simulation.step_ns;
  const sim::SimTime span_ns =
      std::max<sim::SimTime>(step_ns, std::chrono::nanoseconds(timeout).count());
  wait_until(lock, client, /*wants_data=*/true, simulation_.now_ns() + span_ns);
  return client.has_data || over();
}

void Host::Core::sleep(Client& client, double duration_s) {
  if (!(duration_s >= 0.0 && duration_s <= 1e9)) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "sleep takes a number of seconds in [0, 1e9]");
  }
  Lock lock(mutex_);
  const sim::SimTime wake_ns = simulation_.now_ns() + sim::from_seconds(duration_s);
  wait_until(lock, client, /*wants_data=*/false, wake_ns);
}

// --- Inputs
// ---------------------------------------------------------------------------------------

void Host::Core::send(Client& client, DeviceId device, const sim::Command& command) {
  require_open(client);
  touch(client);
  {
    const std::lock_guard input(client.input_mutex);
    // Of commands in a row of the same kind to the same device only the last counts.
    if (!client.commands.empty() && client.commands.back().first == device &&
        client.commands.back().second.index() == command.index()) {
      client.commands.back().second = command;
      return;
    }
    client.commands.emplace_back(device, command);
    if (client.commands.size() <= kCommandLimit) return;
  }
  const Lock lock = lock_soon();
  apply_inputs(client);
}

void Host::Core::draw(Client& client, std::span<const sim::CanvasOperation> operations) {
  require_open(client);
  bool full = false;
  {
    const std::lock_guard input(client.input_mutex);
    client.drawings.insert(client.drawings.end(), operations.begin(), operations.end());
    full = client.drawings.size() > kDrawingLimit;
  }
  if (!full) return;
  const Lock lock = lock_soon();
  const std::lock_guard input(client.input_mutex);
  flush_drawings(client);
}

std::optional<sim::Colour> Host::Core::pixel(Client& client, int column, int row) {
  const Lock lock = lock_soon();
  require_open(client);
  const std::lock_guard input(client.input_mutex);
  flush_drawings(client);
  return simulation_.canvas().pixel(column, row);
}

std::vector<std::uint8_t> Host::Core::canvas_image(Client& client) {
  const Lock lock = lock_soon();
  require_open(client);
  const std::lock_guard input(client.input_mutex);
  flush_drawings(client);
  return simulation_.canvas().data();
}

// --- Pacing
// ---------------------------------------------------------------------------------------

void Host::Core::prefer_real_time(const std::string& reason) {
  const Lock lock = lock_soon();
  if (mode_chosen_ || ended_ || paced_) return;
  paced_ = true;
  warn(reason +
       ": simulated time now follows the wall clock (PLAYPEN_TIME=lockstep, or a time "
       "mode in the world file's \"simulation\", decides otherwise)");
  pacer_ = std::thread([this] { pace(); });
  changed_.notify_all();
}

void Host::Core::pace() {
  Lock lock(mutex_);
  const double factor = simulation_.world().simulation.time_factor;
  const double step_s = sim::to_seconds(simulation_.world().simulation.step_ns);
  const auto gate_clients = simulation_.world().simulation.start_gate_clients;
  changed_.wait(
      lock, [&] { return stop_pacing_ || (gate_clients <= 1 ? !clients_.empty() : gate_open()); });
  auto base = WallClock::now();
  std::uint64_t done = 0;
  while (!stop_pacing_ && !over()) {
    const auto due = base + wall(static_cast<double>(done + 1) * step_s / factor);
    const auto now = WallClock::now();
    if (now < due) {
      changed_.wait_until(lock, due, [&] { return stop_pacing_; });
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
    if (!ended_) {
      for (const auto& client : clients_) apply_inputs(*client);
      end_run();
      release_waiters();
    }
    stop_pacing_ = true;
    changed_.notify_all();
  } catch (const std::exception& e) {
    warn(e.what());
  }
}

void Host::Core::end_run() {
  ended_ = true;
  if (settings_.progress) show_progress(true);
  try {
    write_results();
  } catch (const std::exception& e) {
    warn(std::string("results of the run are missing: ") + e.what());
  }
  if (settings_.quiet_end) end_program_quietly_if_uncaught();
}

void Host::Core::write_results() {
  recorder_->close();
  if (settings_.output_folder.empty()) return;
  write_outputs(settings_.output_folder, simulation_, recorder_->scene(simulation_), time_locked());
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
    std::fprintf(stderr, "\r[%.*s%.*s] %7.1f / %.0f s simulated, %.0f x real time, %.0f s left ",
                 full, "##############################", kCells - full,
                 "..............................", sim_s, *t.duration_s, t.real_time_factor,
                 std::ceil(std::max(0.0, left_s)));
  } else {
    std::fprintf(stderr, "\r%9.1f s simulated, %.0f x real time ", sim_s, t.real_time_factor);
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

std::uint64_t Host::Core::state_hash() const {
  const Lock lock = lock_soon();
  return simulation_.state_hash();
}

void Host::Core::warn(const std::string& text) const {
  if (log_) log_(sim::LogLevel::kWarning, text);
}

// --- Host
// -----------------------------------------------------------------------------------------

Host::Host(std::unique_ptr<Core> core) : core_(std::move(core)) {}
Host::~Host() = default;

std::shared_ptr<Host> Host::create(sim::WorldDescription world, RunSettings settings,
                                   sim::LogHook log) {
  auto core = std::make_unique<Core>(std::move(world), std::move(settings), std::move(log));
  core->start_pacer_if_needed();
  return std::shared_ptr<Host>(new Host(std::move(core)));
}

std::unique_ptr<Session> Host::connect(int port) {
  const auto& robots = core_->robots();
  const bool known =
      port == kMorsePort ||
      std::any_of(robots.begin(), robots.end(), [&](const auto& r) { return r.port == port; });
  if (!known) {
    std::string ports = std::to_string(kMorsePort) + " (all robots)";
    for (const RobotInfo& robot : robots) {
      ports += ", " + std::to_string(robot.port) + " (" + robot.name + ')';
    }
    throw SessionError(
        SessionError::Code::kNoSuchDevice,
        "no robot of this world has port " + std::to_string(port) + "; ports it has: " + ports);
  }
  return std::make_unique<InProcessSession>(shared_from_this(), core_->add_client(port));
}

void Host::thread_ended(std::thread::id thread) noexcept { core_->thread_ended(thread); }

void Host::finish() noexcept {
  core_->finish();
  core_->stop_pacer();
}

bool Host::finished() const { return core_->finished(); }
TimeStatistics Host::time() const { return core_->time(); }
std::uint64_t Host::state_hash() const { return core_->state_hash(); }

}  // namespace playerlike
