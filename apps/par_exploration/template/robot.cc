// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "robot.h"

#include <cmath>
#include <string>

#include "imr-h/logging.h"

// The functions that are yours to fill are at the end of this file, in the order in which you need
// them. As it is, the robot knows nothing of the arena, learns nothing, and stands still.

namespace {

const double RADIUS = 0.125;    // of the robot, with some room for driving inexactly [m]
const double REACH = 0.15;      // see moveToFree() [m]
const double SAME_TIME = 1e-3;  // times that differ by less are the same moment [s]

// The window, with the layers of the task. They lie over one another as sheets of glass do, the
// ones with higher priorities on top. A grey layer shows numbers: 0 white, 1 black. In a binary
// layer a cell is set, and then drawn in the layer's colour, or not.
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
    // Also the way in which a simulated run ends: when its time is over, Read() throws.
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
      addScan();
      drawScan();
      drawMap();
    }
    shared.publish(map, pose, position.GetDataTime());

    // Simulated time goes on when ALL threads that read wait in Read(). The other thread waits for
    // the map that was just published before it reads again: neither can run ahead, and equal runs
    // give equal results.
    client.Read();
    const ScopedLock lk(mtx);
    if (quit) break;
  }
}

// --- The thread that plans and drives ------------------------------------------------------------

imr::CConfig& CRobot::getConfig(imr::CConfig& config) {
  // Ports 6665, 6666, ... are one robot each. Index 0 of position2d is the arena's localisation,
  // which is exact; index 1 the odometry, which drifts.
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
      laser(new CCMorse::LaserProxy(client.get(), cfg.get<unsigned>("laser-index"))) {
  // A client takes part in the run from its first Read() on. When both have read, neither thread
  // can miss what the other one sees, whichever of them starts first.
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
  // The other thread may be in Read(), where it waits for time to go on. It goes on when this
  // thread no longer takes part: when its client is gone.
  shared.close();
  collector.stop();
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
    const Map inflated = inflate(map, RADIUS);
    const std::vector<Cell> frontiers = findFrontiers(map);

    // The robot's own cell may lie in a grown obstacle; the way then starts from the nearest free
    // one.
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
  // A command holds until the next one: a robot that nobody stops goes on for ever.
  position->SetSpeed(0.0, 0.0);
}

Cell CRobot::cellOf(double x, double y) const { return {window.GetX(x), window.GetY(y)}; }

double CRobot::xOf(const Cell& cell) const { return (cell.column + 0.5) * window.GetCellSize(); }

double CRobot::yOf(const Cell& cell) const {
  // Rows count from the top, y from below.
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

void CCollector::addScan() {
  // Beam i was measured in the direction pose.yaw + laser.GetBearing(i), from the LASER, which is
  // 0.035 m ahead of the robot's centre. It ended after laser[i] metres at something, unless that
  // is GetMaxRange(): then it met nothing. A place (x, y) lies in the cell of column window.GetX(x)
  // and row window.GetY(y).
  //
  // Try first: make the cell where each beam ends 1, and see whether drawMap() shows walls. A beam
  // may end off the map. The face of an obstacle lies between two cells: take the end 0.01 m
  // further on.
  // Then: every cell that a beam passed is free (look up "Bresenham's line"), but not a cell in
  // which another beam of the same scan ends: beams graze along walls. The laser does not see the
  // floor on which the robot stands: it is free, too, within 0.07 m of its centre.
  // Then: a scan may err (5 mm of noise here), so do not set cells, but let each scan make them a
  // little more likely free or occupied. Look up "occupancy grid" and "log odds": a number l for
  // each cell, in a variable of your own in robot.h, at first 0. A scan in which the cell is
  // occupied adds 0.9, one in which it is free subtracts 0.4, and l stays within -4 and 4. The
  // probability of the cell is 1 / (1 + exp(-l)).
}

void CCollector::drawMap() {
  // Try first: the whole map at once, window.GetLayer("occupancy").SetCells(map.occupied). This
  // layer is what is graded.
  // Next: is it needed ten times a second?
}

void CCollector::drawScan() {
  // window.GetLayer("scan"): Clear() it, then SetPixelMetres(x, y) for the end of each beam.
}

void CCollector::drawTrail() {
  // window.GetLayer("trail").SetLineMetres(x0, y0, x1, y1), from the pose before to this one.
}

// --- Yours: where to go --------------------------------------------------------------------------

Map CRobot::inflate(const Map& map, double radius) const {
  // Where may the robot's CENTRE be? Nowhere nearer than its radius to what is occupied. If
  // obstacles are grown by that radius, the robot may be planned for as if it were a point. What is
  // unknown is not grown: nobody knows that anything is there.
  //
  // Try first: as in the planning task, cells whose centres are within radius of that of an
  // occupied one become 1. There, too, the cells just off the map count as occupied: the arena ends
  // in a wall.
  static_cast<void>(radius);
  return map;
}

std::vector<Cell> CRobot::findFrontiers(const Map& map) const {
  // A frontier is where the known ends: a free cell that has an unknown neighbour.
  //
  // Try first: all such cells, as a list; draw() shows whether they lie where you expect them.
  // Next: group those that touch one another. What do you do with groups of two or three cells?
  static_cast<void>(map);
  return std::vector<Cell>();
}

bool CRobot::chooseGoal(const Map& map, const Cell& from, const std::vector<Cell>& frontiers,
                        Cell& goal) {
  // Where to go next, from a free cell; false if there is nowhere to go.
  //
  // Try first: the frontier that is nearest as the crow flies, and see where that robot gets stuck.
  // Then: the one that is nearest to drive to. Flood the free cells of the map from `from`, as in
  // plan(), until the first frontier cell comes out. Frontiers in grown obstacles never do.
  // Then: a frontier may still be there when the robot has looked at it. Keep a count for each
  // cell, in a variable of your own: 1 more for the goal each turn, 10 more while it is nearer than
  // 0.15 m. Frontier cells within 0.1 m of a cell with more than 300 are given up: they are no
  // goals again.
  // Next: keep a goal until it is no frontier any more, rather than change it each turn. Look at a
  // frontier from farther away. Go where there is more to be seen.
  static_cast<void>(map);
  static_cast<void>(from);
  static_cast<void>(frontiers);
  static_cast<void>(goal);
  return false;
}

std::vector<Cell> CRobot::plan(const Map& map, const Cell& from, const Cell& to) const {
  // The cells from `from` to `to`, each a neighbour of the one before; empty if there is no way.
  //
  // Try first: flooding over free cells, as in the planning task. The way must not lead through
  // unknown cells: they are not grown.
  // Next: keep more room to obstacles where there is some.
  static_cast<void>(map);
  static_cast<void>(from);
  static_cast<void>(to);
  return std::vector<Cell>();
}

void CRobot::decideSpeeds(const std::vector<Cell>& path) {
  // Sets forwardSpeed [m/s] and turnRate [rad/s], so that the robot follows the path. The S1R
  // drives at most 0.5 m/s and turns at most 3 rad/s.
  //
  // Try first: turn towards the cell 5 cells ahead on the path (where it is: xOf(), yOf()) with
  // turnRate = 3 * angle, and drive at 0.2 m/s while the angle is less than 0.3 rad. Without a
  // path, or when it has no more than 5 cells, turn on the spot at 2 rad/s: that shows the laser
  // all there is to see from here.
  // Then: the map may be wrong, or not know yet what the last scan shows. Beam i ended, seen from
  // the robot's centre, at x = 0.035 + r * cos(b) ahead and y = r * sin(b) to the left, with the
  // range r = (*laser)[i] and the bearing b = laser->GetBearing(i). If any end has x between 0 and
  // 0.14 m and y between -0.1 and 0.1 m, do not drive, only turn: a robot that touches something
  // has failed.
  static_cast<void>(path);
}

bool CRobot::isFinished(bool hasGoal) {
  // When is the arena explored? The frame ends the program if this is true.
  //
  // Try first: when there has been no goal for 20 turns. After one turn it is too early: the first
  // scans are not enough for any cell to be free for certain.
  static_cast<void>(hasGoal);
  return false;
}

void CRobot::draw(const Map& inflated, const std::vector<Cell>& frontiers,
                  const std::vector<Cell>& path) {
  // Into window.GetLayer("inflated"), ("frontiers") and ("path"): Clear(), then SetPixel(column,
  // row) for each cell, or SetCells() for all of them at once.
  static_cast<void>(inflated);
  static_cast<void>(frontiers);
  static_cast<void>(path);
}
