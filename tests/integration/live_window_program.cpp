// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The program of live_window_test: paints the canvas green except for a red corner, while its robot
// stands still. An argument is the name of a file that it creates first.
#include <libCCMorse/CCMorse.h>

#include <fstream>

int main(int argc, char** argv) {
  if (argc > 1) std::ofstream(argv[1]) << "started\n";
  CCMorse::PlayerClient client("localhost", 6665);
  CCMorse::Position2dProxy position(&client, 0);
  CCMorse::WindowProxy& window = CCMorse::WindowProxy::GetInstance(&client, 100, 100);
  for (int y = 0; y < 100; ++y) {
    const int red = y < 20 ? 20 : 0;  // columns at the top left
    if (red > 0) window.SetLine(0, y, red - 1, y, 200, 0, 0);
    window.SetLine(red, y, 99, y, 0, 200, 0);
  }
  for (;;) {
    client.Read();
    position.SetSpeed(0.0, 0.0);
  }
}
