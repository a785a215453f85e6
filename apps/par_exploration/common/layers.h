// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_EXPLORATION_LAYERS_H
#define PAR_EXPLORATION_LAYERS_H

#include <vector>

#include "libCCMorse/CCMorse.h"
#include "par_common/frontiers.h"
#include "par_common/occupancy_grid.h"
#include "par_common/planners.h"
#include "shared_map.h"

// What the robot knows and intends, in layers of the grid-map over the arena. From below:
//   occupancy  white free, black occupied, grey unknown
//   inflated   blue: free, but too close to something for the robot's centre
//   frontiers  purple: where the known ends
//   scan       green: the last scan
//   trail      red: where the robot was
//   path       orange: where it means to go
//
// The functions of the first group are called by the thread that collects data, those of the second
// one by the thread that drives; no layer is drawn by both.
class CLayers {
 public:
  // Makes the layers. The client must outlive this object.
  explicit CLayers(CCMorse::PlayerClient* client);
  ~CLayers();

  // Size and place of the canvas: the map's, too.
  const par::GridFrame& getFrame() const { return frame; }

  void drawMap(const par::OccupancyGrid& map);
  void drawScan(const Observation& seen);
  void drawTrail(const par::Pose& robot);

  void drawInflated(const par::Mask& inflated);
  void drawFrontiers(const std::vector<par::Frontier>& frontiers);
  void drawPath(const std::vector<par::Cell>& turns);

 private:
  CCMorse::WindowProxy& window;
  CCMorse::GridMapLayer& occupancy;
  CCMorse::GridMapLayer& inflated;
  CCMorse::GridMapLayer& frontiers;
  CCMorse::GridMapLayer& scan;
  CCMorse::GridMapLayer& trail;
  CCMorse::GridMapLayer& path;
  par::GridFrame frame;

  bool trailBegun = false;
  par::Pose last;  // where the trail ends
};

#endif
