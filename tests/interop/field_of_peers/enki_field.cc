// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
//
// The hall of bench_field in Enki. Reads the lines of `bench_field --hall N` from its standard
// input, and prints "figure field NUMBER": simulated seconds a second of processor time.
//
// Enki has no laser. Its CircularCam keeps the squared distance of each pixel; one such camera sees
// at most 180 degrees, so two of them, with half of the beams each, make the scan. Their pixels
// have the angles of the beams. The rule compares squared distances, which saves Enki a root for
// each beam. Walls have no maximum range in Enki, which costs nothing and does not change what the
// rule does.
#include <enki/PhysicalEngine.h>
#include <enki/interactions/CircularCam.h>
#include <enki/robots/DifferentialWheeled.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

constexpr double kCm = 100.0;  // Enki's worlds are in centimetres
constexpr double kStep_s = 0.1;
constexpr double kHeight_cm = 10.0;
constexpr double kWheels_cm = 14.0;
constexpr double kFastest_cm_per_s = 200.0;
constexpr double kLeastTime_s = 2.0;

struct Laser {
  int beams = 0;
  double first_rad = 0.0;
  double step_rad = 0.0;
  double range_m = 0.0;
  double x_m = 0.0;
};

class Robot : public Enki::DifferentialWheeled {
 public:
  Robot(const Laser& laser, const Enki::Polygon& footprint)
      : DifferentialWheeled(kWheels_cm, kFastest_cm_per_s, 0.0),
        right_(this, Enki::Point(laser.x_m * kCm, 0.0), 0.5 * kHeight_cm, centre(laser, 0),
               half_view(laser), static_cast<unsigned>(laser.beams / 2)),
        left_(this, Enki::Point(laser.x_m * kCm, 0.0), 0.5 * kHeight_cm,
              centre(laser, laser.beams / 2), half_view(laser),
              static_cast<unsigned>(laser.beams / 2)) {
    addLocalInteraction(&right_);
    addLocalInteraction(&left_);
    right_.setRange(laser.range_m * kCm);
    left_.setRange(laser.range_m * kCm);
    setCustomHull(Enki::PhysicalObject::Hull(Enki::PhysicalObject::Part(footprint, kHeight_cm)),
                  2.0);
  }

  // The wandering rule of tests/bench/wanderers.h.
  void choose(std::size_t robot) {
    double least = 1e30;
    std::size_t nearest = 0;
    const std::size_t half = right_.zbuffer.size();
    for (const auto* camera : {&right_, &left_}) {
      for (std::size_t i = 0; i < half; ++i) {
        const double range2 = camera->zbuffer[i];
        if (range2 < least) {
          least = range2;
          nearest = i + (camera == &left_ ? half : 0);
        }
      }
    }
    const double near_cm = 0.25 * kCm;
    if (least < near_cm * near_cm) {
      drive(0.0, nearest > half ? -1.5 : 1.5);
    } else {
      drive(0.3, 0.1 * (static_cast<double>(robot % 13) - 6.0));
    }
  }

 private:
  static double half_view(const Laser& laser) {
    return 0.5 * (laser.beams / 2 - 1) * laser.step_rad;
  }
  static double centre(const Laser& laser, int first) {
    return laser.first_rad + first * laser.step_rad + half_view(laser);
  }
  void drive(double speed_mps, double turn_rate_radps) {
    leftSpeed = speed_mps * kCm - 0.5 * kWheels_cm * turn_rate_radps;
    rightSpeed = speed_mps * kCm + 0.5 * kWheels_cm * turn_rate_radps;
  }

  Enki::CircularCam right_;
  Enki::CircularCam left_;
};

struct Hall {
  double side_m = 0.0;
  Laser laser;
  Enki::Polygon footprint;
  std::vector<std::vector<double>> boxes;   // x, y, two sizes [m]
  std::vector<std::vector<double>> robots;  // x, y [m], yaw [rad]
};

Hall read_hall(std::istream& in) {
  Hall hall;
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string what;
    words >> what;
    std::vector<double> numbers;
    for (double number = 0.0; words >> number;) numbers.push_back(number);
    const auto wants = [&](std::size_t count) {
      if (numbers.size() != count || !words.eof()) {
        throw std::runtime_error("expected " + std::to_string(count) + " numbers in \"" + line +
                                 "\"");
      }
    };
    if (what == "side") {
      wants(1);
      hall.side_m = numbers[0];
    } else if (what == "laser") {
      wants(5);
      hall.laser = {static_cast<int>(numbers[0]), numbers[1], numbers[2], numbers[3], numbers[4]};
    } else if (what == "footprint") {
      wants(numbers.size() / 2 * 2);
      for (std::size_t i = 0; i < numbers.size(); i += 2) {
        hall.footprint.push_back(Enki::Point(numbers[i] * kCm, numbers[i + 1] * kCm));
      }
    } else if (what == "box") {
      wants(4);
      hall.boxes.push_back(numbers);
    } else if (what == "robot") {
      wants(3);
      hall.robots.push_back(numbers);
    } else {
      throw std::runtime_error("unknown line \"" + line + "\"");
    }
  }
  if (hall.side_m <= 0.0 || hall.laser.beams < 4 || hall.laser.beams % 2 != 0 ||
      hall.footprint.size() < 3 || hall.robots.empty()) {
    throw std::runtime_error("expected a side, an even number of beams, a footprint and robots");
  }
  return hall;
}

double simulated_seconds_per_second(const Hall& hall) {
  Enki::World world(hall.side_m * kCm, hall.side_m * kCm);
  for (const auto& box : hall.boxes) {
    auto* const object = new Enki::PhysicalObject;  // the world deletes its objects
    object->setRectangular(box[2] * kCm, box[3] * kCm, kHeight_cm, -1.0);
    object->pos = Enki::Point(box[0] * kCm, box[1] * kCm);
    world.addObject(object);
  }
  std::vector<Robot*> robots;
  for (const auto& pose : hall.robots) {
    auto* const robot = new Robot(hall.laser, hall.footprint);
    robot->pos = Enki::Point(pose[0] * kCm, pose[1] * kCm);
    robot->angle = pose[2];
    world.addObject(robot);
    robots.push_back(robot);
  }
  world.step(kStep_s);  // the first scan
  const int rounds = std::max(20, 2000 / static_cast<int>(robots.size()));
  double best_s = 1e30;
  double total_s = 0.0;
  while (total_s < kLeastTime_s) {
    const std::clock_t begin = std::clock();
    for (int i = 0; i < rounds; ++i) {
      for (std::size_t r = 0; r < robots.size(); ++r) robots[r]->choose(r);
      world.step(kStep_s);
    }
    const double used_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    best_s = std::min(best_s, used_s);
    total_s += used_s;
  }
  for (const Robot* robot : robots) {
    const double side_cm = hall.side_m * kCm;
    if (!(robot->pos.x > 0.0 && robot->pos.x < side_cm && robot->pos.y > 0.0 &&
          robot->pos.y < side_cm)) {
      throw std::runtime_error("a robot has left the hall");
    }
  }
  return rounds * kStep_s / best_s;
}

}  // namespace

int main() {
  try {
    std::printf("figure field %.6g\n", simulated_seconds_per_second(read_hall(std::cin)));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "enki_field: %s\n", error.what());
    return 1;
  }
}
