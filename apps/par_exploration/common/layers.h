// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_EXPLORATION_LAYERS_H
#define PAR_EXPLORATION_LAYERS_H

#include <vector>

#include "libCCMorse/CCMorse.h"
#include "par_common/frontiers.h"
#include "par_common/occupancy_grid.h"
#include "par_common/planners.h"
#include "shared_map.h"

// The robot's knowledge and intentions, drawn as layers of the grid-map over the arena. From bottom
// to top:
//   occupancy  white free, black occupied, grey unknown
//   inflated   blue: free, but too close to something for the robot's centre
//   frontiers  purple: the border between known and unknown
//   scan       green: the last scan
//   trail      red: where the robot has been
//   path       orange: the planned path
//
// The thread that collects data calls the first group of functions, the thread that drives the
// second group. No layer is drawn by both threads.
class CLayers {
 public:
  // Creates the layers. The client must outlive this object.
  explicit CLayers(CCMorse::PlayerClient* client);
  ~CLayers();

  // Size and position of the canvas, and of the map.
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
