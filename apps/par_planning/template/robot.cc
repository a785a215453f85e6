// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "robot.h"

#include <cmath>

#include "imr-h/logging.h"

// The functions that are yours to fill are at the end of this file, in the order in which you need
// them. As it is, the program knows of no map, finds no way and stands still.

namespace {

const double RADIUS = 0.13;  // of the robot, with some room for driving inexactly [m]

// The robot and its goal may be nearer than RADIUS to a wall: the goal of this task lies 0.12 m
// from a block. Then the nearest free cell is meant, if it is not farther away than this [m].
const double REACH = 0.15;

}  // namespace

imr::CConfig& CRobot::getConfig(imr::CConfig& config) {
  config.add<std::string>("host", "where the robot is", "localhost");
  config.add<unsigned>("port", "its port", 4000);
  config.add<unsigned>("position2d-index", "number of the drive", 0);
  config.add<std::string>("map", "text file with the map; without it, the world is asked", "");
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
  // Layers lie over one another as sheets of glass do, the ones with higher priorities on top. In a
  // binary layer a cell is set, and then drawn in the layer's colour, or not.
  window.CreateLayer("inflated", CCMorse::GridMapLayer::BINARY, 1).SetColour("#a9d4f5");
  window.CreateLayer("map", CCMorse::GridMapLayer::BINARY, 2).SetColour("#202020");
  window.CreateLayer("path", CCMorse::GridMapLayer::BINARY, 3).SetColour("#1030a0");
  window.CreateLayer("smoothed", CCMorse::GridMapLayer::BINARY, 4).SetColour("#ff8800");
  window.CreateLayer("goal", CCMorse::GridMapLayer::BINARY, 5).SetColour("#d6006c");
  // Proxies are empty until the first data come.
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
    // Also the way in which a simulated run ends: when its time is over, Read() throws.
    INFO("The run is over: " << e.GetErrorStr());
  }
}

void CRobot::navigation() {
  drawGoal(window.GetLayer("goal"), cellOf(goalX, goalY));

  // Simulated time stands still while you compute: it goes on in Read() only.
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
  // A command holds until the next one: a robot that nobody stops goes on for ever.
  position->SetSpeed(0.0, 0.0);
  client->Read();
  position->SetMotorEnable(false);
}

Cell CRobot::cellOf(double x, double y) const { return {window.GetX(x), window.GetY(y)}; }

double CRobot::xOf(const Cell& cell) const { return (cell.column + 0.5) * window.GetCellSize(); }

double CRobot::yOf(const Cell& cell) const {
  // Rows count from the top, y from below.
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
  // A dot and a ring of 0.12 m round it, in which the robot has room.
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
  // The first line of the file is the number of rows; then come the rows, the top one first: '.' is
  // a free cell and '#' a wall. worlds/maps/two_rooms.txt is one. A cell is window.GetCellSize()
  // wide.
  //
  // Try first: read the height with std::ifstream and >>, then each row with >> into a std::string.
  // Then think of files that are not there, too short, or hold other characters: say what is wrong,
  // and in which line.
  INFO("loadMap() is empty: " << file << " is not read");
  return Map();
}

Map CRobot::fetchMap() const {
  // The world tells its map too: a CCMorse::MapProxy for the client with index 0 has it after
  // RequestMap(). GetCell(x, y) is -1 where the cell is free, 0 where nobody knows, and 1 where
  // something stands. Beware: Player counts rows from the BOTTOM.
  //
  // Try first: a map of GetWidth() x GetHeight() cells, all free. Then copy the cells. drawMap()
  // shows you whether it stands on its head.
  return Map();
}

Map CRobot::inflate(const Map& map, double radius) const {
  // Where may the robot's CENTRE be? Nowhere nearer than its radius to a wall. If walls are grown
  // by that radius, the robot may be planned for as if it were a point.
  //
  // Try first: for each wall cell, occupy all cells whose centres are within radius of its centre.
  // Then: the arena ends in a wall, which is not on the map. Take the cells just off the map, all
  // round it (column -1 and width, row -1 and height), for wall cells, too.
  // Next: that looks at each cell many times; how does it get faster? (Look up "distance
  // transform".)
  static_cast<void>(radius);
  return map;
}

std::vector<Cell> CRobot::plan(const Map& map, const Cell& from, const Cell& to) {
  // The cells from `from` to `to`, each a neighbour of the one before; empty if there is no way.
  //
  // Both ends are free cells of the map: navigation() sees to that.
  //
  // Try first: flooding. Put `from` into a std::queue; take a cell out, put its free neighbours
  // (left, right, above and below) in that were not in before, and note for each of them from where
  // it was reached. When `to` comes out, walk back along the notes. The map ends somewhere: a
  // neighbour may be off it.
  // Next: Dijkstra's algorithm. A std::priority_queue, and diagonal steps that cost sqrt(2). May a
  // diagonal step brush the corner of a wall?
  static_cast<void>(map);
  static_cast<void>(from);
  static_cast<void>(to);
  return {};
}

std::vector<Cell> CRobot::smooth(const Map& map, const std::vector<Cell>& path) {
  // A way over neighbours has corners every few cells. If all cells on the straight line between
  // two cells of the way are free, those between can be left out.
  //
  // Try first: from the first cell to the last one of the way that it can see, and on from there
  // until the end. The cells on a straight line: look up "Bresenham's line".
  static_cast<void>(map);
  return path;
}

void CRobot::drawMap(CCMorse::GridMapLayer& layer, const Map& map) const {
  // Try first: layer.SetCell(column, row, 1) for each cell that is occupied.
  static_cast<void>(layer);
  static_cast<void>(map);
}

void CRobot::drawPath(CCMorse::GridMapLayer& layer, const std::vector<Cell>& path) const {
  // Try first: layer.SetLine(column0, row0, column1, row1) from each cell of the way to the next
  // one; it draws in the layer's own colour.
  static_cast<void>(layer);
  static_cast<void>(path);
}

bool CRobot::decideSpeeds(const std::vector<Cell>& path) {
  // Where the robot is: position->GetXPos(), GetYPos() [m], GetYaw() [rad]; where cell path[i] is:
  // xOf(), yOf(). The direction of a point is std::atan2(dy, dx); minus the yaw, and brought into
  // -pi..pi by std::remainder(angle, 2 * PI), it tells how far to turn.
  //
  // Try first: remember in a variable of your own, in robot.h, which cell of the smoothed way comes
  // next. Turn towards it with turnRate = 3 * angle, and drive at 0.2 m/s while the angle is less
  // than 0.2 rad. When the cell is nearer than 0.03 m, go on to the one after. Return true when the
  // last one is reached. A way without cells leads nowhere: stand still.
  // Next: drive faster, without swinging, and without standing still at each corner.
  static_cast<void>(path);
  forwardSpeed = 0.0;
  turnRate = 0.0;
  return false;
}
