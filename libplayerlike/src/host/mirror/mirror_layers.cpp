// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/mirror/mirror_layers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace playerlike {
namespace {

constexpr sim::Colour kUnexpected{0xe6, 0x19, 0x4b, 0xff};
constexpr sim::Colour kMissing{0x43, 0x63, 0xd8, 0xff};
constexpr double kGreatestDistance_m = 0.2;  // drawn in red, like longer ones

sim::Colour colour_of(double distance_m) {
  const double share = std::clamp(distance_m / kGreatestDistance_m, 0.0, 1.0);
  const auto channel = [](double value) { return static_cast<std::uint8_t>(std::lround(value)); };
  return {channel(230.0 * share), channel(170.0 * (1.0 - share)), 40, 160};
}

}  // namespace

MirrorLayers::MirrorLayers(sim::LayerStack& stack, const std::string& name, int owner,
                           bool has_ghost)
    : stack_(stack) {
  if (has_ghost) {
    distance_ = stack.add(sim::LayerKind::kColour,
                          {.name = name + " ghost distance", .colour = colour_of(1.0)}, owner);
  }
  scan_ = stack.add(sim::LayerKind::kColour,
                    {.name = name + " scan difference", .colour = kUnexpected}, owner);
}

MirrorLayers::Cell MirrorLayers::cell_at(const sim::Vec2& p_W) const {
  const sim::CanvasDescription canvas = stack_.description();
  // Places far outside would not fit an int; drawings there are clipped.
  const sim::Vec2 cells =
      ((p_W - canvas.origin) / canvas.cell_size_m).array().floor().max(-1e6).min(1e6);
  return {static_cast<int>(cells.x()), canvas.height - 1 - static_cast<int>(cells.y())};
}

void MirrorLayers::show_scan(const ScanDifference& difference, const sim::Pose& X_WL) {
  std::vector<sim::DrawOperation> drawings;
  drawings.reserve(difference.places.size() + 1);
  drawings.push_back({.kind = sim::DrawOperation::Kind::kFill,
                      .layer = scan_,
                      .value = sim::CellValue::of(sim::Colour{0, 0, 0, 0})});
  for (const ScanDifference::Place& place : difference.places) {
    const Cell cell = cell_at(X_WL * place.p_L);
    drawings.push_back({.kind = sim::DrawOperation::Kind::kPixel,
                        .layer = scan_,
                        .x0 = cell.column,
                        .y0 = cell.row,
                        .value = sim::CellValue::of(place.unexpected ? kUnexpected : kMissing)});
  }
  stack_.draw(drawings);
}

void MirrorLayers::add_distance(const sim::Vec2& p_WB, const sim::Vec2& p_WG) {
  if (!distance_) return;
  const Cell from = cell_at(p_WB);
  const Cell to = cell_at(p_WG);
  const sim::DrawOperation line{.kind = sim::DrawOperation::Kind::kLine,
                                .layer = *distance_,
                                .x0 = from.column,
                                .y0 = from.row,
                                .x1 = to.column,
                                .y1 = to.row,
                                .value = sim::CellValue::of(colour_of((p_WB - p_WG).norm()))};
  stack_.draw({&line, 1});
}

}  // namespace playerlike
