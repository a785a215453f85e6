// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/shrink.h"

#include <algorithm>
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

}  // namespace

void shrink(Finding& finding, Runner& runner, const Rules& rules, const Base& base,
            std::size_t most_runs, const std::function<bool()>& is_over) {
  const std::size_t begin = runner.count();
  for (;;) {
    std::vector<Candidate> candidates = candidates_of(finding.scenario, base);
    std::vector<std::string> worlds;
    for (const Candidate& one : candidates) worlds.push_back(one.world.text);
    const auto results = runner.run(worlds, is_over);
    bool found = false;
    for (std::size_t i = 0; i < candidates.size() && !found; ++i) {
      if (!results[i]) return;  // there is no time left
      auto failure = failure_of(*results[i], rules, base, candidates[i].world);
      if (!failure || failure->kind != finding.failure.kind) continue;
      finding.scenario = std::move(candidates[i].scenario);
      finding.world = std::move(candidates[i].world);
      finding.failure = *std::move(failure);
      found = true;
    }
    if (!found || runner.count() - begin >= most_runs) return;
  }
}

}  // namespace playpen::fuzz
