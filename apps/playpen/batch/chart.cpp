// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "batch/chart.h"

#include <memory>

#include "batch/chart_parts.h"
#include "sim/core/assert.h"
#include "sim/render/render.h"

namespace playpen::batch {
namespace {

std::unique_ptr<PlacedChart> placed(const Chart& chart) {
  return chart.x_name.empty() ? place_dot_chart(chart) : place_line_chart(chart);
}

}  // namespace

sim::render::Drawing draw_chart(const Chart& chart) { return placed(chart)->draw(); }

std::optional<sim::Vec2> place_in_chart(const Chart& chart, std::size_t series, std::size_t point) {
  SIM_ASSERT(series < chart.series.size() && point < chart.series[series].points.size());
  return placed(chart)->place(series, point);
}

void write_chart(const Chart& chart, const std::filesystem::path& file) {
  sim::render::write_png(draw_chart(chart).image(), file.string());
}

}  // namespace playpen::batch
