// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The main function of a copy of a program with planted faults (plant.py).
//   PROGRAM FAULT [ARGUMENT...] - runs the program with a fault, or with "none"
//   PROGRAM --list              - prints the names of its faults
#include <cstdio>
#include <cstring>

#include "planted.h"

int program_main(int argc, char** argv);

namespace {

struct Fault {
  const char* name;
  const char* text;
};

constexpr Fault kFaults[] = {
    {"none", "has no fault"},
#include "faults.inc"
};

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::strcmp(argv[1], "--list") == 0) {
    for (const Fault& one : kFaults) std::printf("%s: %s\n", one.name, one.text);
    return 0;
  }
  for (const Fault& one : kFaults) {
    if (argc < 2 || std::strcmp(argv[1], one.name) != 0) continue;
    planted::fault = one.name;
    argv[1] = argv[0];
    return program_main(argc - 1, argv + 1);
  }
  std::fprintf(stderr, "%s: expected the name of a fault, 'none' or '--list'\n", argv[0]);
  return 2;
}
