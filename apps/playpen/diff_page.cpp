// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "diff_page.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "diff/difference_text.h"
#include "grade/text.h"
#include "plot_parts.h"
#include "sim/core/math.h"
#include "sim/core/number_text.h"
#include "sim/core/pose.h"

namespace playpen {
namespace {

using diff::Parting;
using diff::RobotDifference;
using sim::render::page_palette::kFaintInk;
using sim::render::page_palette::kFrame;
using sim::render::page_palette::kGrid;
using sim::render::page_palette::kInk;
using Page = sim::render::Drawing;
using sim::Vec2;

constexpr double kDotRadius = 4.2;  // [pixels]
constexpr sim::Colour kPaper{0xff, 0xff, 0xff, 0xff};
constexpr sim::Colour kCurve{0x4b, 0x3f, 0x8c, 0xff};  // of the only robot
constexpr sim::Colour kLimit{0xb9, 0x6b, 0x1a, 0xff};  // of the limits at which runs part

// A filled circle.
void add_disc(Page& page, const Vec2& center, double radius, sim::Colour colour) {
  constexpr int kCorners = 20;
  std::vector<Vec2> corners;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    corners.push_back(center + radius * sim::unit_vector(angle));
  }
  page.add_area(std::move(corners), colour);
}

// The mark of a place or a time at which trajectories part.
void add_dot(Page& page, const Vec2& center, sim::Colour colour) {
  add_disc(page, center, kDotRadius + 1.6, kPaper);
  add_disc(page, center, kDotRadius, colour);
}

// A curve in a logarithmic chart.
struct LogCurve {
  const std::vector<double>* time_s;
  const std::vector<double>* values;
  const std::vector<Parting>* partings;
  sim::Colour colour;
};

// The axes of a logarithmic chart. Below the least decade is a strip for zero.
struct LogAxes {
  std::string title;
  double top = 0.0;
  double bottom = 0.0;
  double least = 0.01;  // value of the lower end, a power of ten
  double most = 1.0;    // value of the upper end
  double end_s = 1.0;
  std::vector<double> limits;

  static constexpr double kZeroStrip = 34.0;  // height [pixels]

  [[nodiscard]] double x(double time_s) const {
    return page::kLeft + (page::kRight - page::kLeft) * time_s / end_s;
  }
  [[nodiscard]] double y(double value) const {
    if (!(value > 0.0)) return bottom - 0.4 * kZeroStrip;
    const double share = sim::math::log10(value / least) / sim::math::log10(most / least);
    return bottom - kZeroStrip - (bottom - kZeroStrip - top) * std::clamp(share, 0.0, 1.0);
  }
};

// The next power of ten that is not less than the greatest value, at least `least_end`.
double upper_end(const std::vector<LogCurve>& curves, double least_end) {
  constexpr double kMostEnd = 1e9;  // more than any distance in an arena
  double greatest = 0.0;
  for (const LogCurve& curve : curves) {
    for (const double value : *curve.values) greatest = std::max(greatest, value);
  }
  double end = least_end;
  while (end < greatest && end < kMostEnd) end *= 10.0;
  return end;
}

// A line across a chart with a number beside it.
void draw_level(Page& page, double height, const std::string& text, sim::Colour line,
                sim::Colour ink, bool dashed) {
  page.add_line({{page::kLeft, height}, {page::kRight, height}}, line, 1.0, dashed);
  page.add_text(text, {page::kLeft - 7.0, height + 0.5 * page::kSmallText}, page::kSmallText, ink,
                Page::Align::kRight);
}

void draw_axes(Page& page, const LogAxes& axes, bool with_times) {
  page.add_text(axes.title, {page::kLeft, axes.top - 9.0}, page::kText, kInk);
  for (const sim::render::Tick& tick : sim::render::ticks(0.0, axes.end_s, 8)) {
    page.add_line({{axes.x(tick.value), axes.top}, {axes.x(tick.value), axes.bottom}}, kGrid, 1.0);
    if (!with_times) continue;
    page.add_text(tick.text, {axes.x(tick.value), axes.bottom + 18.0}, page::kSmallText, kFaintInk,
                  Page::Align::kMiddle);
  }
  constexpr double kRounding = 1.0001;  // of the repeated products
  for (double value = axes.least; value <= kRounding * axes.most; value *= 10.0) {
    const bool is_limit = std::any_of(
        axes.limits.begin(), axes.limits.end(),
        [value](double limit) { return std::abs(limit - value) < (kRounding - 1.0) * value; });
    draw_level(page, axes.y(value), sim::rounded_text(value, 8), is_limit ? kLimit : kGrid,
               is_limit ? kLimit : kFaintInk, is_limit);
  }
  draw_level(page, axes.y(0.0), "0", kGrid, kFaintInk, false);
  page.add_line({{page::kLeft, axes.top}, {page::kLeft, axes.bottom}, {page::kRight, axes.bottom}},
                kFrame, 1.2);
}

// Draws a curve. A pixel's column of many values has only its first, last, least and greatest.
void draw_curve(Page& page, const LogAxes& axes, const LogCurve& curve) {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < curve.values->size(); ++i) {
    const Vec2 point(axes.x((*curve.time_s)[i]), axes.y((*curve.values)[i]));
    if (points.size() > 2 && point.x() - points[points.size() - 2].x() < 0.25 &&
        (point.y() - points.back().y()) * (points.back().y() - points[points.size() - 2].y()) >=
            0.0) {
      points.back() = point;
    } else {
      points.push_back(point);
    }
  }
  if (points.size() > 1) page.add_line(std::move(points), curve.colour, 1.7);
}

void draw_dots(Page& page, const LogAxes& axes, const LogCurve& curve) {
  for (const Parting& parting : *curve.partings) {
    const auto row = std::lower_bound(curve.time_s->begin(), curve.time_s->end(), parting.time_s) -
                     curve.time_s->begin();
    const double value = (*curve.values)[static_cast<std::size_t>(row)];
    add_dot(page, {axes.x(parting.time_s), axes.y(value)}, curve.colour);
  }
}

void draw_log_chart(Page& page, const LogAxes& axes, const std::vector<LogCurve>& curves,
                    bool with_times) {
  draw_axes(page, axes, with_times);
  for (const LogCurve& curve : curves) draw_curve(page, axes, curve);
  for (const LogCurve& curve : curves) draw_dots(page, axes, curve);
}

// The colour of what differs between the runs of a robot: that of the robot in the first run. If
// there is one robot, it is a colour of neither run.
sim::Colour colour_of(const RobotDifference& robot, const std::vector<Series>& all,
                      const diff::RunDifference& difference) {
  if (difference.robots.size() == 1) return kCurve;
  const auto series = std::find_if(all.begin(), all.end(), [&robot](const Series& candidate) {
    return candidate.run == 0 && static_cast<std::size_t>(candidate.robot) == robot.in_first;
  });
  return series == all.end() ? kCurve : series->colour;
}

// The charts share their axis of time.
void draw_charts(Page& page, const std::vector<Series>& all,
                 const diff::RunDifference& difference) {
  constexpr double kShareOfDistances = 0.62;
  std::vector<std::vector<double>> distances_mm(difference.robots.size());
  std::vector<LogCurve> distances;
  std::vector<LogCurve> headings;
  double end_s = 0.0;
  for (std::size_t i = 0; i < difference.robots.size(); ++i) {
    const RobotDifference& robot = difference.robots[i];
    if (robot.time_s.empty()) continue;
    for (const double distance_m : robot.distance_m) distances_mm[i].push_back(1e3 * distance_m);
    const sim::Colour colour = colour_of(robot, all, difference);
    distances.push_back({&robot.time_s, &distances_mm[i], &robot.distances, colour});
    headings.push_back({&robot.time_s, &robot.heading_deg, &robot.headings, colour});
    end_s = std::max(end_s, robot.time_s.back());
  }
  const double middle =
      page::kTop + kShareOfDistances * (page::kBottom - page::kTop - page::kTitleGap);
  LogAxes axes;
  axes.title = "distance between the runs [mm]";
  if (distances.size() > 1) axes.title += ", in the robots' colours of the first run";
  axes.top = page::kTop;
  axes.bottom = middle;
  axes.end_s = end_s > 0.0 ? end_s : 1.0;
  for (const double limit_m : diff::kDistances_m) axes.limits.push_back(1e3 * limit_m);
  axes.most = upper_end(distances, 1000.0);
  draw_log_chart(page, axes, distances, false);
  axes.title = "difference of the headings [degrees]";
  axes.top = middle + page::kTitleGap;
  axes.bottom = page::kBottom;
  axes.most = 180.0;
  axes.limits.assign(diff::kHeadings_deg.begin(), diff::kHeadings_deg.end());
  draw_log_chart(page, axes, headings, true);
  page.add_text("time [s]", {page::kRight, page::kBottom + 36.0}, page::kText, kInk,
                Page::Align::kRight);
}

// --- Labels in the scene

// A label of a place.
struct Label {
  Vec2 place;  // what it names
  Vec2 low;    // top left corner
  Vec2 size;
  std::string text;
  sim::Colour colour;
};

// Finds places for labels around what they name: free of other labels and, if possible, of
// trajectories.
class Labels {
 public:
  Labels(const Vec2& low, const Vec2& high) : low_(low), high_(high) {}

  // A label must not hide this. Neighbouring points count as one.
  void avoid(const Vec2& point) {
    constexpr double kLeastGap = 3.0;
    if (hidden_.empty() || (point - hidden_.back()).norm() > kLeastGap) hidden_.push_back(point);
  }

  void add(const Vec2& place, const std::string& text, sim::Colour colour) {
    const Vec2 size(Page::text_width_px(text, page::kSmallText) + 10.0, page::kSmallText + 9.0);
    std::optional<Label> best;
    double least = std::numeric_limits<double>::infinity();
    for (const double distance : {26.0, 40.0, 58.0, 80.0}) {
      for (int i = 0; i < kDirections; ++i) {
        const double angle = 2.0 * std::numbers::pi * (i + 0.5) / kDirections;
        const Vec2 away = sim::unit_vector(angle);
        const Vec2 center = place + away.cwiseProduct(Vec2::Constant(distance) + 0.4 * size);
        const Label label{place, center - 0.5 * size, size, text, colour};
        const double cost = cost_of(label) + 0.4 * distance;
        if (cost >= least) continue;
        least = cost;
        best = label;
      }
    }
    if (best) labels_.push_back(*best);
  }

  void draw(Page& page) const {
    for (const Label& label : labels_) {
      page.add_line({label.place, label.low + 0.5 * label.size}, kPaper, 3.6);
      page.add_line({label.place, label.low + 0.5 * label.size}, label.colour, 1.4);
    }
    for (const Label& label : labels_) add_dot(page, label.place, label.colour);
    for (const Label& label : labels_) {
      add_box(page, label.low - Vec2(1.2, 1.2), label.size + Vec2(2.4, 2.4), label.colour);
      add_box(page, label.low, label.size, kPaper);
      page.add_text(
          label.text,
          label.low + Vec2(0.5 * label.size.x(), 0.5 * (label.size.y() + page::kSmallText)),
          page::kSmallText, kInk, Page::Align::kMiddle);
    }
  }

 private:
  static constexpr int kDirections = 16;

  static void add_box(Page& page, const Vec2& low, const Vec2& size, sim::Colour colour) {
    page.add_area({low, low + Vec2(size.x(), 0.0), low + size, low + Vec2(0.0, size.y())}, colour);
  }

  static bool overlap(const Label& a, const Label& b) {
    constexpr double kGap = 3.0;
    return (a.low.array() < (b.low + b.size).array() + kGap).all() &&
           (b.low.array() < (a.low + a.size).array() + kGap).all();
  }

  [[nodiscard]] double cost_of(const Label& label) const {
    constexpr double kOutside = 1e4;
    constexpr double kOverlap = 1e3;
    double cost = 0.0;
    if ((label.low.array() < low_.array()).any() ||
        ((label.low + label.size).array() > high_.array()).any()) {
      cost += kOutside;
    }
    for (const Label& other : labels_) {
      if (overlap(label, other)) cost += kOverlap;
    }
    for (const Vec2& point : hidden_) {
      const Vec2 from_low = point - label.low;
      if ((from_low.array() > -2.0).all() && (from_low.array() < label.size.array() + 2.0).all()) {
        cost += 1.0;
      }
    }
    return cost;
  }

  Vec2 low_;
  Vec2 high_;
  std::vector<Vec2> hidden_;
  std::vector<Label> labels_;
};

void draw_partings(Page& page, const sim::SceneSnapshot& scene, const PlacedScene& placed,
                   const std::vector<Series>& all, const diff::RunDifference& difference) {
  constexpr std::size_t kMostLabelledRobots = 4;
  const auto place_of = [&](const Vec2& p_W) -> Vec2 {
    return placed.corner + sim::render::place_in_picture(scene, placed.options, p_W);
  };
  Labels labels(placed.corner, placed.corner + placed.size);
  for (const sim::RobotSnapshot& robot : scene.robots) {
    for (const Vec2& p_W : robot.trail) labels.avoid(place_of(p_W));
  }
  std::size_t labelled = 0;
  for (const RobotDifference& robot : difference.robots) {
    if (robot.distances.empty()) continue;
    const bool with_labels = labelled++ < kMostLabelledRobots;
    const sim::Colour colour = colour_of(robot, all, difference);
    for (const Parting& parting : robot.distances) {
      const Vec2 place = place_of(0.5 * parting.first.position() + 0.5 * parting.second.position());
      const Vec2 from_corner = place - placed.corner;
      // What is outside the arena cannot be shown.
      if (!((from_corner.array() >= 0.0).all() &&
            (from_corner.array() <= placed.size.array()).all())) {
        continue;
      }
      if (with_labels) {
        labels.add(place, diff::distance_text(parting.limit), colour);
      } else {
        add_dot(page, place, colour);
      }
    }
  }
  labels.draw(page);
  if (labelled == 0) return;
  const bool has_key = !scene.collisions.empty() || !scene.goals.empty();
  const Vec2 key = placed.corner + Vec2(11.0, placed.size.y() + (has_key ? 46.0 : 24.0));
  add_dot(page, key - Vec2(0.0, 4.5), difference.robots.size() == 1 ? kCurve : kInk);
  page.add_text("first more than 1, 10 and 100 mm apart", key + Vec2(14.0, 0.0), page::kText, kInk);
}

}  // namespace

sim::render::Drawing diff_page(const std::vector<RunData>& runs,
                               const diff::RunDifference& difference) {
  Page drawing(page::kPageWidth, page::kPageHeight);
  const std::vector<Series> all = series_of(runs);
  std::string title = grade::plain_text(runs.front().world_name);
  if (runs.back().world_name != runs.front().world_name) {
    title += " and " + grade::plain_text(runs.back().world_name);
  }
  drawing.add_text(title, {page::kLeft, 30.0}, 13.0, kInk);
  // Curves of the second run are dashed in charts; here, only the scene shows them.
  std::vector<Series> entries = all;
  for (Series& entry : entries) entry.run = 0;
  draw_legend(drawing, entries);
  draw_charts(drawing, all, difference);
  const sim::SceneSnapshot scene = scene_of(runs, {0, 1}, all);
  const PlacedScene placed = draw_scene(drawing, scene, "trajectories", false,
                                        {page::kSceneLeft, page::kTop}, page::kScenesWidth);
  draw_partings(drawing, scene, placed, all, difference);
  return drawing;
}

}  // namespace playpen
