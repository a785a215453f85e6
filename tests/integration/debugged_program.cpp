// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Programs to stop in a debugger: each calls stop_here() once, after 20 rounds.
//   debugged_program one [PORT]      one client
//   debugged_program two             a client in the main thread and one in another, which stops
//   debugged_program busy SECONDS    one client, which computes for so long after stop_here() [s]
#include <libplayerc++/playerc++.h>
#include <sys/resource.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

extern "C" void stop_here() { std::puts("stop_here"); }

namespace {

constexpr int kRounds = 60;
constexpr int kStop = 20;

double processor_time_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

void compute(double seconds) {
  const double end = processor_time_s() + seconds;
  while (processor_time_s() < end) {
    for (volatile int i = 0; i < 1'000'000; i = i + 1) {
    }
  }
}

void drive(std::uint32_t port, bool stops, double busy_s) {
  PlayerCc::PlayerClient robot("localhost", port);
  PlayerCc::Position2dProxy position(&robot, 0);
  PlayerCc::LaserProxy laser(&robot, 0);
  for (int round = 0; round < kRounds; ++round) {
    robot.Read();
    if (stops && round == kStop) {
      stop_here();
      compute(busy_s);
    }
    position.SetSpeed(0.2, laser.GetMinLeft() - laser.GetMinRight());
  }
  std::printf("%d rounds\n", kRounds);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  if (what == "one") {
    drive(argc > 2 ? static_cast<std::uint32_t>(std::atoi(argv[2])) : 6665, true, 0.0);
  } else if (what == "two") {
    std::thread other(drive, 6666, true, 0.0);
    drive(6665, false, 0.0);
    other.join();
  } else if (what == "busy" && argc > 2) {
    drive(6665, true, std::atof(argv[2]));
  } else {
    return 9;
  }
  return 0;
}
