// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Wanders with a ranger. It first requests its configuration and geometry and prints its limits.
#include <libplayerc++/playerc++.h>
#include <string>

int main()
{
  using namespace PlayerCc;
  PlayerClient robot("localhost");
  RangerProxy ranger(&robot, 0);
  Position2dProxy pos(&robot, 0);

  ranger.RequestConfigure();
  ranger.RequestGeom();
  robot.Read();
  std::cout << "ranges: " << ranger.GetRangeCount() << " from " << rtod(ranger.GetMinAngle()) << " to "
            << rtod(ranger.GetMaxAngle()) << ", max " << ranger.GetMaxRange() << std::endl;

  for (int turn = 0; turn < 580; ++turn) {
    robot.Read();
    uint32_t n = ranger.GetRangeCount();
    double ahead = ranger.GetMaxRange();
    double left = 0, right = 0;
    for (uint32_t i = 0; i < n; ++i) {
      if (i > n / 3 && i < 2 * n / 3 && ranger[i] < ahead) ahead = ranger[i];
      (i < n / 2 ? right : left) += ranger.GetRange(i);
    }
    if (ahead < 0.8)
      pos.SetSpeed(0.0, left > right ? 0.6 : -0.6);
    else
      pos.SetSpeed(0.4, 0.2 * (left - right) / (left + right));
  }
  pos.SetSpeed(0, 0);
  std::cout << pos << std::endl;
  return 0;
}
