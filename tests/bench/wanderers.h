// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <libplayerc++/playerc++.h>

#include <cstddef>
#include <cstdint>
#include <ctime>
#include <memory>
#include <utility>
#include <vector>

#include "playerlike/host/host.h"
#include "realtime.h"

namespace sim::bench {

// What a robot is told to do.
struct Choice {
  double speed_mps;
  double turn_rate_radps;
};

// The wandering rule: look at each beam, turn away from near obstacles, otherwise drive on.
template <typename Beams>
[[nodiscard]] Choice choose(const Beams& beams, std::uint32_t count, std::size_t robot) {
  double least_m = 1e3;
  std::uint32_t nearest = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double range_m = beams[i];
    if (range_m < least_m) {
      least_m = range_m;
      nearest = i;
    }
  }
  if (least_m < 0.25) return {0.0, nearest > count / 2 ? -1.5 : 1.5};
  return {0.3, 0.1 * (static_cast<double>(robot % 13) - 6.0)};
}

// Processor time of a call [us].
template <typename F>
[[nodiscard]] double used_us(F f) {
  const std::clock_t begin = std::clock();
  f();
  return static_cast<double>(std::clock() - begin) * 1e6 / CLOCKS_PER_SEC;
}

// The simulation with the rule inside it: no client, no session.
class Alone {
 public:
  // @param steps  of a round: from a scan to the next.
  Alone(const WorldDescription& world, int steps) : simulation_(world), steps_(steps) {
    for (int r = 0; r < simulation_.robot_count(); ++r) {
      const int laser = simulation_.find_device(r, "laser").value();
      robots_.push_back({dynamic_cast<const Laser*>(&simulation_.device(r, laser)),
                         {r, simulation_.find_device(r, "motion").value()}});
    }
  }

  // One round.
  void wander() {
    for (std::size_t r = 0; r < robots_.size(); ++r) {
      const LaserReading& scan = robots_[r].laser->reading();
      const auto count = static_cast<std::uint32_t>(scan.sequence > 0 ? scan.ranges_m.size() : 0);
      command(r, choose(scan.ranges_m, count, r));
    }
    step();
  }
  void drive_on() {
    for (std::size_t r = 0; r < robots_.size(); ++r)
      command(r, choose(std::vector<double>(), 0, r));
    step();
  }

 private:
  struct Robot {
    const Laser* laser;
    playerlike::DeviceId motion;
  };
  void command(std::size_t r, const Choice& choice) {
    simulation_.apply(robots_[r].motion, TwistCommand{{.v_mps = choice.speed_mps,
                                                       .omega_radps = choice.turn_rate_radps}});
  }
  void step() {
    for (int i = 0; i < steps_; ++i) simulation_.step();
  }

  Simulation simulation_;
  int steps_;
  std::vector<Robot> robots_;
};

// The same rule in client programs, one per robot, in one thread.
class Clients {
 public:
  explicit Clients(const std::shared_ptr<playerlike::Host>& host) {
    for (const playerlike::RobotInfo& robot : host->robots()) {
      robots_.push_back(std::make_unique<Robot>(host->connect(robot.port)));
    }
  }

  void wander() {
    for (std::size_t r = 0; r < robots_.size(); ++r) {
      Robot& robot = *robots_[r];
      robot.client.Read();
      const Choice choice = choose(robot.laser, robot.laser.GetCount(), r);
      robot.position.SetSpeed(choice.speed_mps, choice.turn_rate_radps);
    }
  }
  void drive_on() {
    for (std::size_t r = 0; r < robots_.size(); ++r) {
      robots_[r]->client.Read();
      const Choice choice = choose(std::vector<double>(), 0, r);
      robots_[r]->position.SetSpeed(choice.speed_mps, choice.turn_rate_radps);
    }
  }
  void read() {
    for (const auto& robot : robots_) robot->client.Read();
  }
  // So many turns of a program for each robot.
  void drive(const auto& turn, int turns) {
    for (int i = 0; i < turns; ++i, ++turn_) {
      for (const auto& robot : robots_) {
        robot->client.Read();
        turn(robot->laser, robot->position, turn_);
      }
    }
  }

 private:
  struct Robot {
    explicit Robot(std::unique_ptr<playerlike::Session> session)
        : client(std::move(session)), position(&client, 0), laser(&client, 0) {}
    PlayerCc::PlayerClient client;
    PlayerCc::Position2dProxy position;
    PlayerCc::LaserProxy laser;
  };
  std::vector<std::unique_ptr<Robot>> robots_;
  int turn_ = 0;
};

}  // namespace sim::bench
