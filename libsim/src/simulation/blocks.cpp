// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Dynamic blocks: extending and retracting them, at once or with a speed, and the events of this.
#include "simulation/blocks.h"

#include <algorithm>

#include "sim/core/assert.h"

namespace sim {

std::optional<std::string> Simulation::Impl::Blocks::find_free(const std::string& name,
                                                               int& index) const {
  const std::optional<int> found = impl_.find_obstacle(name);
  if (!found) return "there is no obstacle named \"" + name + "\"";
  const ObstacleDescription& block = impl_.world.arena.obstacles[static_cast<std::size_t>(*found)];
  if (block.type == ObstacleType::kStatic) {
    return "obstacle \"" + name + "\" is static: it can be neither extended nor retracted";
  }
  if (block.carried_by >= 0) {
    return "obstacle \"" + name + "\" is carried by robot " +
           impl_.world.robots[static_cast<std::size_t>(block.carried_by)].name;
  }
  index = *found;
  return std::nullopt;
}

BlockPhase Simulation::Impl::Blocks::phase_of(int index) const {
  for (const BlockMotion& motion : motions_) {
    if (motion.obstacle == index) return motion.phase;
  }
  const ObstacleDescription& block = impl_.world.arena.obstacles[static_cast<std::size_t>(index)];
  return block.state == ObstacleState::kExtended ? BlockPhase::kExtended : BlockPhase::kRetracted;
}

void Simulation::Impl::Blocks::set_enabled(int index, bool extended) {
  impl_.physics->set_extended(index, extended);
  impl_.obstacle(index).state = extended ? ObstacleState::kExtended : ObstacleState::kRetracted;
  impl_.invalidate_clearances();
}

void Simulation::Impl::Blocks::begin_motion(int index, BlockPhase phase) {
  end_motion(index);
  const auto after = std::find_if(motions_.begin(), motions_.end(), [&](const BlockMotion& motion) {
    return motion.obstacle > index;
  });
  motions_.insert(after, {index, phase});
}

void Simulation::Impl::Blocks::end_motion(int index) {
  std::erase_if(motions_, [&](const BlockMotion& motion) { return motion.obstacle == index; });
}

std::optional<std::string> Simulation::Impl::Blocks::set(int index, bool extend) {
  ObstacleDescription& block = impl_.obstacle(index);
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
  const int robot = impl_.physics->robot_on(index);
  if (robot < 0) {
    end_motion(index);
    set_enabled(index, true);
    if (slow) {
      block.present_height_m = 0.0;
      impl_.physics->set_height(index, 0.0);
      begin_motion(index, BlockPhase::kRising);
    }
    record(slow ? ArenaEventKind::kRising : ArenaEventKind::kExtended, block.name);
    return std::nullopt;
  }
  const std::string& name = impl_.name_of_body(robot);
  const std::string reason = "obstacle \"" + block.name + "\" cannot be extended: " +
                             (robot < impl_.physics->robot_count() ? "a robot" : "an obstacle") +
                             " stands on it";
  if (block.when_blocked == WhenBlocked::kRefuse) {
    impl_.record(ArenaEventKind::kRefused, block.name, name, reason);
    return reason;
  }
  const bool waits = std::any_of(motions_.begin(), motions_.end(),
                                 [&](const BlockMotion& m) { return m.obstacle == index; });
  if (waits) return std::nullopt;
  begin_motion(index, BlockPhase::kRetracted);
  impl_.record(ArenaEventKind::kWaiting, block.name, name, reason);
  return std::nullopt;
}

void Simulation::Impl::Blocks::move(double dt_s) {
  const std::vector<BlockMotion> moving = motions_;  // the loop changes it
  for (const auto& [index, phase] : moving) {
    ObstacleDescription& block = impl_.obstacle(index);
    if (phase == BlockPhase::kRetracted) {
      if (impl_.physics->robot_on(index) < 0) static_cast<void>(set(index, true));
      continue;
    }
    SIM_ASSERT(block.present_height_m.has_value());
    const double way_m = block.rise_speed_mps * dt_s;
    double& height_m = *block.present_height_m;
    height_m += phase == BlockPhase::kRising ? way_m : -way_m;
    if (height_m > 0.0 && height_m < block.height_m) {
      impl_.physics->set_height(index, height_m);
      continue;
    }
    end_motion(index);
    block.present_height_m.reset();
    impl_.physics->set_height(index, block.height_m);
    if (phase == BlockPhase::kRising) {
      record(ArenaEventKind::kExtended, block.name);
    } else {
      set_enabled(index, false);
      record(ArenaEventKind::kRetracted, block.name);
    }
  }
}

std::vector<MovingBlock> Simulation::Impl::Blocks::moving() const {
  std::vector<MovingBlock> all;
  for (const auto& [index, phase] : motions_) {
    all.push_back({index, phase, impl_.obstacle(index).present_height_m.value_or(0.0)});
  }
  return all;
}

void Simulation::Impl::Blocks::archive(StateArchive& archive) {
  int last = -1;
  archive.list(motions_, [&](BlockMotion& motion) {
    archive.index(motion.obstacle, impl_.world.arena.obstacles.size());
    archive.choice(motion.phase, BlockPhase::kSinking);
    ObstacleDescription& block = impl_.obstacle(motion.obstacle);
    const bool waits = motion.phase == BlockPhase::kRetracted;
    archive(block.present_height_m);
    const bool can_be = motion.obstacle > last && block.type == ObstacleType::kDynamic &&
                        block.carried_by < 0 && motion.phase != BlockPhase::kExtended &&
                        waits == (block.state == ObstacleState::kRetracted) &&
                        waits != block.present_height_m.has_value() &&
                        (waits || block.rise_speed_mps > 0.0) &&
                        block.present_height_m.value_or(0.0) >= 0.0 &&
                        block.present_height_m.value_or(0.0) <= block.height_m;
    archive.expect(can_be, "blocks that move");
    last = motion.obstacle;
  });
}

// --- Simulation

std::optional<std::string> Simulation::set_obstacle_state(const std::string& name,
                                                          ObstacleState state) {
  ++interventions_;
  int index = 0;
  if (auto reason = impl_->blocks->find_free(name, index)) return reason;
  return impl_->blocks->set(index, state == ObstacleState::kExtended);
}

std::vector<MovingBlock> Simulation::moving_blocks() const { return impl_->blocks->moving(); }

}  // namespace sim
