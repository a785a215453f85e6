// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <libplayerc++/playerc++.h>

#include "rounds.h"

int main() {
  PlayerCc::PlayerClient robot("localhost", 6665);
  for (int i = 0; i < rounds; i++) robot.Read();
  std::cout << "read " << rounds << " times" << std::endl;
}
