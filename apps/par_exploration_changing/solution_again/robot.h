// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_EXPLORATION_CHANGING_ROBOT_H
#define PAR_EXPLORATION_CHANGING_ROBOT_H

#include <cstddef>
#include <string>
#include <vector>

#include "explorer.h"
#include "imr-h/imr_config.h"
#include "libCCMorse/ArenaProxy.h"
#include "libCCMorse/CCMorse.h"

// Explores an arena whose blocks rise and sink. When a block has changed, the robot forgets the map
// at its place. The border of the place then is a frontier, and the robot goes there to look again.
// The exploration ends when nothing is left to explore and no timer of the arena is on.
class CRobot : public CExplorer {
 public:
  explicit CRobot(imr::CConfig& cfg);
  ~CRobot() override;

 protected:
  std::size_t choose(const std::vector<Candidate>& candidates,
                     const par::Grid<par::CellState>& states) override;
  bool lookAhead() override;

 private:
  void forgetBlock(const std::string& name);

  CCMorse::ArenaProxy arena;
  PlayerCc::SimulationProxy simulation;  // the places of the blocks
};

#endif
