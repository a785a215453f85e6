// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "robot.h"

#include <algorithm>

CRobot::~CRobot() {
  stop();
  join();
}

// The candidate with the shortest path; the first one of several equals.
std::size_t CRobot::choose(const std::vector<Candidate>& candidates,
                           const par::Grid<par::CellState>&) {
  const auto nearest =
      std::min_element(candidates.begin(), candidates.end(),
                       [](const Candidate& a, const Candidate& b) { return a.way < b.way; });
  return static_cast<std::size_t>(nearest - candidates.begin());
}
