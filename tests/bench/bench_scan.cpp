// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Speed of a laser scan compared with one b2World::RayCast per beam in the same world, and of a
// round of 16 sonars compared with beams that fill each cone.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "figures.h"
#include "physics/physics_world.h"
#include "realtime.h"
#include "sim/devices/laser.h"
#include "sim/devices/rangers.h"
#include "sim/simulation/simulation.h"

namespace sim::bench {
namespace {

// The arena with 13 robots; their lasers take turns.
struct Arena {
  Arena()
      : world(load_world(PLAYPEN_SOURCE_DIR "/worlds/examples/thirteen_robots.json")),
        physics(world.arena),
        kernel({laser.beam_count, laser.resolution_rad, laser.range_max_m}),
        ranges(static_cast<std::size_t>(laser.beam_count)) {
    for (const RobotDescription& description : world.robots) {
      physics.add_robot(*find_robot_model(world, description.model), description.pose);
    }
  }

  int next_robot() { return robot = (robot + 1) % physics.robot_count(); }

  void scan() {
    const int r = next_robot();
    const Pose X_WL = physics.body(r).X_WB * laser.X_BL;
    physics.collect_edges(X_WL.position(), laser.range_max_m, laser.height_m, r, false, edges);
    kernel.scan(edges, X_WL.yaw_rad, ranges);
    benchmark::DoNotOptimize(ranges.data());
  }

  void ray_casts() {
    const int r = next_robot();
    const Pose X_WL = physics.body(r).X_WB * laser.X_BL;
    for (int beam = 0; beam < laser.beam_count; ++beam) {
      ranges[static_cast<std::size_t>(beam)] = physics.ray_cast_m(
          X_WL.position(), X_WL.yaw_rad + kernel.geometry().angle_rad(beam), laser.range_max_m, r);
    }
    benchmark::DoNotOptimize(ranges.data());
  }

  LaserParams laser;
  WorldDescription world;
  PhysicsWorld physics;
  scan::ScanKernel kernel;
  scan::EdgeBuffer edges;
  std::vector<double> ranges;
  int robot = 0;
};

void BM_Scan682(benchmark::State& state) {
  Arena arena;
  for (auto _ : state) arena.scan();
}
BENCHMARK(BM_Scan682)->Unit(benchmark::kMicrosecond);

void BM_RayCast682(benchmark::State& state) {
  Arena arena;
  for (auto _ : state) arena.ray_casts();
}
BENCHMARK(BM_RayCast682)->Unit(benchmark::kMicrosecond);

// 16 sonars around a robot, as on a Pioneer: the device, and the slow method with 121 beams per
// cone.
struct Sonars {
  static constexpr int kCount = 16;

  Sonars()
      : params([] {
          SonarParams p;
          p.range_max_m = 5.0;
          p.X_BS.clear();
          for (int i = 0; i < kCount; ++i) {
            const double yaw = normalize_angle(2.0 * std::numbers::pi * i / kCount);
            p.X_BS.push_back({0.07 * std::cos(yaw), 0.07 * std::sin(yaw), yaw});
          }
          return p;
        }()),
        ring("sonar", "sonar", params, false, RandomStream(1, "bench")),
        kernel({121, params.field_of_view_rad / 120.0, params.range_max_m}),
        beams(121) {}

  void exact() {
    const int r = arena.next_robot();
    now_ns += 1'000'000'000;
    ring.update({now_ns, arena.physics.body(r), arena.physics, r, arena.world});
    benchmark::DoNotOptimize(ring.reading().ranges_m.data());
  }

  void by_beams() {
    const int r = arena.next_robot();
    double sum = 0.0;
    for (const Pose& X_BS : params.X_BS) {
      const Pose X_WS = arena.physics.body(r).X_WB * X_BS;
      arena.physics.collect_edges(X_WS.position(), params.range_max_m, params.height_m, r, false,
                                  arena.edges);
      kernel.scan(arena.edges, X_WS.yaw_rad, beams);
      sum += *std::min_element(beams.begin(), beams.end());
    }
    benchmark::DoNotOptimize(sum);
  }

  Arena arena;
  SonarParams params;
  Ranger ring;
  scan::ScanKernel kernel;
  std::vector<double> beams;
  SimTime now_ns = 0;
};

void print_figures() {
  Arena arena;
  // They take turns, so that a slow moment of the machine affects both.
  double scan_s = 1e30;
  double cast_s = 1e30;
  for (int round = 0; round < 10; ++round) {
    scan_s = std::min(scan_s, seconds_per_call([&] { arena.scan(); }, 1300, 3));
    cast_s = std::min(cast_s, seconds_per_call([&] { arena.ray_casts(); }, 39, 3));
  }
  figure("scan_us", scan_s * 1e6);
  figure("scan_ns_per_beam", scan_s * 1e9 / arena.laser.beam_count);
  figure("raycast_us", cast_s * 1e6);
  figure("scan_speedup_over_raycast", cast_s / scan_s);

  Sonars sonars;
  double exact_s = 1e30;
  double beams_s = 1e30;
  for (int round = 0; round < 10; ++round) {
    exact_s = std::min(exact_s, seconds_per_call([&] { sonars.exact(); }, 1300, 3));
    beams_s = std::min(beams_s, seconds_per_call([&] { sonars.by_beams(); }, 390, 3));
  }
  figure("sonar_ring_us", exact_s * 1e6);
  figure("sonar_ring_speedup_over_beams", beams_s / exact_s);
}

}  // namespace
}  // namespace sim::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  sim::bench::print_figures();
  sim::bench::print_realtime_factors();
}
