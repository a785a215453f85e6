// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_TRAPS_TRAPS_H
#define PAR_TRAPS_TRAPS_H

#include <string>
#include <vector>

#include "par_common/grid.h"

// What the robot knows about the traps. Nobody says how large they are, so each place where one has
// sprung stands for a circle around it.
class CTraps {
 public:
  // A place where a trap has sprung.
  struct Place {
    std::string trap;      // its name
    par::Point at;         // where the robot was
    double points = 0.0;   // what it lost there, >= 0
    bool putBack = false;  // whether it was put back to its start
  };

  // Remembers a place. Its points and putBack become known later, by setLoss() and setPutBack().
  void add(const std::string& trap, const par::Point& at);
  // For the newest place of that trap.
  void setLoss(const std::string& trap, double points);
  // For the newest place.
  void setPutBack();

  // The additional cost of a step to each cell of the frame, in cells; 0 outside known traps.
  par::Grid<double> costs(const par::GridFrame& frame) const;

  const std::vector<Place>& places() const { return known; }

 private:
  std::vector<Place> known;
};

// The cheapest path from one free cell to another: each step costs its length plus the additional
// cost of the cell that it leads to. Empty if there is no path. Dijkstra's algorithm.
std::vector<par::Cell> cheapestPath(const par::Mask& blocked, const par::Grid<double>& costs,
                                    const par::Cell& start, const par::Cell& goal);

// Removes turns from a path where the robot can drive straight on without entering a trap.
std::vector<par::Cell> straighten(const par::Mask& blocked, const par::Grid<double>& costs,
                                  const std::vector<par::Cell>& path);

#endif
