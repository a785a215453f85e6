// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Simulated seconds a processor second in a hall of 16 x 16 m with 24 boxes. Each robot has a laser
// with 682 beams at 10 Hz and wanders by the same rule, as in comparisons with other simulators.
// `bench_field --hall N` prints the hall with N robots instead, and `bench_field --arena N` the
// SyRoTek arena with N places for a robot, for the programs of other simulators.
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "crowd.h"
#include "figures.h"
#include "playerlike/host/host.h"
#include "wanderers.h"

namespace sim::bench {
namespace {

constexpr double kSide_m = 16.0;
constexpr int kBoxes = 24;

// @param step_s  length of a step; commands are given, and scans measured, every 0.1 s.
WorldDescription hall(int robots, const std::string& step_s) {
  std::string boxes;
  for (int i = 1; i <= kBoxes; ++i) {
    boxes += std::string(i == 1 ? "" : ", ") + R"({"center": [)" +
             std::to_string(kSide_m * van_der_corput(i, 2)) + ", " +
             std::to_string(kSide_m * van_der_corput(i, 3)) +
             R"(], "size": [0.6, 0.6], "type": "static"})";
  }
  WorldDescription world =
      load_world_text(R"({"simulation": {"step": )" + step_s + R"(}, "canvas": {"cell_size": 0.1},
          "arena": {"size": [16, 16], "obstacles": [)" +
                      boxes + R"(]},
          "robots": [{"pose": {"x": 1, "y": 1},
                      "devices": {"laser": {}, "pose": {}, "motion": {}}}]})");
  return crowd_of(std::move(world), robots, {});
}

// The best of several rounds. The simulations take turns, so that a slow moment of the machine
// affects all.
void print_figures(int robots) {
  constexpr int kTurns = 20;
  const int rounds = std::max(20, 2000 / robots);  // of 0.1 s each
  const WorldDescription world = hall(robots, "0.01");
  Alone alone(world, 10);
  Alone coarse(hall(robots, "0.1"), 1);
  Clients clients(playerlike::Host::create(world));
  Clients coarse_clients(playerlike::Host::create(hall(robots, "0.1")));
  double best_us[] = {1e30, 1e30, 1e30, 1e30};
  const auto measure = [rounds](auto& robots_of, double& best) {
    best = std::min(best, used_us([&] {
                      for (int i = 0; i < rounds; ++i) robots_of.wander();
                    }));
  };
  for (int turn = 0; turn < kTurns; ++turn) {
    measure(alone, best_us[0]);
    measure(coarse, best_us[1]);
    measure(clients, best_us[2]);
    measure(coarse_clients, best_us[3]);
  }
  const char* const names[] = {"alone_10ms", "alone_100ms", "clients_10ms", "clients_100ms"};
  for (std::size_t i = 0; i < std::size(names); ++i) {
    figure(("field_" + std::string(names[i]) + "_" + std::to_string(robots)).c_str(),
           0.1 * rounds * 1e6 / best_us[i]);
  }
}

// The laser's beams, the angle of the first one, the angle between two, range and place before the
// robot's centre; the outline of a robot.
void print_robot() {
  const LaserParams laser;
  std::printf("laser %d %.17g %.17g %.17g %.17g\n", laser.beam_count,
              -0.5 * (laser.beam_count - 1) * laser.resolution_rad, laser.resolution_rad,
              laser.range_max_m, laser.X_BL.x_m);
  std::printf("footprint");
  for (const Vec2& p_BV : default_robot_model().footprint)
    std::printf(" %.17g %.17g", p_BV.x(), p_BV.y());
  std::printf("\n");
}

// One thing a line, its name first, in metres and radians: the side of the square floor, which
// begins at the origin; the robot; each box; each robot's pose.
void print_hall(int robots) {
  const WorldDescription world = hall(robots, "0.1");
  std::printf("side %.17g\n", kSide_m);
  print_robot();
  for (const ObstacleDescription& box : world.arena.obstacles) {
    std::printf("box %.17g %.17g %.17g %.17g\n", box.center.x(), box.center.y(), box.size.x(),
                box.size.y());
  }
  for (const RobotDescription& robot : world.robots) {
    std::printf("robot %.17g %.17g %.17g\n", robot.pose.x_m, robot.pose.y_m, robot.pose.yaw_rad);
  }
}

void print_outline(const std::vector<Vec2>& corners) {
  std::printf("outline");
  for (const Vec2& corner : corners) std::printf(" %.17g %.17g", corner.x(), corner.y());
  std::printf("\n");
}

// The robot; the corners of the room and of each block; and poses with other headings at one place,
// as in bench_parallel.
void print_arena(int poses) {
  const ArenaDescription arena = syrotek_arena();
  print_robot();
  print_outline(box_corners({0.5 * arena.size.x(), 0.5 * arena.size.y(), 0.0}, arena.size));
  for (const ObstacleDescription& block : arena.obstacles) {
    if (block.type == ObstacleType::kStatic) print_outline(box_corners(block));
  }
  for (const ObstacleDescription& block : arena.dock_separators) print_outline(box_corners(block));
  for (int i = 0; i < poses; ++i) std::printf("robot 0.5 0.4 %.17g\n", 6.28 * i / poses);
}

}  // namespace
}  // namespace sim::bench

int main(int argc, char** argv) {
  if (argc == 1) {
    for (const int robots : {1, 13, 100}) sim::bench::print_figures(robots);
    return 0;
  }
  int robots = 0;
  if (argc == 3) {
    const char* const end = argv[2] + std::strlen(argv[2]);
    if (std::from_chars(argv[2], end, robots).ptr != end) robots = 0;
  }
  if (robots > 0 && std::strcmp(argv[1], "--hall") == 0) {
    sim::bench::print_hall(robots);
  } else if (robots > 0 && std::strcmp(argv[1], "--arena") == 0) {
    sim::bench::print_arena(robots);
  } else {
    std::fprintf(stderr, "usage: bench_field [--hall | --arena NUMBER_OF_ROBOTS]\n");
    return 2;
  }
}
