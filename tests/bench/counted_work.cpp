// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Work whose instructions tests/bench/instructions.py counts: counted_work NAME TIMES.
#include <libplayerc++/playerc++.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "playerlike/host/host.h"
#include "realtime.h"
#include "sim/canvas/layers.h"
#include "sim/devices/rangers.h"
#include "sim/parallel/batch.h"

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

// The rings of 16 sonars of 13 robots that stand between blocks, in each step.
void sonar_rings(int times) {
  constexpr int kCount = 16;
  sim::SonarParams ring;
  ring.frequency_hz = 100.0;
  ring.range_max_m = 5.0;
  ring.X_BS.clear();
  for (int i = 0; i < kCount; ++i) {
    const double yaw = sim::normalize_angle(2.0 * std::numbers::pi * i / kCount);
    ring.X_BS.push_back({0.07 * std::cos(yaw), 0.07 * std::sin(yaw), yaw});
  }
  sim::WorldDescription world = sim::bench::endless(sim::bench::kThirteen);
  for (sim::RobotDescription& robot : world.robots) robot.devices = {{"sonar", "sonar", ring}};
  Simulation simulation(world);
  for (int i = 0; i < times; ++i) simulation.step();
}

// 4096 pixels on the canvas below eight layers.
void pixels(int times) {
  sim::LayerStack stack({.width = 172, .height = 186});
  for (int i = 0; i < 8; ++i) stack.add(sim::LayerKind::kColour, {}, 0);
  std::vector<sim::DrawOperation> drawings;
  for (int i = 0; i < 4096; ++i) {
    drawings.push_back({sim::DrawOperation::Kind::kPixel, sim::kBaseLayer, (7 * i) % 172,
                        (13 * i) % 186, 0, 0, sim::CellValue::of(sim::Colour{255, 0, 0, 255})});
  }
  for (int i = 0; i < times; ++i) stack.draw(drawings);
}

// Decisions of 16 simulations at once, with a scan each. The robots drive on circles.
void many(int times, int beams) {
  constexpr int kCount = 16;
  sim::Batch batch(sim::bench::endless(sim::bench::kOne),
                   {.simulations = kCount, .threads = 1, .beams = beams});
  std::vector<double> actions;
  for (int i = 0; i < kCount; ++i) actions.insert(actions.end(), {0.2, 0.5});
  std::vector<float> scans(static_cast<std::size_t>(kCount * batch.beams()));
  for (int i = 0; i < times; i += kCount) {
    batch.step({actions}, 1, {.scans = {scans}});
  }
}

// Saves 13 robots with all devices of an S1R.
void save(int times) {
  Simulation simulation(sim::bench::endless(sim::bench::kThirteen));
  for (int i = 0; i < 50; ++i) simulation.step();
  for (int i = 0; i < times; ++i) static_cast<void>(simulation.save());
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
      {"pixels", pixels},
      {"many", [](int times) { many(times, 0); }},
      {"many_180", [](int times) { many(times, 180); }},
      {"read", read_scans},
      {"save", save},
      {"scan", scan},
      {"sonar_rings", sonar_rings},
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
