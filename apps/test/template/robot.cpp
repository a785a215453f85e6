// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>

#include "wanderer.h"

// The program: robot [HOST [PORT]]. The same binary drives a real robot.
int main(int argc, char** argv) {
  Wanderer wanderer(argc > 1 ? argv[1] : "localhost",
                    argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 6665);
  for (;;) wanderer.step();  // `playpen run` ends the program with the run
}
