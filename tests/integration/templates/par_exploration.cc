// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The functions of apps/par_exploration/template, implemented as the comments there describe.

// insert into robot.cc before: #include "imr-h/logging.h"
#include <algorithm>
#include <cstdlib>
#include <queue>

// insert into robot.cc before: }  // namespace
std::vector<Cell> lineOf(const Cell& from, const Cell& to) {
  const int dx = std::abs(to.column - from.column);
  const int dy = std::abs(to.row - from.row);
  const int stepX = from.column < to.column ? 1 : -1;
  const int stepY = from.row < to.row ? 1 : -1;
  std::vector<Cell> cells;
  cells.reserve(static_cast<std::size_t>(std::max(dx, dy)) + 1);
  int error = dx - dy;
  Cell at = from;
  while (true) {
    cells.push_back(at);
    if (at.column == to.column && at.row == to.row) return cells;
    const int twice = 2 * error;
    if (twice > -dy) {
      error -= dy;
      at.column += stepX;
    }
    if (twice < dx) {
      error += dx;
      at.row += stepY;
    }
  }
}

std::size_t indexOf(const Map& map, const Cell& cell) {
  return static_cast<std::size_t>(cell.row * map.width + cell.column);
}

const Cell STEPS[] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};  // to the neighbours

// insert into robot.h before:   bool quit = false;
std::vector<double> logOdds;
bool hasTrail = false;
double trailX = 0.0;
double trailY = 0.0;

// insert into robot.h before:   double forwardSpeed = 0.0;
std::vector<int> counts;  // for each cell: how long it has been the goal
int turnsWithoutGoal = 0;

// function: void CCollector::addScan(
void CCollector::addScan() {
  if (logOdds.empty()) logOdds.assign(map.occupied.size(), 0.0);
  std::vector<double> change(map.occupied.size(), 0.0);
  const auto cellOf = [&](double x, double y) { return Cell{window.GetX(x), window.GetY(y)}; };
  const double laserX = pose.x + 0.035 * std::cos(pose.yaw);
  const double laserY = pose.y + 0.035 * std::sin(pose.yaw);
  std::vector<Cell> ends;
  for (unsigned i = 0; i < laser.GetCount(); i++) {
    const bool hit = laser[i] < laser.GetMaxRange();
    const double range = hit ? laser[i] + 0.01 : laser[i];
    const double angle = pose.yaw + laser.GetBearing(i);
    const Cell end = cellOf(laserX + range * std::cos(angle), laserY + range * std::sin(angle));
    for (const Cell& cell : lineOf(cellOf(laserX, laserY), end)) {
      if (map.contains(cell)) change[indexOf(map, cell)] = -0.4;
    }
    if (hit && map.contains(end)) ends.push_back(end);
  }
  const Cell centre = cellOf(pose.x, pose.y);
  for (int row = centre.row - 3; row <= centre.row + 3; row++) {
    for (int column = centre.column - 3; column <= centre.column + 3; column++) {
      const double distance = std::hypot(column - centre.column, row - centre.row);
      if (distance * map.cellSize > 0.07 || !map.contains({column, row})) continue;
      change[indexOf(map, {column, row})] = -0.4;
    }
  }
  for (const Cell& cell : ends) change[indexOf(map, cell)] = 0.9;
  for (std::size_t i = 0; i < change.size(); i++) {
    logOdds[i] = std::max(-4.0, std::min(4.0, logOdds[i] + change[i]));
    map.occupied[i] = 1.0 / (1.0 + std::exp(-logOdds[i]));
  }
}

// function: void CCollector::drawMap(
void CCollector::drawMap() { window.GetLayer("occupancy").SetCells(map.occupied); }

// function: void CCollector::drawScan(
void CCollector::drawScan() {
  CCMorse::GridMapLayer& layer = window.GetLayer("scan");
  layer.Clear();
  for (unsigned i = 0; i < laser.GetCount(); i++) {
    const double angle = pose.yaw + laser.GetBearing(i);
    layer.SetPixelMetres(pose.x + 0.035 * std::cos(pose.yaw) + laser[i] * std::cos(angle),
                         pose.y + 0.035 * std::sin(pose.yaw) + laser[i] * std::sin(angle));
  }
}

// function: void CCollector::drawTrail(
void CCollector::drawTrail() {
  if (hasTrail) window.GetLayer("trail").SetLineMetres(trailX, trailY, pose.x, pose.y);
  hasTrail = true;
  trailX = pose.x;
  trailY = pose.y;
}

// function: Map CRobot::inflate(
Map CRobot::inflate(const Map& map, double radius) const {
  Map grown = map;
  const double reach = radius / map.cellSize;
  const int whole = static_cast<int>(reach);
  for (int row = -1; row <= map.height; row++) {
    for (int column = -1; column <= map.width; column++) {
      if (map.contains({column, row}) && !map.isOccupied({column, row})) continue;
      for (int y = std::max(0, row - whole); y <= std::min(map.height - 1, row + whole); y++) {
        for (int x = std::max(0, column - whole); x <= std::min(map.width - 1, column + whole);
             x++) {
          const int dx = x - column;
          const int dy = y - row;
          if (dx * dx + dy * dy <= reach * reach) grown.at({x, y}) = 1.0;
        }
      }
    }
  }
  return grown;
}

// function: std::vector<Cell> CRobot::findFrontiers(
std::vector<Cell> CRobot::findFrontiers(const Map& map) const {
  std::vector<Cell> frontiers;
  for (int row = 0; row < map.height; row++) {
    for (int column = 0; column < map.width; column++) {
      const Cell cell = {column, row};
      if (!map.isFree(cell)) continue;
      for (const Cell& step : STEPS) {
        const Cell n = {cell.column + step.column, cell.row + step.row};
        if (!map.contains(n) || map.isFree(n) || map.isOccupied(n)) continue;
        frontiers.push_back(cell);
        break;
      }
    }
  }
  return frontiers;
}

// function: bool CRobot::chooseGoal(
bool CRobot::chooseGoal(const Map& map, const Cell& from, const std::vector<Cell>& frontiers,
                        Cell& goal) {
  if (counts.empty()) counts.assign(map.occupied.size(), 0);
  std::vector<bool> isGoal(map.occupied.size(), false);
  for (const Cell& cell : frontiers) isGoal[indexOf(map, cell)] = true;
  for (int row = 0; row < map.height; row++) {
    for (int column = 0; column < map.width; column++) {
      if (counts[indexOf(map, {column, row})] <= 300) continue;
      for (int y = row - 5; y <= row + 5; y++) {
        for (int x = column - 5; x <= column + 5; x++) {
          if (map.contains({x, y}) && std::hypot(x - column, y - row) <= 5.0) {
            isGoal[indexOf(map, {x, y})] = false;
          }
        }
      }
    }
  }
  std::vector<bool> wasIn(map.occupied.size(), false);
  std::queue<Cell> cells;
  cells.push(from);
  wasIn[indexOf(map, from)] = true;
  while (!cells.empty()) {
    const Cell cell = cells.front();
    cells.pop();
    if (isGoal[indexOf(map, cell)]) {
      goal = cell;
      const Cell robot = cellOf(pose.x, pose.y);
      const double distance = std::hypot(cell.column - robot.column, cell.row - robot.row);
      counts[indexOf(map, cell)] += distance * map.cellSize < 0.15 ? 10 : 1;
      return true;
    }
    for (const Cell& step : STEPS) {
      const Cell n = {cell.column + step.column, cell.row + step.row};
      if (!map.contains(n) || !map.isFree(n) || wasIn[indexOf(map, n)]) continue;
      wasIn[indexOf(map, n)] = true;
      cells.push(n);
    }
  }
  return false;
}

// function: std::vector<Cell> CRobot::plan(
std::vector<Cell> CRobot::plan(const Map& map, const Cell& from, const Cell& to) const {
  std::vector<Cell> reachedFrom(map.occupied.size(), {-1, -1});
  std::queue<Cell> cells;
  cells.push(from);
  reachedFrom[indexOf(map, from)] = from;
  while (!cells.empty()) {
    const Cell cell = cells.front();
    cells.pop();
    if (cell.column == to.column && cell.row == to.row) {
      std::vector<Cell> path(1, to);
      while (path.back().column != from.column || path.back().row != from.row) {
        path.push_back(reachedFrom[indexOf(map, path.back())]);
      }
      std::reverse(path.begin(), path.end());
      return path;
    }
    for (const Cell& step : STEPS) {
      const Cell n = {cell.column + step.column, cell.row + step.row};
      if (!map.contains(n) || !map.isFree(n) || reachedFrom[indexOf(map, n)].row >= 0) continue;
      reachedFrom[indexOf(map, n)] = cell;
      cells.push(n);
    }
  }
  return {};
}

// function: void CRobot::decideSpeeds(
void CRobot::decideSpeeds(const std::vector<Cell>& path) {
  forwardSpeed = 0.0;
  turnRate = 2.0;
  if (path.size() <= 5) return;
  const double direction = std::atan2(yOf(path[5]) - pose.y, xOf(path[5]) - pose.x);
  const double angle = std::remainder(direction - pose.yaw, 2.0 * PI);
  turnRate = 3.0 * angle;
  if (std::fabs(angle) < 0.3) forwardSpeed = 0.2;
  for (unsigned i = 0; i < laser->GetCount(); i++) {
    const double endX = 0.035 + (*laser)[i] * std::cos(laser->GetBearing(i));
    const double endY = (*laser)[i] * std::sin(laser->GetBearing(i));
    if (endX > 0.0 && endX < 0.14 && std::fabs(endY) < 0.1) forwardSpeed = 0.0;
  }
}

// function: bool CRobot::isFinished(
bool CRobot::isFinished(bool hasGoal) {
  turnsWithoutGoal = hasGoal ? 0 : turnsWithoutGoal + 1;
  return turnsWithoutGoal >= 20;
}

// function: void CRobot::draw(
void CRobot::draw(const Map& inflated, const std::vector<Cell>& frontiers,
                  const std::vector<Cell>& path) {
  CCMorse::GridMapLayer& grown = window.GetLayer("inflated");
  grown.Clear();
  for (int row = 0; row < inflated.height; row++) {
    for (int column = 0; column < inflated.width; column++) {
      if (inflated.isOccupied({column, row})) grown.SetPixel(column, row);
    }
  }
  CCMorse::GridMapLayer& ends = window.GetLayer("frontiers");
  ends.Clear();
  for (const Cell& cell : frontiers) ends.SetPixel(cell.column, cell.row);
  CCMorse::GridMapLayer& way = window.GetLayer("path");
  way.Clear();
  for (const Cell& cell : path) way.SetPixel(cell.column, cell.row);
}
