// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Lets the first robot of a world drive in Playpen by the controllers of blind_driver.h, for
// blind_worlds.py:
//   playpen_drive WORLD SECONDS
// It writes the lines of stage_drive.cc.
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "blind_driver.h"
#include "playpen_beams.h"
#include "sim/core/error.h"
#include "sim/simulation/simulation.h"

namespace {

class PlaypenRobot {
 public:
  struct Place {
    double x, y, a;
  };

  PlaypenRobot(sim::Simulation& simulation, int robot) : simulation_(simulation), robot_(robot) {}

  [[nodiscard]] Place pose() const {
    const sim::Pose& X_WB = simulation_.body(robot_).X_WB;
    return {X_WB.x_m, X_WB.y_m, X_WB.yaw_rad};
  }
  [[nodiscard]] bool stalled() const { return simulation_.body(robot_).stalled; }

  /// What the robot has met last.
  [[nodiscard]] std::string partner() const {
    const auto& collisions = simulation_.collisions();
    return collisions.empty() ? "-" : collisions.back().partner;
  }

  [[nodiscard]] std::vector<interop::Beam> beams() const {
    std::vector<interop::Beam> beams;
    for (const std::string& name : interop::rangers_of(simulation_, robot_)) {
      const interop::Beams ranger = interop::beams_of(simulation_, robot_, name);
      for (std::size_t i = 0; i < ranger.ranges_m.size() && i < ranger.X_BS.size(); ++i) {
        const sim::Pose& X_BS = ranger.X_BS[i];
        beams.push_back(
            {X_BS.x_m, X_BS.y_m, X_BS.yaw_rad, ranger.ranges_m[i], ranger.ranges_max_m[i]});
      }
    }
    return beams;
  }

  [[nodiscard]] interop::Body body() const {
    interop::Body body{-1e9, 1e9, 0.0};
    const auto extend = [&](const sim::Polygon& outline) {
      for (const sim::Vec2& corner : outline) {
        body.front_m = std::max(body.front_m, corner.x());
        body.rear_m = std::min(body.rear_m, corner.x());
        body.side_m = std::max(body.side_m, std::abs(corner.y()));
      }
    };
    const sim::RobotSnapshot shot = simulation_.robot_snapshot(robot_);
    extend(shot.footprint);
    for (const sim::Polygon& paddle : shot.paddles) extend(paddle);
    return body;
  }

  void set_speed(const interop::Twist& twist) {
    if (const auto motion = simulation_.find_device(robot_, "motion")) {
      static_cast<void>(simulation_.apply(
          {robot_, *motion}, sim::TwistCommand{{twist.forward_mps, twist.turn_radps}}));
    }
  }

  void advance() {
    const sim::SimTime until_ns = simulation_.now_ns() + sim::from_seconds(0.1);
    while (simulation_.now_ns() < until_ns) simulation_.step();
  }

  void look() {
    set_speed({0.0, 0.0});
    for (int i = 0; i < 3; ++i) advance();
  }

 private:
  sim::Simulation& simulation_;
  int robot_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: playpen_drive WORLD SECONDS\n";
    return 2;
  }
  try {
    sim::Simulation simulation(sim::load_world(argv[1]));
    std::cout.precision(9);
    std::cout << "robots " << simulation.robot_count() << '\n';
    if (simulation.robot_count() == 0) return 0;
    int first = 0;
    while (first < simulation.robot_count() && interop::rangers_of(simulation, first).empty())
      ++first;
    if (first == simulation.robot_count()) first = 0;
    PlaypenRobot robot(simulation, first);
    robot.look();
    const auto start = robot.pose();
    std::cout << "robot " << simulation.world().robots[static_cast<std::size_t>(first)].name << ' '
              << start.x << ' ' << start.y << ' ' << start.a << '\n';
    interop::drive(robot, std::atof(argv[2]));
  } catch (const std::exception& error) {
    std::cerr << "playpen_drive: " << error.what() << '\n';
    return 1;
  }
}
