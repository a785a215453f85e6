// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A program for two platforms, as students of the SyRoTek course write them: with -D_MORSE it
// drives the simulation, without it the real robot, whose Player server has port 38000. It drives
// ahead for a few metres, turns where something is near, and ends.
#include <cmath>
#include <iostream>
#include <string>

#include "imr-h/imr_config.h"
#include "imr-h/imr_exceptions.h"
#include "imr-h/thread.h"
#include "robot_types.h"
#ifdef _MORSE
#include "libCCMorse/CCMorse.h"
#else
#include "libPlayer/LaserProxy.h"
#include "libPlayer/PlayerClient.h"
#include "libPlayer/Position2dProxy.h"
#endif
#include "libCCMorse/MorseError.h"

class CRobot : public imr::concurrent::CThread {
 public:
  explicit CRobot(imr::CConfig& config)
      : client(new CCMorse::PlayerClient(config.get<std::string>("host"), config.get<int>("port"))),
        laser(new CCMorse::LaserProxy(client, 0)),
        position(new CCMorse::Position2dProxy(client, 0)) {
#ifdef _MORSE
    CCMorse::WindowProxy::GetInstance(client, 172, 186);
#endif
    while (!laser->IsFresh()) {
      client->Read();
      while (client->Peek(0)) client->Read();
    }
  }
  ~CRobot() {
    join();
#ifdef _MORSE
    delete &CCMorse::WindowProxy::GetInstance();
#endif
    delete laser;
    delete position;
    delete client;
  }
  bool arrived = false;

 protected:
  void threadBody() {
    try {
      navigate();
      arrived = true;
    } catch (CCMorse::MorseError& error) {
      std::cerr << error.GetErrorStr() << " in " << error.GetErrorFun() << std::endl;
    }
  }

 private:
  void navigate() {
    position->SetMotorEnable(true);
    imr::robot::SPosition last;
    double way = -1;
    while (way < 1.0) {
      client->Read();
      while (client->Peek(0)) client->Read();
      if (position->IsFresh() && position->IsValid()) {
        const double x = position->GetXPos();
        const double y = position->GetYPos();
        way = way < 0 ? 0 : way + std::hypot(x - last.x, y - last.y);
        last.x = x;
        last.y = y;
#ifdef _MORSE
        CCMorse::WindowProxy& window = CCMorse::WindowProxy::GetInstance();
        window.SetPixel(window.GetX(x), window.GetY(y), 255, 0, 255);
#endif
        position->NotFresh();
      }
      if (laser->IsFresh() && laser->IsValid()) {
        double nearest = laser->GetMaxRange();
        const unsigned count = laser->GetCount();
        for (unsigned i = count / 3; i < count - count / 3; i++) {
          if ((*laser)[i] < nearest) nearest = (*laser)[i];
        }
        position->SetSpeed(nearest < 0.4 ? 0.0 : 0.3, nearest < 0.4 ? 1.0 : 0.0);
        laser->NotFresh();
      }
    }
    position->SetSpeed(0.0, 0.0);
  }

  CCMorse::PlayerClient* client;
  CCMorse::LaserProxy* laser;
  CCMorse::Position2dProxy* position;
};

int main(int argc, char** argv) {
  try {
    imr::CConfig config;
#ifdef _MORSE
    config.add<std::string>("host", "morse server hostname", "localhost");
    config.add<int>("port", "morse server port", 4000);
#else
    config.add<std::string>("host", "syrotek server hostname", "syrotek.felk.cvut.cz");
    config.add<int>("port", "syrotek server port", 38000);
#endif
    if (!config.parse_command_line(argc, argv)) return 0;
    CRobot robot(config);
    robot.execute();
    robot.join();
    std::cout << (robot.arrived ? "arrived" : "lost") << std::endl;
    return robot.arrived ? 0 : 1;
  } catch (CCMorse::MorseError& error) {
    std::cerr << error.GetErrorStr() << " in " << error.GetErrorFun() << std::endl;
  } catch (imr::exception& error) {
    std::cerr << error.what() << std::endl;
  }
  return 1;
}
