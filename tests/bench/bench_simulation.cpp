// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Cost of a step compared with the bare physics and the bare scans, the additional cost of a
// client's Read(), and the speed relative to real time.
#include <benchmark/benchmark.h>
#include <libplayerc++/playerc++.h>

#include <algorithm>
#include <any>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "controller_load.h"
#include "crowd.h"
#include "figures.h"
#include "moving_load.h"
#include "physics/physics_world.h"
#include "realtime.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"
#include "sim/devices/motion.h"
#include "sim/simulation/simulation.h"

namespace sim::bench {
namespace {

// The bare cost of a step of 13 robots: b2World::Step, and a tenth of each robot's scan.
struct Bare {
  explicit Bare(const WorldDescription& world)
      : physics(world.arena),
        kernel({laser.beam_count, laser.resolution_rad, laser.range_max_m}),
        ranges(static_cast<std::size_t>(laser.beam_count)) {
    for (const RobotDescription& robot : world.robots) {
      physics.add_robot(*find_robot_model(world, robot.model), robot.pose);
    }
  }
  void scan_all() {
    for (int r = 0; r < physics.robot_count(); ++r) {
      const Pose X_WL = physics.body(r).X_WB * laser.X_BL;
      physics.collect_edges(X_WL.position(), laser.range_max_m, laser.height_m, r, false, edges);
      kernel.scan(edges, X_WL.yaw_rad, ranges);
    }
  }
  LaserParams laser;
  PhysicsWorld physics;
  scan::ScanKernel kernel;
  scan::EdgeBuffer edges;
  std::vector<double> ranges;
};

// 13 wandering robots, and the same robots with the same targets in plain Box2D. The two take
// turns, so that a slow moment of the machine affects both.
void step_figures() {
  const WorldDescription world = endless(kThirteen);
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;
  // Take the minimum over the rounds: other processes can only add time.
  Seconds best_step{1e30};
  Seconds best_bare{1e30};
  Seconds best_scans{1e30};
  for (int round = 0; round < 7; ++round) {
    Simulation simulation(world);
    Bare bare(world);
    Seconds step{};
    Seconds bare_step{};
    Seconds scans{};
    constexpr int kRounds = 400;
    for (int k = 0; k < kRounds; ++k) {
      wander(simulation);
      for (int r = 0; r < simulation.robot_count(); ++r) {
        const auto& motion = dynamic_cast<const Motion&>(
            simulation.device(r, simulation.find_device(r, "motion").value()));
        bare.physics.set_target(r, motion.commanded());
      }
      const auto t0 = Clock::now();
      for (int i = 0; i < 10; ++i) simulation.step();
      const auto t1 = Clock::now();
      for (int i = 0; i < 10; ++i) bare.physics.plain_box2d_step(0.01);
      const auto t2 = Clock::now();
      bare.scan_all();
      const auto t3 = Clock::now();
      step += t1 - t0;
      bare_step += t2 - t1;
      scans += t3 - t2;
    }
    best_step = std::min(best_step, step / (10.0 * kRounds));
    best_bare = std::min(best_bare, bare_step / (10.0 * kRounds));
    best_scans = std::min(best_scans, scans / (10.0 * kRounds));
  }
  figure("step_us", best_step.count() * 1e6);
  figure("bare_step_us", best_bare.count() * 1e6);
  figure("bare_scans_us_per_step", best_scans.count() * 1e6);
  figure("step_overhead_ratio", best_step / (best_bare + best_scans));
}

// Read() of a client with position and laser, compared with the ten steps that it waits for.
void read_figures() {
  Simulation plain(endless(kOne));
  ::setenv("PLAYPEN_WORLD", kOne, 1);
  ::setenv("PLAYPEN_DURATION", "1e9", 1);
  PlayerCc::PlayerClient client("localhost", 6665);
  PlayerCc::Position2dProxy position(&client, 0);
  PlayerCc::LaserProxy laser(&client, 0);
  double read_s = 1e30;
  double steps_s = 1e30;
  for (int round = 0; round < 20; ++round) {
    read_s = std::min(read_s, seconds_per_call([&] { client.Read(); }, 500, 3));
    steps_s = std::min(steps_s, seconds_per_call(
                                    [&] {
                                      for (int i = 0; i < 10; ++i) plain.step();
                                    },
                                    500, 3));
  }
  figure("read_us", read_s * 1e6);
  figure("read_overhead_us", (read_s - steps_s) * 1e6);
}

double resident_kb() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmRSS:", 0) == 0) return std::stod(line.substr(6));
  }
  return 0.0;
}

// Memory growth over a million steps of one robot, after a warm-up.
void memory_figure() {
  Simulation simulation(endless(kOne));
  const auto run = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      if (i % 10 == 0) wander(simulation);
      simulation.step();
    }
  };
  run(20'000);
  const double before_kb = resident_kb();
  run(1'000'000);
  figure("memory_growth_kb_per_million_steps", std::max(0.0, resident_kb() - before_kb));
}

// Minimum duration of `work` over some rounds [s].
template <typename Work>
double least_s(Work work) {
  double best_s = 1e30;
  for (int round = 0; round < 20; ++round) {
    const std::clock_t begin = std::clock();
    work();
    best_s = std::min(best_s, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return best_s;
}

// Saves and restores 1000 robots with all devices of an S1R, 2 m apart on a plain floor. Laser and
// odometry have noise.
void save_figures() {
  WorldDescription world = endless(PLAYPEN_SOURCE_DIR "/worlds/examples/empty_room.json");
  world.arena.size = {64.0, 66.0};
  RobotDescription robot = world.robots[0];
  for (DeviceDescription& device : robot.devices) {
    if (auto* laser = std::any_cast<LaserParams>(&device.params)) laser->noise_m = 0.01;
    if (auto* odometry = std::any_cast<OdometryParams>(&device.params)) odometry->noise = 0.01;
  }
  world.robots.clear();
  for (int i = 0; i < 1000; ++i) {
    robot.name = std::string("r").append(std::to_string(i));
    robot.port = 20'000 + i;
    robot.pose = {1.0 + 2.0 * (i % 32), 1.0 + 2.0 * (i / 32), 0.1 * i};
    world.robots.push_back(robot);
  }
  Simulation simulation(world);
  for (int i = 0; i < 50; ++i) {
    if (i % 10 == 0) wander(simulation);
    simulation.step();
  }
  const Snapshot snapshot = simulation.save();
  figure("save_ms_1000", least_s([&] { benchmark::DoNotOptimize(simulation.save()); }) * 1e3);
  figure("restore_ms_1000", least_s([&] { simulation.restore(snapshot); }) * 1e3);
  figure("state_mb_1000", static_cast<double>(snapshot.size()) * 1e-6);
  Simulation thirteen(endless(kThirteen));
  for (int i = 0; i < 50; ++i) thirteen.step();
  figure("hash_us_13", least_s([&] { benchmark::DoNotOptimize(thirteen.state_hash()); }) * 1e6);
  figure("fork_us_13", least_s([&] { benchmark::DoNotOptimize(thirteen.fork()); }) * 1e6);
}

void BM_Step(benchmark::State& state, const char* file) {
  Simulation simulation(endless(file));
  int i = 0;
  for (auto _ : state) {
    if (i++ % 10 == 0) wander(simulation);
    simulation.step();
  }
}
BENCHMARK_CAPTURE(BM_Step, one_robot, kOne)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(BM_Step, thirteen_robots, kThirteen)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace sim::bench

// With --world FILE: only the cost per robot, for each --robots N that is given (default 1, 10, 50
// and 200). Its robots keep only lasers, motors and odometry. --devices TYPE,TYPE... keeps other
// devices instead (laser and motion must be among them); --devices all keeps all.
int main(int argc, char** argv) {
  std::string world;
  std::vector<int> counts;
  std::vector<std::string> types = {"laser", "motion", "odometry"};
  for (int i = 1; i + 1 < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--world")
      world = argv[++i];
    else if (option == "--robots")
      counts.push_back(std::stoi(argv[++i]));
    else if (option == "--devices") {
      std::stringstream list(argv[++i]);
      types.clear();
      for (std::string type; std::getline(list, type, ',');) types.push_back(type);
    }
  }
  if (!world.empty()) {
    if (counts.empty()) counts = {1, 10, 50, 200};
    if (types == std::vector<std::string>{"all"}) types.clear();
    sim::bench::print_crowd(world.c_str(), counts, types);
    return 0;
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  sim::bench::step_figures();
  sim::bench::read_figures();
  sim::bench::memory_figure();
  sim::bench::save_figures();
  sim::bench::controller_figures();
  sim::bench::moving_figures();
  sim::bench::print_realtime_factors();
}
