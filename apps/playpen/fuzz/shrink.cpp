// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/shrink.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace playpen::fuzz {
namespace {

struct Candidate {
  Scenario scenario;
  Base::World world;
};

// The scenarios that are simpler and are worlds, the simplest first.
std::vector<Candidate> candidates_of(const Scenario& scenario, const Base& base) {
  std::vector<Candidate> all;
  for (Scenario& one : simpler(scenario)) {
    if (weight_of(one) >= weight_of(scenario) || !base.allows(one)) continue;
    if (auto world = base.world_of(one)) all.push_back({std::move(one), *std::move(world)});
  }
  std::ranges::stable_sort(all, {}, [](const Candidate& one) { return weight_of(one.scenario); });
  return all;
}

// The failure of the same kind that the first of these scenarios has which has one. They run in
// parts of as many as there are jobs, because most often one of the first has it, and a program
// that hangs takes its whole wall time.
struct Simpler {
  std::size_t index;
  Failure failure;
};

std::optional<Simpler> first_failure(const std::vector<Candidate>& candidates, Kind kind,
                                     Runner& runner, const Rules& rules, const Base& base,
                                     const std::function<bool()>& is_over) {
  const std::size_t jobs = runner.settings().jobs;
  for (std::size_t begin = 0; begin < candidates.size(); begin += jobs) {
    std::vector<std::string> worlds;
    for (std::size_t i = begin; i < std::min(begin + jobs, candidates.size()); ++i) {
      worlds.push_back(candidates[i].world.text);
    }
    const auto results = runner.run(worlds, is_over);
    for (std::size_t i = 0; i < results.size(); ++i) {
      if (!results[i]) return std::nullopt;  // there is no time left
      auto failure = failure_of(*results[i], rules, base, candidates[begin + i].world);
      if (failure && failure->kind == kind) return Simpler{begin + i, *std::move(failure)};
    }
  }
  return std::nullopt;
}

}  // namespace

void shrink(Finding& finding, Runner& runner, const Rules& rules, const Base& base,
            std::size_t most_runs, const std::function<bool()>& is_over) {
  // Counts the runs that one job would need, so that the result does not depend on their number.
  for (std::size_t runs = 0; runs < most_runs;) {
    std::vector<Candidate> candidates = candidates_of(finding.scenario, base);
    auto found = first_failure(candidates, finding.failure.kind, runner, rules, base, is_over);
    if (!found) return;
    runs += found->index + 1;
    finding.scenario = std::move(candidates[found->index].scenario);
    finding.world = std::move(candidates[found->index].world);
    finding.failure = std::move(found->failure);
  }
}

}  // namespace playpen::fuzz
