// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

#include "fuzz/judgement.h"

namespace playpen::fuzz {

/// The situations that a program has been in: for each of eight directions from the robot's heading
/// whether something is near, at a middle distance or far, its speed and its turn, each coarsely.
///
/// It is the counterpart of the edges of a program that coverage-guided fuzzers count (M. Böhme,
/// V.-T. Pham and A. Roychoudhury, "Coverage-based Greybox Fuzzing as Markov Chain", CCS 2016).
class Situations {
 public:
  /// Adds those of a run. @return how many of them are new.
  std::size_t add(const RunResult& result, const Base& base, const Base::World& world);
  [[nodiscard]] std::size_t count() const noexcept { return seen_.size(); }

 private:
  std::set<std::uint32_t> seen_;
};

}  // namespace playpen::fuzz
