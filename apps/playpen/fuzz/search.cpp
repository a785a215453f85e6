// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/search.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "fuzz/choice.h"

namespace playpen::fuzz {
namespace {

constexpr std::size_t kMostClose = 16;  // parents of each list
constexpr std::size_t kMostRare = 256;
constexpr double kLeastRandom = 0.2;  // share of random scenarios
constexpr double kMostRandom = 0.8;
constexpr double kForgotten = 0.9;     // of counts, with each generation
constexpr double kRareShare = 0.5;     // of choices of a parent
constexpr double kMixedShare = 0.2;    // of changes
constexpr std::size_t kMostMixed = 8;  // elements

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

const Search::Parent& Search::chosen_parent(sim::RandomStream& random) const {
  const std::vector<Parent>& close = close_[index_below(random, close_.size())];
  if (close.empty() || (!rare_.empty() && random.uniform() < kRareShare)) {
    const double at = random.uniform() * energies_.back();
    const auto found = std::ranges::upper_bound(energies_, at);
    const auto index = static_cast<std::size_t>(found - energies_.begin());
    return rare_[std::min(index, rare_.size() - 1)];
  }
  return close[index_below(random, close.size())];
}

double Search::random_share() const {
  // One new situation more than there were, so that neither starts at 0.
  const auto rate = [this](std::size_t i) { return (news_of_[i] + 1.0) / (runs_of_[i] + 1.0); };
  return std::clamp(rate(0) / (rate(0) + rate(1)), kLeastRandom, kMostRandom);
}

Scenario Search::next_scenario(sim::RandomStream& random, std::size_t& parent) const {
  parent = 0;
  if (!settings_.guided || rare_.empty() || random.uniform() < random_share()) {
    return base_.random(random);
  }
  const Parent& first = chosen_parent(random);
  parent = first.number;
  Scenario scenario = first.scenario;
  // With a thing of another parent.
  if (random.uniform() < kMixedShare) {
    const std::vector<Element>& others = chosen_parent(random).scenario.elements;
    if (!others.empty() && scenario.elements.size() < kMostMixed) {
      scenario.elements.push_back(others[index_below(random, others.size())]);
      return scenario;
    }
  }
  return base_.mutated(std::move(scenario), random);
}

std::vector<Search::Trial> Search::next_generation() {
  std::vector<Trial> all;
  if (generation_ == 0) {
    const Scenario plain;  // the world as it is
    if (auto world = base_.world_of(plain)) all.push_back({plain, *std::move(world), 0});
  }
  for (double& count : runs_of_) count *= kForgotten;
  for (double& count : news_of_) count *= kForgotten;
  energies_.clear();
  for (const Parent& one : rare_) {
    const auto runs = static_cast<double>(situations_.runs_of_rarest(one.situations));
    energies_.push_back((energies_.empty() ? 0.0 : energies_.back()) + 1.0 / std::max(runs, 1.0));
  }
  constexpr std::size_t kTries = 40;  // of a place in the generation
  const std::size_t count = std::min(kGeneration, settings_.most_runs - runs_);
  for (std::size_t i = all.size(); i < count; ++i) {
    sim::RandomStream random(settings_.seed,
                             "fuzz/" + std::to_string(generation_) + '/' + std::to_string(i));
    for (std::size_t k = 0; k < kTries; ++k) {
      std::size_t parent = 0;
      Scenario scenario = next_scenario(random, parent);
      if (auto world = base_.world_of(scenario)) {
        all.push_back({std::move(scenario), *std::move(world), parent});
        break;
      }
    }
  }
  ++generation_;
  return all;
}

void Search::keep_close(std::vector<Parent>& list, const Parent& parent, std::size_t grandparent) {
  if (!std::isfinite(parent.closeness)) return;
  const auto before = std::ranges::find(list, grandparent, &Parent::number);
  if (before != list.end()) {
    if (parent.closeness >= before->closeness) return;
    list.erase(before);
  }
  list.insert(std::ranges::upper_bound(list, parent.closeness, {}, &Parent::closeness), parent);
  if (list.size() > kMostClose) list.pop_back();
}

void Search::keep(const Trial& trial, const RunResult& result) {
  std::vector<Situations::Id> situations = Situations::of(result, base_, trial.world);
  const std::size_t news = situations_.add(situations);
  const std::size_t kind = trial.parent == 0 ? 0 : 1;
  runs_of_[kind] += 1.0;
  news_of_[kind] += static_cast<double>(news);
  Parent parent{runs_, trial.scenario, 0.0, {}};
  const double values[] = {least_clearance_m(result, base_),
                           least_time_to_contact_s(result, base_, trial.world),
                           least_room_m(result, base_, trial.world)};
  for (std::size_t i = 0; i < close_.size(); ++i) {
    parent.closeness = values[i];
    keep_close(close_[i], parent, trial.parent);
  }
  if (news == 0) return;
  parent.situations = std::move(situations);
  rare_.push_back(std::move(parent));
  if (rare_.size() <= kMostRare) return;
  const auto commonest = std::ranges::max_element(
      rare_, {}, [this](const Parent& one) { return situations_.runs_of_rarest(one.situations); });
  rare_.erase(commonest);
}

void Search::run(const std::function<void(const Finding&)>& on_finding) {
  std::size_t findings = 0;
  const auto is_over = [this] { return settings_.is_over && settings_.is_over(); };
  while (findings < settings_.most_findings && runs_ < settings_.most_runs && !is_over()) {
    std::vector<Trial> generation = next_generation();
    if (generation.empty()) return;
    std::vector<std::string> worlds;
    for (const Trial& one : generation) worlds.push_back(one.world.text);
    const auto results = runner_.run(worlds, settings_.is_over);
    for (std::size_t i = 0; i < results.size() && findings < settings_.most_findings; ++i) {
      if (!results[i]) return;
      ++runs_;
      auto& [scenario, world, parent] = generation[i];
      auto failure = failure_of(*results[i], rules_, base_, world);
      if (!failure) {
        keep(generation[i], *results[i]);
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
