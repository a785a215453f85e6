// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace playerlike {

/// What a program may use in a run. Everything else is refused with SessionError kNotAvailable.
struct MayUse {
  /// Names of the robots whose devices the program may read and command.
  std::vector<std::string> robots;
  /// Names or types of these devices; nullopt: all devices of the robots.
  std::optional<std::vector<std::string>> devices;
  /// Which data of the world the program may ask for; see kWorldData.
  std::vector<std::string> world;

  friend bool operator==(const MayUse&, const MayUse&) = default;
};

/// Data of the world that no sensor measures, as words of MayUse::world: the map (MapProxy); poses
/// and properties of objects (SimulationProxy); state and events of the arena (ArenaProxy).
inline constexpr std::array<std::string_view, 3> kWorldData = {"map", "objects", "arena"};

/// The part of a task that the host of a run enforces or measures.
struct TaskRules {
  std::optional<MayUse> may_use;  ///< nullopt: everything
  /// Name of the robot whose sensors decide which floor counts as seen; "": this is not recorded.
  std::string seen_by;

  friend bool operator==(const TaskRules&, const TaskRules&) = default;
};

/// The rules as text for PLAYPEN_TASK; "" for rules that are all defaults.
[[nodiscard]] std::string to_text(const TaskRules& rules);

/// Inverse function of to_text(). @return nullopt for any other text.
[[nodiscard]] std::optional<TaskRules> parse_task_rules(const std::string& text);

/// Description of the values that parse_task_rules() accepts, for messages.
inline constexpr const char* kTaskRulesExpected = "the rules of a task, as playpen grade sets them";

}  // namespace playerlike
