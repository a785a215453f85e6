// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/host.h"

#include <utility>

#include "host/core.h"
#include "host/in_process_session.h"
#include "host/stepping/virtual_clock.h"
#include "virtual_time/program_threads.h"

namespace playerlike {

Host::Host(std::unique_ptr<Core> core) : core_(std::move(core)) {}
Host::~Host() = default;

std::shared_ptr<Host> Host::create(sim::WorldDescription world, RunSettings settings,
                                   sim::LogHook log) {
  const virtual_time::Inside inside;
  auto core = std::make_unique<Core>(std::move(world), std::move(settings), std::move(log));
  core->start();
  return std::shared_ptr<Host>(new Host(std::move(core)));
}

void Host::require_port(int port) const {
  const auto& robots = core_->robots();
  if (!is_open(robots, port)) {
    std::string ports = std::to_string(kMorsePort) + " (all robots)";
    for (const RobotInfo& robot : robots) {
      ports += ", " + std::to_string(robot.port) + " (" + robot.name + ')';
    }
    throw SessionError(SessionError::Code::kNoSuchDevice,
                       "no robot of this world has port " + std::to_string(port) +
                           "; ports it has: " + ports + "; `playpen run --port " +
                           std::to_string(port) + "` gives the first robot this port");
  }
}

std::unique_ptr<Session> Host::connect(int port) {
  require_port(port);
  return std::make_unique<InProcessSession>(shared_from_this(), core_->add_client(port));
}

std::unique_ptr<EventClient> Host::connect_events(int port, std::function<void()> notify,
                                                  EventRole role, const CreationOrder& order) {
  require_port(port);
  auto client = core_->add_client(port, role, std::move(notify), order);
  client->served = true;
  return std::make_unique<EventClient>(shared_from_this(), std::move(client));
}

bool Host::is_abandoned() const {
  return InsideCore(*core_)->locked([this] { return core_->is_abandoned(); });
}

bool Host::advance(std::chrono::microseconds slice) { return core_->advance_for(slice); }
void Host::check_silence() { core_->check_silence(); }
void Host::watch_program() {
  core_->locked([this] { core_->watch_program(); });
}
void Host::note_program_ends(int status) { InsideCore(*core_)->note_program_ends(status); }
void Host::note_end_request(int signal) noexcept { core_->results_.note_end_request(signal); }
bool Host::take_over_results() noexcept { return core_->results_.take_over(); }
void Host::note_onlooker_acts() noexcept { core_->onlooker_acted_ = true; }
std::vector<std::string> Host::Core::unrepeatable() const {
  std::vector<std::string> why = told_unrepeatable_;
  if (turns_) why = Turns::instance().unrepeatable();
  if (paced()) why.emplace_back("simulated time followed the wall clock");
  if (lockstep_.silence_noted()) {
    why.emplace_back("simulated time advanced without a client that did not call Read() for " +
                     std::to_string(settings_.silence_limit_s) + " s of wall time");
  }
  if (inputs_.commanders.has_stopped()) why.emplace_back("a watchdog has stopped a robot");
  if (results_.conflict_noted()) why.emplace_back(kConflictWhy);
  if (driven_by_hand_) why.emplace_back("a robot was driven by hand");
  if (acted_on_page_) why.emplace_back("somebody moved things on the live page");
  if (onlooker_acted_) {
    why.emplace_back("a client on a Player port commanded a robot or changed the world");
  }
  if (!paced() && (!turns_ || !Turns::instance().active())) {
    if (lockstep_.several_owners() || (watches_program_ && program_has_threads())) {
      why.emplace_back(
          "the program has several threads or there were several programs, and time was "
          "not virtual: the order of their calls varies");
    }
  }
  return why;
}

void Host::note_unrepeatable(const std::string& reason) {
  constexpr std::size_t kMostReasons = 32;
  core_->locked([&] {
    std::vector<std::string>& told = core_->told_unrepeatable_;
    const bool known = std::find(told.begin(), told.end(), reason) != told.end();
    if (!known && told.size() < kMostReasons) told.push_back(reason);
  });
}
void Host::thread_ended(ThreadId thread_id) noexcept {
  InsideCore(*core_)->thread_ended(thread_id);
}
AlarmId Host::set_alarm(Alarm alarm) { return core_->set_alarm(std::move(alarm)); }
bool Host::cancel_alarm(AlarmId alarm) {
  return core_->locked([&] { return core_->alarms_.cancel(alarm); });
}
void Host::look_at_simulation(const std::function<void(const sim::Simulation&)>& look) const {
  core_->locked([&] { look(core_->simulation_); });
}
void Host::change_simulation(const std::function<void(sim::Simulation&)>& act) {
  core_->locked([&] {
    for (const auto& client : core_->clients_) core_->inputs_.apply_drawings(*client);
    act(core_->simulation_);
  });
}
void Host::watch_steps(std::function<void(const sim::Simulation&)> watch) {
  core_->locked([&] { core_->step_watch_ = std::move(watch); });
}
HostState Host::save() {
  return core_->locked([this] {
    HostState state;
    for (const auto& client : core_->clients_) {
      core_->inputs_.apply_drawings(*client);
      const std::lock_guard input(client->input_mutex);
      state.commands.insert(state.commands.end(), client->commands.begin(), client->commands.end());
    }
    state.snapshot = core_->simulation_.save();
    state.layers = core_->inputs_.registry;
    state.layers.leave_all();
    return state;
  });
}
sim::SharedReading Host::newest_reading(DeviceId sensor) const {
  return core_->locked([&] { return core_->clients_.newest(sensor); });
}
std::uint64_t Host::count_of_readings(DeviceId sensor) const noexcept {
  return core_->clients_.count_of_readings(sensor);
}
void Host::set_step_credit(std::optional<std::uint64_t> steps) {
  core_->change_step_limit([&](Pace& pace) { pace.set_limit(steps); });
}
void Host::add_step_credit(std::uint64_t steps) {
  core_->change_step_limit([&](Pace& pace) { pace.add_to_limit(steps); });
}
std::optional<std::string> Host::set_time_factor(double factor) {
  return core_->set_time_factor(factor);
}
const std::vector<RobotInfo>& Host::robots() const noexcept { return core_->robots(); }
bool Host::own_sensors_only() const noexcept { return core_->own_sensors_only(); }

void Host::finish() noexcept { InsideCore(*core_)->stop(); }
bool Host::finished() const {
  return InsideCore(*core_)->locked([this] { return core_->over(); });
}
sim::SimTime Host::now_ns() const noexcept { return core_->now_ns(); }

TimeStatistics Host::time() const {
  return InsideCore(*core_)->locked([this] { return core_->time_locked(); });
}
sim::RobotStatistics Host::statistics(int robot) const {
  return InsideCore(*core_)->locked([&] { return core_->simulation_.statistics(robot); });
}
std::uint64_t Host::state_hash() const {
  return InsideCore(*core_)->locked([this] { return core_->simulation_.state_hash(); });
}
std::shared_ptr<TurnClock> Host::clock() { return {shared_from_this(), core_->clock_.get()}; }

}  // namespace playerlike
