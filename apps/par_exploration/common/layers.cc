// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "layers.h"

#include <cmath>

namespace {

using CCMorse::GridMapLayer;

GridMapLayer& makeLayer(CCMorse::WindowProxy& window, const char* name, GridMapLayer::Kind kind,
                        int priority, const char* colour, double transparency) {
  GridMapLayer& layer = window.CreateLayer(name, kind, priority);
  layer.SetColour(colour);
  layer.SetTransparency(transparency);
  return layer;
}

par::GridFrame frameOf(const CCMorse::WindowProxy& window) {
  par::GridFrame frame;
  frame.width = window.GetWidth();
  frame.height = window.GetHeight();
  frame.cell_size_m = window.GetCellSize();
  // The cell of the world's origin gives the position of the grid's corner.
  frame.origin.x = -window.GetX(0.0) * frame.cell_size_m;
  frame.origin.y = -(frame.height - 1 - window.GetY(0.0)) * frame.cell_size_m;
  return frame;
}

}  // namespace

// Surfaces lie below thin things: frontiers and the scan cover walls, and no surface covers a line.
CLayers::CLayers(CCMorse::PlayerClient* client)
    : window(CCMorse::WindowProxy::GetInstance(client, 172, 186)),
      occupancy(makeLayer(window, "occupancy", GridMapLayer::GREY, 1, "#000000", 0.0)),
      inflated(makeLayer(window, "inflated", GridMapLayer::BINARY, 2, "#2F6FDE", 0.55)),
      frontiers(makeLayer(window, "frontiers", GridMapLayer::BINARY, 3, "#9B30C8", 0.0)),
      scan(makeLayer(window, "scan", GridMapLayer::BINARY, 4, "#18B818", 0.0)),
      trail(makeLayer(window, "trail", GridMapLayer::BINARY, 5, "#E02020", 0.0)),
      path(makeLayer(window, "path", GridMapLayer::BINARY, 6, "#FF8C00", 0.0)),
      frame(frameOf(window)) {}

CLayers::~CLayers() { delete &window; }

void CLayers::drawMap(const par::OccupancyGrid& map) {
  occupancy.SetCells(map.probabilities().values());
}

void CLayers::drawScan(const Observation& seen) {
  scan.Clear();
  const double c = std::cos(seen.robot.yaw);
  const double s = std::sin(seen.robot.yaw);
  for (const par::Point& p : seen.echoes) {
    scan.SetPixelMetres(seen.robot.x + c * p.x - s * p.y, seen.robot.y + s * p.x + c * p.y);
  }
}

void CLayers::drawTrail(const par::Pose& robot) {
  if (!trailBegun) last = robot;
  trailBegun = true;
  trail.SetLineMetres(last.x, last.y, robot.x, robot.y);
  last = robot;
}

void CLayers::drawInflated(const par::Mask& cells) { inflated.SetCells(cells.values()); }

void CLayers::drawFrontiers(const std::vector<par::Frontier>& all) {
  frontiers.Clear();
  for (const par::Frontier& frontier : all) {
    for (const par::Cell& cell : frontier.cells) frontiers.SetPixel(cell.column, cell.row);
  }
}

void CLayers::drawPath(const std::vector<par::Cell>& turns) {
  path.Clear();
  for (std::size_t i = 1; i < turns.size(); i++) {
    path.SetLine(turns[i - 1].column, turns[i - 1].row, turns[i].column, turns[i].row);
  }
}
