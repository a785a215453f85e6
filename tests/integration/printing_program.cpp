// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A client program that prints the simulated time after each read, without flushing:
//   printing_program [BYTES [READS]]
// Each line is filled up with BYTES bytes (default 0). It ends after READS reads (default 30).
#include <libplayerc++/playerc++.h>

#include <cstdlib>
#include <iostream>
#include <string>

int main(int argc, char** argv) {
  const std::string filling(argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 0, 'x');
  const long reads = argc > 2 ? std::atol(argv[2]) : 30;
  PlayerCc::PlayerClient robot("localhost", 6665);
  PlayerCc::LaserProxy laser(&robot, 0);
  for (long i = 0; i < reads; ++i) {
    robot.Read();
    std::cout << laser.GetDataTime() << ' ' << filling << '\n';
  }
}
