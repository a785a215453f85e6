// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// How many rounds of pose and laser a program with the real libplayerc++ reads a second:
//   read_rate [HOST [PORT [ROUNDS]]]
#include <libplayerc++/playerc++.h>

#include <chrono>
#include <cstdlib>
#include <iostream>

int main(int argc, char** argv) {
  const char* host = argc > 1 ? argv[1] : "localhost";
  const int port = argc > 2 ? std::atoi(argv[2]) : 6665;
  const int rounds = argc > 3 ? std::atoi(argv[3]) : 2000;
  try {
    PlayerCc::PlayerClient client(host, port);
    PlayerCc::Position2dProxy pose(&client, 0);
    PlayerCc::LaserProxy laser(&client, 0);
    for (int i = 0; i < 100; ++i) client.Read();
    const double simulated = pose.GetDataTime();
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < rounds; ++i) client.Read();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    std::cout << laser.GetCount() << " beams, " << rounds / took.count() << " rounds a second, "
              << (pose.GetDataTime() - simulated) / rounds << " s simulated a round\n";
  } catch (const PlayerCc::PlayerError& error) {
    std::cerr << error << '\n';
    return 1;
  }
}
