// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Lets the first robot of a world drive in real Stage by the controllers of blind_driver.h, for
// blind_worlds.py. It links libstage and needs no display:
//   stage_drive WORLD SECONDS
// It writes `robot NAME X Y YAW`, the lines of interop::drive(), and what the rangers measure at
// some of the places where the robot has been, in the format of stage_scans.cc.
#include <cstdlib>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "blind_driver.h"
#include "stage_robots.h"

namespace {

using interop::Beam;

class StageRobot {
 public:
  StageRobot(Stg::World& world, interop::Robot robot) : world_(world), robot_(std::move(robot)) {}

  [[nodiscard]] Stg::Pose pose() const { return robot_.body->GetGlobalPose(); }
  [[nodiscard]] bool stalled() const { return robot_.body->Stalled(); }
  [[nodiscard]] std::string partner() const { return "-"; }

  [[nodiscard]] std::vector<Beam> beams() const {
    std::vector<Beam> beams;
    const Stg::Pose body = pose();
    const double c = std::cos(body.a), s = std::sin(body.a);
    for (Stg::ModelRanger* ranger : robot_.rangers) {
      for (const auto& sensor : ranger->GetSensors()) {
        const Stg::Pose at = ranger->LocalToGlobal(sensor.pose);
        const double dx = at.x - body.x, dy = at.y - body.y;
        for (std::size_t i = 0; i < sensor.ranges.size(); ++i) {
          beams.push_back({c * dx + s * dy, c * dy - s * dx,
                           Stg::normalize(at.a - body.a + interop::bearing(sensor, i)),
                           sensor.ranges[i], sensor.range.max});
        }
      }
    }
    return beams;
  }

  [[nodiscard]] interop::Body body() const {
    interop::Body body{-1e9, 1e9, 0.0};
    extend(body, robot_.body, 0.0, 0.0);
    return body;
  }

  void set_speed(const interop::Twist& twist) {
    robot_.body->SetSpeed(twist.forward_mps, 0.0, twist.turn_radps);
  }

  void advance() {
    const Stg::usec_t until = world_.SimTimeNow() + 100000;
    while (world_.SimTimeNow() < until) world_.Update();
  }

  void look() {
    set_speed({0.0, 0.0});
    interop::measure(world_);
  }

 private:
  /// Adds the bounding box of a model and of those on it; a turned part counts with its greater
  /// side.
  static void extend(interop::Body& body, Stg::Model* model, double x, double y) {
    const Stg::Geom geom = model->GetGeom();
    const bool turned = std::abs(std::sin(geom.pose.a)) > 0.01;
    const double greater = std::max(geom.size.x, geom.size.y);
    const double half_x = 0.5 * (turned ? greater : geom.size.x),
                 half_y = 0.5 * (turned ? greater : geom.size.y);
    body.front_m = std::max(body.front_m, x + geom.pose.x + half_x);
    body.rear_m = std::min(body.rear_m, x + geom.pose.x - half_x);
    body.side_m = std::max(body.side_m, std::abs(y + geom.pose.y) + half_y);
    for (Stg::Model* child : model->GetChildren()) {
      const Stg::Pose pose = child->GetPose();
      extend(body, child, x + geom.pose.x + pose.x, y + geom.pose.y + pose.y);
    }
  }

  Stg::World& world_;
  interop::Robot robot_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: stage_drive WORLD SECONDS\n";
    return 2;
  }
  Stg::Init(&argc, &argv);
  Stg::World world(argv[1]);
  if (!interop::start(world, argv[1])) return 1;
  std::vector<interop::Robot> robots = interop::find_robots(world, true);
  std::cout << "\nresolution " << 1.0 / world.Resolution() << "\nrobots " << robots.size() << '\n';
  if (robots.empty()) {
    std::cout.flush();
    std::_Exit(0);
  }
  // The first one with a ranger, else the first one.
  std::size_t first = 0;
  while (first < robots.size() && !interop::sees(robots[first])) ++first;
  interop::Robot& robot = robots[first < robots.size() ? first : 0];
  interop::switch_on(robot);
  interop::measure(world);
  const Stg::Pose start = robot.body->GetGlobalPose();
  std::cout << "robot " << robot.body->Token() << ' ' << start.x << ' ' << start.y << ' ' << start.a
            << '\n';
  StageRobot driven(world, robot);
  interop::drive(driven, std::atof(argv[2]));
  std::cout.flush();
  std::_Exit(0);  // Stage's destructors wait for its threads
}
