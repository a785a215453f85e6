// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "fuzz/judgement.h"

namespace playpen::fuzz {

/// The situations that a program has been in. One is, for each of eight directions from the robot's
/// heading, whether something is near, at a middle distance or far, with its speed and its turn,
/// each coarsely. Others come from what the program prints: each pair of successive lines, without
/// their numbers, once for each power of two of its count.
///
/// They are the counterpart of the edges of a program, and of the classes of their counts, in a
/// coverage-guided fuzzer (M. Böhme, V.-T. Pham and A. Roychoudhury, "Coverage-based Greybox
/// Fuzzing as Markov Chain", CCS 2016).
class Situations {
 public:
  using Id = std::uint64_t;

  /// Those of a run, each once, in ascending order.
  [[nodiscard]] static std::vector<Id> of(const RunResult& result, const Base& base,
                                          const Base::World& world);
  /// Counts a run with these situations. @return how many of them are new.
  std::size_t add(const std::vector<Id>& situations);
  /// Number of runs that had the rarest of these situations; 0: there are none.
  [[nodiscard]] std::size_t runs_of_rarest(const std::vector<Id>& situations) const;
  [[nodiscard]] std::size_t count() const noexcept { return runs_.size(); }

 private:
  std::map<Id, std::size_t> runs_;
};

/// The mean of the free distances on the robot's four sides, where it was most enclosed [m];
/// infinite without a trajectory.
[[nodiscard]] double least_room_m(const RunResult& result, const Base& base,
                                  const Base::World& world);

/// How long the robot would have needed to hit the standing obstacle ahead of it, at the most
/// dangerous moment of a run [s]; infinite if it never drove towards one.
[[nodiscard]] double least_time_to_contact_s(const RunResult& result, const Base& base,
                                             const Base::World& world);

}  // namespace playpen::fuzz
