// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/requests/arena.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "session/checks.h"

namespace playerlike {
namespace {

using sim::Simulation;

template <typename List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  names.reserve(list.size());
  for (const auto& element : list) names.push_back(element.name);
  return names;
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

[[noreturn]] void refuse_unknown(const char* what, const std::string& name,
                                 const std::vector<std::string>& known) {
  refuse_argument(unknown_name(what, name, known));
}

const sim::ControllerDescription& controller_of(const Simulation& simulation) {
  return simulation.world().controller;
}

std::vector<std::string> dynamic_block_names(const Simulation& simulation) {
  std::vector<std::string> names;
  for (const sim::ObstacleDescription& block : simulation.world().arena.obstacles) {
    if (block.type == sim::ObstacleType::kDynamic) names.push_back(block.name);
  }
  return names;
}

}  // namespace

std::vector<ArenaBlock> arena_blocks(const Simulation& simulation) {
  const std::vector<sim::MovingBlock> all_moving = simulation.moving_blocks();  // by index
  auto moving = all_moving.begin();
  std::vector<ArenaBlock> blocks;
  int index = -1;
  for (const sim::ObstacleDescription& block : simulation.world().arena.obstacles) {
    ++index;
    if (block.type != sim::ObstacleType::kDynamic) continue;
    const bool stands = block.state == sim::ObstacleState::kExtended;
    ArenaBlock& out = blocks.emplace_back();
    out.name = block.name;
    out.state = stands ? "extended" : "retracted";
    if (stands) out.height_m = sim::standing_height_m(block);
    if (moving == all_moving.end() || moving->obstacle != index) continue;
    out.state = moving->phase == sim::BlockPhase::kRising    ? "rising"
                : moving->phase == sim::BlockPhase::kSinking ? "sinking"
                                                             : "waiting";
    ++moving;
  }
  return blocks;
}

ArenaStatus arena_status(const Simulation& simulation) {
  sim::ArenaState state = simulation.arena_state();
  ArenaStatus status;
  status.time_ns = simulation.now_ns();
  status.configurations = names_of(controller_of(simulation).configurations);
  status.configuration = std::move(state.configuration);
  status.blocks = arena_blocks(simulation);
  status.timers = std::move(state.timers);
  status.traps = std::move(state.traps);
  const std::vector<double>& scores = simulation.scores();
  for (std::size_t i = 0; i < simulation.world().robots.size(); ++i) {
    status.scores.push_back(
        {simulation.world().robots[i].name, i < scores.size() ? scores[i] : 0.0});
  }
  status.verdict = simulation.verdict();
  status.newest = simulation.arena_events().count;
  return status;
}

ArenaEventList arena_events(const Simulation& simulation, std::uint64_t since) {
  const sim::ArenaEvents& all = simulation.arena_events();
  ArenaEventList list;
  list.newest = all.count;
  if (since >= all.count) return list;
  const std::uint64_t first_kept = all.count - all.newest.size();  // number before the oldest
  if (since < first_kept) list.lost = first_kept - since;
  const auto skipped = static_cast<std::ptrdiff_t>(std::max(since, first_kept) - first_kept);
  list.events.assign(all.newest.begin() + skipped, all.newest.end());
  return list;
}

std::string verdict_text(const Simulation& simulation) {
  const std::optional<sim::Verdict>& verdict = simulation.verdict();
  if (!verdict) return "";
  std::string text = verdict->passed ? "passed" : "failed";
  if (!verdict->reason.empty()) text.append(": ").append(verdict->reason);
  return text;
}

void set_configuration(Simulation& simulation, const std::string& name) {
  const std::vector<std::string> known = names_of(controller_of(simulation).configurations);
  if (!has(known, name)) refuse_unknown("configuration", name, known);
  require_done(simulation.set_configuration(name));
}

void set_block(Simulation& simulation, const std::string& name, bool extended) {
  const auto& obstacles = simulation.world().arena.obstacles;
  const bool exists = std::any_of(obstacles.begin(), obstacles.end(),
                                  [&](const auto& block) { return block.name == name; });
  if (!exists) refuse_unknown("dynamic block", name, dynamic_block_names(simulation));
  require_done(simulation.set_obstacle_state(
      name, extended ? sim::ObstacleState::kExtended : sim::ObstacleState::kRetracted));
}

void set_timer(Simulation& simulation, const std::string& name, bool enabled) {
  const std::vector<std::string> known = names_of(controller_of(simulation).timers);
  if (!has(known, name)) refuse_unknown("timer", name, known);
  require_done(simulation.set_timer_enabled(name, enabled));
}

void set_trap(Simulation& simulation, const std::string& name, bool enabled) {
  const std::vector<std::string> known = names_of(controller_of(simulation).traps);
  if (!has(known, name)) refuse_unknown("trap", name, known);
  require_done(simulation.set_trap_enabled(name, enabled));
}

}  // namespace playerlike
