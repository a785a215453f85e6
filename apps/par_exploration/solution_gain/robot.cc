// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "robot.h"

#include <cmath>

#include "imr-h/imr_exceptions.h"
#include "par_common/frontiers.h"

imr::CConfig& CRobot::getConfig(imr::CConfig& config) {
  CExplorer::getConfig(config);
  config.add<double>("lambda", "discount of the gain per metre of path", 1.0);
  config.add<double>("gain-range", "radius within which unknown floor counts as gain [m]", 1.0);
  return config;
}

CRobot::CRobot(imr::CConfig& cfg)
    : CExplorer(cfg), lambda(cfg.get<double>("lambda")), range(cfg.get<double>("gain-range")) {
  imr::assert_argument(lambda >= 0.0, "--lambda must not be negative");
  imr::assert_argument(range > 0.0 && range <= 5.0, "--gain-range must be above 0, and 5 at most");
}

CRobot::~CRobot() {
  stop();
  join();
}

// The candidate with the greatest worth; the first one of several equals.
std::size_t CRobot::choose(const std::vector<Candidate>& candidates,
                           const par::Grid<par::CellState>& states) {
  std::size_t best = 0;
  double bestWorth = -1.0;
  for (std::size_t i = 0; i < candidates.size(); i++) {
    const double gain =
        static_cast<double>(par::information_gain(states, candidates[i].place, range));
    const double worth = gain * std::exp(-lambda * candidates[i].way);
    if (worth <= bestWorth) continue;
    best = i;
    bestWorth = worth;
  }
  return best;
}
