// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "sim/simulation/simulation.h"

int main() {
  sim::Simulation simulation(sim::load_world(""));
  while (simulation.now_ns() < 1'000'000'000) simulation.step();
  std::printf("after 1 s: %d steps\n", static_cast<int>(simulation.steps()));
  return 0;
}
