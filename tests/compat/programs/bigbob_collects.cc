// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// In the style of the Player/Stage tutorial: Bigbob drives to an orange, takes it between its teeth
// and brings it home. It makes another one disappear.
#include <stdio.h>
#include <libplayerc++/playerc++.h>

using namespace PlayerCc;

struct Item
{
  char name[16];
  double x;
  double y;
} typedef item_t;

void RefreshItemList(item_t *itemList, SimulationProxy &simProxy)
{
  double dummy;
  for (int i = 0; i < 4; i++)
  {
    sprintf(itemList[i].name, "orange%d", i + 1);
    simProxy.GetPose2d(itemList[i].name, itemList[i].x, itemList[i].y, dummy);
    sprintf(itemList[i + 4].name, "carton%d", i + 1);
    simProxy.GetPose2d(itemList[i + 4].name, itemList[i + 4].x, itemList[i + 4].y, dummy);
  }
}

// Steers towards a point; returns its distance from the centre of the robot.
double SteerTo(double x, double y, double reach, Position2dProxy &pp, SimulationProxy &simProxy)
{
  double robotX, robotY, robotYaw;
  simProxy.GetPose2d((char *)"bob1", robotX, robotY, robotYaw);
  double dist = hypot(x - robotX, y - robotY);
  double turn = normalize(atan2(y - robotY, x - robotX) - robotYaw);
  double forward = fabs(turn) > dtor(5) ? 0.0 : limit(0.6 * (dist - reach), 0.1, 0.8);
  pp.SetSpeed(forward, limit(1.5 * turn, -dtor(60), dtor(60)));
  return dist;
}

int main()
{
  PlayerClient robot("localhost", 6665);
  Position2dProxy p2dProxy(&robot, 0);
  RangerProxy sonarProxy(&robot, 0);
  RangerProxy laserProxy(&robot, 1);
  BlobfinderProxy blobProxy(&robot, 0);
  GripperProxy gripper(&robot, 0);
  SimulationProxy simProxy(&robot, 0);
  item_t itemList[8];
  const double homeX = -6.2, homeY = -6.2;

  p2dProxy.SetMotorEnable(1);
  p2dProxy.RequestGeom();
  RefreshItemList(itemList, simProxy);
  robot.Read();
  while (sonarProxy.GetRangeCount() == 0 || laserProxy.GetRangeCount() == 0)
    robot.Read();
  printf("%u sonars, %u beams between the teeth, gripper %s\n", sonarProxy.GetRangeCount(),
         laserProxy.GetRangeCount(), gripper.GetPaddlesOpen() ? "open" : "not open");

  // drive to the orange, until it breaks the inner beam
  int orangeBlobs = 0;
  while (!gripper.GetInnerBreakBeam())
  {
    robot.Read();
    for (unsigned int i = 0; i < blobProxy.GetCount(); i++)
    {
      playerc_blobfinder_blob_t blob = blobProxy[i];
      int centre = blobProxy.GetWidth() / 2;
      if ((blob.color & 0xffffff) == 0xffa500 && abs((int)blob.x - centre) < 10) orangeBlobs++;
    }
    SteerTo(itemList[0].x, itemList[0].y, 0.6, p2dProxy, simProxy);
  }
  p2dProxy.SetSpeed(0, 0);
  printf("between the teeth: %s, laser %.2f\n", itemList[0].name, laserProxy[90]);
  bool seen = laserProxy[90] < 0.25 && orangeBlobs > 10;

  gripper.Close();
  do
    robot.Read();
  while (gripper.GetState() == PLAYER_GRIPPER_STATE_OPEN ||
         gripper.GetState() == PLAYER_GRIPPER_STATE_MOVING);
  if (gripper.GetState() != PLAYER_GRIPPER_STATE_CLOSED) return 1;

  // bring it home
  do
    robot.Read();
  while (SteerTo(homeX, homeY, 0.6, p2dProxy, simProxy) > 0.7);
  p2dProxy.SetSpeed(0, 0);
  robot.Read();
  gripper.Open();
  for (int i = 0; i < 30; i++)
  {
    robot.Read();
    p2dProxy.SetSpeed(-0.2, 0);
  }
  p2dProxy.SetSpeed(0, 0);

  // the tutorial's method of collecting: move it out of the simulation
  simProxy.SetPose2d(itemList[1].name, -10, -10, 0);
  robot.Read();
  RefreshItemList(itemList, simProxy);
  printf("%s is %.2f m from home, %s is at %.0f %.0f\n", itemList[0].name,
         hypot(itemList[0].x - homeX, itemList[0].y - homeY), itemList[1].name, itemList[1].x,
         itemList[1].y);
  return seen && hypot(itemList[0].x - homeX, itemList[0].y - homeY) < 0.3 ? 0 : 1;
}
