// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Times its motion by the wall clock: time(), gettimeofday(), and busy waiting.
#include <libplayerc++/playerc++.h>
#include <sys/time.h>
#include <time.h>
using namespace PlayerCc;

static double now()
{
  struct timeval tv;
  gettimeofday(&tv, NULL);
  return tv.tv_sec + 1e-6 * tv.tv_usec;
}

int main()
{
  PlayerClient robot("localhost");
  Position2dProxy pp(&robot, 0);
  double start = now();
  pp.SetSpeed(0.3, 0);
  while (now() - start < 2.0) robot.Read();
  pp.SetSpeed(0, 0.5);
  time_t until = time(NULL) + 3;
  while (time(NULL) < until)
    ;
  pp.SetSpeed(0.3, 0);
  start = now();
  while (now() < start + 1.0) {
    struct timespec pause = {0, 50 * 1000 * 1000};
    nanosleep(&pause, NULL);
  }
  pp.SetSpeed(0, 0);
  robot.Read();
  std::cout << "took " << (now() - start) << std::endl;
  return 0;
}
