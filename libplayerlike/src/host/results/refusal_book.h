// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/time.h"

namespace playerlike {

/// What was refused to the program because its task does not allow it, for the run's report. Each
/// thing is noted once.
class RefusalBook {
 public:
  struct Refusal {
    sim::SimTime time_ns = 0;  ///< of the first time
    std::string what;          ///< as Permissions calls it
  };

  /// @return whether it is new.
  bool note(std::string what, sim::SimTime now_ns) {
    const auto is_known = [&what](const Refusal& known) { return known.what == what; };
    if (std::any_of(refusals_.begin(), refusals_.end(), is_known)) return false;
    refusals_.push_back({now_ns, std::move(what)});
    return true;
  }
  /// In the order of their times.
  [[nodiscard]] const std::vector<Refusal>& refusals() const noexcept { return refusals_; }

 private:
  std::vector<Refusal> refusals_;
};

}  // namespace playerlike
