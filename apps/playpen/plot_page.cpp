// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "plot_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <set>

#include "plot_parts.h"

namespace playpen {
namespace {

using sim::Vec2;
using sim::render::Drawing;
using sim::render::Tick;
using sim::render::ticks;
using sim::render::page_palette::kFaintInk;
using sim::render::page_palette::kFrame;
using sim::render::page_palette::kGrid;
using sim::render::page_palette::kInk;
using Align = Drawing::Align;

using page::kBottom;
using page::kLeft;
using page::kMostEntries;
using page::kPageHeight;
using page::kPageWidth;
using page::kRight;
using page::kSceneLeft;
using page::kScenesWidth;
using page::kSmallText;
using page::kText;
using page::kTitleGap;
using page::kTop;

constexpr double kSceneGap = 14.0;   // between scenes side by side
constexpr double kSceneFoot = 64.0;  // below a scene, for its key and the next scene's title

using Values = std::vector<double> Track::*;
struct Panel {
  const char* title;
  Values values;
  bool from_zero;
};
constexpr std::array<Panel, 4> kPanels = {{{"speed [m/s]", &Track::v_mps, true},
                                           {"turn rate [rad/s]", &Track::omega_radps, true},
                                           {"clearance [m]", &Track::clearance_m, true},
                                           {"path [m]", &Track::path_m, true}}};

// A chart of one quantity over time.
class Chart {
 public:
  Chart(Drawing& page, const Panel& panel, double top, double bottom, double end_s)
      : page_(page), panel_(panel), top_(top), bottom_(bottom), end_s_(end_s) {}

  void draw(const std::vector<Series>& all, bool with_times) {
    find_range(all);
    page_.add_text(panel_.title, {kLeft, top_ - 9.0}, kText, kInk);
    draw_grid(with_times);
    bool any = false;
    for (const Series& series : all) any = draw_line(series) || any;
    for (const Series& series : all) draw_marks(series);
    if (!any) {
      page_.add_text("not known: the world's file was not found",
                     {0.5 * (kLeft + kRight), 0.5 * (top_ + bottom_)}, kText, kFaintInk,
                     Align::kMiddle);
    }
  }

 private:
  void find_range(const std::vector<Series>& all) {
    low_ = panel_.from_zero ? 0.0 : std::numeric_limits<double>::infinity();
    high_ = low_;
    for (const Series& series : all) {
      for (const double value : series.track->*panel_.values) {
        low_ = std::min(low_, value);
        high_ = std::max(high_, value);
      }
    }
    if (!(high_ - low_ > 1e-9)) high_ = low_ + 1.0;
    const double room = 0.06 * (high_ - low_);
    high_ += room;
    if (low_ < 0.0) low_ -= room;
  }

  [[nodiscard]] double x(double time_s) const { return kLeft + (kRight - kLeft) * time_s / end_s_; }
  [[nodiscard]] double y(double value) const {
    return bottom_ - (bottom_ - top_) * (value - low_) / (high_ - low_);
  }

  void draw_grid(bool with_times) {
    for (const Tick& tick : ticks(0.0, end_s_, 8)) {
      page_.add_line({{x(tick.value), top_}, {x(tick.value), bottom_}}, kGrid, 1.0);
      if (with_times) {
        page_.add_text(tick.text, {x(tick.value), bottom_ + 18.0}, kSmallText, kFaintInk,
                       Align::kMiddle);
      }
    }
    for (const Tick& tick : ticks(low_, high_, 5)) {
      const bool is_zero = tick.value == 0.0 && low_ < 0.0;
      const double height = y(tick.value);
      page_.add_line({{kLeft, height}, {kRight, height}}, is_zero ? kFrame : kGrid, 1.0);
      page_.add_text(tick.text, {kLeft - 7.0, height + 0.5 * kSmallText}, kSmallText, kFaintInk,
                     Align::kRight);
    }
    page_.add_line({{kLeft, top_}, {kLeft, bottom_}, {kRight, bottom_}}, kFrame, 1.2);
  }

  // @return whether the chart has data.
  bool draw_line(const Series& series) {
    const std::vector<double>& values = series.track->*panel_.values;
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Vec2 point(x(series.track->time_s[i]), y(values[i]));
      // If one column of pixels contains many values, the curve needs only the first and last
      // value, the minimum and the maximum.
      if (points.size() > 2 && point.x() - points[points.size() - 2].x() < 0.25 &&
          (point.y() - points.back().y()) * (points.back().y() - points[points.size() - 2].y()) >=
              0.0) {
        points.back() = point;
      } else {
        points.push_back(point);
      }
    }
    if (points.size() > 1) page_.add_line(std::move(points), series.colour, 1.7, series.run > 0);
    return !values.empty();
  }

  // Marks collisions and reached goals on a curve.
  void draw_marks(const Series& series) {
    constexpr double kLeastGap = 3.0;  // [pixels]; marks that are nearer look like one
    double last = -std::numeric_limits<double>::infinity();
    for (const sim::CollisionMark& mark : series.data->collisions) {
      if (mark.robot != series.robot) continue;
      const std::optional<Vec2> place = place_at(series, mark.time_s);
      if (!place || place->x() - last < kLeastGap) continue;
      last = place->x();
      add_cross(page_, *place);
    }
    for (const Moment& moment : series.data->reached) {
      if (moment.robot != series.robot) continue;
      if (const std::optional<Vec2> place = place_at(series, moment.time_s)) {
        add_diamond(page_, *place);
      }
    }
  }

  // Where a curve is at a time; none if it has no values.
  [[nodiscard]] std::optional<Vec2> place_at(const Series& series, double time_s) const {
    const std::vector<double>& values = series.track->*panel_.values;
    if (values.empty()) return std::nullopt;
    const std::vector<double>& times = series.track->time_s;
    const auto after = std::lower_bound(times.begin(), times.end(), time_s);
    const auto row = std::min(static_cast<std::size_t>(after - times.begin()), values.size() - 1);
    return Vec2(x(time_s), y(values[row]));
  }

  Drawing& page_;
  const Panel& panel_;
  double top_;
  double bottom_;
  double end_s_;
  double low_ = 0.0;
  double high_ = 1.0;
};

// The runs of one world; their indices.
using Group = std::vector<std::size_t>;

// Runs of the same world share a scene.
std::vector<Group> groups_of(const std::vector<RunData>& runs) {
  std::vector<Group> groups;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& known) {
      const RunData& first = runs[known.front()];
      return first.world_name == runs[r].world_name &&
             first.world.has_value() == runs[r].world.has_value() &&
             (!first.world || first.world->file == runs[r].world->file);
    });
    if (group == groups.end()) {
      groups.push_back({r});
    } else {
      group->push_back(r);
    }
  }
  return groups;
}

// The places of scenes: one large one, two above each other, or rows of two.
class SceneGrid {
 public:
  explicit SceneGrid(std::size_t scenes) : columns_(scenes > 2 ? 2 : 1), scenes_(scenes) {
    side_ = scenes == 1   ? kScenesWidth
            : scenes == 2 ? 0.5 * (kBottom - kTop - kSceneFoot)
                          : 0.5 * (kScenesWidth - kSceneGap);
  }
  [[nodiscard]] double side() const noexcept { return side_; }
  [[nodiscard]] Vec2 corner(std::size_t scene) const {
    const auto column = static_cast<double>(scene % columns_);
    const std::size_t rows_above = scene / columns_;
    const auto row = static_cast<double>(rows_above);
    const double width = static_cast<double>(columns_) * (side_ + kSceneGap) - kSceneGap;
    return {kSceneLeft + 0.5 * (kScenesWidth - width) + column * (side_ + kSceneGap),
            kTop + row * (side_ + kSceneFoot)};
  }
  /// Height of a page on which all scenes fit [pixels].
  [[nodiscard]] int page_height() const {
    const double end = corner(scenes_ - 1).y() + side_ + kSceneFoot - 18.0;
    return std::max(kPageHeight, static_cast<int>(end));
  }

 private:
  std::size_t columns_;
  std::size_t scenes_;
  double side_;
};

void draw_scenes(Drawing& page, const SceneGrid& grid, const std::vector<Group>& groups,
                 const std::vector<RunData>& runs, const std::vector<Series>& all) {
  const bool with_names = all.size() <= kMostEntries && runs.size() == 1;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const std::string title =
        groups.size() == 1 ? "trajectories" : runs[groups[g].front()].world_name;
    draw_scene(page, scene_of(runs, groups[g], all), title, with_names, grid.corner(g),
               grid.side());
  }
}

}  // namespace

Drawing plot_page(const std::vector<RunData>& runs) {
  constexpr std::size_t kMostScenes = 40;  // the page would become too high
  std::vector<Group> groups = groups_of(runs);
  if (groups.size() > kMostScenes) groups.resize(kMostScenes);
  const SceneGrid grid(groups.size());
  Drawing page(kPageWidth, grid.page_height());
  const std::vector<Series> all = series_of(runs);
  double end_s = 0.0;
  for (const Series& series : all) end_s = std::max(end_s, series.track->time_s.back());
  if (!(end_s > 0.0)) end_s = 1.0;
  std::string title;
  std::set<std::string> named;
  for (const RunData& run : runs) {
    if (named.insert(run.world_name).second) title += (title.empty() ? "" : ", ") + run.world_name;
  }
  page.add_text(title, {kLeft, 30.0}, 13.0, kInk);
  draw_legend(page, all);
  const double height = (kBottom - kTop - kTitleGap * (kPanels.size() - 1)) / kPanels.size();
  for (std::size_t i = 0; i < kPanels.size(); ++i) {
    const double top = kTop + static_cast<double>(i) * (height + kTitleGap);
    Chart(page, kPanels.at(i), top, top + height, end_s).draw(all, i + 1 == kPanels.size());
  }
  page.add_text("time [s]", {kRight, kBottom + 36.0}, kText, kInk, Align::kRight);
  draw_scenes(page, grid, groups, runs, all);
  return page;
}

}  // namespace playpen
