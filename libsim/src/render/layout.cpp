// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "render/layout.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "render/text_outline.h"
#include "sim/core/math.h"

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
  const double power = math::pow(10.0, std::floor(math::log10(limit)));
  // The tolerance allows for 0.999...9, which logarithm and power may give for a power of ten.
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= limit * (1.0 + 1e-9)) return factor * power;
  }
  return power;
}

std::string shortened(const std::string& text, const TextStyle& style, double width_px) {
  constexpr std::size_t kMaxLength = 64;
  std::string shown = text;
  if (text.size() > kMaxLength) {
    shown.resize(kMaxLength - 3);
    drop_cut_character(shown);
    shown += "...";
  }
  while (Painter::text_width_px(shown, style) > width_px) {
    if (shown.size() <= 8) return "";  // a shorter text would not be useful
    const std::size_t kept = shown.size() - (shown.ends_with("...") ? 4 : 3);
    shown.resize(kept);
    drop_cut_character(shown);
    while (shown.ends_with(' ')) shown.pop_back();
    shown += "...";
  }
  return shown;
}

Layout::Layout(const ArenaDescription& arena, const RenderOptions& options,
               const std::optional<ScenePart>& part)
    : cropped(part.has_value()), view_only(part.has_value()) {
  const bool exact = options.width_px > 0 && options.height_px > 0;
  // Lines and texts of a long narrow picture have the sizes of a picture of half the length.
  const int size = exact ? std::min(std::max(options.width_px, options.height_px),
                                    2 * std::min(options.width_px, options.height_px))
                         : options.size_px;
  unit_px = size / 1000.0;
  text = size >= kLeastSizeWithTextPx;
  const bool legend = options.legend && text;
  const double margin = std::round(38.0 * unit_px);
  const double footer = legend ? std::round(74.0 * unit_px) : margin;
  view_low = part ? part->low : arena.origin;
  view_size = (part ? part->size : arena.size).cwiseMax(1e-3);
  const double room_x = (exact ? options.width_px : size) - 2.0 * margin;
  const double room_y = (exact ? options.height_px : size) - margin - footer;
  pixels_per_m = std::min(room_x / view_size.x(), room_y / view_size.y());
  if (part && part->fills_room && exact) {
    const Vec2 middle = view_low + 0.5 * view_size;
    view_size = Vec2(room_x, room_y) / pixels_per_m;
    view_low = middle - 0.5 * view_size;
  }
  const Vec2 size_px = view_size * pixels_per_m;
  // A narrow arena is centred in a picture that is wide enough for the footer. A flat arena gets a
  // picture of a minimum height.
  const double least_width = legend ? std::min<double>(size, 480.0 * unit_px) : 0.0;
  width = exact ? options.width_px
                : static_cast<int>(std::lround(std::max(size_px.x() + 2.0 * margin, least_width)));
  height = exact ? options.height_px : static_cast<int>(std::lround(size_px.y() + margin + footer));
  margin_px = margin;
  footer_px = footer;
  view.left = std::round((width - size_px.x()) / 2.0);
  view.top = exact ? margin + std::floor(0.5 * (room_y - size_px.y())) : margin;
  view.right = view.left + size_px.x();
  view.bottom = view.top + size_px.y();
  origin = arena.origin;
  floor = view;
  if (part) {
    const Vec2 from_low = (origin - view_low) * pixels_per_m;
    const Vec2 floor_px = arena.size.cwiseMax(1e-3) * pixels_per_m;
    floor.left = view.left + from_low.x();
    floor.bottom = view.bottom - from_low.y();
    floor.right = floor.left + floor_px.x();
    floor.top = floor.bottom - floor_px.y();
  }
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
  const auto within = [](double value, int least, int most) {
    return static_cast<int>(std::clamp<double>(value, least, std::max(least, most)));
  };
  PixelRect part;
  part.left = within(std::floor(std::max(floor.left, view.left)), 0, width - 1);
  part.top = within(std::floor(std::max(floor.top, view.top)), 0, height - 1);
  part.right = within(std::ceil(std::min(floor.right, view.right)), part.left + 1, width);
  part.bottom = within(std::ceil(std::min(floor.bottom, view.bottom)), part.top + 1, height);
  return part;
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
