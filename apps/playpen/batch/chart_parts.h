// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "batch/chart.h"
#include "batch/statistics.h"
#include "sim/core/colour.h"
#include "sim/core/pose.h"
#include "sim/render/drawing.h"

/// The parts that line charts and dot charts share. Lengths are pixels.
namespace playpen::batch {

constexpr double kChartWidth = 1000.0;
constexpr double kChartMargin = 30.0;    ///< free on the left and on the right
constexpr double kChartText = 10.0;      ///< height of a capital letter
constexpr double kChartSmallText = 8.6;  ///< of numbers and notes

/// The least and the greatest of some numbers.
class Extent {
 public:
  void add(double value);
  /// Adds the mean, the interval and the single runs.
  void add(const ChartPoint& point);
  [[nodiscard]] bool is_empty() const noexcept { return low_ > high_; }
  /// The range from the least to the greatest; wider if they are equal, or nearly. Without numbers:
  /// 0 to 1.
  [[nodiscard]] Interval range() const;

 private:
  double low_ = 1.0;
  double high_ = 0.0;
};

/// The range of an axis of values: it begins at 0 if that leaves at most half of it empty, and it
/// has some room beyond the other ends.
[[nodiscard]] Interval range_of_values(const Extent& extent);

/// A horizontal or vertical axis.
class ChartAxis {
 public:
  /// @param begin_px, end_px  where the ends of the range are.
  /// @param unit  follows every number: " %".
  ChartAxis(const Interval& range, double begin_px, double end_px, int count, std::string unit);
  /// Widens the range until it begins and ends at ticks.
  void widen_to_ticks();
  /// Removes ticks until the texts of a horizontal axis have room.
  void thin_out();
  /// Removes ticks until all are whole numbers.
  void keep_whole();

  [[nodiscard]] double operator()(double value) const;
  [[nodiscard]] const std::vector<sim::render::Tick>& ticks() const noexcept { return ticks_; }
  /// Whether a tick is a zero between negative and positive values.
  [[nodiscard]] bool is_middle(const sim::render::Tick& tick) const noexcept {
    return tick.value == 0.0 && range_.low < 0.0 && range_.high > 0.0;
  }
  /// Width of the longest text of a tick.
  [[nodiscard]] double text_width() const;

 private:
  void set_ticks(int count);

  Interval range_;
  double begin_px_;
  double end_px_;
  int count_;
  std::string unit_;
  std::vector<sim::render::Tick> ticks_;
};

/// The value axis of a chart, widened to ticks, or from 0 to 100 % for shares.
[[nodiscard]] ChartAxis value_axis(const Chart& chart, const Extent& extent, double begin_px,
                                   double end_px, int count);

/// A number of the chart as it is shown: shares in percent.
[[nodiscard]] inline double shown(const Chart& chart, double value) {
  return chart.is_share ? 100.0 * value : value;
}

/// Title and legend.
class ChartHeading {
 public:
  /// @param with_lines  the legend shows lines with dots instead of dots.
  ChartHeading(const Chart& chart, bool with_lines);
  void draw(sim::render::Drawing& page) const;
  /// Lower end of the heading.
  [[nodiscard]] double bottom() const noexcept { return bottom_; }

 private:
  struct Entry {
    std::string name;
    sim::Vec2 place;
    sim::Colour colour;
  };
  std::string title_;
  bool with_lines_;
  std::vector<Entry> entries_;
  std::string rest_;  ///< how many series have no entry
  sim::Vec2 rest_place_ = sim::Vec2::Zero();
  double bottom_;
};

/// A text whose middle is replaced by dots if it is too long. At least its first character is left.
[[nodiscard]] std::string shortened_in_middle(const std::string& text, double cap_height_px,
                                              double width_px);

/// The same colour, transparent. @param opacity  0..1.
[[nodiscard]] sim::Colour faded(sim::Colour colour, double opacity);

void draw_disc(sim::render::Drawing& page, const sim::Vec2& center, double radius_px,
               sim::Colour colour);
/// The dot of a mean, with a white rim.
void draw_mean(sim::render::Drawing& page, const sim::Vec2& center, sim::Colour colour);
/// The dot of a single run.
void draw_run(sim::render::Drawing& page, const sim::Vec2& center, sim::Colour colour);

/// Draws what the marks mean, and at the right end of the line the name of the horizontal axis.
/// @param y  base line.
/// @param right  right end of the axis.
void draw_foot(sim::render::Drawing& page, const Chart& chart, const std::string& axis_name,
               bool with_bands, double y, double right);

/// A chart that is placed on its page.
class PlacedChart {
 public:
  virtual ~PlacedChart() = default;
  [[nodiscard]] virtual sim::render::Drawing draw() const = 0;
  [[nodiscard]] virtual std::optional<sim::Vec2> place(std::size_t series,
                                                       std::size_t point) const = 0;
};
/// @param chart  must outlive the result.
[[nodiscard]] std::unique_ptr<PlacedChart> place_line_chart(const Chart& chart);
[[nodiscard]] std::unique_ptr<PlacedChart> place_dot_chart(const Chart& chart);

}  // namespace playpen::batch
