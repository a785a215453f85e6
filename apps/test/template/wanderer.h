// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <libplayerc++/playerc++.h>

#include <string>

// Drives ahead and turns away from what its laser sees: replace it by your own controller. It has a
// constructor that takes the host, and step(), so tests can do with it what they like.
class Wanderer {
 public:
  explicit Wanderer(const std::string& host = "localhost", unsigned port = 6665);

  // Waits for new data, then commands the motors. Throws PlayerCc::PlayerError when the run ends.
  void step();

 private:
  PlayerCc::PlayerClient client_;
  PlayerCc::Position2dProxy position_;
  PlayerCc::LaserProxy laser_;
  int reads_without_scan_ = 0;
  double turn_ = 0.0;  // the side to which it turns away: 1 left, -1 right, 0 it drives ahead
};
