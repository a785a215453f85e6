// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A program for CCMorse that opens every namespace and uses all three layers.
#include <libCCMorse/CCMorse.h>

using namespace std;
using namespace PlayerCc;
using namespace CCMorse;

static_assert(is_same<CCMorse::PlayerClient, PlayerCc::PlayerClient>::value, "");
static_assert(is_same<MorseError, PlayerError>::value, "");

typedef unsigned char uchar;

int main() {
  PlayerClient* client = new PlayerClient("localhost", 4000);
  LaserProxy* laser = new LaserProxy(client, 0);
  Position2dProxy* position = new Position2dProxy(client, 0);
  WindowProxy::GetInstance(client, 172, 186);
  int failures = 0;
  try {
    WindowProxy& window = WindowProxy::GetInstance();
    ImagePoint_t last, current;
    position->SetMotorEnable(true);
    for (int i = 0; i < 30; i++) {
      client->Read();
      while (client->Peek(0)) client->Read();
      current = ImagePoint_t(window.GetX(position->GetXPos()), window.GetY(position->GetYPos()));
      if (i == 0) last = current;
      window.SetLine(last.x, last.y, current.x, current.y, 0, 255, 0);
      window.SetPixel(current.x, current.y, 255, 0, 255);
      last = current;
      position->SetSpeed((*laser)[laser->GetCount() / 2] > 0.4 ? 0.3 : 0.0, 0.1 * PI);
    }
    uchar r, g, b;
    window.GetPixel(current.x, current.y, r, g, b);
    if (r != 255 || g != 0 || b != 255) failures++;

    MorseClient morse;
    MorseRobot robot = morse.GetRobot();
    MorsePose pose(robot);
    MorseOdometry odometry(robot);
    MorseLaser scanner(robot);
    MorseMotionVW motion(robot);
    MorsePen pen(robot);
    MorseProperties properties(robot);
    MorseTime clock(morse);
    delete laser;
    delete position;
    delete &WindowProxy::GetInstance();
    delete client;
    motion.SetSpeed(0.1, 0.0);
    morse.Read();
    if (!pose.IsFresh() || !scanner.IsValid()) failures++;
    if (scanner.GetLeastRange() > scanner.GetMaxRange()) failures++;
    double before = clock.Now();
    clock.Sleep(0.5);
    if (fabs(clock.Now() - before - 0.5) > 1e-9) failures++;
    pen.SetPixel(pen.GetPoint(pose.GetX(), pose.GetY()), "#34AAFF");
    cout << robot.GetName() << " " << properties.GetProxyIndex("laser") << " " << clock.Mode()
         << " " << odometry.GetX() << endl;
  } catch (const MorseError& e) {
    cerr << e << endl;
    failures++;
  }
  return failures;
}
