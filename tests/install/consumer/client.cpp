// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <imr-h/thread.h>
#include <libplayerc++/playerc++.h>

#include <cstdio>

static_assert(__cplusplus == 201402L, "the package must not force a language standard on clients");

int main() {
  try {
    PlayerCc::PlayerClient client("localhost", 6665);
    PlayerCc::Position2dProxy position(&client, 0);
    int reads = 0;
    for (; reads < 10; ++reads) {
      client.Read();
      position.SetSpeed(0.1, 0.2);
    }
    std::printf("read %d times, robot at %.3f %.3f %.3f\n", reads, position.GetXPos(),
                position.GetYPos(), position.GetYaw());
  } catch (const PlayerCc::PlayerError& error) {
    std::fprintf(stderr, "%s\n", error.GetErrorStr().c_str());
    return 1;
  }
  return 0;
}
