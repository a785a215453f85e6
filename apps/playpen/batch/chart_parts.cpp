// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "batch/chart_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <string_view>
#include <utility>

#include "sim/core/pose.h"
#include "sim/core/utf8.h"

namespace playpen::batch {
namespace {

using sim::Colour;
using sim::Vec2;
using sim::render::Drawing;
using sim::render::Tick;
using sim::render::page_palette::kFaintInk;
using sim::render::page_palette::kInk;

constexpr double kMean_px = 4.6;  // radius
constexpr double kRun_px = 2.1;
constexpr double kTitle = 13.0;     // height of a capital letter
constexpr double kLineMark = 36.0;  // width of a mark in the legend, with the space after it
constexpr double kDotMark = 16.0;

std::vector<std::string_view> characters_of(std::string_view text) {
  std::vector<std::string_view> all;
  while (!text.empty()) {
    const std::size_t length = std::max<std::size_t>(sim::utf8_length(text), 1);
    all.push_back(text.substr(0, length));
    text.remove_prefix(length);
  }
  return all;
}

// The first and the last characters of a text, `kept` in all, with dots between them.
std::string ends_of(const std::vector<std::string_view>& characters, std::size_t kept) {
  const std::size_t last = kept / 2;
  const std::size_t first = kept - last;
  std::string text;
  for (std::size_t i = 0; i < first; ++i) text += characters[i];
  text += "...";
  for (std::size_t i = characters.size() - last; i < characters.size(); ++i) text += characters[i];
  return text;
}

}  // namespace

void Extent::add(double value) {
  const bool is_first = is_empty();
  low_ = is_first ? value : std::min(low_, value);
  high_ = is_first ? value : std::max(high_, value);
}

void Extent::add(const ChartPoint& point) {
  add(point.value);
  add(point.interval.low);
  add(point.interval.high);
  for (const double value : point.values) add(value);
}

Interval Extent::range() const {
  constexpr double kNearlyEqual = 1e-9;  // of the numbers; below it, digits tell them apart no more
  if (is_empty()) return {0.0, 1.0};
  const double largest = std::max(std::abs(low_), std::abs(high_));
  if (high_ - low_ > kNearlyEqual * largest) return {low_, high_};
  const double half = largest > 0.0 ? 0.1 * largest : 1.0;
  return {low_ - half, high_ + half};
}

Interval range_of_values(const Extent& extent) {
  constexpr double kRoom = 0.02;
  Interval range = extent.range();
  const double room = kRoom * (range.high - range.low);
  const bool from_zero = range.low >= 0.0 && range.low <= 0.5 * range.high;
  const bool to_zero = range.high <= 0.0 && range.high >= 0.5 * range.low;
  range.low = from_zero ? 0.0 : range.low - room;
  range.high = to_zero ? 0.0 : range.high + room;
  return range;
}

ChartAxis::ChartAxis(const Interval& range, double begin_px, double end_px, int count,
                     std::string unit)
    : range_(range), begin_px_(begin_px), end_px_(end_px), count_(count), unit_(std::move(unit)) {
  set_ticks(count);
}

void ChartAxis::set_ticks(int count) {
  count_ = count;
  ticks_ = sim::render::ticks(range_.low, range_.high, count);
  for (Tick& tick : ticks_) tick.text += unit_;
}

void ChartAxis::widen_to_ticks() {
  if (ticks_.size() < 2) return;
  const double step = ticks_[1].value - ticks_[0].value;
  const auto differ = [step](double a, double b) { return std::abs(a - b) > 1e-6 * step; };
  const double first = ticks_.front().value;
  const double last = ticks_.back().value;
  range_.low = differ(first, range_.low) ? first - step : first;
  range_.high = differ(last, range_.high) ? last + step : last;
  set_ticks(static_cast<int>(std::lround((range_.high - range_.low) / step)));
}

void ChartAxis::thin_out() {
  constexpr double kGap = 16.0;  // between texts
  const double length = std::abs(end_px_ - begin_px_);
  while (count_ > 1 && ticks_.size() > 1) {
    const double step = (*this)(ticks_[1].value) - (*this)(ticks_[0].value);
    if (std::abs(step) >= std::min(text_width() + kGap, length)) return;
    set_ticks(count_ - 1);
  }
}

void ChartAxis::keep_whole() {
  const auto is_whole = [](const Tick& tick) { return tick.value == std::round(tick.value); };
  while (count_ > 1 && !std::all_of(ticks_.begin(), ticks_.end(), is_whole)) set_ticks(count_ - 1);
}

double ChartAxis::operator()(double value) const {
  const double share = (value - range_.low) / (range_.high - range_.low);
  return begin_px_ + (end_px_ - begin_px_) * share;
}

double ChartAxis::text_width() const {
  double width = 0.0;
  for (const Tick& tick : ticks_) {
    width = std::max(width, Drawing::text_width_px(tick.text, kChartSmallText));
  }
  return width;
}

ChartAxis value_axis(const Chart& chart, const Extent& extent, double begin_px, double end_px,
                     int count) {
  if (chart.is_share) return {{0.0, 100.0}, begin_px, end_px, count, " %"};
  ChartAxis axis(range_of_values(extent), begin_px, end_px, count, "");
  axis.widen_to_ticks();
  return axis;
}

ChartHeading::ChartHeading(const Chart& chart, bool with_lines)
    : title_(shortened_in_middle(chart.title, kTitle, kChartWidth - 2.0 * kChartMargin)),
      with_lines_(with_lines),
      bottom_(chart.title.empty() ? 12.0 : 36.0) {
  constexpr double kLineHeight = 20.0;
  constexpr std::size_t kMostLines = 4;
  constexpr double kWidestName = 260.0;
  constexpr double kBetween = 28.0;
  constexpr double kRoom = kChartWidth - 2.0 * kChartMargin + kBetween;
  const std::size_t count = chart.series.size();
  if (count < 2) return;
  const double mark = with_lines ? kLineMark : kDotMark;
  std::vector<std::string> names;
  std::vector<double> widths;
  for (const ChartSeries& series : chart.series) {
    names.push_back(shortened_in_middle(series.name, kChartText, kWidestName));
    widths.push_back(mark + Drawing::text_width_px(names.back(), kChartText) + kBetween);
  }
  const double widest = *std::max_element(widths.begin(), widths.end());
  // Names that need more lines than one stand in columns.
  const bool one_line = std::accumulate(widths.begin(), widths.end(), 0.0) <= kRoom;
  const std::size_t columns = one_line ? count : static_cast<std::size_t>(kRoom / widest);
  const std::size_t places = columns * kMostLines;
  double x = kChartMargin;
  double y = bottom_ + 26.0;
  for (std::size_t s = 0; s < count; ++s) {
    if (s > 0 && s % columns == 0) {
      x = kChartMargin;
      y += kLineHeight;
    }
    if (s + 1 == places && count > places) {
      rest_ = "and " + std::to_string(count - s) + " more";
      rest_place_ = {x, y};
      break;
    }
    entries_.push_back({std::move(names[s]), {x, y}, sim::render::distinct_colour(s)});
    x += one_line ? widths[s] : widest;
  }
  bottom_ = y + 4.0;
}

void ChartHeading::draw(Drawing& page) const {
  page.add_text(title_, {kChartMargin, 32.0}, kTitle, kInk);
  for (const Entry& entry : entries_) {
    const double y = entry.place.y() - 0.5 * kChartText;
    double x = entry.place.x();
    if (with_lines_) {
      page.add_line({{x, y}, {x + 28.0, y}}, entry.colour, 2.2);
      draw_mean(page, {x + 14.0, y}, entry.colour);
      x += kLineMark;
    } else {
      draw_mean(page, {x + 5.0, y}, entry.colour);
      x += kDotMark;
    }
    page.add_text(entry.name, {x, entry.place.y()}, kChartText, kInk);
  }
  if (!rest_.empty()) page.add_text(rest_, rest_place_, kChartText, kFaintInk);
}

std::string shortened_in_middle(const std::string& text, double cap_height_px, double width_px) {
  const auto fits = [&](const std::string& shown_text) {
    return Drawing::text_width_px(shown_text, cap_height_px) <= width_px;
  };
  constexpr std::size_t kMostBytes = 1000;  // a longer text is not measured
  if (text.size() <= kMostBytes && fits(text)) return text;
  const std::vector<std::string_view> characters = characters_of(text);
  std::size_t kept = 1;
  std::size_t too_many = std::min(characters.size(), kMostBytes);
  while (too_many - kept > 1) {
    const std::size_t middle = (kept + too_many) / 2;
    if (fits(ends_of(characters, middle))) {
      kept = middle;
    } else {
      too_many = middle;
    }
  }
  return ends_of(characters, kept);
}

Colour faded(Colour colour, double opacity) {
  return {colour.r, colour.g, colour.b, static_cast<std::uint8_t>(std::lround(255.0 * opacity))};
}

void draw_disc(Drawing& page, const Vec2& center, double radius_px, Colour colour) {
  constexpr int kCorners = 32;
  std::vector<Vec2> corners;
  corners.reserve(kCorners);
  for (int i = 0; i < kCorners; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / kCorners;
    corners.push_back(center + radius_px * sim::unit_vector(angle_rad));
  }
  page.add_area(std::move(corners), colour);
}

void draw_mean(Drawing& page, const Vec2& center, Colour colour) {
  draw_disc(page, center, kMean_px + 1.3, {0xff, 0xff, 0xff});
  draw_disc(page, center, kMean_px, colour);
}

void draw_run(Drawing& page, const Vec2& center, Colour colour) {
  draw_disc(page, center, kRun_px, faded(colour, 0.45));
}

void draw_foot(Drawing& page, const Chart& chart, const std::string& axis_name, bool with_bands,
               double y, double right) {
  const double middle = y - 0.5 * kChartSmallText;
  double x = kChartMargin;
  if (with_bands) {
    page.add_area(
        {{x, middle - 6.0}, {x + 24.0, middle - 6.0}, {x + 24.0, middle + 6.0}, {x, middle + 6.0}},
        faded(kFaintInk, 0.2));
    page.add_line({{x, middle}, {x + 24.0, middle}}, kFaintInk, 2.0);
  } else {
    page.add_line({{x, middle}, {x + 24.0, middle}}, faded(kFaintInk, 0.4), 5.0);
  }
  draw_mean(page, {x + 12.0, middle}, kFaintInk);
  x += 33.0;
  const auto add_note = [&](const std::string& note) {
    page.add_text(note, {x, y}, kChartSmallText, kFaintInk);
    x += Drawing::text_width_px(note, kChartSmallText) + 26.0;
  };
  add_note(chart.is_share ? "share and 95 % interval" : "mean and 95 % interval");
  bool has_runs = false;
  for (const ChartSeries& series : chart.series) {
    for (const ChartPoint& point : series.points) has_runs = has_runs || !point.values.empty();
  }
  if (has_runs) {
    draw_run(page, {x, middle}, kInk);
    x += 9.0;
    add_note("single run");
  }
  page.add_text(shortened_in_middle(axis_name, kChartText, right - x), {right, y}, kChartText, kInk,
                Drawing::Align::kRight);
}

}  // namespace playpen::batch
