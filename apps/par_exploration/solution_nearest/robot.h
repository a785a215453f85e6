// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_EXPLORATION_ROBOT_H
#define PAR_EXPLORATION_ROBOT_H

#include <cstddef>
#include <vector>

#include "explorer.h"
#include "par_common/occupancy_grid.h"

// Explores by visiting the nearest frontier, the classic method (B. Yamauchi, "A frontier-based
// approach for autonomous exploration", CIRA 1997). It is simple and hard to beat by much.
class CRobot : public CExplorer {
 public:
  using CExplorer::CExplorer;
  ~CRobot() override;

 protected:
  std::size_t choose(const std::vector<Candidate>& candidates,
                     const par::Grid<par::CellState>& states) override;
};

#endif
