// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_PLANNING_ROBOT_H
#define PAR_PLANNING_ROBOT_H

#include <memory>
#include <string>
#include <vector>

#include "imr-h/imr_config.h"
#include "imr-h/thread.h"
#include "libCCMorse/CCMorse.h"
#include "par_common/path_follower.h"
#include "par_common/planners.h"
#include "robot_types.h"

// Finds a way over a known map and drives it: map -> grown obstacles -> plan -> smooth -> follow.
// What each step found is drawn in a layer of its own. How a way is planned is in planner.cc.
class CRobot : public imr::concurrent::CThread {
 public:
  // Declares the settings that can be given on the command line, with their defaults.
  static imr::CConfig& getConfig(imr::CConfig& config);

  // Reads the map file, if one is given, connects to the robot and waits for its first data.
  explicit CRobot(imr::CConfig& cfg);
  ~CRobot();

  // Asks the thread to end after its current turn; may be called from any thread.
  void stop();

  // Whether the robot came to the goal (with a map of another place: whether there is a way). To be
  // asked when the thread has ended.
  bool succeeded() const { return success; }

 protected:
  void threadBody() override;

 private:
  bool navigation();
  void fetchMap();
  bool findEnds();
  bool findEnd(const char* what, const par::Point& wanted, double reach, par::Cell& cell) const;
  bool drive(const par::Path& way);

  // Drawing. A cell of the map is a pixel of the canvas, or a square of several; or several cells
  // are one pixel, if the map is larger than the canvas.
  CCMorse::ImagePoint_t pixelOf(const par::Cell& cell) const;
  void drawCells(const std::string& layer, const par::Mask& cells) const;
  // A dot and a ring round it where the robot is to go.
  void drawGoal() const;
  // The planned way is drawn with a margin [pixels], to be seen under the smoothed one.
  void drawWay(const std::string& layer, const par::Path& way, int margin) const;

  double goalX, goalY;    // [m]
  double startX, startY;  // the same, for maps of other places; negative: not given
  double inflation;       // radius by which obstacles are grown [m]

  // The connection, and the devices that are reached through it. The order matters: what is
  // declared last is destroyed first, and a proxy needs its client to the end.
  std::unique_ptr<CCMorse::PlayerClient> client;
  std::unique_ptr<CCMorse::Position2dProxy> position;
  CCMorse::WindowProxy& window;

  par::Mask walls;        // the map: 1 where there is a wall
  bool fromFile;          // the map comes from a file
  bool isOfWorld = true;  // the map shows the place where the robot is
  int pixelsPerCell = 1;  // side of the square that is drawn for a cell ...
  int cellsPerPixel = 1;  // ... or side of the square of cells that is drawn as one pixel

  par::Mask inflated;  // where the robot's centre cannot be
  par::Cell start, goal;
  par::PathFollower follower;

  bool success = false;
  bool quit = false;  // guarded by mtx: stop() sets it from another thread
  Mutex mtx;
};

#endif
