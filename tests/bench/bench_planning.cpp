// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Duration of planning on a grid of 186 x 172 cells, the arena's canvas.
#include <benchmark/benchmark.h>

#include <string>

#include "figures.h"
#include "par_common/distance.h"
#include "par_common/planners.h"
#include "par_common/text_map.h"

namespace sim::bench {
namespace {

using Planner = par::Path (*)(const par::Mask&, const par::Cell&, const par::Cell&);

// The planning task: its map with inflated obstacles, its start and its goal.
struct Task {
  Task()
      : walls(par::load_text_map(PLAYPEN_SOURCE_DIR "/worlds/maps/par_planning.txt")),
        inflated(par::inflate(walls, 0.13)),
        start(near({1.2, 0.9})),
        goal(near({3.1, 3.3})) {}

  [[nodiscard]] par::Cell near(const par::Point& point) const {
    return par::nearest_free(inflated, inflated.frame().cell_of(point), 0.15).value();
  }

  par::Mask walls;
  par::Mask inflated;
  par::Cell start;
  par::Cell goal;
};

void BM_Plan(benchmark::State& state, Planner planner) {
  const Task task;
  for (auto _ : state) {
    benchmark::DoNotOptimize(planner(task.inflated, task.start, task.goal).length_m);
  }
}
BENCHMARK_CAPTURE(BM_Plan, dijkstra, par::dijkstra)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(BM_Plan, a_star, par::a_star)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(BM_Plan, theta_star, par::theta_star)->Unit(benchmark::kMicrosecond);

void BM_Inflate(benchmark::State& state) {
  const Task task;
  for (auto _ : state) benchmark::DoNotOptimize(par::inflate(task.walls, 0.13).values().data());
}
BENCHMARK(BM_Inflate)->Unit(benchmark::kMicrosecond);

void print_figures() {
  const Task task;
  struct Row {
    const char* name;
    Planner planner;
  };
  for (const Row& row : {Row{"plan_ms_dijkstra", par::dijkstra}, Row{"plan_ms_a_star", par::a_star},
                         Row{"plan_ms_theta_star", par::theta_star}}) {
    const double seconds = seconds_per_call(
        [&] {
          benchmark::DoNotOptimize(row.planner(task.inflated, task.start, task.goal).length_m);
        },
        20);
    figure(row.name, seconds * 1e3);
  }
  const double seconds = seconds_per_call(
      [&] { benchmark::DoNotOptimize(par::inflate(task.walls, 0.13).values().data()); }, 20);
  figure("inflate_ms", seconds * 1e3);
}

}  // namespace
}  // namespace sim::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  sim::bench::print_figures();
}
