// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Work whose instructions tests/bench/instructions.py counts: counted_work NAME TIMES.
#include <libplayerc++/playerc++.h>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>

#include "playerlike/host/host.h"
#include "realtime.h"

namespace {

using sim::Simulation;

// A robot that drives on a circle on a plain floor, without a sensor that scans.
sim::WorldDescription driving_robot() {
  return sim::load_world_text(
      R"({"arena": {"size": [4, 4]}, "robots": [{"name": "r1", "pose": {"x": 2, "y": 1},
          "devices": {"motion": {}, "pose": {}, "odometry": {}}}]})");
}

void step(int times) {
  Simulation simulation(driving_robot());
  simulation.apply({0, simulation.find_device(0, "motion").value()},
                   sim::TwistCommand{{.v_mps = 0.3, .omega_radps = 0.4}});
  for (int i = 0; i < times; ++i) simulation.step();
}

void wandering_step(int times) {
  Simulation simulation(sim::bench::endless(sim::bench::kThirteen));
  for (int i = 0; i < times; ++i) {
    if (i % 10 == 0) sim::bench::wander(simulation);
    simulation.step();
  }
}

void scan(int times) {
  const Simulation simulation(sim::bench::endless(sim::bench::kOne));
  const int laser = simulation.find_device(0, "laser").value();
  for (int i = 0; i < times; ++i) static_cast<void>(simulation.ideal_scan({0, laser}));
}

void read_scans(int times) {
  const auto host = playerlike::Host::create(sim::bench::endless(sim::bench::kOne));
  PlayerCc::PlayerClient client(host->connect(6665));
  const PlayerCc::LaserProxy laser(&client, 0);
  for (int i = 0; i < times; ++i) client.Read();
}

// The loop that a program writes, without Read().
void beams(int times) {
  const auto host = playerlike::Host::create(sim::bench::endless(sim::bench::kOne));
  PlayerCc::PlayerClient client(host->connect(6665));
  const PlayerCc::LaserProxy laser(&client, 0);
  client.Read();
  double ahead_m = 1.0;
  for (int n = 0; n < times; ++n) {
    for (unsigned i = 0; i < laser.GetCount(); ++i) {
      const double angle_rad = laser.GetBearing(i);
      if (angle_rad > -0.6 && angle_rad < 0.6 && laser[i] < ahead_m) ahead_m = laser[i];
    }
  }
  std::printf("%g\n", ahead_m);
}

}  // namespace

int main(int argc, char** argv) {
  const std::map<std::string, std::function<void(int)>> works = {
      {"beams", beams},
      {"read", read_scans},
      {"scan", scan},
      {"step", step},
      {"wandering_step", wandering_step}};
  const auto work = works.find(argc == 3 ? argv[1] : "");
  if (work == works.end()) {
    std::fprintf(stderr, "Usage: counted_work NAME TIMES; names:");
    for (const auto& [name, unused] : works) std::fprintf(stderr, " %s", name.c_str());
    std::fprintf(stderr, "\n");
    return 2;
  }
  work->second(std::atoi(argv[2]));
}
