// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// An e-puck whose ring of eight lights shows the directions of near obstacles; the green body light
// is on while it drives.
#include <iostream>
#include <vector>
#include <libplayerc++/playerc++.h>
using namespace PlayerCc;

int main()
{
  PlayerClient robot("localhost");
  Position2dProxy pp(&robot, 0);
  IrProxy ir(&robot, 0);
  std::vector<BlinkenLightProxy *> ring;
  for (int i = 0; i < 8; i++)
    ring.push_back(new BlinkenLightProxy(&robot, i));
  BlinkenLightProxy body(&robot, 8);

  int lit = 0;
  ir.RequestGeom();
  for (int k = 0; k < 400; k++) {
    robot.Read();
    bool near = false;
    std::vector<bool> on(8, false);
    for (uint32_t i = 0; i < ir.GetCount(); i++) {
      if (ir.GetRange(i) > 0.05) continue;
      int led = (int)(8.5 - ir.GetPose(i).pyaw * 8 / (2 * M_PI)) % 8;  // led 0 ahead, 2 on the right
      on[led] = true;
      if (fabs(ir.GetPose(i).pyaw) < 1) near = true;
    }
    for (int i = 0; i < 8; i++) {
      if (on[i] != ring[i]->GetEnable()) ring[i]->SetEnable(on[i]);
      if (on[i]) lit |= 1 << i;
    }
    if (body.GetEnable() == near) body.SetEnable(!near);
    pp.SetSpeed(near ? 0 : 0.08, near ? 1.0 : 0);
  }
  int different = 0;
  for (int i = 0; i < 8; i++)
    different += lit >> i & 1;
  std::cout << different << " of " << ring.size() << " lights shone" << std::endl;
  return 0;
}
