// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_EXPLORATION_ROBOT_H
#define PAR_EXPLORATION_ROBOT_H

#include <cstddef>
#include <vector>

#include "explorer.h"
#include "imr-h/imr_config.h"
#include "par_common/occupancy_grid.h"

// Explores by weighing the information gain at a frontier against the path to it (H. H.
// Gonzalez-Banos and J.-C. Latombe, "Navigation strategies for exploring indoor environments",
// International Journal of Robotics Research 21(10-11), 2002). It visits the candidate with the
// greatest
//
//   gain x exp(-lambda x way)
//
// The gain is the unknown area that may be visible from there; `way` is the length of the path.
// With lambda = 0 only the gain counts; with a large lambda the result is close to the nearest
// frontier.
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
  double range;   // range within which the gain is counted [m]
};

#endif
