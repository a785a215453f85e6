// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "args.h"

int main(int argc, char** argv) {
  parse_args(argc, argv);
  PlayerCc::PlayerClient robot(gHostname, gPort);
  PlayerCc::Position2dProxy pp(&robot, 0);
  for (uint i = 0; i < gRounds; i++) robot.Read();
  std::cout << "read " << gRounds << " times at port " << gPort << std::endl;
}
