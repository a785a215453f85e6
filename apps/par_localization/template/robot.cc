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

// Fill in the three functions at the end of this file. As it is, the robot wanders about until the
// time is over, because its particles never tell it where it is.

namespace {

const double RADIUS = 0.14;  // radius of the robot, with some room for an inexact pose [m]
const double REACH = 0.2;    // see moveToFree() [m]

const std::size_t PARTICLES = 20000;  // at the start
const double FAR = 1.0;               // greatest value of distanceToWall() [m]
const double WANDER_TURN = 1.2;       // turn rate [rad/s]
const unsigned BEAMS = 40;            // beams of a scan in `ends`

// The particles have settled if the standard deviations of their position and heading are less.
const double SETTLED_POSITION = 0.08;  // [m]
const double SETTLED_HEADING = 0.1;    // [rad]
// The scan fits the map if more than this share of it ends within 0.08 m of a wall.
const double FITS = 0.85;
const double CONTRADICTS = 0.75;  // with less than this, the robot is elsewhere
const int ROUNDS = 10;            // in which it must be so

}  // namespace

imr::CConfig& CRobot::getConfig(imr::CConfig& config) {
  config.add<std::string>("host", "where the robot is", "localhost");
  config.add<unsigned>("port", "its port", 6665);
  config.add<unsigned>("position2d-index", "number of the odometry", 0);
  config.add<unsigned>("laser-index", "number of the laser", 0);
  config.add<double>("goal-x", "where to go [m]", 3.1);
  config.add<double>("goal-y", "where to go [m]", 3.3);
  return config;
}

CRobot::CRobot(imr::CConfig& cfg)
    : client(new CCMorse::PlayerClient(cfg.get<std::string>("host"), cfg.get<unsigned>("port"))),
      position(new CCMorse::Position2dProxy(client.get(), cfg.get<unsigned>("position2d-index"))),
      laser(new CCMorse::LaserProxy(client.get(), cfg.get<unsigned>("laser-index"))),
      window(CCMorse::WindowProxy::GetInstance(client.get(), 172, 186)),
      goalX(cfg.get<double>("goal-x")),
      goalY(cfg.get<double>("goal-y")) {
  // Layers are stacked: those with a higher priority lie on top.
  window.CreateLayer("map", CCMorse::GridMapLayer::BINARY, 1).SetColour("#202020");
  window.CreateLayer("particles", CCMorse::GridMapLayer::BINARY, 2).SetColour("#d62020");
  window.CreateLayer("path", CCMorse::GridMapLayer::BINARY, 3).SetColour("#ff8800");
  window.CreateLayer("goal", CCMorse::GridMapLayer::BINARY, 4).SetColour("#d6006c");
  // Proxies are empty until the first data arrive.
  while (!position->IsFresh() || !laser->IsFresh()) {
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
    INFO("The run is over before the goal was reached: " << e.GetErrorStr());
  }
}

void CRobot::navigation() {
  position->SetMotorEnable(true);
  walls = fetchMap();
  inflated = inflate(walls, RADIUS);
  measureDistances();
  drawMap("map", walls);
  drawGoal();
  scatter();

  imr::robot::SPosition before(position->GetXPos(), position->GetYPos(), position->GetYaw());
  bool known = false;   // whether the robot knows its pose
  int fits = 0;         // rounds in a row in which the scan fits the map
  int contradicts = 0;  // rounds in a row in which it does not
  bool q = false;
  for (int round = 0; !q; round++) {
    client->Read();
    if (!laser->IsFresh()) continue;
    laser->NotFresh();
    position->NotFresh();
    lookAtScan();

    // Where the robot has come since the last scan that was used, seen from its pose there.
    const imr::robot::SPosition now(position->GetXPos(), position->GetYPos(), position->GetYaw());
    const double dx = now.x - before.x;
    const double dy = now.y - before.y;
    const double ahead = std::cos(before.yaw) * dx + std::sin(before.yaw) * dy;
    const double left = -std::sin(before.yaw) * dx + std::cos(before.yaw) * dy;
    const double turned = std::remainder(now.yaw - before.yaw, 2.0 * PI);
    if (std::hypot(ahead, left) > 0.04 || std::fabs(turned) > 0.08) {
      before = now;
      moveParticles(ahead, left, turned);
      weighParticles();
      resample();
    }
    estimate();
    if (round % 5 == 0) drawParticles();

    const bool blocked = roomAhead(0.09) < 0.12;
    fits = settled && fitting() > FITS ? fits + 1 : 0;
    contradicts = settled && (fitting() < CONTRADICTS || (known && blocked)) ? contradicts + 1 : 0;
    if (!known && fits >= ROUNDS) {
      INFO("The robot is at (" << pose.x << ", " << pose.y << ") m");
      makePath();
      known = true;
    } else if (contradicts >= ROUNDS) {
      INFO("The robot is elsewhere: it must look again");
      scatter();
      known = false;
      contradicts = 0;
    }
    if (known) {
      decideSpeeds();
    } else {
      wander();
    }
    position->SetSpeed(blocked ? 0.0 : forwardSpeed, turnRate);

    ScopedLock lk(mtx);
    q = quit || (known && next >= path.size());
  }
  // A command stays in effect until the next one: without this one the robot would drive on.
  position->SetSpeed(0.0, 0.0);
  client->Read();
}

// --- These already work --------------------------------------------------------------------------

void CRobot::scatter() {
  // The robot may be in any cell that its centre can be in, with any heading.
  std::vector<Cell> free;
  for (int row = 0; row < walls.height; row++) {
    for (int column = 0; column < walls.width; column++) {
      const Cell cell = {column, row};
      if (distanceToWall(xOf(cell), yOf(cell)) > 0.09) free.push_back(cell);
    }
  }
  particles.clear();
  std::uniform_int_distribution<std::size_t> place(0, free.size() - 1);
  std::uniform_real_distribution<double> heading(-PI, PI);
  while (particles.size() < PARTICLES) {
    const Cell& cell = free[place(random)];
    particles.push_back({xOf(cell), yOf(cell), heading(random), 1.0});
  }
}

void CRobot::estimate() {
  // The mean of the particles; of the headings, the direction of the sum of their unit vectors.
  double x = 0.0;
  double y = 0.0;
  double c = 0.0;
  double s = 0.0;
  const double count = static_cast<double>(particles.size());
  for (const Particle& particle : particles) {
    x += particle.x / count;
    y += particle.y / count;
    c += std::cos(particle.yaw) / count;
    s += std::sin(particle.yaw) / count;
  }
  double square = 0.0;
  for (const Particle& particle : particles) {
    square += (particle.x - x) * (particle.x - x) / count;
    square += (particle.y - y) * (particle.y - y) / count;
  }
  pose = imr::robot::SPosition(x, y, std::atan2(s, c));
  const double length = std::min(1.0, std::max(1e-9, std::hypot(c, s)));
  settled =
      std::sqrt(square) < SETTLED_POSITION && std::sqrt(-2.0 * std::log(length)) < SETTLED_HEADING;
}

void CRobot::lookAtScan() {
  const player_pose3d_t mount = laser->GetPose();
  const unsigned stride = std::max(1U, laser->GetCount() / BEAMS);
  scan.clear();
  ends.clear();
  for (unsigned i = 0; i < laser->GetCount(); i++) {
    if (laser->GetRange(i) >= laser->GetMaxRange() - 1e-6) continue;  // it has hit nothing
    const double bearing = mount.pyaw + laser->GetBearing(i);
    const End end = {mount.px + laser->GetRange(i) * std::cos(bearing),
                     mount.py + laser->GetRange(i) * std::sin(bearing)};
    scan.push_back(end);
    if (i % stride == 0) ends.push_back(end);
  }
}

double CRobot::fitting() const {
  int near = 0;
  for (const End& end : scan) {
    const double x = pose.x + std::cos(pose.yaw) * end.ahead - std::sin(pose.yaw) * end.left;
    const double y = pose.y + std::sin(pose.yaw) * end.ahead + std::cos(pose.yaw) * end.left;
    if (distanceToWall(x, y) < 0.08) near++;
  }
  return scan.empty() ? 0.0 : static_cast<double>(near) / static_cast<double>(scan.size());
}

double CRobot::roomAhead(double halfWidth) const {
  double room = laser->GetMaxRange();
  for (const End& end : scan) {
    if (end.ahead > 0.0 && std::fabs(end.left) < halfWidth) room = std::min(room, end.ahead);
  }
  return room;
}

void CRobot::wander() {
  // Goes ahead while there is room; else turns to the side with more room until there is room
  // ahead.
  forwardSpeed = 0.0;
  if (roomAhead(0.13) > 0.3) {
    forwardSpeed = std::min(0.25, roomAhead(0.13) - 0.25);
    turnRate = 0.0;
    return;
  }
  if (std::fabs(turnRate) == WANDER_TURN) return;  // it turns already
  double sum = 0.0;
  for (const End& end : scan) {
    sum += (end.left > 0.0 ? 1.0 : -1.0) * std::hypot(end.ahead, end.left);
  }
  turnRate = sum > 0.0 ? WANDER_TURN : -WANDER_TURN;
}

void CRobot::measureDistances() {
  // Dijkstra's algorithm from all walls at once; diagonal steps are longer. The error is below 8 %.
  typedef std::pair<double, int> Open;  // distance of a cell, its index
  distances.assign(walls.occupied.size(), FAR);
  std::priority_queue<Open, std::vector<Open>, std::greater<Open>> open;
  for (int row = 0; row < walls.height; row++) {
    for (int column = 0; column < walls.width; column++) {
      // The arena's border is a wall, too: the cells just outside the map.
      const bool edge =
          row == 0 || column == 0 || row == walls.height - 1 || column == walls.width - 1;
      if (!edge && !walls.isOccupied({column, row})) continue;
      open.push(
          Open(walls.isOccupied({column, row}) ? 0.0 : walls.cellSize, row * walls.width + column));
    }
  }
  while (!open.empty()) {
    const Open nearest = open.top();
    open.pop();
    if (nearest.first >= distances[static_cast<std::size_t>(nearest.second)]) continue;
    distances[static_cast<std::size_t>(nearest.second)] = nearest.first;
    const Cell cell = {nearest.second % walls.width, nearest.second / walls.width};
    for (int dy = -1; dy <= 1; dy++) {
      for (int dx = -1; dx <= 1; dx++) {
        const int column = cell.column + dx;
        const int row = cell.row + dy;
        if (column < 0 || row < 0 || column >= walls.width || row >= walls.height) continue;
        open.push(
            Open(nearest.first + walls.cellSize * std::hypot(dx, dy), row * walls.width + column));
      }
    }
  }
}

double CRobot::distanceToWall(double x, double y) const {
  const Cell cell = cellOf(x, y);
  if (cell.column < 0 || cell.row < 0 || cell.column >= walls.width || cell.row >= walls.height) {
    return FAR;
  }
  return distances[static_cast<std::size_t>(cell.row * walls.width + cell.column)];
}

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
  if (std::fabs(angle) < 0.3) forwardSpeed = 0.25;
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
  for (int dy = -6; dy <= 6; dy++) {
    for (int dx = -6; dx <= 6; dx++) {
      const int square = dx * dx + dy * dy;
      if (square < 3 || (square > 25 && square < 41)) {
        window.GetLayer("goal").SetCell(goal.column + dx, goal.row + dy, 1);
      }
    }
  }
}

void CRobot::drawParticles() const {
  CCMorse::GridMapLayer& drawing = window.GetLayer("particles");
  drawing.Clear();
  for (const Particle& particle : particles) {
    const Cell cell = cellOf(particle.x, particle.y);
    drawing.SetCell(cell.column, cell.row, 1);
  }
}

// --- Yours ---------------------------------------------------------------------------------------

void CRobot::moveParticles(double ahead, double left, double turned) {
  // The robot has moved by `ahead` and `left` metres, seen from where it was, and then turned by
  // `turned` radians: so says its odometry, which is not exact. Moves each particle in the same
  // way, seen from its own pose.
  //
  // Try first: without errors. A particle with heading yaw moves by
  //   cos(yaw) * ahead - sin(yaw) * left  along x, and  sin(yaw) * ahead + cos(yaw) * left  along
  //   y.
  // Then: add an error of its own to the three numbers of each particle, for example
  //   std::normal_distribution<double> error(0.0, 0.002 + 0.1 * std::fabs(ahead));
  //   ... ahead + error(random) ...
  // Next: how large are the errors of the odometry? Too small an error here loses the robot.
  static_cast<void>(ahead);
  static_cast<void>(left);
  static_cast<void>(turned);
}

void CRobot::weighParticles() {
  // Sets the weight of each particle to the likelihood of the scan if the robot were there. `ends`
  // has the places where some beams ended, seen from the robot. Seen from the right particle, they
  // lie at walls of the map: distanceToWall(x, y) is small.
  //
  // Try first: the sum of -d * d / (2 * sigma * sigma) over all ends, with d the distance to the
  // wall, at most 0.15 m, and sigma = 0.06 m; the weight is std::exp(0.2 * sum). (Neighbouring
  // beams tell much the same. The factor keeps the particles from being too sure.) Then: a particle
  // within 0.07 m of a wall is wrong: give it a weight near 0.
}

void CRobot::resample() {
  // Draws new particles: each old one with a chance that is proportional to its weight, so some
  // come several times, and others vanish.
  //
  // Try first: std::discrete_distribution with the weights, and std::vector<Particle>::swap().
  // Then: 20 000 particles are needed only while the robot may be anywhere. Once settled is true,
  // 2000 do.
  // Next: look up the low variance sampler, which needs one random number for all particles.
}
