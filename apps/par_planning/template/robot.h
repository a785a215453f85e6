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

// A square of the map: column from the left and row from the TOP, both starting at 0. It is the
// pixel of the canvas with the same column and row.
struct Cell {
  int column;
  int row;
};

// The map, or any other set of cells: a cell is occupied if it belongs to the set.
struct Map {
  int width = 0;               // columns
  int height = 0;              // rows
  double cellSize = 0.0;       // side of a cell [m]
  std::vector<bool> occupied;  // cell (column, row) is at row * width + column

  bool isOccupied(const Cell& cell) const {
    return occupied[static_cast<std::size_t>(cell.row * width + cell.column)];
  }
};

// A robot controlled by its own thread, as in the introduction task. The thread runs navigation(),
// in robot.cc.
class CRobot : public imr::concurrent::CThread {
 public:
  // Declares the command-line settings and their defaults.
  static imr::CConfig& getConfig(imr::CConfig& config);

  // Connects to the robot and waits for its first data.
  explicit CRobot(imr::CConfig& cfg);
  ~CRobot();

  // Asks the thread to end after its current iteration. Any thread may call this.
  void stop();

 protected:
  void threadBody() override;

 private:
  void navigation();  // all the steps, one after another

  // Yours, in this order:
  Map loadMap(const std::string& file) const;                                // from a text file
  Map fetchMap() const;                                                      // from the world
  Map inflate(const Map& map, double radius) const;                          // inflated obstacles
  std::vector<Cell> plan(const Map& map, const Cell& from, const Cell& to);  // a path
  std::vector<Cell> smooth(const Map& map, const std::vector<Cell>& path);   // a straighter path
  void drawMap(CCMorse::GridMapLayer& layer, const Map& map) const;          // the occupied cells
  void drawPath(CCMorse::GridMapLayer& layer, const std::vector<Cell>& path) const;
  bool decideSpeeds(const std::vector<Cell>& path);  // to follow the path; true at its end

  void drawGoal(CCMorse::GridMapLayer& layer, const Cell& goal) const;  // already works

  // Conversions from metres to cells and back. These already work.
  Cell cellOf(double x, double y) const;
  double xOf(const Cell& cell) const;
  double yOf(const Cell& cell) const;
  // Replaces an occupied cell by the nearest free one; false if there is none close by. This
  // already works, too.
  bool moveToFree(const Map& map, Cell& cell) const;

  std::string mapFile;  // empty: ask the world
  double goalX, goalY;  // the goal [m]

  // The connection and the drive. The order matters: members are destroyed in reverse order, and a
  // proxy must be destroyed before its client.
  std::unique_ptr<CCMorse::PlayerClient> client;
  std::unique_ptr<CCMorse::Position2dProxy> position;
  CCMorse::WindowProxy& window;  // the canvas, with one layer for the result of each step

  double forwardSpeed = 0.0;  // commanded [m/s], positive ahead
  double turnRate = 0.0;      // commanded [rad/s], positive to the left
  // Your own variables go here.

  bool quit = false;  // guarded by mtx; stop() sets it from another thread
  Mutex mtx;
};

#endif
