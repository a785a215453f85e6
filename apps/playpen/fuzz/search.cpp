// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/search.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace playpen::fuzz {
namespace {

constexpr std::size_t kMostParents = 24;  // of each list
constexpr double kRandomShare = 0.25;

// What a failure is like: failures that are alike are found once.
std::string signature_of(const Failure& failure, const Scenario& scenario) {
  std::string text(name_of(failure.kind));
  if (failure.kind == Kind::kExpectation) return text + ' ' + failure.with;
  if (failure.kind != Kind::kCollision) return text;
  constexpr std::string_view kFound = "found";
  if (!failure.with.starts_with(kFound)) return text + " world";
  std::size_t number = 0;
  std::from_chars(failure.with.data() + kFound.size(), failure.with.data() + failure.with.size(),
                  number);
  if (number == 0 || number > scenario.elements.size()) return text;
  const Element& element = scenario.elements[number - 1];
  return text + ' ' + std::to_string(static_cast<int>(element.shape)) +
         (element.moves ? " moves" : "");
}

}  // namespace

Search::Search(const Base& base, const Rules& rules, Runner& runner, SearchSettings settings)
    : base_(base), rules_(rules), runner_(runner), settings_(std::move(settings)) {}

Scenario Search::next_scenario(sim::RandomStream& random) const {
  const bool has_parents = !by_clearance_.empty() || !by_news_.empty();
  if (!settings_.guided || !has_parents || random.uniform() < kRandomShare) {
    return base_.random(random);
  }
  const bool near = by_news_.empty() || (!by_clearance_.empty() && random.uniform() < 0.6);
  const std::vector<Parent>& parents = near ? by_clearance_ : by_news_;
  // The better ones more often: the square of a uniform number is small.
  const double share = random.uniform();
  const auto index = static_cast<std::size_t>(share * share * static_cast<double>(parents.size()));
  return base_.mutated(parents[std::min(index, parents.size() - 1)].scenario, random);
}

std::vector<std::pair<Scenario, Base::World>> Search::next_generation() {
  std::vector<std::pair<Scenario, Base::World>> all;
  if (generation_ == 0) {
    const Scenario plain;  // the world as it is
    if (auto world = base_.world_of(plain)) all.emplace_back(plain, *std::move(world));
  }
  constexpr std::size_t kTries = 40;  // of a place in the generation
  for (std::size_t i = all.size(); i < kGeneration; ++i) {
    sim::RandomStream random(settings_.seed,
                             "fuzz/" + std::to_string(generation_) + '/' + std::to_string(i));
    for (std::size_t k = 0; k < kTries; ++k) {
      Scenario scenario = next_scenario(random);
      if (auto world = base_.world_of(scenario)) {
        all.emplace_back(std::move(scenario), *std::move(world));
        break;
      }
    }
  }
  ++generation_;
  return all;
}

void Search::keep(const Scenario& scenario, const RunResult& result, const Base::World& world) {
  Parent parent{scenario, least_clearance_m(result, base_), situations_.add(result, base_, world)};
  const auto insert = [&](std::vector<Parent>& list, const auto& is_better) {
    list.insert(
        std::ranges::find_if(list, [&](const Parent& other) { return is_better(parent, other); }),
        parent);
    if (list.size() > kMostParents) list.pop_back();
  };
  insert(by_clearance_,
         [](const Parent& a, const Parent& b) { return a.clearance_m < b.clearance_m; });
  if (parent.news > 0) {
    insert(by_news_, [](const Parent& a, const Parent& b) { return a.news >= b.news; });
  }
}

void Search::run(const std::function<void(const Finding&)>& on_finding) {
  std::size_t findings = 0;
  const auto is_over = [this] { return settings_.is_over && settings_.is_over(); };
  while (findings < settings_.most_findings && runs_ < settings_.most_runs && !is_over()) {
    std::vector<std::pair<Scenario, Base::World>> generation = next_generation();
    if (generation.empty()) return;
    std::vector<std::string> worlds;
    for (const auto& [scenario, world] : generation) worlds.push_back(world.text);
    const auto results = runner_.run(worlds, settings_.is_over);
    for (std::size_t i = 0; i < results.size() && findings < settings_.most_findings; ++i) {
      if (!results[i]) return;
      ++runs_;
      auto& [scenario, world] = generation[i];
      auto failure = failure_of(*results[i], rules_, base_, world);
      if (!failure) {
        keep(scenario, *results[i], world);
        continue;
      }
      const std::string first = signature_of(*failure, scenario);
      if (!known_.insert(first).second) continue;
      Finding finding{std::move(scenario), *std::move(failure), std::move(world), runs_, 0};
      finding.things = finding.scenario.elements.size();
      shrink(finding, runner_, rules_, base_, settings_.most_shrink_runs, settings_.is_over);
      // It may have become one that was found before.
      const std::string now = signature_of(finding.failure, finding.scenario);
      if (now != first && !known_.insert(now).second) continue;
      ++findings;
      on_finding(finding);
    }
  }
}

}  // namespace playpen::fuzz
