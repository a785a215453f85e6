// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A client program for mirror_test: drives ahead until it is 0.3 m from where it began, and draws
// where it was. With the argument "forever" it then waits for the end of the run. With "drive" it
// drives ahead without an end, until a byte on its standard input says how it ends: 'a' by abort(),
// 'q' by leaving its robot.
#include <libCCMorse/CCMorse.h>
#include <libplayerc++/playerc++.h>
#include <poll.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

void drive_until_told() {
  PlayerCc::PlayerClient client("localhost", 6665);
  {
    PlayerCc::Position2dProxy position(&client, 0);
    position.SetSpeed(0.2, 0.0);
    std::printf("process %d\n", static_cast<int>(getpid()));
    std::fflush(stdout);
    pollfd input{STDIN_FILENO, POLLIN, 0};
    while (poll(&input, 1, 0) == 0) client.Read();
    char byte = 0;
    if (read(STDIN_FILENO, &byte, 1) == 1 && byte == 'a') std::abort();
  }
  for (;;) pause();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc > 1 && std::string(argv[1]) == "drive") drive_until_told();
    PlayerCc::PlayerClient client("localhost", 6665);
    PlayerCc::Position2dProxy position(&client, 0);
    PlayerCc::LaserProxy laser(&client, 0);
    CCMorse::WindowProxy& window = CCMorse::WindowProxy::GetInstance(&client, 172, 186);
    client.Read();
    while (!position.IsFresh()) client.Read();
    const double start_x = position.GetXPos();
    while (position.GetXPos() < start_x + 0.3) {
      position.SetSpeed(0.2, 0.0);  // again, if the machine is so busy that the watchdog stops it
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
