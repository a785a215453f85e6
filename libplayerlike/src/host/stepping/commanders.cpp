// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/stepping/commanders.h"

#include <algorithm>
#include <string_view>

namespace playerlike {
namespace {

/// Whether a device goes on moving its robot after a command.
bool drives_robot(std::string_view type) {
  return type == "motion" || type == "waypoint" || type == "destination";
}

}  // namespace

bool moves_robot(const std::string& type) {
  return drives_robot(type) || type == "teleport" || type == "orientation";
}

Commanders::Commanders(const sim::Simulation& simulation, const std::vector<RobotInfo>& robots)
    : simulation_(simulation), robots_(robots.size()) {
  for (std::size_t i = 0; i < robots.size(); ++i) {
    for (const DeviceInfo& device : robots[i].devices) {
      robots_[i].roles.push_back(drives_robot(device.type)  ? Role::kDrives
                                 : moves_robot(device.type) ? Role::kPlaces
                                                            : Role::kNone);
    }
    robots_[i].mirrors = simulation.world().robots[i].real.has_value();
    for (const InterfaceAddress& address : list_interfaces(robots, robots[i].port)) {
      if (address.interface != "position2d") continue;
      const DeviceId pose =
          find_interface(robots, robots[i].port, address.interface, address.index).reading;
      if (pose.robot == static_cast<int>(i)) robots_[i].poses.insert(pose.device);
    }
  }
}

std::optional<std::string> Commanders::note(Who who, DeviceId device, Kind kind) {
  Robot& robot = at(device.robot);
  const Role role = robot.roles[static_cast<std::size_t>(device.device)];
  if (role == Role::kNone) return std::nullopt;
  if (robot.overruled.contains(who)) {
    return "robot " + simulation_.world().robots[static_cast<std::size_t>(device.robot)].name +
           " obeys another client, which has taken it over";
  }
  robot.holders.insert(who);
  robot.last = who;
  robot.last_kind = kind;
  if (role == Role::kDrives) robot.commanded.insert(device.device);
  return std::nullopt;
}

void Commanders::note_opened(const Client& client, DeviceId device) {
  if (client.onlooker) return;  // a watcher commands nothing
  Robot& robot = at(device.robot);
  if (robot.poses.contains(device.device)) robot.holders.insert(&client);
}

std::vector<int> Commanders::note_closed(const Client& client, DeviceId device) {
  if (device.robot < 0 || static_cast<std::size_t>(device.robot) >= robots_.size()) return {};
  Robot& robot = at(device.robot);
  if (!robot.poses.contains(device.device)) return {};
  const bool still_open =
      std::any_of(client.subscriptions.begin(), client.subscriptions.end(), [&](const auto& s) {
        return s.device.robot == device.robot && robot.poses.contains(s.device.device);
      });
  if (still_open || !let_go(robot, &client)) return {};
  return {device.robot};
}

std::vector<int> Commanders::note_gone(Who who) {
  std::vector<int> stopped;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    Robot& robot = robots_[i];
    const bool in_charge = robot.charge && robot.charge->who == who;
    const bool drives_for_it = in_charge && drives_for_charge(robot);
    if (let_go(robot, who) || drives_for_it) stopped.push_back(static_cast<int>(i));
    robot.overruled.erase(who);
    if (in_charge) robot.charge.reset();
  }
  return stopped;
}

bool Commanders::let_go(Robot& robot, Who who) {
  if (robot.holders.erase(who) == 0) return false;
  const bool commanded_last = robot.last == who;
  if (commanded_last) robot.last = nullptr;
  if (robot.commanded.empty()) return false;
  if (robot.mirrors) return commanded_last;
  return robot.holders.empty() && !(commanded_last && robot.last_kind == Kind::kMorse);
}

bool Commanders::drives_for_charge(const Robot& robot) {
  if (!robot.charge || robot.commanded.empty()) return false;
  return robot.last == robot.charge->who || robot.last == nullptr ||
         robot.last_kind == Kind::kFollower;
}

bool Commanders::take_charge(Who who, const TakeChargeRequest& what, WallClock::time_point now) {
  Robot& robot = at(what.device.robot);
  const std::string& name =
      simulation_.world().robots[static_cast<std::size_t>(what.device.robot)].name;
  const bool is_new = !robot.charge || robot.charge->who != who;
  if (robot.overruled.contains(who) && !what.take_over) {
    throw SessionError(SessionError::Code::kNotAvailable,
                       robot.charge ? robot.charge->name + " has taken over robot " + name
                                    : "robot " + name + " was taken over by another client");
  }
  if (is_new && robot.charge && !what.take_over) {
    throw SessionError(SessionError::Code::kNotAvailable,
                       robot.charge->name + " is in charge of robot " + name +
                           "; ask to take over, or wait until it has left");
  }
  const bool from_another = is_new && robot.charge;
  if (from_another) robot.overruled.insert(robot.charge->who);
  robot.overruled.erase(who);
  if (is_new) robot.charge = Charge{who, what.name.empty() ? "another client" : what.name, {}, {}};
  robot.charge->watchdog = wall(what.watchdog_s);
  robot.charge->heard = now;
  return from_another;
}

bool Commanders::take_stopped(int robot) {
  auto& charge = at(robot).charge;
  return charge && std::exchange(charge->stopped, false);
}

std::vector<int> Commanders::overdue(WallClock::time_point now,
                                     const std::function<bool()>& is_excused) {
  std::vector<int> late;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    Robot& robot = robots_[i];
    if (!drives_for_charge(robot)) continue;
    if (now - robot.charge->heard <= robot.charge->watchdog) continue;
    if (is_excused && is_excused()) {
      robot.charge->heard = now;
      continue;
    }
    robot.charge->stopped = has_stopped_ = true;
    late.push_back(static_cast<int>(i));
  }
  return late;
}

Commanders::Commands Commanders::stop(int robot) {
  Robot& stopped = at(robot);
  Commands commands;
  for (const int device : std::exchange(stopped.commanded, {})) {
    if (simulation_.device(robot, device).type() == "waypoint") {
      commands.push_back({{robot, device}, sim::StopCommand{}});
    }
  }
  // Also after a command to another device: it drives the motors.
  for (int device = 0; device < simulation_.device_count(robot); ++device) {
    if (simulation_.device(robot, device).type() == "motion") {
      commands.push_back({{robot, device}, sim::TwistCommand{}});
    }
  }
  return commands;
}

}  // namespace playerlike
