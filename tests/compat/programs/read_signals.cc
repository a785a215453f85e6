// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Uses callbacks only: Run() reads, read signals steer, Stop() ends it.
#include <libplayerc++/playerc++.h>
#include <functional>
using namespace PlayerCc;

static PlayerClient *gClient;
static Position2dProxy *gPosition;
static int gScans = 0, gPoses = 0;

void on_position()
{
  if (++gPoses == 150) {
    gPosition->SetSpeed(0, 0);
    gClient->Stop();
  }
}

class Steering {
 public:
  Steering(LaserProxy &laser, Position2dProxy &position) : laser_(laser), position_(position)
  {
    connection_ = laser_.ConnectReadSignal(std::bind(&Steering::scan, this));
  }
  ~Steering() { laser_.DisconnectReadSignal(connection_); }

 private:
  void scan()
  {
    ++gScans;
    double l = laser_.GetMinLeft(), r = laser_.GetMinRight();
    position_.SetSpeed(l < 0.7 || r < 0.7 ? 0.0 : 0.35, 0.5 * (l - r) / (l + r));
  }
  LaserProxy &laser_;
  Position2dProxy &position_;
  ClientProxy::connection_t connection_;
};

int main()
{
  PlayerClient client("localhost", 6665);
  Position2dProxy position(&client, 0);
  LaserProxy laser(&client, 0);
  gClient = &client;
  gPosition = &position;
  position.ConnectReadSignal(&on_position);
  {
    Steering steering(laser, position);
    client.Run(100);
  }
  std::cout << gScans << " scans, " << gPoses << " poses" << std::endl;
  return gScans > 100 ? 0 : 1;
}
