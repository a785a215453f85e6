// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Drives the mirrored robot r1 by its laser, and compares where its world has it with where the
// real simulation has its robot:
//   mirror_drive SERVER NAME SECONDS
// NAME is the robot's name in the simulation of SERVER. It prints the mean and maximum distance
// while it drives, and the distance after it has stood still for two seconds.
#include <libplayerc++/playerc++.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

namespace {

/// Where a simulation has a robot.
struct Place {
  double x = 0.0, y = 0.0, yaw = 0.0;
};

Place place_of(PlayerCc::SimulationProxy& simulation, std::string name) {
  Place place;
  simulation.GetPose2d(&name[0], place.x, place.y, place.yaw);
  return place;
}

double distance(const Place& a, const Place& b) { return std::hypot(a.x - b.x, a.y - b.y); }

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: mirror_drive SERVER NAME SECONDS\n";
    return 2;
  }
  try {
    PlayerCc::PlayerClient client("localhost", 6665);
    PlayerCc::Position2dProxy position(&client, 0);
    PlayerCc::LaserProxy laser(&client, 0);
    PlayerCc::SimulationProxy here(&client, 0);
    PlayerCc::PlayerClient other(argv[1]);
    PlayerCc::SimulationProxy there(&other, 0);
    const double seconds = std::atof(argv[3]);
    client.Read();
    const double begin = position.GetDataTime();
    double sum = 0.0, most = 0.0;
    int rounds = 0;
    while (position.GetDataTime() < begin + seconds) {
      client.Read();
      const double left = laser.MinLeft(), right = laser.MinRight();
      const double speed = std::max(0.0, std::min(0.4, 0.25 * (left + right) - 0.3));
      const double turn = std::max(-40.0, std::min(40.0, 30.0 * (left - right)));
      position.SetSpeed(speed, PlayerCc::dtor(left < 0.6 && right < 0.6 ? 40.0 : turn));
      const double error = distance(place_of(here, "r1"), place_of(there, argv[2]));
      sum += error;
      most = std::max(most, error);
      ++rounds;
    }
    for (int i = 0; i < 20; ++i) {
      position.SetSpeed(0.0, 0.0);
      client.Read();
    }
    const Place mirrored = place_of(here, "r1");
    const Place real = place_of(there, argv[2]);
    std::cout << "while driving: mean " << 1000.0 * sum / rounds << " mm, at most " << 1000.0 * most
              << " mm (" << rounds
              << " comparisons); at rest: " << 1000.0 * distance(mirrored, real) << " mm, "
              << std::abs(PlayerCc::rtod(PlayerCc::normalize(mirrored.yaw - real.yaw)))
              << " degrees\n";
  } catch (const PlayerCc::PlayerError& error) {
    std::cerr << "mirror_drive: " << error << '\n';
    return 1;
  }
}
