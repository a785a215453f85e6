// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Exports a run, for mcap_test.py: `mcap_sample OUT FILE` writes the run of the output folder OUT
// to FILE.
#include <exception>
#include <iostream>

#include "playerlike/host/rerun.h"
#include "replay/run_mcap.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: mcap_sample OUT FILE\n";
    return 2;
  }
  try {
    playerlike::Rerun rerun(argv[1]);
    playpen::replay::write_mcap(rerun, argv[2]);
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return 1;
  }
  return 0;
}
