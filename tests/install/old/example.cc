// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A program made from one of Player's examples, without that example's header for the command line.
#include "args.h"

int main(int argc, char** argv) {
  parse_args(argc, argv);
  PlayerCc::PlayerClient robot(gHostname, gPort);
  PlayerCc::Position2dProxy pp(&robot, gIndex);
  for (uint32_t i = 0; i < gFrequency; i++) robot.Read();
  std::cout << "read for a second at " << gHostname << ":" << gPort << std::endl;
}
