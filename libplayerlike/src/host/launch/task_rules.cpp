// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/task_rules.h"

#include <nlohmann/json.hpp>

namespace playerlike {
namespace {

constexpr const char* kMayUse = "may_use";
constexpr const char* kRobots = "robots";
constexpr const char* kDevices = "devices";
constexpr const char* kWorld = "world";
constexpr const char* kSeenBy = "seen_by";

}  // namespace

std::string to_text(const TaskRules& rules) {
  if (rules == TaskRules{}) return "";
  nlohmann::ordered_json text = nlohmann::ordered_json::object();
  if (rules.may_use) {
    text[kMayUse] = {{kRobots, rules.may_use->robots}, {kWorld, rules.may_use->world}};
    if (rules.may_use->devices) text[kMayUse][kDevices] = *rules.may_use->devices;
  }
  if (!rules.seen_by.empty()) text[kSeenBy] = rules.seen_by;
  return text.dump(-1, ' ', /*ensure_ascii=*/true,
                   nlohmann::ordered_json::error_handler_t::replace);
}

std::optional<TaskRules> parse_task_rules(const std::string& text) {
  TaskRules rules;
  if (text.empty()) return rules;
  try {
    const nlohmann::json read = nlohmann::json::parse(text);
    if (read.contains(kMayUse)) {
      const nlohmann::json& allowed = read.at(kMayUse);
      MayUse& may_use = rules.may_use.emplace();
      may_use.robots = allowed.at(kRobots).get<std::vector<std::string>>();
      may_use.world = allowed.at(kWorld).get<std::vector<std::string>>();
      if (allowed.contains(kDevices)) {
        may_use.devices = allowed.at(kDevices).get<std::vector<std::string>>();
      }
    }
    rules.seen_by = read.value(kSeenBy, "");
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
  return rules;
}

}  // namespace playerlike
