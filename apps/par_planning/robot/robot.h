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

// Plans a path on a known map and drives it: map -> inflated obstacles -> plan -> smooth -> follow.
// Each step draws its result in its own layer. The planner is in planner.cc.
class CRobot : public imr::concurrent::CThread {
 public:
  // Declares the command-line settings and their defaults.
  static imr::CConfig& getConfig(imr::CConfig& config);

  // Reads the map file if one is given, connects to the robot and waits for its first data.
  explicit CRobot(imr::CConfig& cfg);
  ~CRobot();

  // Asks the thread to end after its current iteration. Any thread may call this.
  void stop();

  // Whether the robot reached the goal; with a map of another place, whether a path exists. Call it
  // after the thread has ended.
  bool succeeded() const { return success; }

 protected:
  void threadBody() override;

 private:
  bool navigation();
  void fetchMap();
  bool findEnds();
  bool findEnd(const char* what, const par::Point& wanted, double reach, par::Cell& cell) const;
  bool drive(const par::Path& way);

  // Drawing. If the canvas is larger than the map, a cell of the map is a square of pixels. If the
  // map is larger than the canvas, several cells share one pixel.
  CCMorse::ImagePoint_t pixelOf(const par::Cell& cell) const;
  void drawCells(const std::string& layer, const par::Mask& cells) const;
  // Marks the goal with a dot and a ring.
  void drawGoal() const;
  // Draws a path with a margin [pixels]. The planned path has one, so that it stays visible under
  // the smoothed path.
  void drawWay(const std::string& layer, const par::Path& way, int margin) const;

  double goalX, goalY;    // [m]
  double startX, startY;  // [m], for maps of other places; negative: not given
  double inflation;       // radius by which obstacles are inflated [m]

  // The connection and its devices. The order matters: members are destroyed in reverse order, and
  // a proxy must be destroyed before its client.
  std::unique_ptr<CCMorse::PlayerClient> client;
  std::unique_ptr<CCMorse::Position2dProxy> position;
  CCMorse::WindowProxy& window;

  par::Mask walls;        // the map: 1 where there is a wall
  bool fromFile;          // the map comes from a file
  bool isOfWorld = true;  // the map shows the place where the robot is
  int pixelsPerCell = 1;  // side of the square of pixels that is drawn for one cell
  int cellsPerPixel = 1;  // side of the square of cells that is drawn as one pixel

  par::Mask inflated;  // where the robot's centre cannot be
  par::Cell start, goal;
  par::PathFollower follower;

  bool success = false;
  bool quit = false;  // guarded by mtx; stop() sets it from another thread
  Mutex mtx;
};

#endif
