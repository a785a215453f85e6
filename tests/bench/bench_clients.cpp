// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Cost of client programs relative to the simulation: 13 clients that wander by laser, the README's
// program, the getter of one beam, and 1000 clients at once.
#include <benchmark/benchmark.h>
#include <libplayerc++/playerc++.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "figures.h"
#include "playerlike/host/host.h"
#include "realtime.h"
#include "wanderers.h"

namespace sim::bench {
namespace {

constexpr int kStepsARound = 10;  // lasers and localisation measure every ten steps

// Compares the same robots without and with clients. The two take turns, so that a slow moment of
// the machine affects both; the minimum of each counts. The names of the figures end with the
// number of robots.
void compare(const WorldDescription& world, int turns, int rounds, const auto& go,
             const std::string& robots) {
  Alone alone(world, kStepsARound);
  Clients clients(playerlike::Host::create(world));
  double alone_us = 1e30;
  double clients_us = 1e30;
  for (int turn = 0; turn < turns; ++turn) {
    alone_us = std::min(alone_us, used_us([&] {
                          for (int i = 0; i < rounds; ++i) go(alone);
                        }));
    clients_us = std::min(clients_us, used_us([&] {
                            for (int i = 0; i < rounds; ++i) go(clients);
                          }));
  }
  const int steps = rounds * kStepsARound;
  figure(("simulation_step_us_" + robots).c_str(), alone_us / steps);
  figure(("clients_step_us_" + robots).c_str(), clients_us / steps);
  figure(("clients_over_simulation_" + robots).c_str(), clients_us / alone_us);
}

// 13 robots of the arena, each driven by its own client.
void wander_figures() {
  compare(
      endless(kThirteen), 40, 200, [](auto& robots) { robots.wander(); }, "13");
}

// The turn of the README's program, for beams whose bearings are bearing(i): what every student
// writes.
void turn_by(const PlayerCc::LaserProxy& laser, PlayerCc::Position2dProxy& position, int turn,
             const auto& count, const auto& bearing) {
  double ahead = 1, right = 1;
  for (unsigned i = 0; i < count(); ++i) {
    const double angle = bearing(i);
    if (angle > -0.6 && angle < 0.6) ahead = std::min(ahead, laser[i]);
    if (angle > -1.2 && angle < -0.4) right = std::min(right, laser[i]);
  }
  if (ahead < 0.25) {
    position.SetSpeed(0, 2);
  } else {
    position.SetSpeed(0.4, turn % 300 < 30 ? 0 : PlayerCc::limit(6 * (0.2 - right), -2.0, 1.5));
  }
}

void readme_turn(const PlayerCc::LaserProxy& laser, PlayerCc::Position2dProxy& position, int turn) {
  turn_by(
      laser, position, turn, [&] { return laser.GetCount(); },
      [&](unsigned i) { return laser.GetBearing(i); });
}

// The same turn, by a program that asks for the count once and knows the bearings.
void hoisted_turn(const PlayerCc::LaserProxy& laser, PlayerCc::Position2dProxy& position,
                  int turn) {
  const unsigned count = laser.GetCount();
  const double first = laser.GetMinAngle();
  const double step = laser.GetScanRes();
  turn_by(
      laser, position, turn, [=] { return count; }, [=](unsigned i) { return first + i * step; });
}

// Simulated seconds a processor second of 13 of the README's programs, each with a robot of its own
// in the arena, in one thread; and of the same programs with hoisted getters.
void readme_figures() {
  const auto host_a = playerlike::Host::create(endless(kThirteen));
  const auto host_b = playerlike::Host::create(endless(kThirteen));
  Clients readme(host_a);
  Clients hoisted(host_b);
  constexpr int kRounds = 200;
  double readme_us = 1e30;
  double hoisted_us = 1e30;
  for (int turn = 0; turn < 40; ++turn) {
    readme_us = std::min(readme_us, used_us([&] { readme.drive(readme_turn, kRounds); }));
    hoisted_us = std::min(hoisted_us, used_us([&] { hoisted.drive(hoisted_turn, kRounds); }));
  }
  const double seconds = 0.1 * kRounds;
  figure("readme_program_13", seconds * 1e6 / readme_us);
  figure("hoisted_program_13", seconds * 1e6 / hoisted_us);
  figure("readme_over_hoisted_13", hoisted_us / readme_us);
}

// A separate function, as in programs.
[[gnu::noinline]] double sum_of_ranges(const PlayerCc::LaserProxy& laser) {
  const std::uint32_t count = laser.GetCount();
  double sum = 0.0;
  for (std::uint32_t i = 0; i < count; ++i) sum += laser[i];
  return sum;
}

// The getter of one beam, over whole scans, with a Read() every hundred scans.
void getter_figure() {
  const auto host = playerlike::Host::create(endless(kOne));
  PlayerCc::PlayerClient client(host->connect(6665));
  PlayerCc::LaserProxy laser(&client, 0);
  constexpr int kScans = 100;
  double best_s = 1e30;
  for (int round = 0; round < 100; ++round) {
    client.Read();
    const std::uint32_t count = laser.GetCount();
    const auto scan = [&] { benchmark::DoNotOptimize(sum_of_ranges(laser)); };
    best_s = std::min(best_s, seconds_per_call(scan, kScans, 1) / count);
  }
  figure("beam_getter_ns", best_s * 1e9);
}

// 1000 robots with laser, localisation and motors, 2 m apart on a plain floor.
WorldDescription plain_floor() {
  std::string text = R"({"arena": {"size": [80, 50]}, "canvas": {"cell_size": 0.25}, "robots": [)";
  for (int i = 0; i < 1000; ++i) {
    text += std::string(i == 0 ? "" : ", ") + R"({"name": "r)" + std::to_string(i) +
            R"(", "pose": {"x": )" + std::to_string(2 * (i % 40) + 1) + R"(, "y": )" +
            std::to_string(2 * (i / 40) + 1) +
            R"(}, "devices": {"laser": {}, "pose": {}, "motion": {}}})";
  }
  return load_world_text(text + "]}");
}

// A thousand clients in one thread, one robot each.
void thousand_figures() {
  const WorldDescription world = plain_floor();
  using Clock = std::chrono::steady_clock;
  double first_read_s = 1e30;
  for (int round = 0; round < 5; ++round) {
    const auto host = playerlike::Host::create(world);
    const auto begin = Clock::now();
    Clients clients(host);
    clients.read();
    first_read_s =
        std::min(first_read_s, std::chrono::duration<double>(Clock::now() - begin).count());
  }
  figure("first_read_ms_1000", first_read_s * 1e3);

  compare(
      world, 20, 3, [](auto& robots) { robots.drive_on(); }, "1000");
}

void BM_BeamGetter(benchmark::State& state) {
  const auto host = playerlike::Host::create(endless(kOne));
  PlayerCc::PlayerClient client(host->connect(6665));
  PlayerCc::LaserProxy laser(&client, 0);
  client.Read();
  std::uint32_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(laser[i]);
    if (++i == laser.GetCount()) {
      i = 0;
      client.Read();
    }
  }
}
BENCHMARK(BM_BeamGetter);

}  // namespace
}  // namespace sim::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  sim::bench::getter_figure();
  sim::bench::wander_figures();
  sim::bench::readme_figures();
  sim::bench::thousand_figures();
}
