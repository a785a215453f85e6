// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/canvas/canvas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "sim/core/state_archive.h"

namespace sim {
namespace {

using Cell = std::pair<int, int>;

constexpr Colour kRed{255, 0, 0, 255};
constexpr Colour kBlue{0, 0, 255, 255};
constexpr int kLeastInt = std::numeric_limits<int>::min();
constexpr int kGreatestInt = std::numeric_limits<int>::max();

Canvas canvas_of(int width, int height) {
  return Canvas({.width = width, .height = height, .cell_size_m = 0.5, .origin = {-1.0, 2.0}});
}

std::set<Cell> drawn_cells(const Canvas& canvas) {
  std::set<Cell> cells;
  for (int row = 0; row < canvas.height(); ++row) {
    for (int column = 0; column < canvas.width(); ++column) {
      if (canvas.pixel(column, row)->a != 0) cells.emplace(column, row);
    }
  }
  return cells;
}

// The common form of Bresenham's algorithm, without clipping: starts at the end with the smaller
// coordinate on the longer axis, and accumulates an error.
std::set<Cell> unclipped_line(int x0, int y0, int x1, int y1) {
  const bool steep = std::abs(y1 - y0) > std::abs(x1 - x0);
  if (steep) {
    std::swap(x0, y0);
    std::swap(x1, y1);
  }
  if (x0 > x1) {
    std::swap(x0, x1);
    std::swap(y0, y1);
  }
  const int dx = x1 - x0;
  const int dy = std::abs(y1 - y0);
  int decision = 2 * dy - dx;
  std::set<Cell> cells;
  for (int x = x0, y = y0; x <= x1; ++x) {
    cells.insert(steep ? Cell{y, x} : Cell{x, y});
    if (decision >= 0) {
      y += y1 < y0 ? -1 : 1;
      decision -= 2 * dx;
    }
    decision += 2 * dy;
  }
  return cells;
}

TEST(Canvas, InitiallyTransparentBlack) {
  const Canvas canvas = canvas_of(3, 2);
  EXPECT_EQ(canvas.data(), std::vector<std::uint8_t>(3 * 2 * 4, 0));
}

TEST(Canvas, Cells_CountedFromTopLeft) {
  // Cells of 0.5 m with the origin (-1, 2); 4 rows, so that row 0 covers y from 3.5 to 4.
  const Canvas canvas = canvas_of(6, 4);
  EXPECT_EQ(canvas.column(-1.0), 0);
  EXPECT_EQ(canvas.column(-0.51), 0);
  EXPECT_EQ(canvas.column(-0.5), 1);
  EXPECT_EQ(canvas.column(-1.01), -1);
  EXPECT_EQ(canvas.column(2.0), 6);
  EXPECT_EQ(canvas.row(2.0), 3);
  EXPECT_EQ(canvas.row(3.99), 0);
  EXPECT_EQ(canvas.row(4.0), -1);
  EXPECT_EQ(canvas.row(1.99), 4);
}

TEST(Canvas, FarCoordinates_Saturate) {
  const Canvas canvas = canvas_of(6, 4);
  constexpr int kLimit = 1 << 30;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(canvas.column(1e300), kLimit);
  EXPECT_EQ(canvas.column(-kInfinity), -kLimit);
  EXPECT_EQ(canvas.row(-1e300), kLimit);
  EXPECT_EQ(canvas.row(kInfinity), 4 - 1 - kLimit);
  EXPECT_FALSE(canvas.contains(canvas.column(std::numeric_limits<double>::quiet_NaN()), 0));
}

TEST(Canvas, SetPixel_ChangesNoOther) {
  Canvas canvas = canvas_of(5, 4);
  canvas.set_pixel(4, 0, kRed);
  EXPECT_EQ(drawn_cells(canvas), (std::set<Cell>{{4, 0}}));
  EXPECT_EQ(canvas.pixel(4, 0), kRed);
  // Row-major from the top: the last cell of the first row begins at byte 4 * 4.
  EXPECT_EQ(canvas.data()[16], 255);
  EXPECT_EQ(canvas.data()[19], 255);
}

TEST(Canvas, Outside_IgnoredAndNotRead) {
  Canvas canvas = canvas_of(5, 4);
  for (const auto& [column, row] :
       {Cell{-1, 0}, {5, 0}, {0, -1}, {0, 4}, {kLeastInt, kGreatestInt}}) {
    canvas.set_pixel(column, row, kRed);
    EXPECT_EQ(canvas.pixel(column, row), std::nullopt);
  }
  EXPECT_TRUE(drawn_cells(canvas).empty());
}

TEST(Canvas, TranslucentColours_Blended) {
  Canvas canvas = canvas_of(3, 1);
  canvas.set_pixel(0, 0, {200, 100, 0, 255});
  canvas.set_pixel(0, 0, {0, 0, 255, 51});
  // Alpha 51/255 = 1/5 over an opaque cell: 200 * 4/5 = 160, 100 * 4/5 = 80, 255 / 5 = 51.
  EXPECT_EQ(canvas.pixel(0, 0), (Colour{160, 80, 51, 255}));

  canvas.set_pixel(1, 0, {10, 20, 30, 100});  // over a transparent cell: unchanged
  EXPECT_EQ(canvas.pixel(1, 0), (Colour{10, 20, 30, 100}));

  canvas.set_pixel(2, 0, {255, 0, 0, 51});
  canvas.set_pixel(2, 0, {0, 0, 255, 51});
  // Alpha 1/5 + 1/5 * 4/5 = 9/25 = 91.8 / 255; red (4/25) / (9/25) = 4/9 of 255 = 113.3, blue 5/9
  // of 255 = 141.7.
  EXPECT_EQ(canvas.pixel(2, 0), (Colour{113, 0, 142, 92}));
}

TEST(Canvas, AlphaZero_ChangesNothing) {
  Canvas canvas = canvas_of(2, 1);
  canvas.set_pixel(0, 0, {1, 2, 3, 4});
  canvas.set_pixel(0, 0, {255, 255, 255, 0});
  canvas.set_pixel(1, 0, {255, 255, 255, 0});
  EXPECT_EQ(canvas.pixel(0, 0), (Colour{1, 2, 3, 4}));
  EXPECT_EQ(canvas.pixel(1, 0), (Colour{0, 0, 0, 0}));
}

TEST(Canvas, Clear_ReplacesEveryCell) {
  Canvas canvas = canvas_of(7, 3);
  canvas.draw_line(0, 0, 6, 2, kRed);
  canvas.clear({9, 8, 7, 6});
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 7; ++column) {
      EXPECT_EQ(canvas.pixel(column, row), (Colour{9, 8, 7, 6}));
    }
  }
  canvas.clear();
  EXPECT_TRUE(drawn_cells(canvas).empty());
}

TEST(CanvasLine, ShallowLine_DrawsBothEnds) {
  Canvas canvas = canvas_of(6, 4);
  canvas.draw_line(0, 0, 5, 2, kRed);
  // y = 0.4 x, rounded: 0, 0.4, 0.8, 1.2, 1.6, 2.
  EXPECT_EQ(drawn_cells(canvas), (std::set<Cell>{{0, 0}, {1, 0}, {2, 1}, {3, 1}, {4, 2}, {5, 2}}));
}

TEST(CanvasLine, OnePoint_OnePixel) {
  Canvas canvas = canvas_of(6, 4);
  canvas.draw_line(2, 3, 2, 3, kBlue);
  canvas.draw_line(-2, 3, -2, 3, kBlue);
  EXPECT_EQ(drawn_cells(canvas), (std::set<Cell>{{2, 3}}));
}

TEST(CanvasLine, ClippedLine_SameCellsAsUnclipped) {
  std::mt19937 random(7);  // its output is the same everywhere, unlike distributions'
  const auto coordinate = [&] { return static_cast<int>(random() % 121) - 50; };
  for (int i = 0; i < 20000; ++i) {
    const int width = 1 + static_cast<int>(random() % 24);
    const int height = 1 + static_cast<int>(random() % 24);
    const int x0 = coordinate();
    const int y0 = coordinate();
    const int x1 = coordinate();
    const int y1 = coordinate();
    std::set<Cell> expected = unclipped_line(x0, y0, x1, y1);
    Canvas canvas = canvas_of(width, height);
    std::erase_if(expected,
                  [&](const Cell& cell) { return !canvas.contains(cell.first, cell.second); });
    canvas.draw_line(x0, y0, x1, y1, kRed);
    ASSERT_EQ(drawn_cells(canvas), expected) << "(" << x0 << ", " << y0 << ") to (" << x1 << ", "
                                             << y1 << ") on " << width << " x " << height;
    Canvas backward = canvas_of(width, height);
    backward.draw_line(x1, y1, x0, y0, kRed);
    ASSERT_EQ(backward.data(), canvas.data());
  }
}

TEST(CanvasLine, EachCell_TouchedOnce) {
  Canvas canvas = canvas_of(20, 20);
  canvas.draw_line(-7, 3, 31, 17, {255, 0, 0, 100});
  for (const auto& [column, row] : drawn_cells(canvas)) {
    EXPECT_EQ(canvas.pixel(column, row)->a, 100);
  }
}

TEST(CanvasLine, ExtremeCoordinates_Accepted) {
  // From corner to corner of all ints, 2^32 - 1 steps each way: the diagonal y = x.
  Canvas diagonal = canvas_of(4, 4);
  diagonal.draw_line(kLeastInt, kLeastInt, kGreatestInt, kGreatestInt, kRed);
  EXPECT_EQ(drawn_cells(diagonal), (std::set<Cell>{{0, 0}, {1, 1}, {2, 2}, {3, 3}}));

  // The other diagonal: y = -1 - x has no cell with both coordinates >= 0.
  Canvas other = canvas_of(4, 4);
  other.draw_line(kLeastInt, kGreatestInt, kGreatestInt, kLeastInt, kRed);
  EXPECT_TRUE(drawn_cells(other).empty());

  // From (-2^31, 0) to (2^31 - 1, 1): row 1 from the middle, x = 0, on. In numbers: column x is
  // step x + 2^31 of 2^32 - 1, and 2^31 / (2^32 - 1) is just over 1/2.
  Canvas flat = canvas_of(3, 3);
  flat.draw_line(kLeastInt, 0, kGreatestInt, 1, kRed);
  EXPECT_EQ(drawn_cells(flat), (std::set<Cell>{{0, 1}, {1, 1}, {2, 1}}));

  Canvas upright = canvas_of(3, 3);
  upright.draw_line(1, kGreatestInt, 1, kLeastInt, kRed);
  EXPECT_EQ(drawn_cells(upright), (std::set<Cell>{{1, 0}, {1, 1}, {1, 2}}));
}

TEST(Canvas, State_DistinguishesContentsAndShapes) {
  const auto state_of = [](Canvas canvas) {
    StateArchive archive;
    canvas.archive(archive);
    return archive.take();
  };
  Canvas canvas = canvas_of(6, 4);
  const std::vector<std::uint8_t> bare = state_of(canvas);
  EXPECT_NE(state_of(canvas_of(4, 6)), bare);
  canvas.set_pixel(5, 3, kRed);
  const std::vector<std::uint8_t> drawn = state_of(canvas);
  EXPECT_NE(drawn, bare);
  Canvas other = canvas_of(1, 1);
  StateArchive reader(drawn);
  other.archive(reader);
  EXPECT_EQ(other.data(), canvas.data());
  canvas.clear();
  EXPECT_EQ(state_of(canvas), bare);
}

TEST(ColourText, ThreeForms_Read) {
  EXPECT_EQ(parse_colour("#f80"), (Colour{0xff, 0x88, 0x00, 255}));
  EXPECT_EQ(parse_colour("#34AAff"), (Colour{0x34, 0xaa, 0xff, 255}));
  EXPECT_EQ(parse_colour("#01020304"), (Colour{1, 2, 3, 4}));
}

TEST(ColourText, OtherTexts_Refused) {
  for (const char* text : {"", "#", "f80", "#f8", "#ff88", "#ff880", "#gg0000", "#ff88001", "red",
                           "#ff88 0", "0ff8800", "#ff880011f"}) {
    EXPECT_EQ(parse_colour(text), std::nullopt) << text;
  }
}

TEST(ColourText, RoundTrips) {
  EXPECT_EQ(to_string(Colour{0x34, 0xaa, 0xff, 255}), "#34aaff");
  EXPECT_EQ(to_string(Colour{1, 2, 3, 4}), "#01020304");
}

}  // namespace
}  // namespace sim
