// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Drives to a goal from the command line with its own controller, by odometry.
#include <libplayerc++/playerc++.h>
#include <stdlib.h>
using namespace PlayerCc;

int main(int argc, char **argv)
{
  const double gx = argc > 1 ? atof(argv[1]) : 1.5, gy = argc > 2 ? atof(argv[2]) : -0.5;
  PlayerClient *pc = new PlayerClient("localhost", 6665);
  Position2dProxy *pp = new Position2dProxy(pc, 0);
  pp->SetOdometry(0, 0, 0);
  pc->Read();
  double d;
  int n = 0;
  do {
    pc->ReadIfWaiting();
    if (!pp->IsFresh()) { pc->Read(); }
    pp->NotFresh();
    double dx = gx - pp->GetXPos(), dy = gy - pp->GetYPos();
    d = sqrt(dx * dx + dy * dy);
    double err = NORMALIZE(atan2(dy, dx) - pp->GetYaw());
    pp->SetSpeed(fabs(err) > DTOR(20) ? 0 : MIN(0.5, d), err);
  } while (d > 0.05 && ++n < 1000);
  pp->SetSpeed(0, 0);
  pc->Read();
  std::cout << "distance left " << d << std::endl;
  delete pp;
  delete pc;
  return d > 0.05;
}
