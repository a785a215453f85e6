// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Programs that try to pass a task of the course without doing what it asks for: one for each name.
//
//     attack_programs NAME [--goal-x=X --goal-y=Y]
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "libCCMorse/ArenaProxy.h"
#include "libCCMorse/CCMorse.h"
#include "libplayerc++/playerc++.h"
#include "par_common/distance.h"
#include "par_common/path_follower.h"
#include "par_common/planners.h"
#include "sim/simulation/simulation.h"
#include "sim/world/occupancy_map.h"

namespace {

using CCMorse::GridMapLayer;
using CCMorse::PlayerClient;
using CCMorse::Position2dProxy;
using CCMorse::WindowProxy;

constexpr int kColumns = 172;
constexpr int kRows = 186;
constexpr double kCell_m = 0.02;

/// What the program was called with.
struct Call {
  std::map<std::string, double> numbers;
};

// --- Maps ----------------------------------------------------------------------------------------

/// Draws a map on the layer that the exploration tasks judge.
void draw(PlayerClient& client, const std::function<bool(int column, int row)>& is_solid) {
  WindowProxy& window = WindowProxy::GetInstance(&client, kColumns, kRows);
  GridMapLayer& layer = window.CreateLayer("occupancy", GridMapLayer::GREY, 1);
  layer.SetColour("#000000");
  std::vector<double> cells;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      cells.push_back(is_solid(column, row) ? 1.0 : 0.0);
    }
  }
  layer.SetCells(cells);
  client.Read();
  delete &window;
}

par::Mask map_of_the_server(PlayerClient& client) {
  CCMorse::MapProxy map(&client, 0);
  map.RequestMap();
  par::GridFrame frame;
  frame.width = static_cast<int>(map.GetWidth());
  frame.height = static_cast<int>(map.GetHeight());
  frame.cell_size_m = map.GetResolution();
  frame.origin = {map.GetOriginX(), map.GetOriginY()};
  par::Mask walls(frame);
  for (int row = 0; row < frame.height; ++row) {
    for (int column = 0; column < frame.width; ++column) {
      walls[{column, row}] = map.GetCell(column, frame.height - 1 - row) < 0 ? 0 : 1;
    }
  }
  return walls;
}

/// The server's map as one's own.
void draw_map_of_the_server(const Call& /*call*/) {
  PlayerClient client("localhost", 6665);
  client.Read();
  const par::Mask walls = map_of_the_server(client);
  draw(client, [&](int column, int row) {
    return walls.contains({column, row}) && walls[{column, row}] != 0;
  });
}

/// A map that the program knows beforehand, in an arena whose blocks stand as `blocks` says.
void draw_known_map(PlayerClient& client, const std::map<std::string, bool>& blocks) {
  sim::ArenaDescription arena = sim::load_world(std::getenv("PLAYPEN_WORLD")).arena;
  for (sim::ObstacleDescription& obstacle : arena.obstacles) {
    const auto block = blocks.find(obstacle.name);
    if (block == blocks.end()) continue;
    obstacle.state = block->second ? sim::ObstacleState::kExtended : sim::ObstacleState::kRetracted;
  }
  sim::CanvasDescription grid;
  grid.width = kColumns;
  grid.height = kRows;
  grid.cell_size_m = kCell_m;
  const sim::OccupancyMap map = sim::true_map(arena, grid);
  draw(client, [&map](int column, int row) { return map.at(column, row) > 0.5F; });
}

void know_the_map(const Call& /*call*/) {
  PlayerClient client("localhost", 6665);
  client.Read();
  draw_known_map(client, {});
}

/// Stands still until the arena is at rest, and draws what it knows and what the arena tells.
void wait_and_know_the_map(const Call& /*call*/) {
  PlayerClient client("localhost", 6665);
  CCMorse::ArenaProxy arena(&client);
  for (int i = 0; i < 1400; ++i) client.Read();
  std::map<std::string, bool> blocks;
  for (const std::string& name : arena.GetBlockNames())
    blocks[name] = arena.GetBlockState(name) == "extended";
  draw_known_map(client, blocks);
}

/// As above, with the server's map.
void wait_and_draw_map_of_the_server(const Call& call) {
  PlayerClient client("localhost", 6665);
  for (int i = 0; i < 1400; ++i) client.Read();
  draw_map_of_the_server(call);
}

// --- Movements on the spot -----------------------------------------------------------------------

void drive(const std::function<void(int, double&, double&)>& speeds) {
  PlayerClient client("localhost", 6665);
  Position2dProxy position(&client, 0);
  position.SetMotorEnable(true);
  for (int i = 0;; ++i) {
    double speed = 0.0;
    double turn_rate = 0.0;
    speeds(i, speed, turn_rate);
    position.SetSpeed(speed, turn_rate);
    client.Read();
  }
}

/// 4 cm to and fro.
void wiggle(const Call& /*call*/) {
  drive([](int i, double& speed, double& /*turn_rate*/) { speed = i / 2 % 2 == 0 ? 0.2 : -0.2; });
}

/// Circles of 5 cm.
void spin(const Call& /*call*/) {
  drive([](int /*i*/, double& speed, double& turn_rate) {
    speed = 0.15;
    turn_rate = 3.0;
  });
}

/// Circles of 15 cm.
void circle(const Call& /*call*/) {
  drive([](int /*i*/, double& speed, double& turn_rate) {
    speed = 0.15;
    turn_rate = 2.0;
  });
}

/// 60 cm to and fro.
void shuttle(const Call& /*call*/) {
  drive([](int i, double& speed, double& /*turn_rate*/) { speed = i / 30 % 2 == 0 ? 0.2 : -0.2; });
}

/// Stands still; a second client wiggles.
void wiggle_by_another_client(const Call& call) {
  const PlayerClient client("localhost", 4000);
  wiggle(call);
}

// --- Other means of knowing and driving ----------------------------------------------------------

using PoseSource = std::function<par::Pose()>;

/// Drives a robot to a place on the server's map, by a pose from anywhere.
void drive_to(PlayerClient& client, Position2dProxy& position, const PoseSource& pose,
              const par::Point& goal) {
  const par::Mask inflated = par::inflate(map_of_the_server(client), 0.13);
  const par::GridFrame& frame = inflated.frame();
  const par::Pose start = pose();
  const auto from = par::nearest_free(inflated, frame.cell_of({start.x, start.y}), 0.3);
  const auto to = par::nearest_free(inflated, frame.cell_of(goal), 0.3);
  if (!from || !to) return;
  par::FollowerParams params;
  params.max_speed_mps = 0.4;
  params.goal_tolerance_m = 0.03;
  par::PathFollower follower(params);
  std::vector<par::Point> points =
      par::to_points(frame, par::theta_star(inflated, *from, *to).cells);
  points.push_back(goal);
  follower.set_path(points);
  position.SetMotorEnable(true);
  while (!follower.done()) {
    const par::Velocity velocity = follower.update(pose());
    position.SetSpeed(velocity.forward_mps, velocity.turn_radps);
    client.Read();
  }
  position.SetSpeed(0.0, 0.0);
  client.Read();
}

/// The true pose of an object, from the simulation.
PoseSource true_pose_of(PlayerCc::SimulationProxy& simulation, const std::string& object) {
  return [&simulation, object] {
    std::string name = object;
    par::Pose pose;
    simulation.GetPose2d(name.data(), pose.x, pose.y, pose.yaw);
    return pose;
  };
}

/// Knows its place from the simulation.
void ask_for_the_pose(const Call& call) {
  PlayerClient client("localhost", 6665);
  Position2dProxy position(&client, 0);
  PlayerCc::SimulationProxy simulation(&client, 0);
  client.Read();
  drive_to(client, position, true_pose_of(simulation, "r1"),
           {call.numbers.at("--goal-x"), call.numbers.at("--goal-y")});
}

/// Lets itself be put at the goal.
void teleport(const Call& call) {
  PlayerClient client("localhost", 6665);
  PlayerCc::SimulationProxy simulation(&client, 0);
  client.Read();
  std::string name = "r1";
  simulation.SetPose2d(name.data(), call.numbers.at("--goal-x"), call.numbers.at("--goal-y"), 0.0);
  client.Read();
}

/// Lets the server plan.
void ask_the_planner(const Call& call) {
  PlayerClient client("localhost", 6665);
  PlayerCc::PlannerProxy planner(&client, 0);
  planner.RequestWaypoints();
  planner.SetGoalPose(call.numbers.at("--goal-x"), call.numbers.at("--goal-y"), 0.0);
  while (planner.GetPathDone() == 0) client.Read();
}

/// Drives the fox to the robot, by a port of its own or by the port of all robots.
void drive_the_fox(int port, unsigned index) {
  PlayerClient client("localhost", static_cast<unsigned>(port));
  Position2dProxy fox(&client, index);
  while (!fox.IsFresh()) client.Read();
  const PoseSource pose = [&fox] { return par::Pose{fox.GetXPos(), fox.GetYPos(), fox.GetYaw()}; };
  drive_to(client, fox, pose, {0.5, 0.6});
  for (;;) client.Read();
}
void drive_the_fox_by_its_port(const Call& /*call*/) { drive_the_fox(6666, 0); }
void drive_the_fox_by_the_port_of_all(const Call& /*call*/) { drive_the_fox(4000, 1); }

/// Drives to where the fox says that it is.
void follow(PlayerClient& client, const PoseSource& fox) {
  Position2dProxy position(&client, 0);
  while (!position.IsFresh()) client.Read();
  const PoseSource own = [&position] {
    return par::Pose{position.GetXPos(), position.GetYPos(), position.GetYaw()};
  };
  const par::Mask inflated = par::inflate(map_of_the_server(client), 0.13);
  const par::GridFrame& frame = inflated.frame();
  position.SetMotorEnable(true);
  par::FollowerParams params;
  params.max_speed_mps = 0.4;
  par::PathFollower follower(params);
  for (int i = 0;; ++i) {
    if (i % 5 == 0) {
      const par::Pose from = own();
      const par::Pose to = fox();
      const auto start = par::nearest_free(inflated, frame.cell_of({from.x, from.y}), 0.3);
      const auto goal = par::nearest_free(inflated, frame.cell_of({to.x, to.y}), 0.3);
      if (start && goal) {
        follower.set_path(par::to_points(frame, par::theta_star(inflated, *start, *goal).cells));
      }
    }
    const par::Velocity velocity = follower.update(own());
    position.SetSpeed(velocity.forward_mps, velocity.turn_radps);
    client.Read();
  }
}

void read_the_sensors_of_the_fox(const Call& /*call*/) {
  PlayerClient client("localhost", 4000);
  Position2dProxy fox(&client, 1);
  while (!fox.IsFresh()) client.Read();
  follow(client, [&fox] { return par::Pose{fox.GetXPos(), fox.GetYPos(), fox.GetYaw()}; });
}

void ask_where_the_fox_is(const Call& /*call*/) {
  PlayerClient client("localhost", 6665);
  PlayerCc::SimulationProxy simulation(&client, 0);
  client.Read();
  follow(client, true_pose_of(simulation, "fox"));
}

const std::map<std::string, void (*)(const Call&)> kAttacks = {
    {"draw_map_of_the_server", draw_map_of_the_server},
    {"know_the_map", know_the_map},
    {"wait_and_know_the_map", wait_and_know_the_map},
    {"wait_and_draw_map_of_the_server", wait_and_draw_map_of_the_server},
    {"wiggle", wiggle},
    {"spin", spin},
    {"circle", circle},
    {"shuttle", shuttle},
    {"wiggle_by_another_client", wiggle_by_another_client},
    {"ask_for_the_pose", ask_for_the_pose},
    {"teleport", teleport},
    {"ask_the_planner", ask_the_planner},
    {"drive_the_fox_by_its_port", drive_the_fox_by_its_port},
    {"drive_the_fox_by_the_port_of_all", drive_the_fox_by_the_port_of_all},
    {"read_the_sensors_of_the_fox", read_the_sensors_of_the_fox},
    {"ask_where_the_fox_is", ask_where_the_fox_is},
};

}  // namespace

int main(int argc, char** argv) {
  Call call;
  for (int i = 2; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::size_t equals = argument.find('=');
    if (equals == std::string::npos) continue;
    call.numbers[argument.substr(0, equals)] = std::atof(argument.c_str() + equals + 1);
  }
  const auto attack = kAttacks.find(argc > 1 ? argv[1] : "");
  if (attack == kAttacks.end()) {
    std::cerr << "no such attack\n";
    return 2;
  }
  // Under the grader an uncaught end of the run ends the program with status 0. Refusals are not
  // caught either: they end it with an error.
  attack->second(call);
  return 0;
}
