// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "course/likeness_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "sim/core/number_text.h"
#include "sim/world/outline.h"

namespace playpen::course {
namespace {

using sim::Colour;
using sim::Vec2;
using sim::render::Drawing;

constexpr int kPageWidth = 900;
constexpr double kMargin = 30.0;     // around the arena [pixels]
constexpr double kHeading = 96.0;    // space above the arena [pixels]
constexpr double kCapHeight = 10.0;  // of letters [pixels]
constexpr Colour kTextColour = sim::render::page_palette::kInk;
constexpr Colour kFloor{0xf7, 0xf7, 0xf5, 0xff};
constexpr Colour kSolid{0xb9, 0xbb, 0xbe, 0xff};
constexpr Colour kWide{0x8c, 0xbc, 0xf0, 0xff};
constexpr Colour kThin{0x8b, 0x12, 0x12, 0xff};
constexpr Colour kWideAfter{0xdf, 0xec, 0xfa, 0xff};
constexpr Colour kThinAfter{0xec, 0xd2, 0xd2, 0xff};
constexpr double kWide_px = 7.0;
constexpr double kThin_px = 1.8;

// From W to the page.
class Scale {
 public:
  explicit Scale(const sim::ArenaDescription& arena)
      : low_(arena.origin),
        px_per_m_(std::min((kPageWidth - 2.0 * kMargin) / arena.size.x(),
                           kMostHeight_px / arena.size.y())),
        height_px_(arena.size.y() * px_per_m_),
        left_px_(0.5 * (kPageWidth - arena.size.x() * px_per_m_)) {}

  [[nodiscard]] Vec2 operator()(const Vec2& p_W) const {
    const Vec2 p = (p_W - low_) * px_per_m_;
    return {left_px_ + p.x(), kHeading + height_px_ - p.y()};
  }
  [[nodiscard]] std::vector<Vec2> operator()(const std::vector<Vec2>& places) const {
    std::vector<Vec2> points;
    points.reserve(places.size());
    for (const Vec2& p_W : places) points.push_back((*this)(p_W));
    return points;
  }
  [[nodiscard]] int page_height() const {
    return std::clamp(static_cast<int>(kHeading + height_px_ + kMargin), 64, 8192);
  }

 private:
  static constexpr double kMostHeight_px = 1400.0;
  Vec2 low_;
  double px_per_m_;
  double height_px_;
  double left_px_;
};

void draw_arena(Drawing& page, const Scale& scale, const sim::ArenaDescription& arena) {
  constexpr double kRoundness_m = 0.002;  // of round obstacles: below a pixel
  const Vec2 low = arena.origin;
  const Vec2 high = arena.origin + arena.size;
  std::vector<Vec2> floor = scale({low, {high.x(), low.y()}, high, {low.x(), high.y()}});
  page.add_area(floor, kFloor);
  for (const sim::WallLoop& loop : arena.walls) {
    std::vector<Vec2> line = scale(loop.vertices);
    if (!line.empty()) line.push_back(line.front());
    page.add_line(std::move(line), kSolid, 2.0);
  }
  for (const sim::ObstacleDescription& box : arena.obstacles) {
    if (!box.solid || box.state != sim::ObstacleState::kExtended) continue;
    page.add_area(scale(sim::outline_of(box, kRoundness_m)), kSolid);
  }
  for (const sim::ObstacleDescription& box : arena.dock_separators) {
    page.add_area(scale(sim::outline_of(box, kRoundness_m)), kSolid);
  }
  floor.push_back(floor.front());
  page.add_line(std::move(floor), kTextColour, arena.border ? 2.5 : 1.0);
}

// The part of a drive from a time to another one, on the page.
std::vector<Vec2> part_of(const Drive& drive, const Scale& scale, double from_s, double until_s) {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < drive.time_s.size(); ++i) {
    if (drive.time_s[i] >= from_s && drive.time_s[i] <= until_s) {
      points.push_back(scale(drive.X_WB[i].position()));
    }
  }
  return points;
}

void draw_part(Drawing& page, std::vector<Vec2> points, Colour colour, double width_px) {
  if (points.size() > 1) page.add_line(std::move(points), colour, width_px);
}

void draw_cross(Drawing& page, const Vec2& place) {
  for (const double side : {-1.0, 1.0}) {
    const Vec2 arm(6.0, 6.0 * side);
    page.add_line({place - arm, place + arm}, kTextColour, 2.6);
  }
}

void draw_heading(Drawing& page, const PairPicture& pair) {
  const auto draw_name = [&page](const std::string& name, double y, Colour colour, double width) {
    page.add_line({{kMargin, y - 4.0}, {kMargin + 44.0, y - 4.0}}, colour, width);
    page.add_text(name, {kMargin + 56.0, y}, kCapHeight, kTextColour);
  };
  page.add_text(pair.run, {kMargin, 28.0}, 13.0, kTextColour);
  draw_name(pair.first, 52.0, kWide, kWide_px);
  draw_name(pair.second, 74.0, kThin, kThin_px);
  const std::string end =
      pair.parted_s ? "part after " + sim::rounded_text(*pair.parted_s, 3) + " s (crosses)"
                    : "never part";
  page.add_text(end, {kPageWidth - kMargin, 28.0}, kCapHeight, kTextColour, Drawing::Align::kRight);
}

}  // namespace

Drawing pair_picture(const PairPicture& pair) {
  constexpr double kEver = std::numeric_limits<double>::infinity();
  const Scale scale(pair.arena);
  Drawing page(kPageWidth, scale.page_height());
  draw_heading(page, pair);
  draw_arena(page, scale, pair.arena);
  const double until_s = pair.parted_s.value_or(kEver);
  if (pair.parted_s) {
    draw_part(page, part_of(pair.first_drive, scale, until_s, kEver), kWideAfter, kWide_px);
    draw_part(page, part_of(pair.second_drive, scale, until_s, kEver), kThinAfter, kThin_px);
  }
  draw_part(page, part_of(pair.first_drive, scale, 0.0, until_s), kWide, kWide_px);
  draw_part(page, part_of(pair.second_drive, scale, 0.0, until_s), kThin, kThin_px);
  if (pair.parted_s) {
    for (const Drive* const drive : {&pair.first_drive, &pair.second_drive}) {
      const std::vector<Vec2> until = part_of(*drive, scale, 0.0, until_s);
      if (!until.empty()) draw_cross(page, until.back());
    }
  }
  return page;
}

}  // namespace playpen::course
