// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_LOCALIZATION_ROBOT_H
#define PAR_LOCALIZATION_ROBOT_H

#include <cstddef>
#include <memory>
#include <random>
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

// A pose that the robot may have, and how likely it is.
struct Particle {
  double x, y;    // [m]
  double yaw;     // [rad]
  double weight;  // relative to those of the others
};

// Where a beam of the laser ended, seen from the robot.
struct End {
  double ahead, left;  // [m]
};

// A robot controlled by its own thread, as in the other tasks. The thread runs navigation(), in
// robot.cc.
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
  void navigation();

  // Yours, in this order:
  void moveParticles(double ahead, double left, double turned);  // as odometry says
  void weighParticles();                                         // as the scan says
  void resample();                                               // draws them by their weights

  // These already work.
  void scatter();          // puts the particles anywhere
  void estimate();         // sets pose and settled
  void lookAtScan();       // sets scan and ends
  double fitting() const;  // share of the scan that ends near a wall of the map
  double roomAhead(double halfWidth) const;
  void wander();
  void measureDistances();
  double distanceToWall(double x, double y) const;  // [m], at most 1 m
  void drawParticles() const;
  Map fetchMap() const;
  Map inflate(const Map& map, double radius) const;
  std::vector<Cell> plan(const Map& map, const Cell& from, const Cell& to) const;
  bool canSee(const Map& map, const Cell& from, const Cell& to) const;
  void makePath();
  void decideSpeeds();
  void drawMap(const std::string& layer, const Map& map) const;
  void drawPath() const;
  void drawGoal() const;
  Cell cellOf(double x, double y) const;
  double xOf(const Cell& cell) const;
  double yOf(const Cell& cell) const;
  bool moveToFree(const Map& map, Cell& cell) const;

  // The connection and its devices. The order matters: members are destroyed in reverse order, and
  // a proxy must be destroyed before its client.
  std::unique_ptr<CCMorse::PlayerClient> client;
  std::unique_ptr<CCMorse::Position2dProxy> position;
  std::unique_ptr<CCMorse::LaserProxy> laser;
  CCMorse::WindowProxy& window;  // the canvas

  double goalX, goalY;            // where to go [m]
  Map walls;                      // the map
  Map inflated;                   // where the robot's centre cannot be
  std::vector<double> distances;  // of each cell of the map to the nearest wall [m]
  std::vector<End> scan;          // the newest scan, without beams that hit nothing
  std::vector<End> ends;          // some of it, evenly spread
  std::vector<Particle> particles;
  std::mt19937 random{1};      // the seed is fixed, so two runs are equal
  imr::robot::SPosition pose;  // where the particles say that the robot is
  bool settled = false;        // whether the particles agree
  std::vector<Cell> path;      // the cells where the path turns
  std::size_t next = 0;        // the cell of the path that the robot drives to

  double forwardSpeed = 0.0;  // commanded [m/s], positive ahead
  double turnRate = 0.0;      // commanded [rad/s], positive to the left
  // Your own variables go here.

  bool quit = false;  // guarded by mtx; stop() sets it from another thread
  Mutex mtx;
};

#endif
