// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "robot.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "imr-h/logging.h"

// Fill in the two functions at the end of this file. As it is, the robot does not look for the fox
// and stands still, until the time is over.

namespace {

const double RADIUS = 0.13;  // radius of the robot, with some room for inexact driving [m]
const double REACH = 0.5;    // see moveToFree() [m]

}  // namespace

imr::CConfig& CRobot::getConfig(imr::CConfig& config) {
  config.add<std::string>("host", "where the robot is", "localhost");
  config.add<unsigned>("port", "its port", 6665);
  config.add<unsigned>("position2d-index", "number of the drive", 0);
  config.add<unsigned>("fiducial-index", "number of the fiducial finder", 0);
  return config;
}

CRobot::CRobot(imr::CConfig& cfg)
    : client(new CCMorse::PlayerClient(cfg.get<std::string>("host"), cfg.get<unsigned>("port"))),
      position(new CCMorse::Position2dProxy(client.get(), cfg.get<unsigned>("position2d-index"))),
      fiducial(new PlayerCc::FiducialProxy(client.get(), cfg.get<unsigned>("fiducial-index"))),
      window(CCMorse::WindowProxy::GetInstance(client.get(), 172, 186)) {
  // Layers are stacked: those with a higher priority lie on top.
  window.CreateLayer("map", CCMorse::GridMapLayer::BINARY, 1).SetColour("#202020");
  window.CreateLayer("path", CCMorse::GridMapLayer::BINARY, 2).SetColour("#ff8800");
  window.CreateLayer("goal", CCMorse::GridMapLayer::BINARY, 3).SetColour("#d6006c");
  // Proxies are empty until the first data arrive.
  while (!position->IsFresh() || !fiducial->IsFresh()) {
    client->Read();
  }
}

CRobot::~CRobot() {
  stop();
  join();
}

void CRobot::stop() {
  ScopedLock lk(mtx);
  quit = true;
}

void CRobot::threadBody() {
  try {
    navigation();
  } catch (const CCMorse::MorseError& e) {
    // Read() also throws when the simulated run ends: here, when the arena's controller ends it.
    INFO("The run is over: " << e.GetErrorStr());
  }
  delete &window;
  fiducial.reset();
  position.reset();
  client.reset();
}

void CRobot::navigation() {
  position->SetMotorEnable(true);
  const Map map = fetchMap();
  drawMap("map", map);
  inflated = inflate(map, RADIUS);
  goalX = position->GetXPos();
  goalY = position->GetYPos();
  int iteration = 0;
  bool q = false;
  while (!q) {
    position->NotFresh();
    pose = imr::robot::SPosition(position->GetXPos(), position->GetYPos(), position->GetYaw());
    if (fiducial->IsFresh()) {
      fiducial->NotFresh();
      lookAround();
    }
    if (iteration++ % 5 == 0) {  // twice a second
      chooseGoal();
      drawGoal();
      makePath();
    }
    decideSpeeds();
    position->SetSpeed(forwardSpeed, turnRate);
    client->Read();

    ScopedLock lk(mtx);
    q = quit;
  }
  // A command stays in effect until the next one: without this one the robot would drive on.
  position->SetSpeed(0.0, 0.0);
}

// --- These already work --------------------------------------------------------------------------

void CRobot::makePath() {
  Cell start = cellOf(pose.x, pose.y);
  Cell goal = cellOf(goalX, goalY);
  std::vector<Cell> cells;
  if (moveToFree(inflated, start) && moveToFree(inflated, goal)) {
    cells = plan(inflated, start, goal);
  }
  if (cells.empty()) INFO("There is no way to (" << goalX << ", " << goalY << ") m");

  // Leaves out the cells between two that are in line of sight.
  path.clear();
  next = 0;
  for (std::size_t at = 0; at < cells.size();) {
    path.push_back(cells[at]);
    std::size_t last = cells.size() - 1;
    while (last > at + 1 && !canSee(inflated, cells[at], cells[last])) last--;
    at = std::max(last, at + 1);
  }
  drawPath();
}

void CRobot::decideSpeeds() {
  forwardSpeed = 0.0;
  turnRate = 0.0;
  const auto dx = [&] { return xOf(path[next]) - pose.x; };
  const auto dy = [&] { return yOf(path[next]) - pose.y; };
  while (next < path.size() && std::hypot(dx(), dy()) < 0.03) next++;
  if (next >= path.size()) return;
  const double angle = std::remainder(std::atan2(dy(), dx()) - pose.yaw, 2.0 * PI);
  turnRate = 3.0 * angle;
  if (std::fabs(angle) < 0.3) forwardSpeed = 0.35;
}

Map CRobot::fetchMap() const {
  CCMorse::MapProxy proxy(client.get(), 0);
  proxy.RequestMap();
  Map map;
  map.width = static_cast<int>(proxy.GetWidth());
  map.height = static_cast<int>(proxy.GetHeight());
  map.cellSize = proxy.GetResolution();
  for (int row = 0; row < map.height; row++) {
    for (int column = 0; column < map.width; column++) {
      map.occupied.push_back(proxy.GetCell(column, map.height - 1 - row) >= 0);
    }
  }
  return map;
}

Map CRobot::inflate(const Map& map, double radius) const {
  Map grown = map;
  const double reach = radius / map.cellSize;
  const int whole = static_cast<int>(reach);
  // The arena's border is a wall, too: the cells just outside the map.
  for (int row = -1; row <= map.height; row++) {
    for (int column = -1; column <= map.width; column++) {
      const bool onMap = row >= 0 && column >= 0 && row < map.height && column < map.width;
      if (onMap && !map.isOccupied({column, row})) continue;
      for (int y = std::max(0, row - whole); y <= std::min(map.height - 1, row + whole); y++) {
        for (int x = std::max(0, column - whole); x <= std::min(map.width - 1, column + whole);
             x++) {
          if (std::hypot(x - column, y - row) > reach) continue;
          grown.occupied[static_cast<std::size_t>(y * map.width + x)] = true;
        }
      }
    }
  }
  return grown;
}

std::vector<Cell> CRobot::plan(const Map& map, const Cell& from, const Cell& to) const {
  // Dijkstra's algorithm with diagonal steps. For each cell, `before` is the cell before it.
  typedef std::pair<double, int> Open;  // length of the path to a cell, index of the cell
  const auto indexOf = [&](const Cell& cell) { return cell.row * map.width + cell.column; };
  const auto isFree = [&](int column, int row) {
    return column >= 0 && row >= 0 && column < map.width && row < map.height &&
           !map.isOccupied({column, row});
  };
  std::vector<int> before(map.occupied.size(), -1);
  std::vector<double> length(map.occupied.size(), std::numeric_limits<double>::infinity());
  const auto at = [](int index) { return static_cast<std::size_t>(index); };
  std::priority_queue<Open, std::vector<Open>, std::greater<Open>> open;
  length[at(indexOf(from))] = 0.0;
  open.push(Open(0.0, indexOf(from)));
  while (!open.empty() && open.top().second != indexOf(to)) {
    const Open best = open.top();
    open.pop();
    if (best.first > length[at(best.second)]) continue;  // a shorter path was found meanwhile
    const Cell cell = {best.second % map.width, best.second / map.width};
    for (int dy = -1; dy <= 1; dy++) {
      for (int dx = -1; dx <= 1; dx++) {
        // A diagonal step must not touch the corner of a wall.
        if (!isFree(cell.column + dx, cell.row + dy) || !isFree(cell.column + dx, cell.row) ||
            !isFree(cell.column, cell.row + dy)) {
          continue;
        }
        const int neighbour = indexOf({cell.column + dx, cell.row + dy});
        const double longer = best.first + std::hypot(dx, dy);
        if (longer >= length[at(neighbour)]) continue;
        length[at(neighbour)] = longer;
        before[at(neighbour)] = best.second;
        open.push(Open(longer, neighbour));
      }
    }
  }
  std::vector<Cell> result;
  if (open.empty()) return result;
  for (int index = indexOf(to); index >= 0; index = before[at(index)]) {
    result.push_back({index % map.width, index / map.width});
  }
  std::reverse(result.begin(), result.end());
  return result;
}

bool CRobot::canSee(const Map& map, const Cell& from, const Cell& to) const {
  // Bresenham's line.
  const int dx = std::abs(to.column - from.column);
  const int dy = std::abs(to.row - from.row);
  int error = dx - dy;
  Cell at = from;
  while (at.column != to.column || at.row != to.row) {
    if (map.isOccupied(at)) return false;
    const int twice = 2 * error;
    if (twice > -dy) {
      error -= dy;
      at.column += from.column < to.column ? 1 : -1;
    }
    if (twice < dx) {
      error += dx;
      at.row += from.row < to.row ? 1 : -1;
    }
  }
  return !map.isOccupied(to);
}

Cell CRobot::cellOf(double x, double y) const { return {window.GetX(x), window.GetY(y)}; }

double CRobot::xOf(const Cell& cell) const { return (cell.column + 0.5) * window.GetCellSize(); }

double CRobot::yOf(const Cell& cell) const {
  // Rows count from the top, y from the bottom.
  return (window.GetHeight() - 1 - cell.row + 0.5) * window.GetCellSize();
}

bool CRobot::moveToFree(const Map& map, Cell& cell) const {
  // Replaces an occupied cell by the nearest free one; false if there is none within REACH.
  const Cell from = cell;
  double least = REACH / map.cellSize;
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

void CRobot::drawMap(const std::string& layer, const Map& map) const {
  CCMorse::GridMapLayer& drawing = window.GetLayer(layer);
  drawing.Clear();
  for (int row = 0; row < map.height; row++) {
    for (int column = 0; column < map.width; column++) {
      if (map.isOccupied({column, row})) drawing.SetCell(column, row, 1);
    }
  }
}

void CRobot::drawPath() const {
  CCMorse::GridMapLayer& drawing = window.GetLayer("path");
  drawing.Clear();
  for (std::size_t i = 1; i < path.size(); i++) {
    drawing.SetLine(path[i - 1].column, path[i - 1].row, path[i].column, path[i].row);
  }
}

void CRobot::drawGoal() const {
  // A dot and a ring of 0.12 m round it. The robot fits inside the ring.
  const Cell goal = cellOf(goalX, goalY);
  window.GetLayer("goal").Clear();
  for (int dy = -6; dy <= 6; dy++) {
    for (int dx = -6; dx <= 6; dx++) {
      const int square = dx * dx + dy * dy;
      if (square < 3 || (square > 25 && square < 41)) {
        window.GetLayer("goal").SetCell(goal.column + dx, goal.row + dy, 1);
      }
    }
  }
}

// --- Yours ---------------------------------------------------------------------------------------

void CRobot::lookAround() {
  // The fiducial finder sees the fox within 1.5 m, up to 90 degrees to both sides, if no wall is
  // between them. fiducial->GetCount() is 1 if it sees the fox, else 0. Then
  // fiducial->GetFiducialItem(0).pose has the place of the fox in the robot's frame: px metres
  // ahead, py to the left.
  //
  // Try first: turn this place into the arena's frame, with the robot's own `pose`. (Look up
  // "rotation matrix".) Keep it, and the time of the last sight, position->GetDataTime(), in
  // variables of your own in robot.h.
  // Next: from two places, estimate where the fox is going.
}

void CRobot::chooseGoal() {
  // Sets goalX and goalY [m]. The robot then drives there on the shortest path. The run ends when
  // it is within 0.3 m of the fox.
  //
  // Try first: if the fox was in sight less than 5 s ago, drive to where it was.
  // Then: otherwise patrol. Make a list of places from which you see much, for example the corners
  // of the arena and the middle of each room, and drive to one after another; (1.85, 1.6) is in the
  // hall in the middle. A place is reached within 0.1 m.
  // Next: which place was out of sight for the longest time? Where can the fox be by now?
}
