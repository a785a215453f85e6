// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "server/morse_state.h"

#include <algorithm>
#include <utility>

#include "server/morse_streams.h"
#include "sim/devices/waypoint.h"

namespace playerlike::server {
namespace {

const sim::Waypoint& waypoint_of(const sim::Simulation& simulation, DeviceId device) {
  return dynamic_cast<const sim::Waypoint&>(simulation.device(device.robot, device.device));
}

sim::Command stop_command(std::string_view type) {
  if (type == "actarray") return sim::JointCommand{sim::JointCommand::Mode::kSpeed, -1, {0.0}};
  if (type == "ptz") return sim::PanCommand{};
  return sim::StopCommand{};
}

}  // namespace

MorseState::MorseState(Hub& hub)
    : hub_(hub),
      postbox_(std::make_shared<Postbox>(hub)),
      components_(host().with_simulation([&](const sim::Simulation& simulation) {
        return morse_components(hub.host().robots(), simulation);
      })),
      streams_(std::make_unique<MorseStreams>(*this)) {}

MorseState::~MorseState() {
  postbox_->close();
  for (const auto& [number, pending] : pending_) host().cancel_alarm(pending.alarm);
  if (synchronised_) host().set_step_credit(std::nullopt);
}

std::shared_ptr<MorseState> MorseState::of(Hub& hub) {
  if (hub.morse_state == nullptr) hub.morse_state = std::make_shared<MorseState>(hub);
  return hub.morse_state;
}

const MorseComponent* MorseState::find(std::string_view name) const noexcept {
  const auto it = std::find_if(components_.begin(), components_.end(),
                               [&](const MorseComponent& c) { return c.name == name; });
  return it != components_.end() ? &*it : nullptr;
}

const std::shared_ptr<EventClient>& MorseState::client() {
  if (client_ == nullptr) client_ = host().connect_events(kMorsePort, {});
  return client_;
}

void MorseState::command(Commander& commander, DeviceId device, const sim::Command& command) {
  if (const auto refusal = commander.command(device, command)) throw MorseRefusal(*refusal);
}

// --- Requests with a later answer

void MorseState::add_pending(PendingRequest pending, Alarm alarm) {
  const Number number = ++last_number_;
  MorseConnection& from = *pending.from;
  pending_.emplace(number, std::move(pending));
  from.peer().set_in_flight(waiting(from));
  alarm.lets_time_pass = true;
  alarm.notify = [box = postbox_, weak = weak_from_this(), number] {
    box->post([weak, number] {
      if (const auto state = weak.lock()) state->on_alarm(number);
    });
  };
  pending_.at(number).alarm = host().set_alarm(std::move(alarm));
  hub_.pump();
}

void MorseState::answer_after(MorseConnection& from, const std::string& id, double seconds) {
  if (host().finished()) throw MorseRefusal(kRunIsOver);
  PendingRequest pending;
  pending.from = &from;
  pending.id = id;
  pending.until_ns = host().time().sim_time_ns + sim::from_seconds(seconds);
  Alarm alarm;
  alarm.until_ns = pending.until_ns;
  add_pending(std::move(pending), std::move(alarm));
}

void MorseState::answer_on_arrival(MorseConnection& from, const std::string& id, DeviceId waypoint,
                                   const sim::GotoCommand& goal) {
  command(from.commander(), waypoint, goal);
  const std::uint64_t goal_number = host().with_simulation([&](const sim::Simulation& simulation) {
    return waypoint_of(simulation, waypoint).goal_number();
  });
  for (auto it = pending_.begin(); it != pending_.end();) {
    it = it->second.device == waypoint ? end(it, "PREEMPTED", nullptr) : std::next(it);
  }
  PendingRequest pending;
  pending.from = &from;
  pending.id = id;
  pending.device = waypoint;
  pending.result = "Arrived";
  pending.outcome = std::make_shared<std::atomic<Outcome>>(Outcome::kNone);
  Alarm alarm;
  alarm.condition = [waypoint, goal_number,
                     outcome = pending.outcome](const sim::Simulation& simulation) {
    const sim::Waypoint& device = waypoint_of(simulation, waypoint);
    if (device.goal_number() != goal_number) {
      *outcome = Outcome::kReplaced;
    } else if (device.status() == sim::WaypointStatus::kArrived) {
      *outcome = Outcome::kArrived;
    }
    return *outcome != Outcome::kNone;
  };
  add_pending(std::move(pending), std::move(alarm));
}

void MorseState::answer_when(MorseConnection& from, const std::string& id, DeviceId device,
                             std::function<bool(const sim::Device&)> done) {
  if (host().finished()) throw MorseRefusal(kRunIsOver);
  for (auto it = pending_.begin(); it != pending_.end();) {
    it = it->second.device == device ? end(it, "PREEMPTED", nullptr) : std::next(it);
  }
  PendingRequest pending;
  pending.from = &from;
  pending.id = id;
  pending.device = device;
  pending.outcome = std::make_shared<std::atomic<Outcome>>(Outcome::kNone);
  Alarm alarm;
  alarm.condition = [device, done = std::move(done),
                     outcome = pending.outcome](const sim::Simulation& simulation) {
    if (done(simulation.device(device.robot, device.device))) *outcome = Outcome::kArrived;
    return *outcome != Outcome::kNone;
  };
  add_pending(std::move(pending), std::move(alarm));
}

void MorseState::on_alarm(Number number) {
  const auto it = pending_.find(number);
  if (it == pending_.end()) return;
  const PendingRequest& pending = it->second;
  if (!pending.device) {
    const bool slept = host().time().sim_time_ns >= pending.until_ns;
    end(it, slept ? "SUCCESS" : "FAILED", slept ? nlohmann::json() : nlohmann::json(kRunIsOver));
    return;
  }
  switch (pending.outcome->load()) {
    case Outcome::kArrived:
      end(it, "SUCCESS", nlohmann::json(pending.result));
      return;
    case Outcome::kReplaced:
      end(it, "PREEMPTED", nullptr);
      return;
    case Outcome::kNone:
      end(it, "FAILED", kRunIsOver);
      return;
  }
}

std::map<MorseState::Number, MorseState::PendingRequest>::iterator MorseState::end(
    std::map<Number, PendingRequest>::iterator pending, std::string_view status,
    const nlohmann::json& result) {
  host().cancel_alarm(pending->second.alarm);
  MorseConnection& from = *pending->second.from;
  const std::string id = std::move(pending->second.id);
  const auto next = pending_.erase(pending);
  from.answer(id, status, result);
  from.peer().set_in_flight(waiting(from));
  return next;
}

void MorseState::cancel(MorseConnection& from, const std::string& id) {
  std::vector<DeviceId> stopped;
  for (auto it = pending_.begin(); it != pending_.end();) {
    if (it->second.from != &from || it->second.id != id) {
      ++it;
      continue;
    }
    if (it->second.device) stopped.push_back(*it->second.device);
    it = end(it, "PREEMPTED", nullptr);
  }
  for (const DeviceId device : stopped) {
    const DeviceInfo& info = host()
                                 .robots()[static_cast<std::size_t>(device.robot)]
                                 .devices[static_cast<std::size_t>(device.device)];
    // A refusal means that the device is off, the run is over, or there is nothing to stop.
    static_cast<void>(from.commander().command(device, stop_command(info.type)));
  }
}

void MorseState::forget(MorseConnection& from) {
  for (auto it = pending_.begin(); it != pending_.end();) {
    if (it->second.from == &from) {
      host().cancel_alarm(it->second.alarm);
      it = pending_.erase(it);
    } else {
      ++it;
    }
  }
}

std::size_t MorseState::waiting(const MorseConnection& from) const noexcept {
  return static_cast<std::size_t>(
      std::count_if(pending_.begin(), pending_.end(),
                    [&](const auto& entry) { return entry.second.from == &from; }));
}

// --- Other members

void MorseState::set_verbose(const std::string& component, bool verbose) {
  if (verbose) {
    verbose_.insert(component);
  } else {
    verbose_.erase(component);
  }
}

void MorseState::set_synchronised(bool synchronised) {
  synchronised_ = synchronised;
  host().set_step_credit(synchronised ? std::optional<std::uint64_t>(0) : std::nullopt);
  hub_.pump();
}

}  // namespace playerlike::server
