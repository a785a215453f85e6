// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "render/layout.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace sim::render {
namespace {

constexpr int kLeastSizeWithTextPx = 200;

std::uint8_t mix_channel(std::uint8_t a, std::uint8_t b, double share) {
  return static_cast<std::uint8_t>(std::lround(a + (b - a) * share));
}

}  // namespace

Colour mix(Colour a, Colour b, double share) {
  return {mix_channel(a.r, b.r, share), mix_channel(a.g, b.g, share), mix_channel(a.b, b.b, share)};
}

double luma(Colour colour) {
  return (0.299 * colour.r + 0.587 * colour.g + 0.114 * colour.b) / 255.0;
}

double round_below(double limit) {
  const double power = std::pow(10.0, std::floor(std::log10(limit)));
  // The tolerance allows for 0.999...9, which logarithm and power may give for a power of ten.
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= limit * (1.0 + 1e-9)) return factor * power;
  }
  return power;
}

std::string shortened(const std::string& text, const TextStyle& style, double width_px) {
  constexpr std::size_t kMaxLength = 64;
  std::string shown = text.size() > kMaxLength ? text.substr(0, kMaxLength - 3) + "..." : text;
  while (Painter::text_width_px(shown, style) > width_px) {
    if (shown.size() <= 8) return "";  // a shorter text would not be useful
    const std::size_t kept = shown.size() - (shown.ends_with("...") ? 4 : 3);
    shown.resize(kept);
    while (shown.ends_with(' ')) shown.pop_back();
    shown += "...";
  }
  return shown;
}

Layout::Layout(const ArenaDescription& arena, const RenderOptions& options) {
  const int size = options.size_px;
  unit_px = size / 1000.0;
  text = size >= kLeastSizeWithTextPx;
  const bool legend = options.legend && text;
  const double margin = std::round(38.0 * unit_px);
  const double footer = legend ? std::round(74.0 * unit_px) : margin;
  const Vec2 size_m = arena.size.cwiseMax(1e-3);
  const double room_x = size - 2.0 * margin;
  const double room_y = size - margin - footer;
  pixels_per_m = std::min(room_x / size_m.x(), room_y / size_m.y());
  const Vec2 size_px = size_m * pixels_per_m;
  // A narrow arena is centred in a picture that is wide enough for the footer. A flat arena gets a
  // picture of a minimum height.
  const double least_width = legend ? std::min<double>(size, 480.0 * unit_px) : 0.0;
  width = static_cast<int>(std::lround(std::max(size_px.x() + 2.0 * margin, least_width)));
  height = static_cast<int>(std::lround(size_px.y() + margin + footer));
  margin_px = margin;
  footer_px = footer;
  floor.left = std::round((width - size_px.x()) / 2.0);
  floor.top = margin;
  floor.right = floor.left + size_px.x();
  floor.bottom = floor.top + size_px.y();
  origin = arena.origin;
  if (arena.border) {
    border_px = std::clamp(0.035 * pixels_per_m, 6.0 * unit_px, 0.5 * margin_px);
  }
}

std::vector<Vec2> Layout::operator()(const std::vector<Vec2>& points_in_world) const {
  std::vector<Vec2> points;
  points.reserve(points_in_world.size());
  for (const Vec2& point : points_in_world) points.push_back((*this)(point));
  return points;
}

PixelRect Layout::floor_pixels() const {
  return {static_cast<int>(std::floor(floor.left)), static_cast<int>(std::floor(floor.top)),
          std::min(static_cast<int>(std::ceil(floor.right)), width),
          std::min(static_cast<int>(std::ceil(floor.bottom)), height)};
}

TextStyle Layout::text_style(double cap_height, Colour colour) const {
  TextStyle style;
  style.cap_height_px = std::max(cap_height * unit_px, 7.0);
  style.colour = colour;
  return style;
}

std::vector<Vec2> rectangle_corners(const Rectangle& rectangle, double grown_px) {
  return {{rectangle.left - grown_px, rectangle.top - grown_px},
          {rectangle.right + grown_px, rectangle.top - grown_px},
          {rectangle.right + grown_px, rectangle.bottom + grown_px},
          {rectangle.left - grown_px, rectangle.bottom + grown_px}};
}

}  // namespace sim::render
