// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Who commands which robot: the host's side of Commanders.
#include "host/core.h"
#include "session/checks.h"

namespace playerlike {

void Host::Core::unsubscribe(Client& client, DeviceId device) {
  const Lock lock = lock_with_priority();
  clients_.unsubscribe(client, device);
  if (ended_ || client.closed) return;
  inputs_.apply(client);
  inputs_.stop(inputs_.commanders.note_closed(client, device));
}

Charge Host::Core::take_charge(Client& client, const TakeChargeRequest& what) {
  require_device(robots_, what.device);
  const double seconds = what.watchdog_s;
  if (!(seconds >= TakeChargeRequest::kLeastWatchdog_s &&
        seconds <= TakeChargeRequest::kMostWatchdog_s)) {
    refuse_argument("a watchdog takes a number of seconds in [0.05, 600]");
  }
  constexpr std::size_t kMostName = 200;
  if (what.name.size() > kMostName || !is_printable(what.name)) {
    refuse_argument("the name of a client in charge has at most 200 printable bytes");
  }
  const Lock lock = lock_with_priority();
  client.require_open();
  client.touch();
  require_permission(permissions_.forbids_device(what.device));
  const int robot = what.device.robot;
  const bool has_changed = inputs_.commanders.take_charge(&client, what, WallClock::now());
  if (has_changed && !ended_) {
    inputs_.stop({robot});
    warn_((what.name.empty() ? "another client" : what.name) + " has taken over robot " +
          robots_[static_cast<std::size_t>(robot)].name);
  }
  return {true, inputs_.commanders.take_stopped(robot)};
}

void Host::Core::stop_unwatched(WallClock::time_point now) {
  // In lockstep a robot stands while the client does. In real time, and if it is real, it must
  // stop.
  const auto is_excused = [this] {
    return !mirror_ && !paced() && lockstep_.anybody_is_debugged();
  };
  for (const int robot : inputs_.commanders.overdue(now, is_excused)) {
    warn_("robot " + robots_[static_cast<std::size_t>(robot)].name +
          " is stopped: the client in charge of it has sent nothing");
    inputs_.stop({robot});
  }
}

std::optional<std::string> Host::Core::command(Commanders::Who who, DeviceId device,
                                               const sim::Command& command) {
  const Lock lock = lock_with_priority();
  if (stands_still()) return kRunIsOver;
  if (const auto what = permissions_.forbids_command(device, command)) {
    return note_forbidden(*what);
  }
  if (mirror_ && pace_.paused()) return "the run is paused: real robots stand still";
  return inputs_.execute_for(who, device, command);
}

void Host::Core::commander_gone(Commanders::Who who) noexcept {
  const Lock lock = lock_with_priority();
  const std::vector<int> left = inputs_.commanders.note_gone(who);
  if (!ended_) inputs_.stop(left);
}

}  // namespace playerlike
