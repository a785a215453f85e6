// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "robot.h"

#include <cmath>

#include "imr-h/logging.h"

// Fill in the functions at the end of this file, in the order in which they stand there. As it is,
// the program has no map, plans no path and stands still.

namespace {

const double RADIUS = 0.13;  // radius of the robot, with some room for inexact driving [m]

// The robot and its goal may be nearer than RADIUS to a wall: the goal of this task is 0.12 m from
// a block. The program then uses the nearest free cell, if it is not farther away than this [m].
const double REACH = 0.15;

}  // namespace

imr::CConfig& CRobot::getConfig(imr::CConfig& config) {
  config.add<std::string>("host", "where the robot is", "localhost");
  config.add<unsigned>("port", "its port", 4000);
  config.add<unsigned>("position2d-index", "number of the drive", 0);
  config.add<std::string>("map", "text file with the map [the map of the world]", "");
  config.add<double>("goal-x", "where to go [m]", 3.1);
  config.add<double>("goal-y", "where to go [m]", 3.3);
  return config;
}

CRobot::CRobot(imr::CConfig& cfg)
    : mapFile(cfg.get<std::string>("map")),
      goalX(cfg.get<double>("goal-x")),
      goalY(cfg.get<double>("goal-y")),
      client(new CCMorse::PlayerClient(cfg.get<std::string>("host"), cfg.get<unsigned>("port"))),
      position(new CCMorse::Position2dProxy(client.get(), cfg.get<unsigned>("position2d-index"))),
      window(CCMorse::WindowProxy::GetInstance(client.get(), 172, 186)) {
  // Layers are stacked: those with a higher priority lie on top. In a binary layer a cell is either
  // set, and drawn in the layer's colour, or transparent.
  window.CreateLayer("inflated", CCMorse::GridMapLayer::BINARY, 1).SetColour("#a9d4f5");
  window.CreateLayer("map", CCMorse::GridMapLayer::BINARY, 2).SetColour("#202020");
  window.CreateLayer("path", CCMorse::GridMapLayer::BINARY, 3).SetColour("#1030a0");
  window.CreateLayer("smoothed", CCMorse::GridMapLayer::BINARY, 4).SetColour("#ff8800");
  window.CreateLayer("goal", CCMorse::GridMapLayer::BINARY, 5).SetColour("#d6006c");
  // Proxies are empty until the first data arrive.
  while (!position->IsFresh()) {
    client->Read();
  }
}

CRobot::~CRobot() {
  stop();
  join();
  delete &window;
}

void CRobot::stop() {
  ScopedLock lk(mtx);
  quit = true;
}

void CRobot::threadBody() {
  try {
    navigation();
  } catch (const CCMorse::MorseError& e) {
    // Read() also throws when the simulated run ends.
    INFO("The run is over: " << e.GetErrorStr());
  }
}

void CRobot::navigation() {
  drawGoal(window.GetLayer("goal"), cellOf(goalX, goalY));

  // Simulated time stands still while you compute: it advances only inside Read().
  const Map map = mapFile.empty() ? fetchMap() : loadMap(mapFile);
  drawMap(window.GetLayer("map"), map);

  const Map inflated = inflate(map, RADIUS);
  drawMap(window.GetLayer("inflated"), inflated);

  Cell start = cellOf(position->GetXPos(), position->GetYPos());
  Cell goal = cellOf(goalX, goalY);
  std::vector<Cell> path;
  if (moveToFree(inflated, start) && moveToFree(inflated, goal)) {
    path = plan(inflated, start, goal);
  }
  drawPath(window.GetLayer("path"), path);
  if (path.empty()) INFO("There is no way to (" << goalX << ", " << goalY << ") m");

  const std::vector<Cell> smoothed = smooth(inflated, path);
  drawPath(window.GetLayer("smoothed"), smoothed);

  position->SetMotorEnable(true);
  bool q = false;
  while (!q) {
    client->Read();
    if (position->IsFresh()) {
      position->NotFresh();
      if (decideSpeeds(smoothed)) stop();
      position->SetSpeed(forwardSpeed, turnRate);
    }
    ScopedLock lk(mtx);
    q = quit;
  }
  // A command stays in effect until the next one: without this one the robot would drive on.
  position->SetSpeed(0.0, 0.0);
  client->Read();
  position->SetMotorEnable(false);
}

Cell CRobot::cellOf(double x, double y) const { return {window.GetX(x), window.GetY(y)}; }

double CRobot::xOf(const Cell& cell) const { return (cell.column + 0.5) * window.GetCellSize(); }

double CRobot::yOf(const Cell& cell) const {
  // Rows count from the top, y from the bottom.
  return (window.GetHeight() - 1 - cell.row + 0.5) * window.GetCellSize();
}

bool CRobot::moveToFree(const Map& map, Cell& cell) const {
  const Cell from = cell;
  double least = REACH / window.GetCellSize();
  bool found = false;
  for (int row = 0; row < map.height; row++) {
    for (int column = 0; column < map.width; column++) {
      const double distance = std::hypot(column - from.column, row - from.row);
      if (found ? distance >= least : distance > least) continue;
      if (map.isOccupied({column, row})) continue;
      cell = {column, row};
      least = distance;
      found = true;
    }
  }
  return found;
}

void CRobot::drawGoal(CCMorse::GridMapLayer& layer, const Cell& goal) const {
  // A dot and a ring of 0.12 m round it. The robot fits inside the ring.
  for (int dy = -6; dy <= 6; dy++) {
    for (int dx = -6; dx <= 6; dx++) {
      const double distance = std::hypot(dx, dy);
      if (distance < 1.5 || (distance > 5.0 && distance < 6.4)) {
        layer.SetCell(goal.column + dx, goal.row + dy, 1);
      }
    }
  }
}

Map CRobot::loadMap(const std::string& file) const {
  // The first line of the file is the number of rows. The rows follow, from top to bottom: '.' is a
  // free cell and '#' a wall. worlds/maps/two_rooms.txt is an example. A cell is
  // window.GetCellSize() wide.
  //
  // Try first: read the height with std::ifstream and >>, then each row with >> into a std::string.
  // Then think of files that do not exist, are too short, or contain other characters: report what
  // is wrong, and in which line.
  INFO("loadMap() is empty: " << file << " is not read");
  return Map();
}

Map CRobot::fetchMap() const {
  // The world also provides its map: create a CCMorse::MapProxy for the client with index 0 and
  // call RequestMap(). GetCell(x, y) is -1 for a free cell, 0 for an unknown cell and 1 for an
  // occupied cell. Beware: Player counts rows from the BOTTOM.
  //
  // Try first: a map of GetWidth() x GetHeight() cells, all free. Then copy the cells. drawMap()
  // shows you whether the map is upside down.
  return Map();
}

Map CRobot::inflate(const Map& map, double radius) const {
  // Where may the robot's CENTRE be? It must stay at least one radius away from every wall. If you
  // inflate the walls by that radius, you can plan for the robot as if it were a point.
  //
  // Try first: for each wall cell, occupy all cells whose centres are within radius of its centre.
  // Then: the arena's border is a wall that is not on the map. Treat the cells just outside the map
  // (columns -1 and width, rows -1 and height) as wall cells, too.
  // Next: this method visits each cell many times. How can it be faster? (Look up "distance
  // transform".)
  static_cast<void>(radius);
  return map;
}

std::vector<Cell> CRobot::plan(const Map& map, const Cell& from, const Cell& to) {
  // Returns the cells from `from` to `to`, each a neighbour of the previous one; empty if there is
  // no path.
  //
  // Both ends are free cells of the map; navigation() ensures that.
  //
  // Try first: breadth-first search. Put `from` into a std::queue. Take a cell out, and put in
  // those free neighbours (left, right, above and below) that have not been in the queue before.
  // Note for each of them the cell from which you reached it. When `to` comes out, follow the notes
  // back to the start. A neighbour may be outside the map.
  // Next: Dijkstra's algorithm, with a std::priority_queue and diagonal steps that cost sqrt(2).
  // May a diagonal step touch the corner of a wall?
  static_cast<void>(map);
  static_cast<void>(from);
  static_cast<void>(to);
  return {};
}

std::vector<Cell> CRobot::smooth(const Map& map, const std::vector<Cell>& path) {
  // A path over neighbours has a corner every few cells. If all cells on the straight line between
  // two cells of the path are free, you can leave out the cells between them.
  //
  // Try first: from the first cell, find the last cell of the path that is in line of sight, and
  // continue from there until the end. For the cells on a straight line, look up "Bresenham's
  // line".
  static_cast<void>(map);
  return path;
}

void CRobot::drawMap(CCMorse::GridMapLayer& layer, const Map& map) const {
  // Try first: layer.SetCell(column, row, 1) for each cell that is occupied.
  static_cast<void>(layer);
  static_cast<void>(map);
}

void CRobot::drawPath(CCMorse::GridMapLayer& layer, const std::vector<Cell>& path) const {
  // Try first: layer.SetLine(column0, row0, column1, row1) from each cell of the path to the next
  // one. It draws in the layer's colour.
  static_cast<void>(layer);
  static_cast<void>(path);
}

bool CRobot::decideSpeeds(const std::vector<Cell>& path) {
  // The robot is at position->GetXPos(), GetYPos() [m] with the heading GetYaw() [rad]. Cell
  // path[i] is at xOf(), yOf(). The direction to a point is std::atan2(dy, dx). Subtract the yaw
  // and bring the result into -pi..pi by std::remainder(angle, 2 * PI): that is the angle to turn.
  //
  // Try first: keep the index of the next cell of the smoothed path in a variable of your own, in
  // robot.h. Turn towards this cell with turnRate = 3 * angle, and drive at 0.2 m/s while the angle
  // is less than 0.2 rad. When the cell is nearer than 0.03 m, continue with the next one. Return
  // true when the robot has reached the last cell. Stand still if the path is empty.
  // Next: drive faster, without oscillating, and without stopping at each corner.
  static_cast<void>(path);
  forwardSpeed = 0.0;
  turnRate = 0.0;
  return false;
}
