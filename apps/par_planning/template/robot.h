// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_PLANNING_ROBOT_H
#define PAR_PLANNING_ROBOT_H

#include <memory>
#include <string>
#include <vector>

#include "imr-h/imr_config.h"
#include "imr-h/thread.h"
#include "libCCMorse/CCMorse.h"
#include "robot_types.h"

// A square of the map: its column from the left and its row from the TOP, both from 0. On the
// canvas it is the pixel of the same column and row.
struct Cell {
  int column;
  int row;
};

// The map, or another set of cells: for each cell whether it is in it (a wall, say).
struct Map {
  int width = 0;               // columns
  int height = 0;              // rows
  double cellSize = 0.0;       // side of a cell [m]
  std::vector<bool> occupied;  // of cell (column, row) at row * width + column

  bool isOccupied(const Cell& cell) const {
    return occupied[static_cast<std::size_t>(cell.row * width + cell.column)];
  }
};

// A robot that thinks in a thread of its own, as in the introduction task. What the thread does
// stands in navigation(), in robot.cc.
class CRobot : public imr::concurrent::CThread {
 public:
  // Declares the settings that can be given on the command line, with their defaults.
  static imr::CConfig& getConfig(imr::CConfig& config);

  // Connects to the robot and waits for its first data.
  explicit CRobot(imr::CConfig& cfg);
  ~CRobot();

  // Asks the thread to end after its current turn; may be called from any thread.
  void stop();

 protected:
  void threadBody() override;

 private:
  void navigation();  // all the steps, one after another

  // Yours, in this order:
  Map loadMap(const std::string& file) const;                                // from a text file
  Map fetchMap() const;                                                      // from the world
  Map inflate(const Map& map, double radius) const;                          // grown obstacles
  std::vector<Cell> plan(const Map& map, const Cell& from, const Cell& to);  // a way
  std::vector<Cell> smooth(const Map& map, const std::vector<Cell>& path);   // a straighter way
  void drawMap(CCMorse::GridMapLayer& layer, const Map& map) const;          // what is occupied
  void drawPath(CCMorse::GridMapLayer& layer, const std::vector<Cell>& path) const;
  bool decideSpeeds(const std::vector<Cell>& path);  // to follow it; true at its end

  void drawGoal(CCMorse::GridMapLayer& layer, const Cell& goal) const;  // works

  // From metres to cells and back; these work.
  Cell cellOf(double x, double y) const;
  double xOf(const Cell& cell) const;
  double yOf(const Cell& cell) const;
  // Replaces a cell that is not free by the nearest one that is; false if there is none close by.
  // This works, too.
  bool moveToFree(const Map& map, Cell& cell) const;

  std::string mapFile;  // empty: ask the world
  double goalX, goalY;  // where to go [m]

  // The connection, and the drive that is reached through it. The order matters: what is declared
  // last is destroyed first, and a proxy needs its client to the end.
  std::unique_ptr<CCMorse::PlayerClient> client;
  std::unique_ptr<CCMorse::Position2dProxy> position;
  CCMorse::WindowProxy& window;  // the canvas, with a layer for the result of each step

  double forwardSpeed = 0.0;  // commanded [m/s], ahead is positive
  double turnRate = 0.0;      // commanded [rad/s], to the left is positive
  // Your own variables go here.

  bool quit = false;  // guarded by mtx: stop() sets it from another thread
  Mutex mtx;
};

#endif
