// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Writes what real Stage measures at random poses, and where its robots get to by some commands;
// for compare_stage.sh. It links libstage and needs no display:
//   stage_scans WORLD POSES SEED >scans.txt
// The lines are described where they are written. Noise is switched off.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "stage_robots.h"

namespace {

using interop::bearing;
using interop::find_robots;
using interop::measure;
using interop::Robot;
using Stg::ModelPosition;
using Stg::ModelRanger;
using Stg::Pose;

/// A free place that a beam from here reaches, with any heading. Places in closed rooms or inside
/// of obstacles are never found.
Pose wander(const Robot& robot, std::mt19937& random) {
  constexpr double kClearance_m = 0.5;
  std::uniform_real_distribution<double> share(0.0, 1.0);
  // The farthest of a few beams, so that the robot does not stay in corners.
  double farthest = 0.0, heading = 0.0;
  for (int tries = 0; tries < 4; ++tries) {
    const auto& sensors = robot.rangers[random() % robot.rangers.size()]->GetSensors();
    if (sensors.empty()) continue;
    const auto& sensor = sensors[random() % sensors.size()];
    if (sensor.ranges.empty()) continue;
    const std::size_t beam = random() % sensor.ranges.size();
    if (sensor.ranges[beam] < farthest) continue;
    farthest = sensor.ranges[beam];
    heading = sensor.pose.a + bearing(sensor, beam);
  }
  Pose pose = robot.body->GetGlobalPose();
  const double distance = share(random) * std::max(0.0, farthest - kClearance_m);
  pose.x += distance * std::cos(pose.a + heading);
  pose.y += distance * std::sin(pose.a + heading);
  pose.a = (2.0 * share(random) - 1.0) * M_PI;
  return pose;
}

double least_range(const Robot& robot) {
  double least = 1e9;
  for (const ModelRanger* ranger : robot.rangers) {
    for (const auto& sensor : ranger->GetSensors()) {
      for (const double range : sensor.ranges) least = std::min(least, range);
    }
  }
  return least;
}

/// pose ROBOT X Y YAW, then for each ranger: ranger INDEX SENSORS, and for each sensor:
/// sensor FIELD_OF_VIEW RANGE_MAX COUNT RANGE...
void write_scan(const Robot& robot) {
  const Pose pose = robot.body->GetGlobalPose();
  std::cout << "pose " << robot.body->Token() << ' ' << pose.x << ' ' << pose.y << ' ' << pose.a
            << '\n';
  for (std::size_t i = 0; i < robot.rangers.size(); ++i) {
    const auto& sensors = robot.rangers[i]->GetSensors();
    std::cout << "ranger " << i << ' ' << sensors.size() << '\n';
    for (const auto& sensor : sensors) {
      std::cout << "sensor " << sensor.fov << ' ' << sensor.range.max << ' '
                << sensor.ranges.size();
      for (const double range : sensor.ranges) std::cout << ' ' << range;
      std::cout << '\n';
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: stage_scans WORLD POSES SEED\n";
    return 2;
  }
  Stg::Init(&argc, &argv);
  Stg::World world(argv[1]);
  if (!interop::start(world, argv[1])) return 1;
  std::vector<Robot> robots = find_robots(world);
  // resolution METRES; then for each robot that has rangers: robot NAME X Y YAW
  std::cout << "\nresolution " << 1.0 / world.Resolution() << '\n';
  constexpr std::size_t kMostRobots = 3;
  if (robots.size() > kMostRobots) robots.resize(kMostRobots);
  if (robots.empty()) {
    std::cout.flush();
    std::_Exit(0);
  }
  for (Robot& robot : robots) interop::switch_on(robot);
  std::mt19937 random(static_cast<unsigned>(std::atoi(argv[3])));
  const int wanted = std::atoi(argv[2]);
  std::vector<std::vector<Pose>> wide(robots.size());  // places with room to drive
  std::vector<std::vector<Pose>> places(robots.size());
  std::vector<Pose> starts;
  for (const Robot& robot : robots) {
    const Pose start = robot.body->GetGlobalPose();
    starts.push_back(start);
    std::cout << "robot " << robot.body->Token() << ' ' << start.x << ' ' << start.y << ' '
              << start.a << '\n';
  }
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const Robot& robot = robots[i];
    measure(world);
    const int count = wanted / static_cast<int>(robots.size());
    for (int done = 0, tries = 0; done < count && tries < 20 * count; ++tries) {
      const Pose before = robot.body->GetGlobalPose();
      robot.body->SetPose(wander(robot, random));
      measure(world);
      if (least_range(robot) < 0.3) {
        robot.body->SetPose(before);
        measure(world);
        continue;
      }
      write_scan(robot);
      if (places[i].size() < 5) places[i].push_back(robot.body->GetGlobalPose());
      if (least_range(robot) > 1.2) wide[i].push_back(robot.body->GetGlobalPose());
      ++done;
    }
    // Others shall not meet it where the comparison has it no longer.
    robot.body->SetPose(starts[i]);
  }
  for (Robot& robot : robots) {  // tracing beams would take most of the time
    for (ModelRanger* ranger : robot.rangers) ranger->Unsubscribe();
  }
  // drive ROBOT X Y YAW V OMEGA SECONDS END_X END_Y END_YAW
  const double commands[][3] = {
      {0.3, 0.0, 3.0}, {0.3, 0.3, 3.0}, {0.0, 0.6, 3.0}, {-0.2, 0.2, 3.0}, {0.2, -0.5, 4.0}};
  const double step = world.sim_interval * 1e-6;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    ModelPosition* const body = robots[i].body;
    for (std::size_t c = 0; c < 5 && c < wide[i].size(); ++c) {
      const double* command = commands[c];
      const Pose from = wide[i][c];
      body->SetPose(from);
      body->SetSpeed(command[0], 0.0, command[1]);
      const int steps = static_cast<int>(std::lround(command[2] / step));
      // The speed takes effect in the first update and the motion in the next.
      Pose last = body->GetGlobalPose();
      int moving = 0;
      while (moving < steps) {
        world.Update();
        const Pose now = body->GetGlobalPose();
        if (now.x != last.x || now.y != last.y || now.a != last.a || moving > 0) ++moving;
        last = now;
        if (world.SimTimeNow() > 100000000000ULL) break;
      }
      const Pose to = body->GetGlobalPose();
      std::cout << "drive " << body->Token() << ' ' << from.x << ' ' << from.y << ' ' << from.a
                << ' ' << command[0] << ' ' << command[1] << ' ' << command[2] << ' ' << to.x << ' '
                << to.y << ' ' << to.a << '\n';
      body->SetSpeed(0.0, 0.0, 0.0);
      world.Update();
    }
    body->SetPose(starts[i]);
  }
  // hit ROBOT X Y YAW V SECONDS END_X END_Y stalled|free: straight on until the robot stalls
  for (std::size_t i = 0; i < robots.size(); ++i) {
    ModelPosition* const body = robots[i].body;
    for (const Pose& from : places[i]) {
      constexpr double kSpeed = 0.3, kSeconds = 8.0;
      body->SetPose(from);
      body->SetSpeed(kSpeed, 0.0, 0.0);
      const Stg::usec_t until = world.SimTimeNow() + static_cast<Stg::usec_t>(1e6 * kSeconds);
      world.Update();
      do world.Update();
      while (!body->Stalled() && world.SimTimeNow() < until);
      const Pose to = body->GetGlobalPose();
      std::cout << "hit " << body->Token() << ' ' << from.x << ' ' << from.y << ' ' << from.a << ' '
                << kSpeed << ' ' << kSeconds << ' ' << to.x << ' ' << to.y << ' '
                << (body->Stalled() ? "stalled" : "free") << '\n';
      body->SetSpeed(0.0, 0.0, 0.0);
      body->SetPose(from);
      world.Update();
      world.Update();
    }
    body->SetPose(starts[i]);
  }
  std::cout.flush();
  std::_Exit(0);  // Stage's destructors wait for its threads
}
