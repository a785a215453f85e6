// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "playerlike/host/task_rules.h"
#include "playerlike/messages/messages.h"

namespace playerlike {

/// Decides what the clients of a run may use, by the rules of its task. Constant, hence
/// thread-safe. A function that finds something forbidden returns what it is, for messages and for
/// the report ("the map"); nullopt: it is allowed.
class Permissions {
 public:
  /// @param robots  must outlive this object.
  Permissions(const std::optional<MayUse>& may_use, const std::vector<RobotInfo>& robots);

  /// Whether anything at all is forbidden.
  [[nodiscard]] bool limited() const noexcept { return may_use_.has_value(); }

  /// @pre The device exists.
  [[nodiscard]] std::optional<std::string> forbids_device(DeviceId device) const;
  /// As forbids_device(), and commands in the world's frame if the program may not know where the
  /// robot is in the world.
  [[nodiscard]] std::optional<std::string> forbids_command(DeviceId device,
                                                           const sim::Command& command) const;
  /// @param data  one of kWorldData.
  [[nodiscard]] std::optional<std::string> forbids_world(std::string_view data) const;

  /// What is allowed, in words.
  [[nodiscard]] std::string allowed_text() const;

 private:
  const std::optional<MayUse> may_use_;
  const std::vector<RobotInfo>& robots_;
};

/// The list of robots for clients. A program that may not read a robot's pose does not learn where
/// the robot starts either.
[[nodiscard]] std::vector<RobotInfo> robots_for(const std::optional<MayUse>& may_use,
                                                std::vector<RobotInfo> robots);

}  // namespace playerlike
