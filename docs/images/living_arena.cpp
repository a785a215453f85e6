// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The robots of worlds/examples/living_arena.json: the runner opens the gate by standing on the
// plate, and then stops in the gate until the chaser catches it. It draws the pictures of
// docs/arena_controller.md (see make_pictures.sh).
#include <libplayerc++/playerc++.h>

#include <algorithm>
#include <cmath>

struct Robot {
  explicit Robot(unsigned number)
      : client("localhost", PlayerCc::PLAYER_PORTNUM + number), position(&client, 0) {}

  // Drives towards a point. Returns whether the robot has arrived and stands still.
  bool go_to(double x, double y) {
    const double dx = x - position.GetXPos();
    const double dy = y - position.GetYPos();
    if (std::hypot(dx, dy) < 0.03) {
      position.SetSpeed(0.0, 0.0);
      return true;
    }
    const double turn = std::remainder(std::atan2(dy, dx) - position.GetYaw(), 2.0 * 3.14159265);
    const double speed = std::fabs(turn) > 0.4 ? 0.0 : std::min(0.3, std::hypot(dx, dy));
    position.SetSpeed(speed, std::max(-1.5, std::min(2.0 * turn, 1.5)));
    return false;
  }

  PlayerCc::PlayerClient client;
  PlayerCc::Position2dProxy position;
};

int main() {
  Robot runner(0);
  Robot chaser(1);
  try {
    bool on_plate = false;
    for (double time_s = 0.0;; time_s += 0.1) {
      runner.client.Read();
      chaser.client.Read();
      on_plate = on_plate || runner.go_to(1.5, 1.5);
      // The plate opens the gate after a second, and the gate sinks within two.
      if (on_plate && time_s > 9.0) runner.go_to(2.0, 1.5);
      if (time_s > 12.0) chaser.go_to(1.8, 1.62);
    }
  } catch (const PlayerCc::PlayerError&) {
    return 0;  // the run is over
  }
}
