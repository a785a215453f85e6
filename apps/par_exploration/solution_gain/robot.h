// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_EXPLORATION_ROBOT_H
#define PAR_EXPLORATION_ROBOT_H

#include <cstddef>
#include <vector>

#include "explorer.h"
#include "imr-h/imr_config.h"
#include "par_common/occupancy_grid.h"

// Explores by weighing what is to be seen at a frontier against the way to it (H. H. Gonzalez-Banos
// and J.-C. Latombe, "Navigation strategies for exploring indoor environments", International
// Journal of Robotics Research 21(10-11), 2002): it goes where
//
//   gain x exp(-lambda x way)
//
// is greatest. The gain is the unknown area that may be seen from there; lambda says how little a
// long way is liked: 0, gain is all; the greater, the more it behaves like the nearest frontier.
class CRobot : public CExplorer {
 public:
  static imr::CConfig& getConfig(imr::CConfig& config);

  explicit CRobot(imr::CConfig& cfg);
  ~CRobot() override;

 protected:
  std::size_t choose(const std::vector<Candidate>& candidates,
                     const par::Grid<par::CellState>& states) override;

 private:
  double lambda;  // [1/m]
  double range;   // the gain is counted this far round a place [m]
};

#endif
