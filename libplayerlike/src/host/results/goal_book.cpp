// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/results/goal_book.h"

#include <variant>

#include "sim/devices/motion.h"
#include "sim/devices/waypoint.h"

namespace playerlike {
namespace {

constexpr double kSamePlace_m = 1e-3;

// Returns the position goal of the motors in W, or none if the motors do not drive to a position.
std::optional<sim::Vec2> place_of(const sim::Simulation& simulation, int robot,
                                  const sim::Command& command) {
  const auto* const position = std::get_if<sim::PositionCommand>(&command);
  if (position == nullptr) return std::nullopt;
  const sim::Vec2 in_frame = position->goal.position();
  if (position->frame < 0 || position->frame >= simulation.device_count(robot)) return in_frame;
  const auto X_FB = simulation.device(robot, position->frame).pose_estimate();
  if (!X_FB) return in_frame;
  return simulation.body(robot).X_WB * (X_FB->inverse() * in_frame);
}

}  // namespace

Goal* GoalBook::newest(int robot) {
  const auto index = static_cast<std::size_t>(robot);
  if (index >= newest_.size() || newest_[index] < 0) return nullptr;
  return &goals_[static_cast<std::size_t>(newest_[index])];
}

void GoalBook::note(int robot, const sim::Vec2& place, double tolerance_m, sim::SimTime now_ns) {
  if (!place.allFinite()) return;
  const Goal* const last = newest(robot);
  if (last != nullptr && (last->place - place).norm() < kSamePlace_m) return;
  if (goals_.size() == kMostGoals) {
    goals_.erase(goals_.begin());
    for (int& index : newest_) index = index < 0 ? -1 : index - 1;
  }
  const auto index = static_cast<std::size_t>(robot);
  if (index >= newest_.size()) newest_.resize(index + 1, -1);
  newest_[index] = static_cast<int>(goals_.size());
  goals_.push_back({robot, place, tolerance_m, now_ns, std::nullopt});
}

void GoalBook::observe(const sim::Simulation& simulation) {
  if (devices_.empty()) {
    for (int robot = 0; robot < simulation.robot_count(); ++robot) {
      Devices& own = devices_.emplace_back();
      for (int device = 0; device < simulation.device_count(robot); ++device) {
        const sim::Device& found = simulation.device(robot, device);
        if (dynamic_cast<const sim::Waypoint*>(&found) != nullptr) own.waypoints.push_back(device);
        if (dynamic_cast<const sim::Motion*>(&found) != nullptr) own.motion = device;
      }
    }
  }
  const sim::SimTime now_ns = simulation.now_ns();
  for (int robot = 0; robot < simulation.robot_count(); ++robot) {
    const Devices& own = devices_[static_cast<std::size_t>(robot)];
    for (const int device : own.waypoints) {
      const auto& waypoint = static_cast<const sim::Waypoint&>(simulation.device(robot, device));
      if (waypoint.status() == sim::WaypointStatus::kTransit) {
        note(robot, waypoint.goal(), waypoint.tolerance_m(), now_ns);
      }
    }
    if (own.motion >= 0) {
      const auto& motion = static_cast<const sim::Motion&>(simulation.device(robot, own.motion));
      if (motion.has_position_goal()) {
        if (const auto place = place_of(simulation, robot, motion.present_command())) {
          note(robot, *place, motion.params().tolerance_m, now_ns);
        }
      }
    }
    Goal* const goal = newest(robot);
    if (goal == nullptr || goal->reached_ns) continue;
    const double distance_m = (simulation.body(robot).X_WB.position() - goal->place).norm();
    if (distance_m <= goal->tolerance_m) goal->reached_ns = now_ns;
  }
}

std::vector<sim::GoalMark> GoalBook::marks() const {
  std::vector<sim::GoalMark> marks;
  marks.reserve(goals_.size());
  for (std::size_t i = 0; i < goals_.size(); ++i) {
    const Goal& goal = goals_[i];
    const bool is_newest = newest_[static_cast<std::size_t>(goal.robot)] == static_cast<int>(i);
    marks.push_back({goal.robot, goal.place, goal.reached_ns.has_value(), is_newest});
  }
  return marks;
}

}  // namespace playerlike
