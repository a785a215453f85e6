// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "robot.h"

#include <algorithm>
#include <set>

namespace {

// The forgotten place is larger than the block by this much on each side, so that the robot looks
// again at the floor in front of the block, too: noise puts ends of beams there [m].
const double MARGIN = 0.04;

}  // namespace

CRobot::CRobot(imr::CConfig& cfg)
    : CExplorer(cfg), arena(getClient()), simulation(getClient(), 0) {}

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

bool CRobot::lookAhead() {
  std::set<std::string> changed;
  for (const CCMorse::ArenaEvent& event : arena.GetEvents()) {
    // A block that rises slowly changes twice: when it begins and when it has risen.
    if (event.kind == "rising" || event.kind == "extended" || event.kind == "retracted") {
      changed.insert(event.what);
    }
  }
  for (const std::string& block : changed) forgetBlock(block);

  for (const std::string& timer : arena.GetTimerNames()) {
    if (arena.IsTimerEnabled(timer)) return false;
  }
  return true;
}

void CRobot::forgetBlock(const std::string& name) {
  Area area;
  simulation.GetPose2d(name.c_str(), area.centre.x, area.centre.y, area.centre.yaw);
  double size[2] = {0.0, 0.0};
  simulation.GetProperty(name.c_str(), "size", size, sizeof size);
  area.length = size[0] + 2.0 * MARGIN;
  area.width = size[1] + 2.0 * MARGIN;
  lookAgain(area);
}
