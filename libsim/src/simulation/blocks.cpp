// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Dynamic blocks: extending and retracting them, at once or with a speed, and the events of this.
#include <algorithm>
#include <utility>

#include "sim/core/assert.h"
#include "simulation/simulation_impl.h"

namespace sim {

std::optional<std::string> Simulation::Impl::find_free_block(const std::string& name,
                                                             int& index) const {
  const std::optional<int> found = find_obstacle(name);
  if (!found) return "there is no obstacle named \"" + name + "\"";
  const ObstacleDescription& block = world.arena.obstacles[static_cast<std::size_t>(*found)];
  if (block.type == ObstacleType::kStatic) {
    return "obstacle \"" + name + "\" is static: it can be neither extended nor retracted";
  }
  if (block.carried_by >= 0) {
    return "obstacle \"" + name + "\" is carried by robot " +
           world.robots[static_cast<std::size_t>(block.carried_by)].name;
  }
  index = *found;
  return std::nullopt;
}

BlockPhase Simulation::Impl::phase_of(int index) const {
  for (const BlockMotion& motion : block_motions) {
    if (motion.obstacle == index) return motion.phase;
  }
  const ObstacleDescription& block = world.arena.obstacles[static_cast<std::size_t>(index)];
  return block.state == ObstacleState::kExtended ? BlockPhase::kExtended : BlockPhase::kRetracted;
}

void Simulation::Impl::set_enabled(int index, bool extended) {
  physics->set_extended(index, extended);
  obstacle(index).state = extended ? ObstacleState::kExtended : ObstacleState::kRetracted;
  invalidate_clearances();
}

void Simulation::Impl::begin_motion(int index, BlockPhase phase) {
  end_motion(index);
  const auto after =
      std::find_if(block_motions.begin(), block_motions.end(),
                   [&](const BlockMotion& motion) { return motion.obstacle > index; });
  block_motions.insert(after, {index, phase});
}

void Simulation::Impl::end_motion(int index) {
  std::erase_if(block_motions, [&](const BlockMotion& motion) { return motion.obstacle == index; });
}

std::optional<std::string> Simulation::Impl::set_block(int index, bool extend) {
  ObstacleDescription& block = obstacle(index);
  const BlockPhase phase = phase_of(index);
  const bool slow = block.rise_speed_mps > 0.0;
  const bool stands = block.state == ObstacleState::kExtended;
  if (!extend) {
    if (phase == BlockPhase::kSinking) return std::nullopt;
    if (!stands) {
      end_motion(index);  // it waits no longer
    } else if (slow) {
      if (!block.present_height_m) block.present_height_m = block.height_m;
      begin_motion(index, BlockPhase::kSinking);
      record(ArenaEventKind::kSinking, block.name);
    } else {
      set_enabled(index, false);
      record(ArenaEventKind::kRetracted, block.name);
    }
    return std::nullopt;
  }
  if (stands) {
    if (phase != BlockPhase::kSinking) return std::nullopt;
    begin_motion(index, BlockPhase::kRising);
    record(ArenaEventKind::kRising, block.name);
    return std::nullopt;
  }
  const int robot = physics->robot_on(index);
  if (robot < 0) {
    end_motion(index);
    set_enabled(index, true);
    if (slow) {
      block.present_height_m = 0.0;
      physics->set_height(index, 0.0);
      begin_motion(index, BlockPhase::kRising);
    }
    record(slow ? ArenaEventKind::kRising : ArenaEventKind::kExtended, block.name);
    return std::nullopt;
  }
  const std::string& name = name_of_body(robot);
  const std::string reason = "obstacle \"" + block.name + "\" cannot be extended: " +
                             (robot < physics->robot_count() ? "a robot" : "an obstacle") +
                             " stands on it";
  if (block.when_blocked == WhenBlocked::kRefuse) {
    record(ArenaEventKind::kRefused, block.name, name, reason);
    return reason;
  }
  const bool waits = std::any_of(block_motions.begin(), block_motions.end(),
                                 [&](const BlockMotion& m) { return m.obstacle == index; });
  if (waits) return std::nullopt;
  begin_motion(index, BlockPhase::kRetracted);
  record(ArenaEventKind::kWaiting, block.name, name, reason);
  return std::nullopt;
}

void Simulation::Impl::move_blocks(double dt_s) {
  const std::vector<BlockMotion> moving = block_motions;  // the loop changes it
  for (const auto& [index, phase] : moving) {
    ObstacleDescription& block = obstacle(index);
    if (phase == BlockPhase::kRetracted) {
      if (physics->robot_on(index) < 0) static_cast<void>(set_block(index, true));
      continue;
    }
    SIM_ASSERT(block.present_height_m.has_value());
    const double way_m = block.rise_speed_mps * dt_s;
    double& height_m = *block.present_height_m;
    height_m += phase == BlockPhase::kRising ? way_m : -way_m;
    if (height_m > 0.0 && height_m < block.height_m) {
      physics->set_height(index, height_m);
      continue;
    }
    end_motion(index);
    block.present_height_m.reset();
    physics->set_height(index, block.height_m);
    if (phase == BlockPhase::kRising) {
      record(ArenaEventKind::kExtended, block.name);
    } else {
      set_enabled(index, false);
      record(ArenaEventKind::kRetracted, block.name);
    }
  }
}

std::optional<std::string> Simulation::set_obstacle_state(const std::string& name,
                                                          ObstacleState state) {
  int index = 0;
  if (auto reason = impl_->find_free_block(name, index)) return reason;
  return impl_->set_block(index, state == ObstacleState::kExtended);
}

std::vector<MovingBlock> Simulation::moving_blocks() const {
  std::vector<MovingBlock> blocks;
  for (const Impl::BlockMotion& motion : impl_->block_motions) {
    const double height_m = impl_->obstacle(motion.obstacle).present_height_m.value_or(0.0);
    blocks.push_back({motion.obstacle, motion.phase, height_m});
  }
  return blocks;
}

bool Simulation::records_arena_events() const noexcept { return impl_->records_events; }
const ArenaEvents& Simulation::arena_events() const noexcept { return impl_->events; }

}  // namespace sim
