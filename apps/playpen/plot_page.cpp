// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "plot_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

#include "sim/core/number_text.h"
#include "sim/simulation/simulation.h"
#include "sim/world/robot_model.h"

namespace playpen {
namespace {

using sim::Colour;
using sim::Vec2;
using sim::render::Drawing;
using Align = Drawing::Align;

constexpr int kWidth = 1200;
constexpr int kHeight = 780;
constexpr double kLeft = 62.0;    // left edge of the panels [pixels]
constexpr double kRight = 640.0;  // right edge of the panels [pixels]
constexpr double kTop = 92.0;
constexpr double kBottom = 734.0;
constexpr double kTitleGap = 30.0;  // space for the title above each panel
constexpr int kSceneSide = 530;
constexpr double kSceneLeft = 662.0;
constexpr double kText = 10.0;  // height of a capital letter [pixels]
constexpr double kSmallText = 8.6;
constexpr Colour kInk{0x35, 0x38, 0x3d, 0xff};
constexpr Colour kFaintInk{0x6d, 0x6f, 0x72, 0xff};
constexpr Colour kGrid{0xe4, 0xe4, 0xe2, 0xff};
constexpr Colour kFrame{0xb4, 0xb6, 0xb8, 0xff};
constexpr Colour kRed{0xe0, 0x1e, 0x37, 0xff};
constexpr std::size_t kMostEntries = 8;  // maximum number of entries in the legend

// A curve in the charts: one robot of one run.
struct Series {
  const Track* track;
  std::size_t run;
  Colour colour;
  std::string name;
};

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

double difference(Colour a, Colour b) {
  const auto square = [](int x) { return static_cast<double>(x * x); };
  return std::sqrt(square(a.r - b.r) + square(a.g - b.g) + square(a.b - b.b));
}

// Robots keep the colours of their world if these colours are distinguishable.
std::vector<Series> series_of(const std::vector<RunData>& runs) {
  constexpr double kFarEnough = 70.0;
  std::vector<Series> all;
  std::size_t next = 0;
  const auto is_free = [&all](Colour colour) {
    return std::none_of(all.begin(), all.end(), [&](const Series& series) {
      return difference(series.colour, colour) < kFarEnough;
    });
  };
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (const Track& track : runs[r].tracks) {
      std::optional<Colour> colour;
      if (runs[r].world) {
        for (const sim::RobotDescription& robot : runs[r].world->robots) {
          if (robot.name == track.robot) colour = robot.colour;
        }
      }
      constexpr std::size_t kColours = 20;
      if (!colour || !is_free(*colour)) {
        colour = sim::render::distinct_colour(next);
        while (next < kColours && !is_free(*colour)) {
          colour = sim::render::distinct_colour(++next);
        }
        ++next;
      }
      std::string name = track.robot;
      if (runs.size() > 1) {
        const std::filesystem::path folder(runs[r].folder);
        const std::filesystem::path last =
            folder.has_filename() ? folder.filename() : folder.parent_path().filename();
        name = last.string() + ": " + name;
      }
      all.push_back({&track, r, *colour, std::move(name)});
    }
  }
  return all;
}

std::string tick_text(double value) {
  return sim::rounded_text(std::abs(value) < 1e-12 ? 0.0 : value, 6);
}

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
    for (const double time_s : ticks(0.0, end_s_, 8)) {
      page_.add_line({{x(time_s), top_}, {x(time_s), bottom_}}, kGrid, 1.0);
      if (with_times) {
        page_.add_text(tick_text(time_s), {x(time_s), bottom_ + 18.0}, kSmallText, kFaintInk,
                       Align::kMiddle);
      }
    }
    for (const double value : ticks(low_, high_, 5)) {
      const bool is_zero = std::abs(value) < 1e-12 && low_ < 0.0;
      page_.add_line({{kLeft, y(value)}, {kRight, y(value)}}, is_zero ? kFrame : kGrid, 1.0);
      page_.add_text(tick_text(value), {kLeft - 7.0, y(value) + 0.5 * kSmallText}, kSmallText,
                     kFaintInk, Align::kRight);
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

  Drawing& page_;
  const Panel& panel_;
  double top_;
  double bottom_;
  double end_s_;
  double low_ = 0.0;
  double high_ = 1.0;
};

// Draws the scene of the first run with the trajectories of all runs.
sim::SceneSnapshot scene_of(const std::vector<RunData>& runs, const std::vector<Series>& all) {
  sim::SceneSnapshot scene;
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high = -low;
  for (const Series& series : all) {
    const RunData& run = runs[series.run];
    sim::RobotSnapshot robot;
    robot.name = series.name;
    robot.colour = series.colour;
    robot.X_WB = series.track->X_WB.back();
    const sim::RobotModel* model = &sim::default_robot_model();
    if (run.world) {
      for (const sim::RobotDescription& described : run.world->robots) {
        if (described.name != series.track->robot) continue;
        if (const auto* own = sim::find_robot_model(*run.world, described.model)) model = own;
      }
    }
    robot.footprint = model->footprint;
    robot.parts = model->parts;
    for (const sim::Superstructure& part : model->superstructures) {
      robot.superstructures.push_back(part.outline);
    }
    for (const sim::Pose& X_WB : series.track->X_WB) {
      robot.trail.push_back(X_WB.position());
      low = low.cwiseMin(X_WB.position());
      high = high.cwiseMax(X_WB.position());
    }
    scene.robots.push_back(std::move(robot));
  }
  if (runs.front().world) {
    scene.arena = runs.front().world->arena;
  } else {
    const double room_m = 0.1 * std::max((high - low).maxCoeff(), 1.0);
    scene.arena.origin = low - Vec2::Constant(room_m);
    scene.arena.size = high - low + Vec2::Constant(2.0 * room_m);
    scene.arena.border = false;
  }
  int first = 0;  // index of the robot in its run
  for (const RunData& run : runs) {
    for (sim::CollisionMark mark : run.collisions) {
      mark.robot += first;
      scene.collisions.push_back(mark);
    }
    for (sim::GoalMark mark : run.goals) {
      mark.robot += first;
      scene.goals.push_back(mark);
    }
    first += static_cast<int>(run.tracks.size());
  }
  return scene;
}

void draw_legend(Drawing& page, const std::vector<Series>& all) {
  double x = kLeft;
  constexpr double kY = 54.0;
  const std::size_t count = std::min(all.size(), kMostEntries);
  for (std::size_t i = 0; i < count; ++i) {
    const Series& series = all[i];
    page.add_line({{x, kY - 4.0}, {x + 30.0, kY - 4.0}}, series.colour, 3.0, series.run > 0);
    page.add_text(series.name, {x + 38.0, kY}, kText, kInk);
    x += 38.0 + Drawing::text_width_px(series.name, kText) + 26.0;
    if (x > kWidth - 150.0) break;
  }
  if (all.size() > count) {
    page.add_text("and " + std::to_string(all.size() - count) + " more", {x, kY}, kText, kFaintInk);
  }
}

void draw_scene(Drawing& page, const std::vector<RunData>& runs, const std::vector<Series>& all) {
  const sim::SceneSnapshot scene = scene_of(runs, all);
  sim::render::RenderOptions options;
  options.size_px = kSceneSide;
  options.legend = false;
  options.names = all.size() <= kMostEntries && runs.size() == 1;
  sim::render::Image image = sim::render::draw_scene(scene, options);
  const double left = kSceneLeft + 0.5 * (kSceneSide - image.width);
  const double bottom = kTop + image.height;
  page.add_text("trajectories", {left + 4.0, kTop - 9.0}, kText, kInk);
  page.add_picture(std::move(image), {left, kTop});
  const double key = bottom + 24.0;
  if (!scene.collisions.empty()) {
    for (const double side : {-1.0, 1.0}) {
      page.add_line({{left + 6.0, key - 4.0 - 5.0 * side}, {left + 16.0, key - 4.0 + 5.0 * side}},
                    kRed, 2.4);
    }
    page.add_text(std::to_string(scene.collisions.size()) +
                      (scene.collisions.size() == 1 ? " collision" : " collisions"),
                  {left + 26.0, key}, kText, kInk);
  }
  if (!scene.goals.empty()) {
    const auto reached = std::count_if(scene.goals.begin(), scene.goals.end(),
                                       [](const sim::GoalMark& goal) { return goal.reached; });
    page.add_text(std::to_string(reached) + " of " + std::to_string(scene.goals.size()) +
                      (scene.goals.size() == 1 ? " goal reached" : " goals reached"),
                  {left + 170.0, key}, kText, kInk);
  }
}

}  // namespace

std::vector<double> ticks(double least, double most, int count) {
  const double rough = (most - least) / std::max(count, 1);
  if (!(rough > 0.0) || !std::isfinite(rough)) return {};
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * power >= rough * (1.0 - 1e-9)) step = factor * power;
  }
  std::vector<double> all;
  const double first = std::ceil(least / step - 1e-9);
  for (double i = first; i * step <= most + 1e-9 * step; i += 1.0) all.push_back(i * step);
  return all;
}

Drawing plot_page(const std::vector<RunData>& runs) {
  Drawing page(kWidth, kHeight);
  const std::vector<Series> all = series_of(runs);
  double end_s = 0.0;
  for (const Series& series : all) end_s = std::max(end_s, series.track->time_s.back());
  if (!(end_s > 0.0)) end_s = 1.0;
  std::string title = runs.front().world_name;
  for (const RunData& run : runs) {
    if (run.world_name != runs.front().world_name) title += ", " + run.world_name;
  }
  page.add_text(title, {kLeft, 30.0}, 13.0, kInk);
  draw_legend(page, all);
  const double height = (kBottom - kTop - kTitleGap * (kPanels.size() - 1)) / kPanels.size();
  for (std::size_t i = 0; i < kPanels.size(); ++i) {
    const double top = kTop + static_cast<double>(i) * (height + kTitleGap);
    Chart(page, kPanels.at(i), top, top + height, end_s).draw(all, i + 1 == kPanels.size());
  }
  page.add_text("time [s]", {kRight, kBottom + 36.0}, kText, kInk, Align::kRight);
  draw_scene(page, runs, all);
  return page;
}

}  // namespace playpen
