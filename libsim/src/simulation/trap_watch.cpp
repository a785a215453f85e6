// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "simulation/trap_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "sim/world/outline.h"
#include "world/find_named.h"

namespace sim {
namespace {

// Subtracted from each bound, because positions and distances are rounded.
constexpr double kRounding_m = 1e-9;

// Whether a point is inside a region, and a lower bound of its distance from the border.
struct Look {
  bool inside;
  double margin_m;
};

Look look(const TrapWatch::Region& region, const Vec2& p) {
  if (region.corners.empty()) {
    const double distance_m = (p - region.center).norm();
    return {distance_m <= region.radius_m, std::abs(distance_m - region.radius_m)};
  }
  const Vec2 beyond = (region.low - p).cwiseMax(p - region.high).cwiseMax(Vec2::Zero());
  if (beyond.x() > 0.0 || beyond.y() > 0.0) return {false, beyond.norm()};
  double margin_m = std::numeric_limits<double>::infinity();
  const std::size_t n = region.corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    margin_m = std::min(margin_m,
                        distance_to_segment_m(p, region.corners[i], region.corners[(i + 1) % n]));
  }
  return {is_inside(region.corners, p), margin_m};
}

// The region without the target that it may follow.
TrapWatch::Region region_of(const TrapRegion& description) {
  TrapWatch::Region region;
  if (const auto* box = std::get_if<BoxRegion>(&description)) {
    region.corners = box_corners({box->center.x(), box->center.y(), box->yaw_rad}, box->size);
  } else if (const auto* circle = std::get_if<CircleRegion>(&description)) {
    region.center = circle->center;
    region.radius_m = circle->radius_m;
  } else if (const auto* polygon = std::get_if<PolygonRegion>(&description)) {
    region.corners = polygon->corners;
  }
  if (region.corners.empty()) return region;
  region.low = region.high = region.corners.front();
  for (const Vec2& corner : region.corners) {
    region.low = region.low.cwiseMin(corner);
    region.high = region.high.cwiseMax(corner);
  }
  return region;
}

}  // namespace

TrapWatch::TrapWatch(const WorldDescription& world) : robots_(world.robots.size()) {
  for (const TrapDescription& trap : world.controller.traps) {
    Region region = region_of(trap.region);
    const auto* near = std::get_if<NearRegion>(&trap.region);
    if (near != nullptr) add_target(region, *near, world);
    const auto index = static_cast<std::uint32_t>(regions_.size());
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      const RobotDescription& robot = world.robots[i];
      const auto& named = trap.robots;
      if (!named.empty() && std::find(named.begin(), named.end(), robot.name) == named.end()) {
        continue;
      }
      if (!trap.model.empty() && robot.model != trap.model) continue;
      if (near != nullptr && near->object == robot.name) continue;
      robots_[i].traps.push_back(index);
    }
    regions_.push_back(std::move(region));
    enabled_.push_back(trap.enabled ? 1 : 0);
  }
  inside_.resize(regions_.size() * robots_.size());
}

void TrapWatch::add_target(Region& region, const NearRegion& near, const WorldDescription& world) {
  const int robot = find_named(world.robots, near.object).value_or(-1);
  const int obstacle =
      robot >= 0 ? -1 : find_named(world.arena.obstacles, near.object).value_or(-1);
  const auto known = std::find_if(targets_.begin(), targets_.end(), [&](const Target& target) {
    return target.robot == robot && target.obstacle == obstacle;
  });
  region.radius_m = near.distance_m;
  region.target = static_cast<int>(known - targets_.begin());
  if (known == targets_.end()) targets_.push_back({robot, obstacle});
}

Vec2 TrapWatch::position(const Target& target, const PhysicsWorld& physics,
                         const WorldDescription& world) {
  return target.robot >= 0
             ? physics.body(target.robot).X_WB.position()
             : world.arena.obstacles[static_cast<std::size_t>(target.obstacle)].center;
}

TrapWatch::Region TrapWatch::region(std::size_t trap, const PhysicsWorld& physics,
                                    const WorldDescription& world) const {
  Region region = regions_[trap];
  if (region.target >= 0) {
    region.center = position(targets_[static_cast<std::size_t>(region.target)], physics, world);
  }
  return region;
}

// Returns how far any target has moved.
double TrapWatch::move_targets(const PhysicsWorld& physics, const WorldDescription& world) {
  double farthest_m = 0.0;
  for (Target& target : targets_) {
    const Vec2 now = position(target, physics, world);
    farthest_m = std::max(farthest_m, (now - target.last).norm());
    target.last = now;
  }
  return farthest_m;
}

const std::vector<TrapWatch::Change>& TrapWatch::update(const PhysicsWorld& physics,
                                                        const WorldDescription& world) {
  changes_.clear();
  const double target_move_m = targets_.empty() ? 0.0 : move_targets(physics, world);
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    Robot& robot = robots_[i];
    const Pose& X_WB = physics.body(static_cast<int>(i)).X_WB;
    const Vec2 p = X_WB.position();
    const double move_m = (p - robot.last).norm() + target_move_m;
    robot.last = p;
    robot.slack_m -= move_m;
    robot.far_slack_m -= move_m;
    if (robot.slack_m > 0.0) continue;
    const auto index = static_cast<std::uint32_t>(i);
    if (robot.far_slack_m > 0.0) {
      test_near(index, p);
    } else {
      test_all(index, p);
    }
  }
  if (changes_.size() > 1) {
    std::sort(changes_.begin(), changes_.end(), [](const Change& a, const Change& b) {
      return std::tie(a.trap, a.robot) < std::tie(b.trap, b.robot);
    });
  }
  return changes_;
}

// Tests one trap. Returns the bound of its border.
double TrapWatch::test(std::uint32_t trap, std::uint32_t robot, const Vec2& p) {
  Region& region = regions_[trap];
  if (region.target >= 0) region.center = targets_[static_cast<std::size_t>(region.target)].last;
  const Look now = look(region, p);
  std::uint8_t& inside = inside_[trap * robots_.size() + robot];
  if (now.inside != (inside != 0)) {
    inside = now.inside ? 1 : 0;
    changes_.push_back({trap, robot, now.inside});
  }
  return now.margin_m - kRounding_m;
}

void TrapWatch::test_near(std::uint32_t robot, const Vec2& p) {
  Robot& r = robots_[robot];
  r.slack_m = r.far_slack_m;
  for (std::uint32_t k = 0; k < r.near_count; ++k) {
    r.slack_m = std::min(r.slack_m, test(r.near[k], robot, p));
  }
}

void TrapWatch::test_all(std::uint32_t robot, const Vec2& p) {
  Robot& r = robots_[robot];
  std::array<double, kNear + 1> margins_m{};  // of the nearest, in rising order
  std::size_t count = 0;
  r.far_slack_m = std::numeric_limits<double>::infinity();
  for (const std::uint32_t trap : r.traps) {
    if (enabled_[trap] == 0) continue;
    const double margin_m = test(trap, robot, p);
    if (count == kNear && margin_m >= margins_m[kNear - 1]) {
      r.far_slack_m = std::min(r.far_slack_m, margin_m);
      continue;
    }
    if (count == kNear) r.far_slack_m = std::min(r.far_slack_m, margins_m[--count]);
    std::size_t at = count++;
    for (; at > 0 && margins_m[at - 1] > margin_m; --at) {
      margins_m[at] = margins_m[at - 1];
      r.near[at] = r.near[at - 1];
    }
    margins_m[at] = margin_m;
    r.near[at] = trap;
  }
  r.near_count = static_cast<std::uint32_t>(count);
  r.slack_m = count > 0 ? std::min(margins_m[0], r.far_slack_m) : r.far_slack_m;
}

void TrapWatch::forget_bounds() {
  for (Robot& robot : robots_) robot.slack_m = robot.far_slack_m = 0.0;
}

void TrapWatch::set_enabled(std::size_t trap, bool enabled) {
  enabled_[trap] = enabled ? 1 : 0;
  const auto first = inside_.begin() + static_cast<std::ptrdiff_t>(trap * robots_.size());
  std::fill_n(first, robots_.size(), std::uint8_t{0});
  forget_bounds();
}

void TrapWatch::archive(StateArchive& archive) {
  const std::size_t count = inside_.size();
  archive(enabled_, inside_);
  const auto is_flag = [](std::uint8_t flag) { return flag <= 1; };
  archive.expect(enabled_.size() == regions_.size() && inside_.size() == count, "all traps");
  archive.expect(std::all_of(enabled_.begin(), enabled_.end(), is_flag) &&
                     std::all_of(inside_.begin(), inside_.end(), is_flag),
                 "0 or 1");
  if (archive.reading()) forget_bounds();
}

}  // namespace sim
