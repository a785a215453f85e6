// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "batch/chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/colour.h"
#include "sim/render/drawing.h"
#include "temporary_folder.h"

namespace playpen::batch {
namespace {

using sim::Colour;
using sim::Vec2;
using sim::render::Image;
using testing::HasSubstr;
using testing::Not;

Colour pixel(const Image& image, const Vec2& place) {
  const auto at = 3 * (static_cast<std::size_t>(place.y()) * static_cast<std::size_t>(image.width) +
                       static_cast<std::size_t>(place.x()));
  return {image.rgb.at(at), image.rgb.at(at + 1), image.rgb.at(at + 2)};
}

ChartPoint point(std::string label, double value, std::optional<double> x = {}) {
  ChartPoint made;
  made.label = std::move(label);
  made.value = value;
  made.interval = {value - 1.0, value + 1.0};
  made.x = x;
  return made;
}

Chart rows() {
  Chart chart;
  chart.title = "Two programs";
  chart.value_name = "path length [m]";
  chart.series = {{"ada", {point("cave", 4.0), point("office", 12.0)}},
                  {"bob", {point("office", 16.0), point("cave", 8.0)}}};
  return chart;
}

Chart lines() {
  Chart chart = rows();
  chart.x_name = "noise [m]";
  chart.series = {{"ada", {point("", 4.0, 0.0), point("", 6.0, 0.2), point("", 5.0, 0.1)}},
                  {"bob", {point("", 8.0, 0.1), point("", 8.0)}}};
  return chart;
}

TEST(DotChart, Means_AreInRowsOnTheAxis) {
  const Chart chart = rows();
  const Image image = draw_chart(chart).image();
  std::vector<Vec2> places;
  for (std::size_t s = 0; s < 2; ++s) {
    for (std::size_t p = 0; p < 2; ++p) {
      const std::optional<Vec2> place = place_in_chart(chart, s, p);
      ASSERT_TRUE(place);
      EXPECT_EQ(pixel(image, *place), sim::render::distinct_colour(s));
      places.push_back(*place);
    }
  }
  // The columns of 4, 12, 16 and 8 m are 8, 4 and -8 m apart, in this order.
  const double px_per_m = (places[1].x() - places[0].x()) / 8.0;
  EXPECT_GT(px_per_m, 20.0);
  EXPECT_NEAR(places[2].x() - places[1].x(), 4.0 * px_per_m, 1e-6);
  EXPECT_NEAR(places[3].x() - places[2].x(), -8.0 * px_per_m, 1e-6);
  // The rows from above: cave of ada and bob, office of ada and bob.
  EXPECT_LT(places[0].y(), places[3].y());
  EXPECT_LT(places[3].y(), places[1].y());
  EXPECT_LT(places[1].y(), places[2].y());
  // A bar shows the interval, half a metre from the mean but not two metres.
  const Vec2 half_metre(0.5 * px_per_m, 0.0);
  EXPECT_NE(pixel(image, places[0] + half_metre), pixel(image, places[0] + 4.0 * half_metre));
  EXPECT_EQ(pixel(image, places[0] - half_metre), pixel(image, places[0] + half_metre));
}

TEST(DotChart, Texts_NameEverything) {
  const std::string svg = draw_chart(rows()).svg();
  for (const char* const text : {">Two programs<", ">path length [m]<", ">ada<", ">bob<", ">cave<",
                                 ">office<", ">4.00<", ">16.00<", ">0<", ">5<", ">20<"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
  EXPECT_THAT(svg, Not(HasSubstr("single run")));
  Chart one = rows();
  one.series.resize(1);
  one.series[0].points[0].values = {3.5, 4.5};
  const std::string of_one = draw_chart(one).svg();
  EXPECT_THAT(of_one, Not(HasSubstr(">ada<")));
  EXPECT_THAT(of_one, HasSubstr("single run"));
}

TEST(DotChart, ManyRows_LastOnesAreCounted) {
  Chart chart;
  chart.series.resize(1);
  for (int i = 0; i < 45; ++i) {
    chart.series[0].points.push_back(point("world " + std::to_string(i), i));
  }
  const sim::render::Drawing page = draw_chart(chart);
  const std::string svg = page.svg();
  EXPECT_THAT(svg, HasSubstr(">world 39<"));
  EXPECT_THAT(svg, Not(HasSubstr(">world 40<")));
  EXPECT_THAT(svg, HasSubstr(">and 5 more<"));
  const std::optional<Vec2> last = place_in_chart(chart, 0, 39);
  ASSERT_TRUE(last);
  EXPECT_LT(last->y(), page.image().height - 60.0);
  EXPECT_FALSE(place_in_chart(chart, 0, 40));
}

TEST(DotChart, LongLabels_KeepTheirEnds) {
  Chart chart = rows();
  const std::string middle(3000, 'x');
  chart.series[0].points = {point("first " + middle + " seed 1", 4.0),
                            point("first " + middle + " seed 2", 5.0)};
  const std::string svg = draw_chart(chart).svg();
  EXPECT_THAT(svg, HasSubstr(">first xx"));
  EXPECT_THAT(svg, HasSubstr("xx seed 1<"));
  EXPECT_THAT(svg, HasSubstr("xx seed 2<"));
  EXPECT_THAT(svg, Not(HasSubstr(std::string(100, 'x'))));
  const std::optional<Vec2> place = place_in_chart(chart, 0, 0);
  ASSERT_TRUE(place);
  EXPECT_GT(place->x(), 340.0);  // to the right of the labels
}

TEST(DotChart, Shares_ArePercent) {
  Chart chart;
  chart.is_share = true;
  chart.series = {{"", {point("all", 1.0), point("none", 0.0), point("some", 0.25)}}};
  for (ChartPoint& share : chart.series[0].points) share.interval = {share.value, share.value};
  const std::string svg = draw_chart(chart).svg();
  for (const char* const text : {">100 %<", ">25 %<", ">20 %<", "share and 95 % interval"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
  const double all = place_in_chart(chart, 0, 0)->x();
  const double none = place_in_chart(chart, 0, 1)->x();
  EXPECT_NEAR(place_in_chart(chart, 0, 2)->x(), 0.75 * none + 0.25 * all, 1e-6);
  chart.series[0].points[2].value = 1.0 / 3.0;
  EXPECT_THAT(draw_chart(chart).svg(), HasSubstr(">33.3 %<"));
}

TEST(LineChart, Means_AreOverTheParameter) {
  const Chart chart = lines();
  const Image image = draw_chart(chart).image();
  const std::optional<Vec2> first = place_in_chart(chart, 0, 0);
  const std::optional<Vec2> last = place_in_chart(chart, 0, 1);
  const std::optional<Vec2> middle = place_in_chart(chart, 0, 2);
  const std::optional<Vec2> other = place_in_chart(chart, 1, 0);
  ASSERT_TRUE(first && last && middle && other);
  EXPECT_NEAR(middle->x(), 0.5 * (first->x() + last->x()), 1e-6);
  EXPECT_NEAR(other->x(), middle->x(), 1e-6);
  const double px_per_m = (first->y() - last->y()) / 2.0;
  EXPECT_NEAR(first->y() - other->y(), 4.0 * px_per_m, 1e-6);
  EXPECT_FALSE(place_in_chart(chart, 1, 1)) << "it has no parameter";
  EXPECT_EQ(pixel(image, *first), sim::render::distinct_colour(0));
  EXPECT_EQ(pixel(image, *other), sim::render::distinct_colour(1));
  // The line leads over the points sorted by their parameters, from 4 over 5 to 6 m.
  EXPECT_EQ(pixel(image, 0.5 * (*first + *middle)), sim::render::distinct_colour(0));
  EXPECT_EQ(pixel(image, 0.5 * (*middle + *last)), sim::render::distinct_colour(0));
  EXPECT_THAT(draw_chart(chart).svg(), HasSubstr(">noise [m]<"));
}

TEST(LineChart, ManySeries_StandSideBySide) {
  Chart chart = lines();
  chart.series.assign(8, {"program", {point("", 5.0, 1.0), point("", 5.0, 4.0)}});
  const Image image = draw_chart(chart).image();
  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    const std::optional<Vec2> place = place_in_chart(chart, s, 1);
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->x(), place_in_chart(chart, 0, 1)->x() + 5.0 * static_cast<double>(s), 1e-6);
    // The interval's bar below the mean, not covered by the other means.
    EXPECT_NE(pixel(image, *place + Vec2(0.0, 40.0)), pixel(image, *place + Vec2(30.0, 40.0)));
  }
  const std::string svg = draw_chart(chart).svg();
  EXPECT_THAT(svg, HasSubstr(">2<"));
  EXPECT_THAT(svg, Not(HasSubstr(">2.5<"))) << "the parameters are whole numbers";
}

// Equal, huge, tiny and no values: all means are on the page, and the axis has some ticks.
TEST(Charts, UnusualValues_AreOnThePage) {
  for (const std::vector<double>& values : {std::vector<double>{},
                                            {0.0},
                                            {0.0, 0.0},
                                            {0.1, 0.1},
                                            {-3.0, -2.0},
                                            {-1e300, 1e300},
                                            {1e-300, 3e-300},
                                            {1e9, 1e9 + 1e-7},
                                            {5e12, 5e12 + 1.0}}) {
    for (const bool with_x : {false, true}) {
      Chart chart;
      chart.x_name = with_x ? "x" : "";
      chart.series.resize(1);
      for (const double value : values) {
        chart.series[0].points.push_back(point(std::to_string(value), value, value));
        chart.series[0].points.back().interval = {value, value};
      }
      const Image image = draw_chart(chart).image();
      for (std::size_t p = 0; p < values.size(); ++p) {
        const std::optional<Vec2> place = place_in_chart(chart, 0, p);
        ASSERT_TRUE(place);
        ASSERT_GT(place->x(), 30.0);
        ASSERT_LT(place->x(), 980.0);
        ASSERT_GT(place->y(), 30.0);
        ASSERT_LT(place->y(), image.height - 50.0);
        EXPECT_EQ(pixel(image, *place), sim::render::distinct_colour(0)) << values[p];
      }
    }
  }
}

TEST(Charts, EqualCharts_EqualFiles) {
  const test_support::TemporaryFolder folder;
  const auto bytes = [&](const Chart& chart, const std::string& name) {
    write_chart(chart, folder / name);
    return test_support::read_bytes(folder / name);
  };
  const std::string first = bytes(rows(), "first.png");
  EXPECT_EQ(first.substr(1, 3), "PNG");
  EXPECT_EQ(bytes(rows(), "second.png"), first);
  EXPECT_NE(bytes(lines(), "third.png"), first);
  EXPECT_THROW(write_chart(rows(), folder / "none/chart.png"), std::runtime_error);
}

}  // namespace
}  // namespace playpen::batch
