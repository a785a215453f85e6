// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_EXPLORATION_CHANGING_ROBOT_H
#define PAR_EXPLORATION_CHANGING_ROBOT_H

#include <cstddef>
#include <memory>
#include <vector>

#include "imr-h/imr_config.h"
#include "imr-h/thread.h"
#include "libCCMorse/ArenaProxy.h"
#include "libCCMorse/CCMorse.h"
#include "robot_types.h"

// A square of the map: column from the left and row from the TOP, both starting at 0. It is the
// pixel of the canvas with the same column and row.
struct Cell {
  int column;
  int row;
};

// The robot's knowledge: the probability of each cell to be occupied. 0 is certainly free, 1 is
// certainly occupied, and 0.5 means that nothing is known. The thresholds for free and occupied are
// those of maps for ROS; all values between them are unknown.
struct Map {
  int width = 0;                 // columns
  int height = 0;                // rows
  double cellSize = 0.0;         // side of a cell [m]
  std::vector<double> occupied;  // cell (column, row) is at row * width + column

  bool contains(const Cell& cell) const {
    return cell.column >= 0 && cell.row >= 0 && cell.column < width && cell.row < height;
  }
  bool isFree(const Cell& cell) const { return at(cell) < 0.196; }
  bool isOccupied(const Cell& cell) const { return at(cell) > 0.65; }
  double& at(const Cell& cell) {
    return occupied[static_cast<std::size_t>(cell.row * width + cell.column)];
  }
  double at(const Cell& cell) const {
    return occupied[static_cast<std::size_t>(cell.row * width + cell.column)];
  }
};

// A rectangle of the floor: its middle, and its extent along x and y [m].
struct Area {
  double x, y;
  double width, height;
};

// The map and the robot's pose, which the two threads share. Only one thread at a time may access
// them, so each call locks the mutex.
class CSharedMap {
 public:
  explicit CSharedMap(const Map& unknown) : map(unknown) {}

  // Called by the thread that collects data: publishes its knowledge at a time [s].
  void publish(const Map& newMap, const imr::robot::SPosition& newPose, double newTime);
  // Called by the thread that plans: waits for the knowledge of that time and copies it. Returns
  // false if the other thread has ended, so that it will never come.
  bool waitFor(double wantedTime, Map& theMap, imr::robot::SPosition& thePose);
  // Called by the thread that plans: asks the other one to forget a rectangle of the floor [m].
  void forget(double x, double y, double width, double height);
  // Called by the thread that collects data: the rectangles since its last call.
  std::vector<Area> takeForgotten();
  // Each thread calls this when it ends; otherwise the other one could wait for ever.
  void close();

 private:
  imr::concurrent::Mutex mtx;
  imr::concurrent::Condition changed;
  Map map;
  imr::robot::SPosition pose;
  double time = -1.0;
  std::vector<Area> forgotten;
  bool closed = false;
};

// The first thread: reads the sensors and updates the map. It has its own client, so that no scan
// is lost while the other thread plans.
class CCollector : public imr::concurrent::CThread {
 public:
  CCollector(imr::CConfig& cfg, CCMorse::PlayerClient& client, CSharedMap& shared);
  ~CCollector();

  // Waits for the first data. Call it before you start the thread.
  void waitForData();
  // Asks the thread to end after its next Read(). Any thread may call this.
  void stop();

 protected:
  void threadBody() override;

 private:
  void collect();

  // Yours:
  void forget(const Area& area);  // makes the cells of an area unknown
  void addScan();                 // adds the laser scan to the map
  void drawMap();                 // draws the map into the layer "occupancy"
  void drawScan();                // draws the ends of the beams into the layer "scan"
  void drawTrail();               // draws the robot's position into the layer "trail"

  CCMorse::PlayerClient& client;
  CSharedMap& shared;
  CCMorse::WindowProxy& window;
  CCMorse::LaserProxy laser;
  CCMorse::Position2dProxy position;

  Map map;
  imr::robot::SPosition pose;  // the robot's pose in the arena
  // Your own variables go here.

  bool quit = false;  // guarded by mtx; stop() sets it from another thread
  Mutex mtx;
};

// The second thread: finds frontiers, decides where to go, and drives.
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
  void explore();  // all the steps, repeatedly

  // Yours, in this order:
  void lookAtEvents();                                    // which blocks have changed?
  Map inflate(const Map& map, double radius) const;       // inflated obstacles
  std::vector<Cell> findFrontiers(const Map& map) const;  // the border of the known area
  bool chooseGoal(const Map& map, const Cell& from, const std::vector<Cell>& frontiers, Cell& goal);
  std::vector<Cell> plan(const Map& map, const Cell& from, const Cell& to) const;
  void decideSpeeds(const std::vector<Cell>& path);  // to follow the path
  bool isFinished(bool hasGoal);                     // whether the exploration ends
  void draw(const Map& inflated, const std::vector<Cell>& frontiers, const std::vector<Cell>& path);

  // These already work: conversions from metres to cells and back, and the replacement of an
  // occupied cell by the nearest free one (false if there is none close by).
  Cell cellOf(double x, double y) const;
  double xOf(const Cell& cell) const;
  double yOf(const Cell& cell) const;
  bool moveToFree(const Map& map, Cell& cell) const;

  // Two connections to the robot, one per thread. The order matters: members are destroyed in
  // reverse order, and each needs the members above it.
  std::unique_ptr<CCMorse::PlayerClient> dataClient;
  CCMorse::WindowProxy& window;  // the canvas, with one layer for each thing to show
  CSharedMap shared;
  CCollector collector;
  std::unique_ptr<CCMorse::PlayerClient> client;
  std::unique_ptr<CCMorse::Position2dProxy> position;
  std::unique_ptr<CCMorse::LaserProxy> laser;             // the same laser as the collector's
  std::unique_ptr<CCMorse::ArenaProxy> arena;             // the arena's events and timers
  std::unique_ptr<PlayerCc::SimulationProxy> simulation;  // where the blocks are

  imr::robot::SPosition pose;  // the robot's pose in the arena
  double forwardSpeed = 0.0;   // commanded [m/s], positive ahead
  double turnRate = 0.0;       // commanded [rad/s], positive to the left
  // Your own variables go here.

  bool quit = false;  // guarded by mtx; stop() sets it from another thread
  Mutex mtx;
};

#endif
