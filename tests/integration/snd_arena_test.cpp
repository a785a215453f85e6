// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// SndDriver in the SyRoTek arena: random blocks, random starts and goals; 50 cases per merge, 200
// in nightly runs.
//
// To run a single case: SND_CASE=17 snd_arena_test
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <limits>
#include <numbers>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "libCCMorse/CCMorse.h"
#include "nightly.h"
#include "patient_host.h"
#include "sim/core/random_stream.h"
#include "sim/simulation/simulation.h"

namespace {

using sim::Vec2;

// The S1R's farthest corner is hypot(0.087, 0.045) = 0.098 m from its centre; 5 cm of clearance.
constexpr double kRadius_m = 0.098 + 0.05;
// Cell size of the planner's grid and of the canvas.
constexpr double kCell_m = 0.02;
// A nearer goal is too easy.
constexpr double kLeastDistance_m = 0.3;
// "Open room": the shortest path is at most this much longer than the straight line. Then a robot
// that sees no farther than its laser gets to the goal mostly by approaching it.
constexpr double kOpenRoom = 1.3;

double distance_to(const sim::ObstacleDescription& box, const Vec2& p_W) {
  const sim::Pose X_WO{box.center.x(), box.center.y(), box.yaw_rad};
  const Vec2 p_O = X_WO.inverse() * p_W;
  return (p_O.cwiseAbs() - 0.5 * box.size).cwiseMax(Vec2::Zero()).norm();
}

/// Distance of a point from everything that is solid [m].
double clearance(const sim::ArenaDescription& arena, const Vec2& p_W) {
  double least_m = std::min({p_W.x(), p_W.y(), arena.size.x() - p_W.x(), arena.size.y() - p_W.y()});
  const auto look_at = [&](const sim::ObstacleDescription& box) {
    // Skip a box whose circumscribed circle is not nearer than the current minimum.
    if ((p_W - box.center).norm() - 0.5 * box.size.norm() >= least_m) return;
    least_m = std::min(least_m, distance_to(box, p_W));
  };
  for (const auto& box : arena.obstacles) {
    if (box.state == sim::ObstacleState::kExtended) look_at(box);
  }
  for (const auto& box : arena.dock_separators) look_at(box);
  return least_m;
}

/// The planner: Dijkstra's algorithm over 8 neighbours, on cells whose centre has room for the
/// robot and the clearance.
class Planner {
 public:
  explicit Planner(const sim::ArenaDescription& arena)
      : width_(static_cast<int>(arena.size.x() / kCell_m)),
        height_(static_cast<int>(arena.size.y() / kCell_m)) {
    for (int i = 0; i < width_ * height_; ++i) {
      free_.push_back(clearance(arena, middle(i)) >= kRadius_m);
    }
  }

  [[nodiscard]] bool is_free(const Vec2& p_W) const {
    return free_[static_cast<std::size_t>(cell(p_W))];
  }

  /// Length of the shortest path on the grid [m]; infinity if there is none.
  [[nodiscard]] double path_m(const Vec2& from, const Vec2& to) const {
    std::vector<double> length_m(free_.size(), std::numeric_limits<double>::infinity());
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    length_m[static_cast<std::size_t>(cell(from))] = 0.0;
    open.emplace(0.0, cell(from));
    while (!open.empty()) {
      const auto [at_m, i] = open.top();
      open.pop();
      if (i == cell(to)) return at_m;
      if (at_m > length_m[static_cast<std::size_t>(i)]) continue;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int x = i % width_ + dx;
          const int y = i / width_ + dy;
          if (x < 0 || y < 0 || x >= width_ || y >= height_) continue;
          const auto j = static_cast<std::size_t>(y * width_ + x);
          const double next_m = at_m + kCell_m * std::hypot(dx, dy);
          if (!free_[j] || next_m >= length_m[j]) continue;
          length_m[j] = next_m;
          open.emplace(next_m, static_cast<int>(j));
        }
      }
    }
    return std::numeric_limits<double>::infinity();
  }

 private:
  [[nodiscard]] int cell(const Vec2& p_W) const {
    return std::min(static_cast<int>(p_W.y() / kCell_m), height_ - 1) * width_ +
           std::min(static_cast<int>(p_W.x() / kCell_m), width_ - 1);
  }
  [[nodiscard]] Vec2 middle(int i) const {
    return kCell_m * Vec2(i % width_ + 0.5, i / width_ + 0.5);
  }

  int width_;
  int height_;
  std::vector<bool> free_;
};

struct Case {
  sim::WorldDescription world;
  Vec2 goal = Vec2::Zero();
  double straight_m = 0.0;
  double path_m = 0.0;
  /// the robot fits along the whole straight line, with 5 cm of clearance
  bool clear_line = false;
  [[nodiscard]] bool open() const { return clear_line || path_m <= kOpenRoom * straight_m; }
};

/// Case number k: each block is extended at random; start, heading and goal are random, with 5 cm
/// of clearance and a path between them.
Case make_case(int k) {
  sim::RandomStream random(static_cast<std::uint64_t>(k), "snd");
  Case c;
  c.world = sim::load_world("");
  for (auto& block : c.world.arena.obstacles) {
    if (block.type != sim::ObstacleType::kDynamic) continue;
    block.state =
        random.uniform() < 0.5 ? sim::ObstacleState::kExtended : sim::ObstacleState::kRetracted;
  }
  const sim::ArenaDescription& arena = c.world.arena;
  const Planner planner(arena);
  const auto anywhere = [&] {
    while (true) {
      const double x_m = random.uniform() * arena.size.x();
      const double y_m = random.uniform() * arena.size.y();
      const Vec2 p(x_m, y_m);
      if (clearance(arena, p) >= kRadius_m && planner.is_free(p)) return p;
    }
  };
  Vec2 start = Vec2::Zero();
  do {
    start = anywhere();
    c.goal = anywhere();
    c.straight_m = (c.goal - start).norm();
    c.path_m = c.straight_m < kLeastDistance_m ? std::numeric_limits<double>::infinity()
                                               : planner.path_m(start, c.goal);
  } while (std::isinf(c.path_m));
  const double yaw_rad = (2.0 * random.uniform() - 1.0) * std::numbers::pi;
  c.world.robots[0].pose = {start.x(), start.y(), yaw_rad};
  const int steps = static_cast<int>(c.straight_m / 0.005) + 1;
  c.clear_line = true;
  for (int i = 0; i <= steps; ++i) {
    const Vec2 p = start + (c.goal - start) * i / steps;
    c.clear_line = c.clear_line && clearance(arena, p) >= kRadius_m;
  }
  return c;
}

struct Outcome {
  CCMorse::SndDriver::Status status = CCMorse::SndDriver::IDLE;
  double from_goal_m = 0.0;  ///< distance of the robot from the goal at the end
  bool collided = false;
  double time_s = 0.0;
};

Outcome run(const Case& c) {
  Outcome outcome;
  const auto host = test::patient_host(c.world);
  CCMorse::PlayerClient client(host->connect(6665));
  CCMorse::Position2dProxy position(&client, 0);
  CCMorse::SndDriver driver(&client);
  driver.SetGoal(c.goal.x(), c.goal.y());
  // Far more than the longest path takes: the driver itself must end the journey.
  outcome.status = driver.WaitForGoal(300.0);
  outcome.from_goal_m =
      std::hypot(position.GetXPos() - c.goal.x(), position.GetYPos() - c.goal.y());
  outcome.time_s = CCMorse::MorseTime(client).Now();
  outcome.collided = host->statistics(0).collisions > 0;
  return outcome;
}

std::string name_of(CCMorse::SndDriver::Status status) {
  constexpr std::array kNames{"idle", "moving", "reached", "blocked"};
  return kNames.at(static_cast<std::size_t>(status));
}

TEST(SndArena, OpenGoals_ReachedWithoutCollision) {
  const char* only = std::getenv("SND_CASE");
  int open = 0;
  int open_reached = 0;
  int clear = 0;
  int clear_reached = 0;
  int reached = 0;
  int blocked = 0;
  const int first = only == nullptr ? 0 : std::atoi(only);
  const int end = only == nullptr ? test_support::cases(50, 200) : first + 1;
  for (int k = first; k < end; ++k) {
    const Case c = make_case(k);
    const Outcome outcome = run(c);
    const bool arrived = outcome.status == CCMorse::SndDriver::REACHED;
    if (only != nullptr || outcome.collided || (c.open() && !arrived)) {
      const sim::Pose& start = c.world.robots[0].pose;
      std::cout << "case " << k << ": (" << start.x_m << ", " << start.y_m << ") to (" << c.goal.x()
                << ", " << c.goal.y() << "), straight " << c.straight_m << " m, way " << c.path_m
                << " m" << (c.clear_line ? ", clear line" : "") << ": " << name_of(outcome.status)
                << " after " << outcome.time_s << " s, " << outcome.from_goal_m << " m off"
                << (outcome.collided ? ", COLLIDED" : "") << '\n';
    }
    EXPECT_FALSE(outcome.collided) << "case " << k;
    // Every case ends: no robot circles for ever.
    EXPECT_TRUE(arrived || outcome.status == CCMorse::SndDriver::BLOCKED) << "case " << k;
    // The tolerance is 5 cm; the robot stands still when it has reached the goal.
    if (arrived) {
      EXPECT_LE(outcome.from_goal_m, 0.05 + 0.001) << "case " << k;
    }
    reached += arrived ? 1 : 0;
    blocked += outcome.status == CCMorse::SndDriver::BLOCKED ? 1 : 0;
    open += c.open() ? 1 : 0;
    open_reached += c.open() && arrived ? 1 : 0;
    clear += c.clear_line ? 1 : 0;
    clear_reached += c.clear_line && arrived ? 1 : 0;
  }
  std::cout << "reached: " << reached << " of " << end - first << "; with a clear line "
            << clear_reached << " of " << clear << "; with that or in open room " << open_reached
            << " of " << open << "; blocked: " << blocked << '\n';
  EXPECT_EQ(clear_reached, clear);
  if (only == nullptr) {
    EXPECT_GE(open_reached, 0.97 * open);
  }
}

}  // namespace
