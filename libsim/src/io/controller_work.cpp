// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/controller_work.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "sim/core/time.h"

namespace sim::io {
namespace {

// What a processor does in an operation: it colours so many cells, clears so many, or compares so
// many names in the search for one.
constexpr std::int64_t kColouredCells = 128;  // which may be new pages of memory
constexpr std::int64_t kClearedCells = 128 * kColouredCells;
constexpr std::int64_t kNames = 64;
constexpr std::int64_t kPlaces = 8;  // of robots and obstacles, compared with a place

std::int64_t count(const auto& list) { return static_cast<std::int64_t>(list.size()); }

}  // namespace

ControllerWork::ControllerWork(const WorldDescription& world)
    : world_(world),
      canvas_(world.canvas),
      robots_(count(world.robots)),
      obstacles_(count(world.arena.obstacles)),
      timers_(count(world.controller.timers)) {
  for (const ObstacleDescription& obstacle : world.arena.obstacles) {
    if (obstacle.type == ObstacleType::kDynamic) ++dynamic_;
  }
  for (const ArenaConfiguration& configuration : world.controller.configurations) {
    const bool all = configuration.others != ArenaConfiguration::Others::kKeep;
    const std::int64_t blocks = count(configuration.extended) + count(configuration.retracted);
    configurations_[configuration.name] =
        1 +
        of_block() * ((all ? std::max(dynamic_, blocks) : blocks) + count(configuration.places));
  }
}

void ControllerWork::set_canvas(int width, int height) {
  canvas_.width = width;
  canvas_.height = height;
}

// A block or obstacle is found by its name, and must have room among the robots.
std::int64_t ControllerWork::of_block() const {
  return 4 + obstacles_ / kNames + robots_ / kPlaces;
}

std::int64_t ControllerWork::of_configuration(const std::string& name) const {
  const auto found = configurations_.find(name);
  return found == configurations_.end() ? 1 : found->second;
}

struct ControllerWork::OfAction {
  const ControllerWork& of;

  std::int64_t operator()(const ConfigurationAction& action) const {
    return of.of_configuration(action.configuration);
  }
  std::int64_t operator()(const BlocksAction& action) const {
    return 1 + of.of_block() * count(action.blocks);
  }
  std::int64_t operator()(const PlaceAction&) const { return 1 + of.of_block(); }
  std::int64_t operator()(const MoveAction& action) const {
    return 1 + of.of_block() + count(action.motion.points) / kPlaces;
  }
  std::int64_t operator()(const TextAction&) const { return 4 + of.timers_ / kNames; }
  std::int64_t operator()(const CanvasAction& action) const {
    const auto side = [&](int whole, double size_m) {
      const double cells = std::ceil(size_m / of.canvas_.cell_size_m) + 1.0;
      return static_cast<std::int64_t>(std::clamp(cells, 0.0, static_cast<double>(whole)));
    };
    std::int64_t width = of.canvas_.width;
    std::int64_t height = of.canvas_.height;
    if (action.area) {
      width = side(of.canvas_.width, action.area->size.x());
      height = side(of.canvas_.height, action.area->size.y());
    }
    const bool clears =
        !action.area && action.colour.value_or(Colour{0, 0, 0, 0}) == Colour{0, 0, 0, 0};
    return 1 + width * height / (clears ? kClearedCells : kColouredCells);
  }
  std::int64_t operator()(const RestartAction&) const {
    return 4 + (of.robots_ + of.obstacles_) / kPlaces;
  }
  std::int64_t operator()(const SwitchAction& action) const {
    return 1 + count(action.names) * (2 + of.timers_ / kNames + of.robots_ / kNames);
  }
  template <typename Simple>
  std::int64_t operator()(const Simple&) const {
    return 2;
  }
};

std::int64_t ControllerWork::of(const ArenaAction& action) const {
  return std::visit(OfAction{*this}, action);
}

std::int64_t ControllerWork::of(const std::vector<ArenaCondition>& conditions) const {
  std::int64_t work = 1;
  for (const ArenaCondition& condition : conditions) {
    work += std::holds_alternative<BlockCondition>(condition) ? 1 + obstacles_ / kNames : 1;
  }
  return work;
}

std::int64_t ControllerWork::most_acts(const TimerDescription& timer) const {
  if (timer.every_s <= 0.0) return 1;
  const double acts = std::floor(to_seconds(world_.simulation.step_ns) / timer.every_s) + 1.0;
  const auto most = static_cast<std::int64_t>(std::min(acts, 1e9));
  return timer.times > 0 ? std::min<std::int64_t>(most, timer.times) : most;
}

std::vector<ControllerWork::Excess> ControllerWork::excesses() const {
  std::vector<Excess> found;
  const auto note = [&](const Excess& trigger) {
    if (trigger.work > kMaxControllerWork / trigger.acts) found.push_back(trigger);
  };
  const ControllerDescription& controller = world_.controller;
  for (std::size_t i = 0; i < controller.timers.size(); ++i) {
    note({true, i, most_acts(controller.timers[i]), of_one(controller.timers[i])});
  }
  for (std::size_t i = 0; i < controller.traps.size(); ++i) {
    note({false, i, 1, of_one(controller.traps[i])});
  }
  return found;
}

std::string text_of(const ControllerWork::Excess& excess) {
  std::string each = std::to_string(excess.work) + " operations";
  if (excess.acts == 1) return each;
  return std::to_string(excess.work * excess.acts) + ": " + std::to_string(excess.acts) +
         " times " + each;
}

}  // namespace sim::io
