// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Uses many simulations at once by the C++ library.
#include <cstdio>
#include <vector>

#include "sim/parallel/batch.h"

int main() {
  sim::Batch batch(sim::load_world(""), {.simulations = 3});
  std::vector<double> times(3);
  batch.step({}, 20, {.times = {times}});
  std::printf("%d simulations after %.1f s\n", batch.simulations(), times[2]);
}
