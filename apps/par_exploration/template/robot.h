// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_EXPLORATION_ROBOT_H
#define PAR_EXPLORATION_ROBOT_H

#include <cstddef>
#include <memory>
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

// What the robot knows: for each cell how likely it is occupied. 0 is free for certain, 1 occupied
// for certain, and 0.5 that nobody knows. What counts as free and as occupied is what maps for ROS
// take for it; the rest is unknown.
struct Map {
  int width = 0;                 // columns
  int height = 0;                // rows
  double cellSize = 0.0;         // side of a cell [m]
  std::vector<double> occupied;  // of cell (column, row) at row * width + column

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

// The map and where the robot is: what the two threads share. Only one thread at a time may touch
// it, so each call takes the mutex.
class CSharedMap {
 public:
  explicit CSharedMap(const Map& unknown) : map(unknown) {}

  // The thread that collects data hands over what it knows at a time [s].
  void publish(const Map& newMap, const imr::robot::SPosition& newPose, double newTime);
  // The thread that plans waits for what was known at a time, and gets copies. False: it will never
  // come, since the other thread has ended.
  bool waitFor(double wantedTime, Map& theMap, imr::robot::SPosition& thePose);
  // A thread that ends says so, or the other one could wait for ever.
  void close();

 private:
  imr::concurrent::Mutex mtx;
  imr::concurrent::Condition changed;
  Map map;
  imr::robot::SPosition pose;
  double time = -1.0;
  bool closed = false;
};

// The first thread: reads the sensors and learns the map. It has a client of its own, so that no
// scan is lost while the other thread thinks.
class CCollector : public imr::concurrent::CThread {
 public:
  CCollector(imr::CConfig& cfg, CCMorse::PlayerClient& client, CSharedMap& shared);
  ~CCollector();

  // Waits for the first data; to be called before the thread is started.
  void waitForData();
  // Asks the thread to end after its next Read(); may be called from any thread.
  void stop();

 protected:
  void threadBody() override;

 private:
  void collect();

  // Yours:
  void addScan();    // what the laser sees, into the map
  void drawMap();    // the map, into the layer "occupancy"
  void drawScan();   // where the beams ended, into the layer "scan"
  void drawTrail();  // where the robot is, into the layer "trail"

  CCMorse::PlayerClient& client;
  CSharedMap& shared;
  CCMorse::WindowProxy& window;
  CCMorse::LaserProxy laser;
  CCMorse::Position2dProxy position;

  Map map;
  imr::robot::SPosition pose;  // of the robot, in the arena
  // Your own variables go here.

  bool quit = false;  // guarded by mtx: stop() sets it from another thread
  Mutex mtx;
};

// The second thread: looks for frontiers, decides where to go, and drives.
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
  void explore();  // all the steps, again and again

  // Yours, in this order:
  Map inflate(const Map& map, double radius) const;       // grown obstacles
  std::vector<Cell> findFrontiers(const Map& map) const;  // where the known ends
  bool chooseGoal(const Map& map, const Cell& from, const std::vector<Cell>& frontiers, Cell& goal);
  std::vector<Cell> plan(const Map& map, const Cell& from, const Cell& to) const;
  void decideSpeeds(const std::vector<Cell>& path);  // to follow it
  bool isFinished(bool hasGoal);                     // the end of the exploration
  void draw(const Map& inflated, const std::vector<Cell>& frontiers, const std::vector<Cell>& path);

  // These work: from metres to cells and back, and from a cell that is not free to the nearest one
  // that is (false if there is none close by).
  Cell cellOf(double x, double y) const;
  double xOf(const Cell& cell) const;
  double yOf(const Cell& cell) const;
  bool moveToFree(const Map& map, Cell& cell) const;

  // Two connections to the robot, for two threads. The order matters: what is declared last is
  // destroyed first, and each needs what is above it to the end.
  std::unique_ptr<CCMorse::PlayerClient> dataClient;
  CCMorse::WindowProxy& window;  // the canvas, with a layer for each thing to show
  CSharedMap shared;
  CCollector collector;
  std::unique_ptr<CCMorse::PlayerClient> client;
  std::unique_ptr<CCMorse::Position2dProxy> position;
  std::unique_ptr<CCMorse::LaserProxy> laser;  // the same laser as the collector's

  imr::robot::SPosition pose;  // of the robot, in the arena
  double forwardSpeed = 0.0;   // commanded [m/s], ahead is positive
  double turnRate = 0.0;       // commanded [rad/s], to the left is positive
  // Your own variables go here.

  bool quit = false;  // guarded by mtx: stop() sets it from another thread
  Mutex mtx;
};

#endif
