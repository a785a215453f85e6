// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Drives sideways, ahead and back without turning, and then turns on the spot.
#include <libplayerc++/playerc++.h>
using namespace PlayerCc;

static void drive(PlayerClient &c, Position2dProxy &p, double x, double y, double a)
{
  for (int i = 0; i < 10; ++i) {
    p.SetSpeed(x, y, a);
    c.Read();
  }
}

int main()
{
  PlayerClient client("localhost", 6665);
  Position2dProxy base(&client, 0);
  drive(client, base, 0, 0.3, 0);
  double side = base.GetYPos();
  drive(client, base, 0.3, 0, 0);
  drive(client, base, -0.3, -0.3, 0);
  player_pose2d_t spin = {0, 0, 1.0};
  for (int i = 0; i < 10; ++i) { base.SetSpeed(spin); client.Read(); }
  base.SetSpeed(0, 0, 0);
  client.Read();
  std::cout << "went " << side << " m to the left, turned " << base.GetYaw() << " rad" << std::endl;
  return side > 0.2 && base.GetYaw() > 0.8 ? 0 : 1;
}
