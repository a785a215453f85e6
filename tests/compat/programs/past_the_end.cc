// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Wanders, and reads elements past the end of each list, which Player's proxies permit. The program
// was written for robots with more devices and elements.
#include <cstring>
#include <iostream>
#include <libplayerc++/playerc++.h>
using namespace PlayerCc;

int main()
{
  PlayerClient robot("localhost");
  Position2dProxy pp(&robot, 0);
  LaserProxy lp(&robot, 0);
  SonarProxy sp(&robot, 0);
  RangerProxy rp(&robot, 0);
  IrProxy ip(&robot, 0);
  BumperProxy bp(&robot, 0);
  LocalizeProxy loc(&robot, 0);
  FiducialProxy fp(&robot, 0);
  BlobfinderProxy bfp(&robot, 0);
  DioProxy dp(&robot, 0);
  AioProxy ap(&robot, 0);
  WiFiProxy wp(&robot, 0);
  MapProxy mp(&robot, 0);
  try {
    mp.RequestMap();
    for (int i = 0; i < 200; i++) {
      robot.Read();
      double sum = 0;
      for (int k = 0; k < 1024; k++) sum += lp[k] + rp[k] + lp.GetIntensity(k);
      for (int k = 0; k < 32; k++) sum += ip[k] + ip.GetVoltage(k) + bp[k] + ap[k] + dp[k];
      sum += loc.GetHypoth(loc.GetHypothCount()).mean.px + loc.GetParticlePose(3).px;
      sum += fp.GetFiducialItem(fp.GetCount()).id + bfp[bfp.GetCount()].area;
      sum += wp.GetLinkLevel(40) + strlen(wp.GetLinkIP(40)) + mp.GetCell(-1, 1 << 20);
      sum += rp.GetElementPose(9).px + rp.GetPoint(2000).px + rp.GetIntensity(0);
      sum += sp.GetPose(99).px + ip.GetPose(99).px + bp.GetPose(99).pose.px;
      dp.SetOutput(9, i);
      ap.SetVoltage(99, 1);
      if (i == 0) std::cout << "sonar 99 reads " << sp[99] << std::endl;
      pp.SetSpeed(lp.GetMinLeft() < 0.7 || lp.GetMinRight() < 0.7 ? 0 : 0.3,
                  lp.GetMinRight() < 0.7 ? 0.6 : lp.GetMinLeft() < 0.7 ? -0.6 : 0);
    }
  } catch (PlayerError &e) {
    std::cout << "thrown: " << e << std::endl;
    return 1;
  }
  std::cout << "nothing was thrown" << std::endl;
  return 0;
}
