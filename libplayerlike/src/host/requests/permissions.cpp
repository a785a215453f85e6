// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/requests/permissions.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace playerlike {
namespace {

constexpr const char* kPoseType = "pose";  // devices of this type measure the true pose

bool has_word(const std::vector<std::string>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool allows(const MayUse& may_use, const RobotInfo& robot, const DeviceInfo& device) {
  return has_word(may_use.robots, robot.name) &&
         (!may_use.devices || has_word(*may_use.devices, device.name) ||
          has_word(*may_use.devices, device.type));
}

bool tells_pose(const MayUse& may_use, const RobotInfo& robot) {
  if (!has_word(may_use.robots, robot.name)) return false;
  return has_word(may_use.world, "objects") ||
         std::any_of(robot.devices.begin(), robot.devices.end(), [&](const DeviceInfo& device) {
           return device.type == kPoseType && allows(may_use, robot, device);
         });
}

/// The device in whose frame a command is given; -1: the world's frame; nullopt: the robot's own.
std::optional<int> frame_of(const sim::Command& command) {
  if (const auto* heading = std::get_if<sim::HeadingCommand>(&command)) return heading->frame;
  if (const auto* position = std::get_if<sim::PositionCommand>(&command)) return position->frame;
  if (std::holds_alternative<sim::GotoCommand>(command) ||
      std::holds_alternative<sim::PlaceCommand>(command) ||
      std::holds_alternative<sim::OrientCommand>(command)) {
    return -1;
  }
  return std::nullopt;
}

std::string list_text(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text.empty() ? "nothing" : text;
}

const char* words_for(std::string_view data) {
  if (data == "map") return "the map of the world";
  if (data == "objects") return "poses and properties of objects";
  return "the state of the arena";
}

}  // namespace

Permissions::Permissions(const std::optional<MayUse>& may_use, const std::vector<RobotInfo>& robots)
    : may_use_(may_use), robots_(robots) {}

std::optional<std::string> Permissions::forbids_device(DeviceId device) const {
  if (!may_use_) return std::nullopt;
  const RobotInfo& robot = robots_[static_cast<std::size_t>(device.robot)];
  const DeviceInfo& info = robot.devices[static_cast<std::size_t>(device.device)];
  if (allows(*may_use_, robot, info)) return std::nullopt;
  return "the device " + info.name + " of robot " + robot.name;
}

std::optional<std::string> Permissions::forbids_command(DeviceId device,
                                                        const sim::Command& command) const {
  if (auto what = forbids_device(device)) return what;
  if (!may_use_) return std::nullopt;
  const std::optional<int> frame = frame_of(command);
  if (!frame) return std::nullopt;
  const RobotInfo& robot = robots_[static_cast<std::size_t>(device.robot)];
  if (*frame < 0) {
    if (tells_pose(*may_use_, robot)) return std::nullopt;
    return "goals in the frame of the world for robot " + robot.name;
  }
  // A device that does not exist is the motors' matter.
  if (static_cast<std::size_t>(*frame) >= robot.devices.size()) return std::nullopt;
  return forbids_device({device.robot, *frame});
}

std::optional<std::string> Permissions::forbids_world(std::string_view data) const {
  if (!may_use_ || has_word(may_use_->world, data)) return std::nullopt;
  return words_for(data);
}

std::string Permissions::allowed_text() const {
  if (!may_use_) return "everything";
  return "robots: " + list_text(may_use_->robots) +
         "; devices: " + (may_use_->devices ? list_text(*may_use_->devices) : "all of them") +
         "; of the world: " + list_text(may_use_->world);
}

std::vector<RobotInfo> robots_for(const std::optional<MayUse>& may_use,
                                  std::vector<RobotInfo> robots) {
  if (!may_use) return robots;
  for (RobotInfo& robot : robots) {
    if (!tells_pose(*may_use, robot)) robot.initial_pose = sim::Pose{};
  }
  return robots;
}

}  // namespace playerlike
