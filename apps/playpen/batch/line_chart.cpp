// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "batch/chart_parts.h"

namespace playpen::batch {
namespace {

using sim::Colour;
using sim::Vec2;
using sim::render::Drawing;
using sim::render::Tick;
using sim::render::page_palette::kFaintInk;
using sim::render::page_palette::kFrame;
using sim::render::page_palette::kGrid;
using sim::render::page_palette::kInk;

constexpr double kPanelHeight = 430.0;
constexpr std::size_t kMostBands = 2;  // more bands cover each other
constexpr double kBeside = 5.0;        // between the bars of two series
constexpr double kMostBeside = 100.0;  // from a parameter to the bars of the outer series

class LineChart final : public PlacedChart {
 public:
  explicit LineChart(const Chart& chart)
      : chart_(chart),
        heading_(chart, true),
        top_(heading_.bottom() + 46.0),
        bottom_(top_ + kPanelHeight),
        y_axis_(value_axis(chart, values(), bottom_, top_, 6)),
        left_(kChartMargin + y_axis_.text_width() + 9.0),
        x_axis_(parameters().range(), left_ + room(), kRight - room(), 8, "") {
    x_axis_.thin_out();
    if (has_whole_parameters()) x_axis_.keep_whole();
    if (!with_bands()) {
      beside_ = std::min(
          {kBeside, 0.7 * least_gap() / series_count(), 2.0 * kMostBeside / series_count()});
    }
  }

  [[nodiscard]] Drawing draw() const override {
    Drawing page(static_cast<int>(kChartWidth), static_cast<int>(bottom_ + 62.0));
    heading_.draw(page);
    page.add_text(shortened_in_middle(chart_.value_name, kChartText, kRight - kChartMargin),
                  {kChartMargin, top_ - 18.0}, kChartText, kInk);
    draw_grid(page);
    if (parameters().is_empty()) {
      page.add_text("no values", {0.5 * (left_ + kRight), 0.5 * (top_ + bottom_)}, kChartText,
                    kFaintInk, Drawing::Align::kMiddle);
    }
    for (std::size_t s = 0; s < chart_.series.size(); ++s) draw_runs(page, s);
    for (std::size_t s = 0; s < chart_.series.size(); ++s) draw_intervals(page, s);
    for (std::size_t s = 0; s < chart_.series.size(); ++s) draw_means(page, s);
    draw_foot(page, chart_, chart_.x_name, has_band(), bottom_ + 44.0, kRight);
    return page;
  }

  [[nodiscard]] std::optional<Vec2> place(std::size_t series, std::size_t point) const override {
    const ChartPoint& which = chart_.series[series].points[point];
    if (!which.x) return std::nullopt;
    return place_of(series, which, which.value);
  }

 private:
  static constexpr double kRight = kChartWidth - kChartMargin;

  [[nodiscard]] bool with_bands() const { return chart_.series.size() <= kMostBands; }
  [[nodiscard]] bool has_band() const {
    for (std::size_t s = 0; s < chart_.series.size(); ++s) {
      if (with_bands() && points_of(s).size() > 1) return true;
    }
    return false;
  }
  [[nodiscard]] double series_count() const { return static_cast<double>(chart_.series.size()); }
  // Between the axis and the outer points.
  [[nodiscard]] double room() const {
    return 22.0 + (with_bands() ? 0.0 : std::min(0.5 * kBeside * series_count(), kMostBeside));
  }

  [[nodiscard]] Extent values() const {
    Extent extent;
    for (const ChartSeries& series : chart_.series) {
      for (const ChartPoint& point : series.points) {
        if (point.x) extent.add(point);
      }
    }
    return extent;
  }

  [[nodiscard]] Extent parameters() const {
    Extent extent;
    for (const ChartSeries& series : chart_.series) {
      for (const ChartPoint& point : series.points) {
        if (point.x) extent.add(*point.x);
      }
    }
    return extent;
  }

  // Numbers of robots and the like.
  [[nodiscard]] bool has_whole_parameters() const {
    for (const ChartSeries& series : chart_.series) {
      for (const ChartPoint& point : series.points) {
        if (point.x && *point.x != std::round(*point.x)) return false;
      }
    }
    return true;
  }

  // The least distance of two parameters on the page.
  [[nodiscard]] double least_gap() const {
    std::vector<double> places;
    for (const ChartSeries& series : chart_.series) {
      for (const ChartPoint& point : series.points) {
        if (point.x) places.push_back(x_axis_(*point.x));
      }
    }
    std::sort(places.begin(), places.end());
    double gap = kChartWidth;
    for (std::size_t i = 1; i < places.size(); ++i) {
      if (places[i] > places[i - 1]) gap = std::min(gap, places[i] - places[i - 1]);
    }
    return gap;
  }

  // Where a value of a point is. Bars of many series stand side by side.
  [[nodiscard]] Vec2 place_of(std::size_t series, const ChartPoint& point, double value) const {
    const double from_middle = static_cast<double>(series) - 0.5 * (series_count() - 1.0);
    return {x_axis_(*point.x) + beside_ * from_middle, y_axis_(shown(chart_, value))};
  }

  // The points of a series with a parameter, sorted by it.
  [[nodiscard]] std::vector<const ChartPoint*> points_of(std::size_t series) const {
    std::vector<const ChartPoint*> points;
    for (const ChartPoint& point : chart_.series[series].points) {
      if (point.x) points.push_back(&point);
    }
    std::stable_sort(points.begin(), points.end(),
                     [](const ChartPoint* a, const ChartPoint* b) { return *a->x < *b->x; });
    return points;
  }

  void draw_grid(Drawing& page) const {
    for (const Tick& tick : x_axis_.ticks()) {
      const double x = x_axis_(tick.value);
      page.add_line({{x, top_}, {x, bottom_}}, kGrid, 1.0);
      page.add_text(tick.text, {x, bottom_ + 18.0}, kChartSmallText, kFaintInk,
                    Drawing::Align::kMiddle);
    }
    for (const Tick& tick : y_axis_.ticks()) {
      const double y = y_axis_(tick.value);
      page.add_line({{left_, y}, {kRight, y}}, y_axis_.is_middle(tick) ? kFrame : kGrid, 1.0);
      page.add_text(tick.text, {left_ - 9.0, y + 0.5 * kChartSmallText}, kChartSmallText, kFaintInk,
                    Drawing::Align::kRight);
    }
    page.add_line({{left_, top_}, {left_, bottom_}, {kRight, bottom_}}, kFrame, 1.2);
  }

  void draw_runs(Drawing& page, std::size_t series) const {
    const Colour colour = sim::render::distinct_colour(series);
    for (const ChartPoint* const point : points_of(series)) {
      for (const double value : point->values) {
        draw_run(page, place_of(series, *point, value), colour);
      }
    }
  }

  void draw_intervals(Drawing& page, std::size_t series) const {
    const Colour colour = sim::render::distinct_colour(series);
    const std::vector<const ChartPoint*> points = points_of(series);
    if (with_bands() && points.size() > 1) {
      std::vector<Vec2> band;
      for (const ChartPoint* const point : points) {
        band.push_back(place_of(series, *point, point->interval.high));
      }
      for (auto point = points.rbegin(); point != points.rend(); ++point) {
        band.push_back(place_of(series, **point, (*point)->interval.low));
      }
      page.add_area(std::move(band), faded(colour, 0.16));
      return;
    }
    for (const ChartPoint* const point : points) {
      page.add_line({place_of(series, *point, point->interval.low),
                     place_of(series, *point, point->interval.high)},
                    faded(colour, 0.4), 4.0);
    }
  }

  void draw_means(Drawing& page, std::size_t series) const {
    const Colour colour = sim::render::distinct_colour(series);
    std::vector<Vec2> places;
    for (const ChartPoint* const point : points_of(series)) {
      places.push_back(place_of(series, *point, point->value));
    }
    if (places.size() > 1) page.add_line(places, colour, 2.0);
    for (const Vec2& place : places) draw_mean(page, place, colour);
  }

  const Chart& chart_;
  ChartHeading heading_;
  double top_;
  double bottom_;
  ChartAxis y_axis_;
  double left_;
  ChartAxis x_axis_;
  double beside_ = 0.0;  // between two series at the same parameter
};

}  // namespace

std::unique_ptr<PlacedChart> place_line_chart(const Chart& chart) {
  return std::make_unique<LineChart>(chart);
}

}  // namespace playpen::batch
