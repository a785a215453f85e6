// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The robots of worlds/examples/living_arena.json: `both` of them, or only the `runner` or the
// `chaser`. The runner opens the gate by standing on the plate and stops in the gate until the
// chaser has caught it. Then it opens the gate again and drives to the goal.
#include <libCCMorse/CCMorse.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace {

struct Point {
  double x, y;
};
constexpr Point kStart = {0.5, 1.5};
constexpr Point kPlate = {1.5, 1.5};
constexpr Point kGate = {2.0, 1.5};
constexpr Point kGoal = {3.6, 1.5};
constexpr Point kBesideGate = {1.8, 1.62};
constexpr Point kHome = {0.5, 2.5};

class Robot {
 public:
  Robot(const std::string& name, int port)
      : name_(name),
        client_("localhost", port),
        position_(&client_),
        arena_(&client_),
        world_(&client_) {}
  virtual ~Robot() = default;

  /// Reads the next sensor data and drives on.
  void read() {
    client_.Read();
    for (const CCMorse::ArenaEvent& event : arena_.GetEvents()) {
      is_caught_ = is_caught_ || event.kind == "restart";
      is_waiting_ = is_waiting_ || event.kind == "waiting";
      if (event.kind == "retracted") is_open_ = event.what == "gate" || is_open_;
      if (event.kind == "rising") is_open_ = event.what != "gate" && is_open_;
    }
    world_.GetPose2d(name_.c_str(), x_, y_, yaw_);
    drive();
  }
  [[nodiscard]] CCMorse::ArenaProxy& arena() { return arena_; }

 protected:
  virtual void drive() = 0;
  /// Drives towards a point. @return whether the robot has arrived and stands still.
  bool go_to(const Point& goal) {
    const double distance = std::hypot(goal.x - x_, goal.y - y_);
    if (distance < 0.03) {
      position_.SetSpeed(0.0, 0.0);
      return true;
    }
    const double bearing = std::atan2(goal.y - y_, goal.x - x_);
    const double turn = std::remainder(bearing - yaw_, 2.0 * std::acos(-1.0));
    const double speed = std::fabs(turn) > 0.4 ? 0.0 : std::min(0.3, distance);
    position_.SetSpeed(speed, std::max(-1.5, std::min(2.0 * turn, 1.5)));
    return false;
  }
  [[nodiscard]] bool is_caught() const { return is_caught_; }
  /// Whether the gate has waited for a robot.
  [[nodiscard]] bool is_waiting() const { return is_waiting_; }
  [[nodiscard]] bool is_open() const { return is_open_; }

 private:
  std::string name_;
  CCMorse::PlayerClient client_;
  CCMorse::Position2dProxy position_;
  CCMorse::ArenaProxy arena_;
  PlayerCc::SimulationProxy world_;
  double x_ = 0.0, y_ = 0.0, yaw_ = 0.0;
  bool is_caught_ = false;
  bool is_waiting_ = false;
  bool is_open_ = false;
};

class Runner final : public Robot {
 public:
  Runner() : Robot("runner", 6665) {}

 private:
  void drive() override {
    if (is_caught()) {
      go_to(is_open() ? kGoal : kStart);
    } else {
      go_to(is_open() ? kGate : kPlate);
    }
  }
};

class Chaser final : public Robot {
 public:
  Chaser() : Robot("chaser", 6666) {}

 private:
  void drive() override { go_to(is_waiting() && !is_caught() ? kBesideGate : kHome); }
};

void print_results(CCMorse::ArenaProxy& arena) {
  std::cout << arena.GetScore("runner") << ' ' << arena.GetScore("chaser") << ' '
            << arena.GetVerdict().reason << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  const std::string part = argc == 2 ? argv[1] : "both";
  std::vector<std::unique_ptr<Robot>> robots;
  if (part != "chaser") robots.push_back(std::make_unique<Runner>());
  if (part != "runner") robots.push_back(std::make_unique<Chaser>());
  try {
    for (;;) {
      for (const auto& robot : robots) robot->read();
    }
  } catch (const CCMorse::MorseError& e) {
    if (e.GetErrorCode() != CCMorse::MorseError::kRunIsOver) throw;
  }
  print_results(robots.front()->arena());
  return robots.front()->arena().GetVerdict().passed ? 0 : 1;
}
