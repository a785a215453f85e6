// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Moves an arm through its joints: prints its geometry, waves with the base, reaches forwards, and
// goes home. It drives a little while the arm moves.
#include <cmath>
#include <cstdio>
#include <iostream>
#include <vector>
#include <libplayerc++/playerc++.h>
using namespace PlayerCc;

static bool moving(ActArrayProxy &arm)
{
  for (uint32_t i = 0; i < arm.GetCount(); i++)
    if (arm[i].state == PLAYER_ACTARRAY_ACTSTATE_MOVING) return true;
  return false;
}

static void finish(PlayerClient &robot, ActArrayProxy &arm)
{
  do
    robot.Read();
  while (moving(arm));
}

int main(int argc, char **argv)
{
  try {
    PlayerClient robot("localhost", 6665);
    Position2dProxy pos(&robot, 0);
    ActArrayProxy arm(&robot, 0);

    arm.RequestGeometry();
    arm.SetPowerConfig(true);
    arm.SetBrakesConfig(false);
    robot.Read();
    std::cout << arm.GetCount() << " joints" << std::endl;
    for (uint32_t i = 0; i < arm.GetCount(); i++) {
      player_actarray_actuatorgeom_t geom = arm.GetActuatorGeom(i);
      std::printf("joint %u: %s, %.2f m, from %.2f to %.2f\n", i,
                  geom.type == PLAYER_ACTARRAY_TYPE_LINEAR ? "linear" : "rotary", geom.length, geom.min, geom.max);
      arm.SetSpeedConfig(i, geom.type == PLAYER_ACTARRAY_TYPE_LINEAR ? 0.05f : 1.0f);
    }

    pos.SetSpeed(0.1, 0);
    for (int i = 0; i < 2; i++) {
      arm.MoveTo(0, dtor(60));
      finish(robot, arm);
      arm.MoveTo(0, dtor(-60));
      finish(robot, arm);
    }
    pos.SetSpeed(0, 0);

    std::vector<float> reach;
    reach.push_back(0.5f);
    reach.push_back(0.6f);
    reach.push_back(-0.4f);
    reach.push_back(0.0f);
    reach.push_back(-0.2f);
    reach.push_back(0.05f);
    arm.MoveToMulti(reach);
    finish(robot, arm);
    double worst = 0;
    for (uint32_t i = 0; i < reach.size(); i++)
      worst = std::fmax(worst, std::fabs(arm.GetActuatorData(i).position - reach[i]));
    std::cout << "reached " << (worst < 0.01 ? "it" : "something else") << std::endl;

    arm.MoveAtSpeed(1, 0.5f);
    do
      robot.Read();
    while (arm[1].state != PLAYER_ACTARRAY_ACTSTATE_STALLED);
    std::printf("stalled at %.2f\n", arm[1].position);

    arm.SetBrakesConfig(true);
    robot.Read();
    std::cout << "braked " << (arm[0].state == PLAYER_ACTARRAY_ACTSTATE_BRAKED) << std::endl;
    arm.SetBrakesConfig(false);
    robot.Read();
    arm.MoveHome(-1);
    finish(robot, arm);
    double off = 0;
    for (uint32_t i = 0; i < arm.GetCount(); i++)
      off = std::fmax(off, std::fabs(arm[i].position - arm.GetActuatorGeom(i).home));
    std::cout << (off < 0.01 ? "home again" : "not at home") << std::endl;
  } catch (PlayerError &e) {
    std::cerr << e << std::endl;
    return 1;
  }
  return 0;
}
