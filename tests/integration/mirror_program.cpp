// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A client program for mirror_test: drives ahead until it is 0.3 m from where it began, and draws
// where it was. With the argument "forever" it then waits for the end of the run.
#include <libCCMorse/CCMorse.h>
#include <libplayerc++/playerc++.h>

#include <cmath>
#include <cstdio>
#include <string>

int main(int argc, char** argv) {
  try {
    PlayerCc::PlayerClient client("localhost", 6665);
    PlayerCc::Position2dProxy position(&client, 0);
    PlayerCc::LaserProxy laser(&client, 0);
    CCMorse::WindowProxy& window = CCMorse::WindowProxy::GetInstance(&client, 172, 186);
    client.Read();
    while (!position.IsFresh()) client.Read();
    const double start_x = position.GetXPos();
    position.SetSpeed(0.2, 0.0);
    while (position.GetXPos() < start_x + 0.3) {
      client.Read();
      window.SetPixel(window.GetX(position.GetXPos()), window.GetY(position.GetYPos()), 0, 0, 255);
    }
    position.SetSpeed(0.0, 0.0);
    std::printf("drove from %.2f with %u beams\n", start_x, laser.GetCount());
    std::fflush(stdout);
    while (argc > 1 && std::string(argv[1]) == "forever") client.Read();
  } catch (const PlayerCc::PlayerError& error) {
    std::fprintf(stderr, "told: %s\n", error.GetErrorStr().c_str());
    return 3;
  }
  return 0;
}
