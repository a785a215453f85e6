// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Speed of Monte Carlo localisation: an update of 2000 particles with a scan of 60 beams, in the
// SyRoTek arena and in the office.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "figures.h"
#include "sim/devices/amcl.h"
#include "sim/simulation/simulation.h"
#include "sim/world/description.h"

namespace sim::bench {
namespace {

constexpr int kParticles = 2000;

/// A filter whose number of particles stays the same, and a scan that fits the pose of its robot.
struct Load {
  explicit Load(const std::string& world) {
    const WorldDescription description = load_world(PLAYPEN_SOURCE_DIR "/worlds/" + world);
    AmclParams params;
    params.min_samples = kParticles;
    params.max_samples = kParticles;
    const auto map = localization_map(description.arena, params.map_resolution_m);
    auto field = std::make_shared<const LikelihoodField>(
        map.value(), LikelihoodSettings{params.range_deviation_m, params.bad_share});
    localizer = std::make_unique<MonteCarloLocalizer>(monte_carlo_settings(params),
                                                      std::move(field), RandomStream(1, "bench"));
    localizer->set_pose(description.robots.at(0).pose, {{0.01, 0.01, 0.01}, {}});
    for (int i = 0; i < params.max_beams; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / params.max_beams;
      scan.p_BQ.emplace_back(1.5 * std::cos(angle), 1.5 * std::sin(angle));
    }
  }

  void update() {
    localizer->move({i_ % 2 == 0 ? 0.2 : -0.2, 0.0, 0.0});
    ++i_;
    localizer->update(scan);
  }

  std::unique_ptr<MonteCarloLocalizer> localizer;
  ScanPoints scan;

 private:
  int i_ = 0;
};

void update(benchmark::State& state, const char* world) {
  Load load(world);
  for (auto _ : state) load.update();
}
BENCHMARK_CAPTURE(update, arena, "syrotek.json");
BENCHMARK_CAPTURE(update, office, "office.json");

void print_figures() {
  Load arena("syrotek.json");
  Load office("office.json");
  figure("localization_update_arena_ms", 1e3 * seconds_per_call([&] { arena.update(); }, 1, 300));
  figure("localization_update_office_ms", 1e3 * seconds_per_call([&] { office.update(); }, 1, 300));
}

}  // namespace
}  // namespace sim::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  sim::bench::print_figures();
}
