// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "batch/chart_parts.h"
#include "sim/core/math.h"
#include "sim/core/number_text.h"

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

constexpr std::size_t kMostRows = 40;
constexpr double kRowPitch = 17.0;    // between rows with the same label
constexpr double kLabelPitch = 28.0;  // between rows with different labels
constexpr double kWidestLabel = 320.0;
constexpr double kBesidePanel = 12.0;  // from the panel to the texts beside it

// A row of the chart: a point of a series.
struct Row {
  std::size_t series;
  const ChartPoint* point;
  double y = 0.0;  // of its middle
};

// Rows with the same label, one below the other.
struct Group {
  std::string label;
  std::vector<Row> rows;

  [[nodiscard]] double middle() const { return 0.5 * (rows.front().y + rows.back().y); }
  [[nodiscard]] double upper() const { return rows.front().y - 0.5 * kLabelPitch; }
  [[nodiscard]] double lower() const { return rows.back().y + 0.5 * kLabelPitch; }
};

// The groups of a chart in the order of their labels' first points, without y.
std::vector<Group> all_groups(const Chart& chart) {
  std::vector<Group> groups;
  std::map<std::string, std::size_t> known;
  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    for (const ChartPoint& point : chart.series[s].points) {
      const auto [group, is_new] = known.emplace(point.label, groups.size());
      if (is_new) groups.push_back({point.label, {}});
      groups[group->second].rows.push_back({s, &point});
    }
  }
  return groups;
}

// Removes the rows after the first kMostRows. @return their number.
std::size_t drop_last_rows(std::vector<Group>& groups) {
  std::size_t kept = 0;
  std::size_t dropped = 0;
  for (Group& group : groups) {
    const std::size_t room = std::min(kMostRows - kept, group.rows.size());
    dropped += group.rows.size() - room;
    kept += room;
    group.rows.erase(group.rows.begin() + static_cast<std::ptrdiff_t>(room), group.rows.end());
  }
  std::erase_if(groups, [](const Group& group) { return group.rows.empty(); });
  return dropped;
}

// Texts of means: four digits of the greatest one, and the same decimals for all. Shares that are
// not whole percents have one decimal.
class MeanTexts {
 public:
  explicit MeanTexts(bool is_share) : is_share_(is_share) {}

  // @param means  as they are shown.
  void set_digits(const std::vector<double>& means) {
    constexpr int kDigits = 4;
    double largest = 0.0;
    bool are_whole = true;
    for (const double mean : means) {
      largest = std::max(largest, std::abs(mean));
      are_whole = are_whole && std::abs(mean - std::round(mean)) < 0.01;
    }
    is_fixed_ = is_share_ || largest == 0.0 || (largest >= 1e-3 && largest < 1e7);
    if (is_share_) {
      decimals_ = are_whole ? 0 : 1;
    } else if (is_fixed_ && largest > 0.0) {
      decimals_ =
          std::max(kDigits - 1 - static_cast<int>(std::floor(sim::math::log10(largest))), 0);
    }
  }
  // @param number  a mean as it is shown.
  [[nodiscard]] std::string operator()(double number) const {
    if (!is_fixed_) return sim::rounded_text(number, 4);
    std::string text = sim::fixed_text(number, decimals_);
    if (text.starts_with('-') && text.find_first_of("123456789") == std::string::npos) {
      text.erase(0, 1);  // rounded to zero
    }
    return text + (is_share_ ? " %" : "");
  }

 private:
  bool is_share_;
  bool is_fixed_ = true;
  int decimals_ = 0;
};

class DotChart final : public PlacedChart {
 public:
  explicit DotChart(const Chart& chart)
      : chart_(chart),
        heading_(chart, false),
        groups_(all_groups(chart)),
        left_out_(drop_last_rows(groups_)),
        mean_text_(chart.is_share),
        axis_(value_axis(chart, {}, 0.0, 1.0, 1)) {
    for (Group& group : groups_) {
      group.label = shortened_in_middle(group.label, kChartText, kWidestLabel);
    }
    set_columns();
    set_rows();
    Extent extent;
    for (const Group& group : groups_) {
      for (const Row& row : group.rows) extent.add(*row.point);
    }
    axis_ = value_axis(chart, extent, left_, right_, 8);
    axis_.thin_out();
  }

  [[nodiscard]] Drawing draw() const override {
    Drawing page(static_cast<int>(kChartWidth), static_cast<int>(bottom_ + 62.0));
    heading_.draw(page);
    draw_stripes(page);
    draw_grid(page);
    for (const Group& group : groups_) {
      draw_label(page, group.label, group.middle(), kInk);
      for (const Row& row : group.rows) draw_row(page, row);
    }
    if (left_out_ > 0) {
      draw_label(page, "and " + std::to_string(left_out_) + " more", bottom_ - 0.5 * kLabelPitch,
                 kFaintInk);
    }
    if (groups_.empty()) {
      page.add_text("no values", {0.5 * (left_ + right_), 0.5 * (top_ + bottom_) + 4.0}, kChartText,
                    kFaintInk, Drawing::Align::kMiddle);
    }
    draw_foot(page, chart_, chart_.value_name, false, bottom_ + 44.0, right_);
    return page;
  }

  [[nodiscard]] std::optional<Vec2> place(std::size_t series, std::size_t point) const override {
    const ChartPoint* const which = &chart_.series[series].points[point];
    for (const Group& group : groups_) {
      for (const Row& row : group.rows) {
        if (row.point == which) return place_of(row, which->value);
      }
    }
    return std::nullopt;
  }

 private:
  // The columns of labels, of the panel and of numbers.
  void set_columns() {
    std::vector<double> means;
    for (const Group& group : groups_) {
      for (const Row& row : group.rows) means.push_back(shown(chart_, row.point->value));
    }
    mean_text_.set_digits(means);
    double label_px = 60.0;
    double number_px = 30.0;
    for (const Group& group : groups_) {
      label_px = std::max(label_px, Drawing::text_width_px(group.label, kChartText));
    }
    for (const double mean : means) {
      number_px = std::max(number_px, Drawing::text_width_px(mean_text_(mean), kChartSmallText));
    }
    left_ = kChartMargin + label_px + kBesidePanel;
    right_ = kChartWidth - kChartMargin - number_px - kBesidePanel;
  }

  void set_rows() {
    top_ = heading_.bottom() + 30.0;
    double y = top_ - 0.5 * kLabelPitch;
    for (Group& group : groups_) {
      y += kLabelPitch;
      for (Row& row : group.rows) {
        row.y = y;
        y += kRowPitch;
      }
      y -= kRowPitch;
    }
    if (left_out_ > 0) y += kLabelPitch;
    if (groups_.empty()) y += 2.0 * kLabelPitch;
    bottom_ = y + 0.5 * kLabelPitch;
  }

  [[nodiscard]] Vec2 place_of(const Row& row, double value) const {
    return {axis_(shown(chart_, value)), row.y};
  }

  // Every second group lies on a grey stripe, which leads from its label to its numbers.
  void draw_stripes(Drawing& page) const {
    constexpr Colour kStripe{0xf6, 0xf6, 0xf4};
    constexpr double kBeyond = 8.0;
    const double left = kChartMargin - kBeyond;
    const double right = kChartWidth - kChartMargin + kBeyond;
    for (std::size_t i = 0; i < groups_.size(); i += 2) {
      const double upper = groups_[i].upper();
      const double lower = groups_[i].lower();
      page.add_area({{left, upper}, {right, upper}, {right, lower}, {left, lower}}, kStripe);
    }
  }

  void draw_grid(Drawing& page) const {
    constexpr double kHigh = 500.0;  // of a panel whose numbers are also above it
    for (const Tick& tick : axis_.ticks()) {
      const double x = axis_(tick.value);
      page.add_line({{x, top_}, {x, bottom_}}, axis_.is_middle(tick) ? kFrame : kGrid, 1.0);
      page.add_text(tick.text, {x, bottom_ + 18.0}, kChartSmallText, kFaintInk,
                    Drawing::Align::kMiddle);
      if (bottom_ - top_ > kHigh) {
        page.add_text(tick.text, {x, top_ - 8.0}, kChartSmallText, kFaintInk,
                      Drawing::Align::kMiddle);
      }
    }
    page.add_line({{left_, top_}, {left_, bottom_}, {right_, bottom_}}, kFrame, 1.2);
  }

  void draw_label(Drawing& page, const std::string& text, double y, Colour colour) const {
    page.add_text(text, {left_ - kBesidePanel, y + 0.5 * kChartText}, kChartText, colour,
                  Drawing::Align::kRight);
  }

  void draw_row(Drawing& page, const Row& row) const {
    const Colour colour = sim::render::distinct_colour(row.series);
    const ChartPoint& point = *row.point;
    page.add_line({place_of(row, point.interval.low), place_of(row, point.interval.high)},
                  faded(colour, 0.4), 5.0);
    // Equal values do not cover each other at once.
    constexpr std::array<double, 5> kAside = {0.0, -4.0, 4.0, -2.0, 2.0};
    std::vector<double> values = point.values;
    std::sort(values.begin(), values.end());
    for (std::size_t i = 0; i < values.size(); ++i) {
      draw_run(page, place_of(row, values[i]) + Vec2(0.0, kAside.at(i % kAside.size())), colour);
    }
    draw_mean(page, place_of(row, point.value), colour);
    page.add_text(mean_text_(shown(chart_, point.value)),
                  {kChartWidth - kChartMargin, row.y + 0.5 * kChartSmallText}, kChartSmallText,
                  kFaintInk, Drawing::Align::kRight);
  }

  const Chart& chart_;
  ChartHeading heading_;
  std::vector<Group> groups_;
  std::size_t left_out_;  // number of points without a row
  MeanTexts mean_text_;
  double top_ = 0.0;
  double bottom_ = 0.0;
  double left_ = 0.0;
  double right_ = 0.0;
  ChartAxis axis_;
};

}  // namespace

std::unique_ptr<PlacedChart> place_dot_chart(const Chart& chart) {
  return std::make_unique<DotChart>(chart);
}

}  // namespace playpen::batch
