// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
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
/// In generations of kGeneration scenarios. Some are random, the others changes of earlier
/// scenarios, their parents. These came close to a failure, as in search-based testing with a
/// distance as the fitness (e.g. R. Ben Abdessalem et al., "Testing advanced driver assistance
/// systems using multi-objective search and neural networks", ASE 2016), or led into situations
/// that are rare: the rarer, the more often they are changed, as by the power schedules of AFLFast
/// (M. Böhme, V.-T. Pham and A. Roychoudhury, "Coverage-based Greybox Fuzzing as Markov Chain", CCS
/// 2016). A change takes the place of its parent in a list of the closest ones, so that these stay
/// different. The share of random scenarios follows the number of new situations that they have led
/// to, beside that of the changes (probability matching: D. Thierens, "An adaptive pursuit strategy
/// for allocating operator probabilities", GECCO 2005).
///
/// A generation depends on those before it only, so equal seeds and programs give equal findings,
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
    std::size_t number = 0;  ///< of its run
    Scenario scenario;
    double closeness = 0.0;                  ///< the less, the closer to a collision
    std::vector<Situations::Id> situations;  ///< of the rare ones
  };
  /// A scenario of a generation.
  struct Trial {
    Scenario scenario;
    Base::World world;
    std::size_t parent = 0;  ///< number of its parent's run; 0: it is random
  };
  [[nodiscard]] std::vector<Trial> next_generation();
  [[nodiscard]] Scenario next_scenario(sim::RandomStream& random, std::size_t& parent) const;
  [[nodiscard]] const Parent& chosen_parent(sim::RandomStream& random) const;
  [[nodiscard]] double random_share() const;
  void keep(const Trial& trial, const RunResult& result);
  static void keep_close(std::vector<Parent>& list, const Parent& parent, std::size_t grandparent);

  const Base& base_;
  const Rules& rules_;
  Runner& runner_;
  const SearchSettings settings_;
  Situations situations_;
  /// By clearance, by time to a contact and by room: the least first.
  std::array<std::vector<Parent>, 3> close_;
  std::vector<Parent> rare_;      ///< led into new situations; the oldest first
  std::vector<double> energies_;  ///< sums of those of rare_, for this generation
  /// Of random scenarios and of changes, the old ones counting less.
  std::array<double, 2> runs_of_{};
  std::array<double, 2> news_of_{};
  std::set<std::string> known_;  ///< kinds of failures that were found
  std::size_t generation_ = 0;
  std::size_t runs_ = 0;
};

}  // namespace playpen::fuzz
