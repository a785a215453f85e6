// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "batch/statistics.h"
#include "sim/core/pose.h"
#include "sim/render/drawing.h"

namespace playpen::batch {

/// The runs of one group in a chart. All numbers are finite and in the unit of the chart's value.
struct ChartPoint {
  std::string label;           ///< name of the group, e.g. "cave"
  std::optional<double> x;     ///< the parameter of the group, for charts with x_name
  double value = 0.0;          ///< the mean
  Interval interval;           ///< of the mean
  std::vector<double> values;  ///< of the single runs, in any order; may be empty
};

/// Points of one colour, e.g. the groups of one program.
struct ChartSeries {
  std::string name;
  std::vector<ChartPoint> points;
};

/// One quantity over groups of runs.
struct Chart {
  std::string title;
  std::string value_name;  ///< "path length [m]"
  std::string x_name;      ///< of the parameter: "noise [m]"; empty: the groups have names only
  bool is_share = false;   ///< the values are shares, 0..1, and are shown in percent
  std::vector<ChartSeries> series;
};

/// Draws a chart.
///
/// With x_name it is a line chart: the mean over the parameter, a line for each series. Intervals
/// are bands; if there are more than two series, or a series has one point, they are bars, and
/// those of the series stand side by side. Points without x are not drawn.
///
/// Without x_name it is a dot chart: a row for each point, with the mean as a dot and a number, the
/// interval as a bar and the single runs as small dots. Points with equal labels lie together, in
/// the order of their series; labels and series keep their order. After 40 rows a note says how
/// many points are left out.
///
/// Every series has the colour distinct_colour() of its number. The axis of values begins at 0 if
/// this leaves at most half of it empty; an axis of shares shows 0..100 %. Long names are shortened
/// in the middle.
[[nodiscard]] sim::render::Drawing draw_chart(const Chart& chart);

/// Where draw_chart() draws the mean of a point [pixels]; none if the point is not drawn.
/// @pre the point exists.
[[nodiscard]] std::optional<sim::Vec2> place_in_chart(const Chart& chart, std::size_t series,
                                                      std::size_t point);

/// Writes a chart as PNG. Equal charts give equal bytes.
/// @throws std::runtime_error naming the file and the reason.
void write_chart(const Chart& chart, const std::filesystem::path& file);

}  // namespace playpen::batch
