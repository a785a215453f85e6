// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A program that changes an environment variable before it connects to "localhost":
// changes_world_program NAME VALUE.
#include <libplayerc++/playerc++.h>

#include <cstdlib>

int main(int argc, char** argv) {
  if (argc != 3 || setenv(argv[1], argv[2], 1) != 0) return 2;
  PlayerCc::PlayerClient client("localhost", 6665);
  client.Read();
  return 0;
}
