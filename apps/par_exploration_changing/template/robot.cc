// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "robot.h"

#include <cmath>
#include <string>

#include "imr-h/logging.h"

// Most functions at the end of this file are those of the exploration task: copy yours. Then fill
// in the two new ones, CCollector::forget() and CRobot::lookAtEvents(), and change isFinished(). As
// it is, the robot knows nothing of the arena, learns nothing, and stands still.

namespace {

const double RADIUS = 0.125;    // radius of the robot, with some room for inexact driving [m]
const double REACH = 0.15;      // see moveToFree() [m]
const double SAME_TIME = 1e-3;  // times that differ by less count as the same moment [s]

// Creates the window with the layers of the task. Layers are stacked: those with a higher priority
// lie on top. A grey layer shows numbers: 0 white, 1 black. In a binary layer a cell is either set,
// and drawn in the layer's colour, or transparent.
CCMorse::WindowProxy& makeWindow(CCMorse::PlayerClient* client) {
  using CCMorse::GridMapLayer;
  CCMorse::WindowProxy& window = CCMorse::WindowProxy::GetInstance(client, 172, 186);
  window.CreateLayer("occupancy", GridMapLayer::GREY, 1);
  window.CreateLayer("inflated", GridMapLayer::BINARY, 2).SetColour("#2F6FDE");
  window.GetLayer("inflated").SetTransparency(0.55);
  window.CreateLayer("frontiers", GridMapLayer::BINARY, 3).SetColour("#9B30C8");
  window.CreateLayer("scan", GridMapLayer::BINARY, 4).SetColour("#18B818");
  window.CreateLayer("trail", GridMapLayer::BINARY, 5).SetColour("#E02020");
  window.CreateLayer("path", GridMapLayer::BINARY, 6).SetColour("#FF8C00");
  return window;
}

Map unknownMap(const CCMorse::WindowProxy& window) {
  Map map;
  map.width = window.GetWidth();
  map.height = window.GetHeight();
  map.cellSize = window.GetCellSize();
  map.occupied.assign(static_cast<std::size_t>(map.width * map.height), 0.5);
  return map;
}

}  // namespace

// --- What the threads share ----------------------------------------------------------------------

void CSharedMap::publish(const Map& newMap, const imr::robot::SPosition& newPose, double newTime) {
  {
    const imr::concurrent::ScopedLock lk(mtx);
    map = newMap;
    pose = newPose;
    time = newTime;
  }
  changed.notify_all();
}

bool CSharedMap::waitFor(double wantedTime, Map& theMap, imr::robot::SPosition& thePose) {
  imr::concurrent::ScopedLock lk(mtx);
  changed.wait(lk, [&] { return closed || time > wantedTime - SAME_TIME; });
  theMap = map;
  thePose = pose;
  return !closed;
}

void CSharedMap::forget(double x, double y, double width, double height) {
  const imr::concurrent::ScopedLock lk(mtx);
  forgotten.push_back({x, y, width, height});
}

std::vector<Area> CSharedMap::takeForgotten() {
  const imr::concurrent::ScopedLock lk(mtx);
  std::vector<Area> areas;
  areas.swap(forgotten);
  return areas;
}

void CSharedMap::close() {
  {
    const imr::concurrent::ScopedLock lk(mtx);
    closed = true;
  }
  changed.notify_all();
}

// --- The thread that collects data ---------------------------------------------------------------

CCollector::CCollector(imr::CConfig& cfg, CCMorse::PlayerClient& aClient, CSharedMap& aMap)
    : client(aClient),
      shared(aMap),
      window(CCMorse::WindowProxy::GetInstance()),
      laser(&client, cfg.get<unsigned>("laser-index")),
      position(&client, cfg.get<unsigned>("position2d-index")),
      map(unknownMap(window)) {}

CCollector::~CCollector() {
  stop();
  join();
}

void CCollector::waitForData() {
  while (!laser.IsFresh() || !position.IsFresh()) client.Read();
}

void CCollector::stop() {
  const ScopedLock lk(mtx);
  quit = true;
}

void CCollector::threadBody() {
  try {
    collect();
  } catch (const CCMorse::MorseError& e) {
    // Read() also throws when the simulated run ends.
    INFO("The run is over: " << e.GetErrorStr());
  }
  shared.close();
}

void CCollector::collect() {
  while (true) {
    if (position.IsFresh()) {
      position.NotFresh();
      pose = imr::robot::SPosition(position.GetXPos(), position.GetYPos(), position.GetYaw());
      drawTrail();
    }
    if (laser.IsFresh()) {
      laser.NotFresh();
      for (const Area& area : shared.takeForgotten()) forget(area);
      addScan();
      drawScan();
      drawMap();
    }
    shared.publish(map, pose, position.GetDataTime());

    // Simulated time advances when ALL threads that read wait in Read(). The other thread waits for
    // the map that this thread has just published before it reads again. So neither thread can run
    // ahead, and equal runs give equal results.
    client.Read();
    const ScopedLock lk(mtx);
    if (quit) break;
  }
}

// --- The thread that plans and drives ------------------------------------------------------------

imr::CConfig& CRobot::getConfig(imr::CConfig& config) {
  // Ports 6665, 6666, ... serve one robot each. Index 0 of position2d is the arena's localisation,
  // which is exact; index 1 is the odometry, which drifts.
  config.add<std::string>("host", "where the robot is", "localhost");
  config.add<unsigned>("port", "its port", 6665);
  config.add<unsigned>("laser-index", "number of the laser", 0);
  config.add<unsigned>("position2d-index", "number of the drive", 0);
  return config;
}

CRobot::CRobot(imr::CConfig& cfg)
    : dataClient(
          new CCMorse::PlayerClient(cfg.get<std::string>("host"), cfg.get<unsigned>("port"))),
      window(makeWindow(dataClient.get())),
      shared(unknownMap(window)),
      collector(cfg, *dataClient, shared),
      client(new CCMorse::PlayerClient(cfg.get<std::string>("host"), cfg.get<unsigned>("port"))),
      position(new CCMorse::Position2dProxy(client.get(), cfg.get<unsigned>("position2d-index"))),
      laser(new CCMorse::LaserProxy(client.get(), cfg.get<unsigned>("laser-index"))),
      arena(new CCMorse::ArenaProxy(client.get())),
      simulation(new PlayerCc::SimulationProxy(client.get(), 0)) {
  // A client takes part in the run from its first Read() on. Both clients read here, so the result
  // does not depend on which thread starts first.
  collector.waitForData();
  while (!position->IsFresh() || !laser->IsFresh()) client->Read();
}

CRobot::~CRobot() {
  stop();
  join();
  delete &window;
}

void CRobot::stop() {
  const ScopedLock lk(mtx);
  quit = true;
}

void CRobot::threadBody() {
  collector.execute();
  try {
    explore();
  } catch (const CCMorse::MorseError& e) {
    INFO("The run is over: " << e.GetErrorStr());
  }
  // The other thread may be waiting in Read(), which returns only when simulated time advances.
  // Time advances after this thread no longer takes part, that is, after its client is destroyed.
  shared.close();
  collector.stop();
  simulation.reset();
  arena.reset();
  laser.reset();
  position.reset();
  client.reset();
  collector.join();
}

void CRobot::explore() {
  position->SetMotorEnable(true);
  Map map;
  bool q = false;
  while (!q && shared.waitFor(position->GetDataTime(), map, pose)) {
    lookAtEvents();
    const Map inflated = inflate(map, RADIUS);
    const std::vector<Cell> frontiers = findFrontiers(map);

    // The robot's own cell may be inside an inflated obstacle. The path then starts from the
    // nearest free cell.
    Cell start = cellOf(pose.x, pose.y);
    Cell goal = start;
    const bool hasGoal =
        moveToFree(inflated, start) && chooseGoal(inflated, start, frontiers, goal);
    if (isFinished(hasGoal)) break;
    std::vector<Cell> path;
    if (hasGoal) path = plan(inflated, start, goal);
    draw(inflated, frontiers, path);

    decideSpeeds(path);
    position->SetSpeed(forwardSpeed, turnRate);
    client->Read();
    const ScopedLock lk(mtx);
    q = quit;
  }
  // A command stays in effect until the next one: without this one the robot would drive on.
  position->SetSpeed(0.0, 0.0);
}

Cell CRobot::cellOf(double x, double y) const { return {window.GetX(x), window.GetY(y)}; }

double CRobot::xOf(const Cell& cell) const { return (cell.column + 0.5) * window.GetCellSize(); }

double CRobot::yOf(const Cell& cell) const {
  // Rows count from the top, y from the bottom.
  return (window.GetHeight() - 1 - cell.row + 0.5) * window.GetCellSize();
}

bool CRobot::moveToFree(const Map& map, Cell& cell) const {
  const Cell from = cell;
  double least = REACH / map.cellSize;
  bool found = false;
  for (int row = 0; row < map.height; row++) {
    for (int column = 0; column < map.width; column++) {
      const double distance = std::hypot(column - from.column, row - from.row);
      if (found ? distance >= least : distance > least) continue;
      if (!map.isFree({column, row})) continue;
      cell = {column, row};
      least = distance;
      found = true;
    }
  }
  return found;
}

// --- Yours: the map ------------------------------------------------------------------------------

void CCollector::forget(const Area& area) {
  // The arena has changed here, so the map may be wrong. If the cells become unknown, their border
  // is a frontier, and the robot comes to look again.
  //
  // Try first: for each cell whose middle is in the area, set map.occupied to 0.5. Set your own
  // number l of addScan(), the log odds, to 0.
  static_cast<void>(area);
}

void CCollector::addScan() {
  // Beam i has the direction pose.yaw + laser.GetBearing(i) and starts at the LASER, which is 0.035
  // m ahead of the robot's centre. It hit something after laser[i] metres, unless that is
  // GetMaxRange(): then it hit nothing. A point (x, y) lies in the cell of column window.GetX(x)
  // and row window.GetY(y).
  //
  // Try first: set the cell at the end of each beam to 1, and see whether drawMap() shows walls. A
  // beam may end outside the map. The face of an obstacle lies on the border of two cells, so move
  // the end 0.01 m further along the beam.
  // Then: every cell that a beam passed is free (look up "Bresenham's line"), except cells in which
  // another beam of the same scan ends, because beams graze along walls. The laser does not see the
  // floor below the robot: set cells within 0.07 m of the robot's centre free, too.
  // Then: a scan may be wrong (it has 5 mm of noise here). So let each scan make a cell only a
  // little more likely free or occupied. Look up "occupancy grid" and "log odds". Keep a number l
  // for each cell, in a variable of your own in robot.h, with the initial value 0. A scan in which
  // the cell is occupied adds 0.9, a scan in which it is free subtracts 0.4, and l stays within -4
  // and 4. The probability that the cell is occupied is 1 / (1 + exp(-l)).
}

void CCollector::drawMap() {
  // Try first: draw the whole map at once with window.GetLayer("occupancy").SetCells(map.occupied).
  // The grading uses this layer.
  // Next: is this necessary ten times a second?
}

void CCollector::drawScan() {
  // Use window.GetLayer("scan"): Clear() it, then SetPixelMetres(x, y) for the end of each beam.
}

void CCollector::drawTrail() {
  // Use window.GetLayer("trail").SetLineMetres(x0, y0, x1, y1), from the previous pose to this one.
}

// --- Yours: what has changed? --------------------------------------------------------------------

void CRobot::lookAtEvents() {
  // arena->GetEvents() returns what has happened since the last call, as a std::vector of
  // CCMorse::ArenaEvent. If `kind` is "extended" or "retracted", the block `what` has risen or
  // sunk. Print the events first, with INFO(event).
  //
  // Try first: find out where the block stands. simulation->GetPose2d(name, x, y, yaw) sets its
  // middle, and simulation->GetProperty(name, "size", size, sizeof size) sets `double size[2]`, its
  // extent along x and y; the name is event.what.c_str(). Then call shared.forget() with an area
  // that is larger by 0.04 m on each side.
  // Then: clear the counts of chooseGoal(), so that no frontier remains given up.
  // Next: does the robot have to go there at once?
}

// --- Yours: where to go --------------------------------------------------------------------------

Map CRobot::inflate(const Map& map, double radius) const {
  // Where may the robot's CENTRE be? It must stay at least one radius away from every occupied
  // cell. If you inflate obstacles by that radius, you can plan for the robot as if it were a
  // point. Do not inflate unknown cells: nobody knows whether anything is there.
  //
  // Try first: as in the planning task, set all cells to 1 whose centres are within radius of the
  // centre of an occupied cell. Treat the cells just outside the map as occupied, too: the arena's
  // border is a wall.
  static_cast<void>(radius);
  return map;
}

std::vector<Cell> CRobot::findFrontiers(const Map& map) const {
  // A frontier is the border between known and unknown: free cells with an unknown neighbour.
  //
  // Try first: return all such cells as a list; draw() shows whether they are where you expect
  // them.
  // Next: group cells that touch one another. What do you do with groups of two or three cells?
  static_cast<void>(map);
  return std::vector<Cell>();
}

bool CRobot::chooseGoal(const Map& map, const Cell& from, const std::vector<Cell>& frontiers,
                        Cell& goal) {
  // Chooses the next goal, starting from a free cell; false if there is nowhere to go.
  //
  // Try first: take the frontier that is nearest in a straight line, and see where that robot gets
  // stuck.
  // Then: take the frontier with the shortest path. Search the free cells of the map from `from`,
  // as in plan(), until the first frontier cell comes out. Frontiers inside inflated obstacles
  // never do.
  // Then: a frontier may remain after the robot has looked at it. Keep a count for each cell, in a
  // variable of your own: add 1 for the goal in each iteration, and 10 while the goal is nearer
  // than 0.15 m. Give up frontier cells within 0.1 m of a cell that has more than 300: never choose
  // them again.
  // Next: keep a goal until it is no longer a frontier, instead of changing it in each iteration.
  // Look at a frontier from farther away. Go where more can be seen.
  static_cast<void>(map);
  static_cast<void>(from);
  static_cast<void>(frontiers);
  static_cast<void>(goal);
  return false;
}

std::vector<Cell> CRobot::plan(const Map& map, const Cell& from, const Cell& to) const {
  // Returns the cells from `from` to `to`, each a neighbour of the previous one; empty if there is
  // no path.
  //
  // Try first: breadth-first search over free cells, as in the planning task. The path must not
  // lead through unknown cells, because they are not inflated.
  // Next: keep a larger distance from obstacles where there is room.
  static_cast<void>(map);
  static_cast<void>(from);
  static_cast<void>(to);
  return std::vector<Cell>();
}

void CRobot::decideSpeeds(const std::vector<Cell>& path) {
  // Sets forwardSpeed [m/s] and turnRate [rad/s], so that the robot follows the path. The S1R
  // drives at most 0.5 m/s and turns at most 3 rad/s.
  //
  // Try first: turn towards the cell 5 cells ahead on the path (its position: xOf(), yOf()) with
  // turnRate = 3 * angle, and drive at 0.2 m/s while the angle is less than 0.3 rad. If the path
  // has 5 cells or fewer, turn on the spot at 2 rad/s: this shows the laser everything that is
  // visible from here.
  // Then: the map may be wrong, or may not yet contain the last scan. In the robot's frame, beam i
  // ended at x = 0.035 + r * cos(b) ahead and y = r * sin(b) to the left, with the range r =
  // (*laser)[i] and the bearing b = laser->GetBearing(i). If any end has x between 0 and 0.14 m and
  // y between -0.1 and 0.1 m, do not drive, only turn: a robot that touches something has failed.
  static_cast<void>(path);
}

bool CRobot::isFinished(bool hasGoal) {
  // Is the exploration complete? The program ends when this returns true.
  //
  // Try first: return true after 20 iterations without a goal, as in the exploration task.
  // Then: the way to the rest may be closed for a while only. The arena changes as long as one of
  // its timers is on: arena->IsTimerEnabled(name), for each name of arena->GetTimerNames(). Do not
  // count iterations while one is.
  static_cast<void>(hasGoal);
  return false;
}

void CRobot::draw(const Map& inflated, const std::vector<Cell>& frontiers,
                  const std::vector<Cell>& path) {
  // Use window.GetLayer("inflated"), ("frontiers") and ("path"): Clear(), then SetPixel(column,
  // row) for each cell, or SetCells() for all cells at once.
  static_cast<void>(inflated);
  static_cast<void>(frontiers);
  static_cast<void>(path);
}
