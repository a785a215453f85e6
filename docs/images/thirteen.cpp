// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Thirteen robots wander about the arena, driven by one thread through thirteen clients, one a
// port. It draws the picture at the top of README.md (see make_pictures.sh).
#include <libplayerc++/playerc++.h>

#include <cmath>
#include <memory>
#include <vector>

struct Robot {
  explicit Robot(unsigned number)
      : client("localhost", PlayerCc::PLAYER_PORTNUM + number),
        position(&client, 0),
        laser(&client, 0) {}

  // Drives towards where there is more room, the faster the more of it lies ahead.
  void drive() {
    double left = 0.0;
    double right = 0.0;
    double ahead = laser.GetMaxRange();
    for (unsigned i = 0; i < laser.GetCount(); ++i) {
      const double bearing = laser.GetBearing(i);
      const double range = laser.GetRange(i);
      if (std::fabs(bearing) < 0.45 && range < ahead) ahead = range;
      if (std::fabs(bearing) < 1.4) (bearing > 0.0 ? left : right) += range < 0.8 ? range : 0.8;
    }
    if (ahead < 0.22) {
      if (turning == 0.0) turning = left > right ? 1.2 : -1.2;
      position.SetSpeed(0.0, turning);
      return;
    }
    turning = 0.0;
    position.SetSpeed(ahead < 0.5 ? 0.1 : 0.25, 0.02 * (left - right));
  }

  PlayerCc::PlayerClient client;
  PlayerCc::Position2dProxy position;
  PlayerCc::LaserProxy laser;
  double turning = 0.0;
};

int main() {
  std::vector<std::unique_ptr<Robot>> robots;
  for (unsigned i = 0; i < 13; ++i) robots.push_back(std::unique_ptr<Robot>(new Robot(i)));
  try {
    while (true) {
      for (auto& robot : robots) {
        robot->client.Read();
        robot->drive();
      }
    }
  } catch (const PlayerCc::PlayerError&) {
    return 0;  // the run is over
  }
}
