// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Assigns indices of interfaces to devices, as the settings of a run choose them.
#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "playerlike/host/run_settings.h"
#include "playerlike/messages/messages.h"
#include "sim/core/error.h"

namespace playerlike {
namespace {

template <typename Names>
std::string joined(const Names& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + std::string(name);
  return text.empty() ? "none" : text;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known) {
  const std::string nearest = sim::nearest_word(word, known);
  return nearest.empty() ? "" : "did you mean \"" + nearest + "\"?";
}

// Applies choices to a world and collects the issues of invalid choices.
class Choices {
 public:
  explicit Choices(sim::WorldDescription& world) : world_(world) {}

  void add(const InterfaceChoice& choice) {
    const auto names = interface_names();
    const std::vector<std::string> known(names.begin(), names.end());
    if (std::find(known.begin(), known.end(), choice.interface) == known.end()) {
      return issue(choice, "an interface that devices have: " + joined(known),
                   '"' + choice.interface + '"', did_you_mean(choice.interface, known));
    }
    const std::vector<std::size_t> robots = robots_of(choice);
    for (const std::size_t robot : robots) add(choice, robot);
  }

  void apply() {
    if (!issues_.empty()) throw sim::ConfigError(std::move(issues_));
    for (const auto& [place, devices] : chosen_) {
      sim::RobotDescription& robot = world_.robots[place.first];
      std::vector<std::string> rest = device_order(robot, place.second);
      const std::size_t count = rest.size();
      for (const auto& device : devices) std::erase(rest, device.second);
      std::vector<std::string> order;
      auto next = rest.begin();
      for (std::size_t i = 0; i < count; ++i) {
        const auto device = devices.find(static_cast<int>(i));
        order.push_back(device == devices.end() ? *next++ : device->second);
      }
      robot.interfaces[place.second] = std::move(order);
    }
  }

 private:
  void issue(const InterfaceChoice& choice, std::string expected, std::string found,
             std::string hint = "") {
    issues_.push_back({"run/interface", "--interface " + choice.text(), "", std::move(expected),
                       std::move(found), std::move(hint)});
  }

  // Returns the robots of a choice; adds an issue if there are none.
  std::vector<std::size_t> robots_of(const InterfaceChoice& choice) {
    std::vector<std::size_t> named;
    std::vector<std::size_t> with_device;
    std::vector<std::string> robots;
    std::vector<std::string> devices;
    for (std::size_t r = 0; r < world_.robots.size(); ++r) {
      const sim::RobotDescription& robot = world_.robots[r];
      robots.push_back(robot.name);
      if (!choice.robot.empty() && robot.name != choice.robot) continue;
      named.push_back(r);
      bool has = false;
      for (const std::string& device : device_order(robot, choice.interface)) {
        has = has || device == choice.device;
        if (std::find(devices.begin(), devices.end(), device) == devices.end()) {
          devices.push_back(device);
        }
      }
      if (has) with_device.push_back(r);
    }
    if (named.empty()) {
      issue(choice, "a robot of this world: " + joined(robots), '"' + choice.robot + '"',
            did_you_mean(choice.robot, robots));
    } else if (with_device.empty()) {
      issue(choice,
            "a device with the interface " + choice.interface +
                (choice.robot.empty() ? " of a robot of this world: "
                                      : " of " + choice.robot + ": ") +
                joined(devices),
            '"' + choice.device + '"', did_you_mean(choice.device, devices));
    }
    return with_device;
  }

  void add(const InterfaceChoice& choice, std::size_t robot) {
    const sim::RobotDescription& description = world_.robots[robot];
    const std::size_t count = device_order(description, choice.interface).size();
    if (static_cast<std::size_t>(choice.index) >= count) {
      return issue(choice,
                   "an index from 0 to " + std::to_string(count - 1) + ": " + description.name +
                       " has " + std::to_string(count) + (count == 1 ? " device" : " devices") +
                       " with the interface " + choice.interface,
                   std::to_string(choice.index));
    }
    std::map<int, std::string>& devices = chosen_[{robot, choice.interface}];
    const bool device_twice = std::any_of(devices.begin(), devices.end(),
                                          [&](const auto& d) { return d.second == choice.device; });
    if (device_twice || !devices.emplace(choice.index, choice.device).second) {
      issue(choice, "each index and each device of an interface once",
            (device_twice ? choice.device : choice.interface + ':' + std::to_string(choice.index)) +
                " again, for " + description.name);
    }
  }

  sim::WorldDescription& world_;
  std::map<std::pair<std::size_t, std::string>, std::map<int, std::string>> chosen_;
  std::vector<sim::ConfigIssue> issues_;
};

}  // namespace

std::string InterfaceChoice::text() const {
  return (robot.empty() ? "" : robot + '.') + interface + ':' + std::to_string(index) + '=' +
         device;
}

bool parse_interface_choice(const std::string& text, InterfaceChoice& choice) {
  const std::size_t equals = text.find('=');
  const std::size_t colon = text.find(':');
  if (equals == std::string::npos || colon >= equals) return false;
  const std::size_t dot = text.rfind('.', colon);
  InterfaceChoice read;
  if (dot != std::string::npos) read.robot = text.substr(0, dot);
  const std::size_t begin = dot == std::string::npos ? 0 : dot + 1;
  read.interface = text.substr(begin, colon - begin);
  read.device = text.substr(equals + 1);
  const char* const last = text.data() + equals;
  const auto [end, error] = std::from_chars(text.data() + colon + 1, last, read.index);
  if (error != std::errc() || end != last || read.index < 0 || read.interface.empty() ||
      read.device.empty() || (dot != std::string::npos && read.robot.empty()) ||
      text.find(',') != std::string::npos) {
    return false;
  }
  choice = std::move(read);
  return true;
}

void apply_interface_choices(sim::WorldDescription& world,
                             const std::vector<InterfaceChoice>& choices) {
  Choices all(world);
  for (const InterfaceChoice& choice : choices) all.add(choice);
  all.apply();
}

}  // namespace playerlike
