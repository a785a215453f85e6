// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Avoids obstacles that its infra-red sensors detect.
#include <libplayerc++/playerc++.h>
using namespace PlayerCc;

int main()
{
  PlayerClient robot("localhost");
  IrProxy ir(&robot, 0);
  Position2dProxy pp(&robot, 0);
  ir.RequestGeom();
  std::cout << ir.GetPoseCount() << " sensors" << std::endl;
  double highest = 0;
  for (int i = 0; i < 300; ++i) {
    robot.Read();
    double speed = 0.1, turn = 0;
    for (uint32_t k = 0; k < ir.GetCount(); ++k) {
      player_pose3d_t pose = ir.GetPose(k);
      if (fabs(pose.pyaw) < 1.2 && ir.GetRange(k) < 0.05) {
        speed = 0.0;
        turn = 0.8;
      }
      if (ir.GetVoltage(k) > highest) highest = ir.GetVoltage(k);
    }
    pp.SetSpeed(speed, turn);
  }
  std::cout << "highest voltage " << highest << std::endl;
  return highest > 0 ? 0 : 1;
}
