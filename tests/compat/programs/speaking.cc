// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Says its position and switches its outputs.
#include <libplayerc++/playerc++.h>
#include <sstream>
using namespace PlayerCc;

int main()
{
  PlayerClient robot("localhost", 6665);
  Position2dProxy pp(&robot, 0);
  SpeechProxy speech(&robot, 0);
  DioProxy dio(&robot, 0);
  speech.Say("Hello");
  for (int i = 0; i < 100; ++i) {
    robot.Read();
    pp.SetSpeed(0.2, 0.2);
    if (i % 20 == 0) {
      std::ostringstream text;
      text << "round " << i / 20;
      speech.Say(text.str());
      dio.SetOutput(8, 1u << (i / 20));
    }
  }
  std::cout << dio.GetCount() << " inputs: " << dio.GetDigin() << std::endl;
  return 0;
}
