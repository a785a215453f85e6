// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The functions of apps/par_planning/template, implemented as the comments there describe.

// insert into robot.cc before: #include "imr-h/logging.h"
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <queue>

// insert into robot.cc before: }  // namespace
std::vector<Cell> lineOf(const Cell& from, const Cell& to) {
  const int dx = std::abs(to.column - from.column);
  const int dy = std::abs(to.row - from.row);
  const int stepX = from.column < to.column ? 1 : -1;
  const int stepY = from.row < to.row ? 1 : -1;
  std::vector<Cell> cells;
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

bool canSee(const Map& map, const Cell& from, const Cell& to) {
  for (const Cell& cell : lineOf(from, to)) {
    if (map.isOccupied(cell)) return false;
  }
  return true;
}

// insert into robot.h before:   bool quit = false;
std::size_t next = 0;  // the cell of the path that the robot drives to

// function: Map CRobot::loadMap(
Map CRobot::loadMap(const std::string& file) const {
  std::ifstream in(file);
  Map map;
  map.cellSize = window.GetCellSize();
  in >> map.height;
  std::string line;
  while (in >> line) {
    map.width = static_cast<int>(line.size());
    for (const char c : line) map.occupied.push_back(c == '#');
  }
  return map;
}

// function: Map CRobot::fetchMap(
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

// function: Map CRobot::inflate(
Map CRobot::inflate(const Map& map, double radius) const {
  Map grown = map;
  const double reach = radius / map.cellSize;
  const int whole = static_cast<int>(reach);
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

// function: std::vector<Cell> CRobot::plan(
std::vector<Cell> CRobot::plan(const Map& map, const Cell& from, const Cell& to) {
  const auto indexOf = [&](const Cell& cell) {
    return static_cast<std::size_t>(cell.row * map.width + cell.column);
  };
  std::vector<Cell> reachedFrom(map.occupied.size(), {-1, -1});
  std::queue<Cell> cells;
  cells.push(from);
  reachedFrom[indexOf(from)] = from;
  while (!cells.empty()) {
    const Cell cell = cells.front();
    cells.pop();
    if (cell.column == to.column && cell.row == to.row) {
      std::vector<Cell> path(1, to);
      while (path.back().column != from.column || path.back().row != from.row) {
        path.push_back(reachedFrom[indexOf(path.back())]);
      }
      std::reverse(path.begin(), path.end());
      return path;
    }
    const Cell neighbours[] = {{cell.column - 1, cell.row},
                               {cell.column + 1, cell.row},
                               {cell.column, cell.row - 1},
                               {cell.column, cell.row + 1}};
    for (const Cell& n : neighbours) {
      if (n.column < 0 || n.row < 0 || n.column >= map.width || n.row >= map.height) continue;
      if (map.isOccupied(n) || reachedFrom[indexOf(n)].row >= 0) continue;
      reachedFrom[indexOf(n)] = cell;
      cells.push(n);
    }
  }
  return {};
}

// function: std::vector<Cell> CRobot::smooth(
std::vector<Cell> CRobot::smooth(const Map& map, const std::vector<Cell>& path) {
  if (path.empty()) return path;
  std::vector<Cell> smoothed(1, path.front());
  for (std::size_t at = 0; at + 1 < path.size();) {
    std::size_t last = path.size() - 1;
    while (last > at + 1 && !canSee(map, path[at], path[last])) last--;
    smoothed.push_back(path[last]);
    at = last;
  }
  return smoothed;
}

// function: void CRobot::drawMap(
void CRobot::drawMap(CCMorse::GridMapLayer& layer, const Map& map) const {
  for (int row = 0; row < map.height; row++) {
    for (int column = 0; column < map.width; column++) {
      if (map.isOccupied({column, row})) layer.SetCell(column, row, 1);
    }
  }
}

// function: void CRobot::drawPath(
void CRobot::drawPath(CCMorse::GridMapLayer& layer, const std::vector<Cell>& path) const {
  for (std::size_t i = 1; i < path.size(); i++) {
    layer.SetLine(path[i - 1].column, path[i - 1].row, path[i].column, path[i].row);
  }
}

// function: bool CRobot::decideSpeeds(
bool CRobot::decideSpeeds(const std::vector<Cell>& path) {
  forwardSpeed = 0.0;
  turnRate = 0.0;
  if (path.empty()) return false;
  const auto dx = [&] { return xOf(path[next]) - position->GetXPos(); };
  const auto dy = [&] { return yOf(path[next]) - position->GetYPos(); };
  while (std::hypot(dx(), dy()) < 0.03) {
    if (++next == path.size()) return true;
  }
  const double angle = std::remainder(std::atan2(dy(), dx()) - position->GetYaw(), 2.0 * PI);
  turnRate = 3.0 * angle;
  if (std::fabs(angle) < 0.2) forwardSpeed = 0.2;
  return false;
}
