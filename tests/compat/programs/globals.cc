// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Client and proxies at namespace scope: constructed before main() and destroyed after it.
#include <libplayerc++/playerc++.h>
using namespace PlayerCc;

PlayerClient    gRobot("localhost");
Position2dProxy gPosition(&gRobot, 0);
LaserProxy      gLaser(&gRobot, 0);

struct Farewell {
  ~Farewell() { std::cout << "heading " << gPosition.GetYaw() << " after main" << std::endl; }
} gFarewell;

int main()
{
  for (int i = 0; i < 100; ++i) {
    gRobot.Read();
    if (gLaser.GetCount() && gLaser[gLaser.GetCount() / 2] < 1.0) gPosition.SetSpeed(0, 0.5);
    else gPosition.SetSpeed(0.3, 0.1);
  }
  gPosition.SetSpeed(0, 0);
  gRobot.Read();
  return 0;
}
