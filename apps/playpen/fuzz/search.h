// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "fuzz/judgement.h"
#include "fuzz/shrink.h"
#include "fuzz/situations.h"

namespace playpen::fuzz {

/// How worlds are searched.
struct SearchSettings {
  std::uint64_t seed = 1;
  bool guided = true;              ///< false: each scenario is random
  std::size_t most_runs = 10'000;  ///< of the search itself, without those of making simpler
  std::size_t most_findings = 5;
  std::size_t most_shrink_runs = 400;  ///< for each finding
  std::function<bool()> is_over = {};  ///< asked between runs; may be empty
};

/// Searches for worlds in which a program fails.
///
/// In generations of kGeneration scenarios: a quarter random ones, the others changes of earlier
/// scenarios that came close to a collision, as in search-based testing with the least distance as
/// the fitness (e.g. R. Ben Abdessalem et al., "Testing advanced driver assistance systems using
/// multi-objective search and neural networks", ASE 2016), or that led into new situations. A
/// generation depends on those before it only, so equal seeds and programs give equal findings,
/// whatever the number of jobs.
class Search {
 public:
  static constexpr std::size_t kGeneration = 32;

  /// All must outlive this object.
  Search(const Base& base, const Rules& rules, Runner& runner, SearchSettings settings);

  /// Searches. @param on_finding  called with each finding once it is simple. Findings differ in
  ///     their kind or in what the robot hits.
  void run(const std::function<void(const Finding&)>& on_finding);

  /// Runs of the search so far, without those of making simpler.
  [[nodiscard]] std::size_t runs() const noexcept { return runs_; }
  [[nodiscard]] std::size_t situations() const noexcept { return situations_.count(); }

 private:
  struct Parent {
    Scenario scenario;
    double clearance_m = 0.0;
    std::size_t news = 0;  ///< situations that were new
  };
  [[nodiscard]] std::vector<std::pair<Scenario, Base::World>> next_generation();
  [[nodiscard]] Scenario next_scenario(sim::RandomStream& random) const;
  void keep(const Scenario& scenario, const RunResult& result, const Base::World& world);

  const Base& base_;
  const Rules& rules_;
  Runner& runner_;
  const SearchSettings settings_;
  Situations situations_;
  std::vector<Parent> by_clearance_;  ///< the least first
  std::vector<Parent> by_news_;       ///< the most first
  std::set<std::string> known_;       ///< kinds of failures that were found
  std::size_t generation_ = 0;
  std::size_t runs_ = 0;
};

}  // namespace playpen::fuzz
