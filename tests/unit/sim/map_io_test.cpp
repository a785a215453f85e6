// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/map_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "canvas/image_file.h"
#include "device_table.h"
#include "outlines.h"
#include "sim/io/world_io.h"
#include "temporary_folder.h"

namespace sim::io {
namespace {

using testing::ElementsAre;
using testing::SizeIs;

/// A grid from text: # is solid, . is free, the top row first.
OccupancyGrid grid_of(const std::vector<std::string>& rows) {
  OccupancyGrid grid;
  grid.width = static_cast<int>(rows.front().size());
  grid.height = static_cast<int>(rows.size());
  for (const std::string& row : rows) {
    for (const char c : row) grid.solid.push_back(c == '#' ? 1 : 0);
  }
  return grid;
}

std::vector<WallLoop> trace(const std::vector<std::string>& rows) {
  return trace_walls(grid_of(rows), Vec2::Zero(), 1.0).value();
}

/// Twice the enclosed area, positive if the loop is counter-clockwise.
double doubled_area(const WallLoop& loop) {
  double sum = 0.0;
  for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
    const Vec2& a = loop.vertices[i];
    const Vec2& b = loop.vertices[(i + 1) % loop.vertices.size()];
    sum += a.x() * b.y() - b.x() * a.y();
  }
  return sum;
}

TEST(TraceWalls, OneCell_CounterClockwiseSquareFromBottomLeft) {
  const std::vector<WallLoop> loops = trace({"...",  //
                                             "..#",  //
                                             "..."});
  ASSERT_THAT(loops, SizeIs(1));
  EXPECT_THAT(loops[0].vertices, ElementsAre(Vec2(2, 1), Vec2(3, 1), Vec2(3, 2), Vec2(2, 2)));
}

TEST(TraceWalls, RowZero_TopOfPicture) {
  const std::vector<WallLoop> loops = trace({"#.",  //
                                             ".."});
  ASSERT_THAT(loops, SizeIs(1));
  EXPECT_EQ(loops[0].vertices.front(), Vec2(0, 1));
}

TEST(TraceWalls, CollinearEdges_Merged) {
  const std::vector<WallLoop> loops = trace({"####",  //
                                             "####"});
  ASSERT_THAT(loops, SizeIs(1));
  EXPECT_THAT(loops[0].vertices, ElementsAre(Vec2(0, 0), Vec2(4, 0), Vec2(4, 2), Vec2(0, 2)));
}

TEST(TraceWalls, Holes_Clockwise) {
  const std::vector<WallLoop> loops = trace({"####",  //
                                             "#..#",  //
                                             "####"});
  ASSERT_THAT(loops, SizeIs(2));
  EXPECT_EQ(doubled_area(loops[0]), 2 * 12.0);
  EXPECT_EQ(doubled_area(loops[1]), -2 * 2.0);
  // The first edge of the hole with free space below it is its ceiling.
  EXPECT_THAT(loops[1].vertices, ElementsAre(Vec2(1, 2), Vec2(3, 2), Vec2(3, 1), Vec2(1, 1)));
}

TEST(TraceWalls, CellsThatMeetAtCorner_SeparateOutlines) {
  for (const std::vector<std::string>& rows :
       {std::vector<std::string>{"#.", ".#"}, std::vector<std::string>{".#", "#."}}) {
    const std::vector<WallLoop> loops = trace(rows);
    ASSERT_THAT(loops, SizeIs(2));
    for (const WallLoop& loop : loops) {
      EXPECT_THAT(loop.vertices, SizeIs(4));
      EXPECT_EQ(doubled_area(loop), 2.0);
    }
  }
}

TEST(TraceWalls, FreeCellsThatMeetAtCorner_OneHole) {
  // The two solid cells in the middle share no side, so the hole passes between them.
  const std::vector<WallLoop> loops = trace({"####",  //
                                             "#.##",  //
                                             "##.#",  //
                                             "####"});
  ASSERT_THAT(loops, SizeIs(2));
  EXPECT_EQ(doubled_area(loops[1]), -2 * 2.0);
  EXPECT_THAT(loops[1].vertices, SizeIs(8));
}

TEST(TraceWalls, OriginAndResolution_PlaceOutline) {
  const std::vector<WallLoop> loops = trace_walls(grid_of({".#"}), Vec2(-1.0, 2.0), 0.5).value();
  ASSERT_THAT(loops, SizeIs(1));
  EXPECT_THAT(loops[0].vertices,
              ElementsAre(Vec2(-0.5, 2.0), Vec2(0, 2.0), Vec2(0, 2.5), Vec2(-0.5, 2.5)));
}

TEST(TraceWalls, NothingSolid_NoLoops) { EXPECT_THAT(trace({"..", ".."}), SizeIs(0)); }

TEST(TraceWalls, RandomGrids_KeepAreaAndAlternateEdges) {
  std::mt19937 random(1);
  for (int round = 0; round < 50; ++round) {
    OccupancyGrid grid{17, 13, {}};
    double solid = 0.0;
    for (int i = 0; i < 17 * 13; ++i) {
      grid.solid.push_back(random() % 2U == 0 ? 1 : 0);
      solid += grid.solid.back();
    }
    double doubled = 0.0;
    const std::vector<WallLoop> loops = trace_walls(grid, Vec2::Zero(), 1.0).value();
    for (const WallLoop& loop : loops) {
      doubled += doubled_area(loop);
      ASSERT_GE(loop.vertices.size(), 4U);
      for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
        const Vec2 first = loop.vertices[(i + 1) % loop.vertices.size()] - loop.vertices[i];
        const Vec2 second = loop.vertices[(i + 2) % loop.vertices.size()] -
                            loop.vertices[(i + 1) % loop.vertices.size()];
        // Axis-parallel edges with a corner at every vertex: nothing is left to merge.
        EXPECT_EQ(first.dot(second), 0.0);
        EXPECT_GT(first.norm(), 0.0);
      }
    }
    // Outer rings count positive and holes negative: the sum is the area of the solid cells.
    EXPECT_EQ(doubled, 2.0 * solid);
  }
}

TEST(TraceWalls, TooManyEdges_Refused) {
  // Every second cell of every second row is solid: each has 4 edges, so 1200 x 1200 cells give
  // 1.44 million.
  OccupancyGrid grid{1200, 1200, std::vector<std::uint8_t>(1200 * 1200, 0)};
  for (std::size_t row = 0; row < 1200; row += 2) {
    for (std::size_t column = 0; column < 1200; column += 2) grid.solid[row * 1200 + column] = 1;
  }
  EXPECT_FALSE(trace_walls(grid, Vec2::Zero(), 1.0).has_value());
}

TEST(TraceWalls, FourMillionCells_TracedWithinSecond) {
  OccupancyGrid grid{2000, 2000, std::vector<std::uint8_t>(4'000'000, 0)};
  // Rooms of 50 cells with walls of 2 cells, each with a door of 10 cells.
  for (std::size_t row = 0; row < 2000; ++row) {
    for (std::size_t column = 0; column < 2000; ++column) {
      const bool wall_row = row % 50 < 2 && column % 50 >= 12;
      const bool wall_column = column % 50 < 2 && row % 50 >= 12;
      grid.solid[row * 2000 + column] = wall_row || wall_column ? 1 : 0;
    }
  }
  const auto start = std::chrono::steady_clock::now();
  const std::optional<std::vector<WallLoop>> loops = trace_walls(grid, Vec2::Zero(), 0.01);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  ASSERT_TRUE(loops.has_value());
  EXPECT_GT(loops->size(), 100U);
  // Measured 0.03 s in a Release build; the bound leaves room for sanitizers and busy machines.
  EXPECT_LT(taken.count(), 1.0);
}

/// A separate folder for each test, removed at its end.
class MapIo : public testing::Test {
 protected:
  MapIo() {
    std::string pattern = (std::filesystem::temp_directory_path() / "map_io_test_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~MapIo() override { std::filesystem::remove_all(folder_); }

  void write_pgm(const char* name, int width, int height, const std::string& pixels) const {
    std::ofstream(folder_ / name, std::ios::binary) << "P5\n"
                                                    << width << " " << height << "\n255\n"
                                                    << pixels;
  }
  [[nodiscard]] WorldDescription read(std::string_view text) const {
    return read_world_text(text, (folder_ / "world.json").string(), test::device_table());
  }

  std::filesystem::path folder_;
};

TEST_F(MapIo, DarkPixels_WallsAndFloorOfPictureSize) {
  // Grey 100 is darker than half of 255; 128 is not.
  write_pgm("m.pgm", 3, 2, std::string("\xff\x64\x80\xff\xff\xff", 6));
  const WorldDescription world =
      read(R"({"arena": {"map": {"image": "m.pgm", "resolution": 0.5, "origin": [1, 2]}},
               "robots": []})");
  EXPECT_EQ(world.arena.size, Vec2(1.5, 1.0));
  EXPECT_EQ(world.arena.origin, Vec2(1, 2));
  ASSERT_THAT(world.arena.walls, SizeIs(1));
  EXPECT_EQ(world.arena.walls[0].vertices.front(), Vec2(1.5, 2.5));
  // The canvas covers the floor: 1.5 / 0.02 = 75 cells, rounded up to an even number.
  EXPECT_EQ(world.canvas.width, 76);
  EXPECT_EQ(world.canvas.height, 50);
  EXPECT_EQ(world.canvas.origin, Vec2(1, 2));
}

TEST(SimplifyWalls, Staircase_OneEdgeButCornersKept) {
  // A triangle with steps of 1 and its right angle at (20, 0), and a single cell.
  std::vector<std::string> rows(20, std::string(23, '.'));
  for (std::size_t row = 0; row < 20; ++row) {
    for (std::size_t column = 19 - row; column < 20; ++column) rows[19 - row][column] = '#';
  }
  std::reverse(rows.begin(), rows.end());
  rows[0][22] = '#';
  std::vector<WallLoop> loops = trace(rows);
  ASSERT_THAT(loops, SizeIs(2));
  const std::vector<WallLoop> before = loops;
  simplify_walls(loops, 1.0);
  EXPECT_LE(loops[0].vertices.size(), 5U);
  EXPECT_GE(before[0].vertices.size(), 40U);
  EXPECT_EQ(loops[1].vertices, before[1].vertices);
  // The triangle's area is that of its cells (210), plus or minus the width of the steps.
  EXPECT_NEAR(0.5 * doubled_area(loops[0]), 210.0, 20.0 * std::sqrt(2.0) * 1.0);
  // Every corner of the steps is within the tolerance of the simplified outline.
  for (const Vec2& p : before[0].vertices) {
    EXPECT_LE(test::distance_to_outline_m(p, loops[0].vertices), 1.0 + 1e-9);
  }
}

TEST_F(MapIo, Threshold_SelectsDarkPixels) {
  write_pgm("m.pgm", 2, 1, std::string("\x32\xc8", 2));  // grey levels 50 and 200
  const auto walls = [this](const char* threshold) {
    return read(std::string(R"({"robots": [], "arena": {"map": {"image": "m.pgm", )") +
                "\"occupied_threshold\": " + threshold + "}}}")
        .arena.walls.size();
  };
  EXPECT_EQ(walls("0.1"), 0U);  // 25.5: none of them
  EXPECT_EQ(walls("0.5"), 1U);  // 127.5: the first
  ASSERT_EQ(walls("1"), 1U);    // both, as one block
}

TEST_F(MapIo, SizeAndOriginOfArena_Used) {
  write_pgm("m.pgm", 2, 1, std::string("\xff\xff", 2));
  const WorldDescription world =
      read(R"({"robots": [], "arena": {"size": [5, 4], "origin": [-1, -1],
               "map": {"image": "m.pgm"}}})");
  EXPECT_EQ(world.arena.size, Vec2(5, 4));
  EXPECT_EQ(world.arena.origin, Vec2(-1, -1));
  EXPECT_EQ(world.arena.maps.at(0).origin, Vec2(-1, -1));
}

TEST_F(MapIo, TooLargePicture_Refused) {
  write_pgm("m.pgm", 8193, 1, std::string(8193, '\xff'));
  try {
    static_cast<void>(read(R"({"arena": {"map": {"image": "m.pgm"}}})"));
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    ASSERT_THAT(error.issues(), SizeIs(1)) << error.what();
    EXPECT_EQ(error.issues()[0].id, "world/map-too-large");
    EXPECT_EQ(error.issues()[0].found, "8193 x 1");
  }
}

TEST_F(MapIo, Noise_RefusedAsTooComplex) {
  std::string pixels(1200 * 1200, '\xff');
  for (std::size_t row = 0; row < 1200; row += 2) {
    for (std::size_t column = 0; column < 1200; column += 2) pixels[row * 1200 + column] = '\0';
  }
  write_pgm("m.pgm", 1200, 1200, pixels);
  try {
    static_cast<void>(read(R"({"arena": {"map": {"image": "m.pgm"}}})"));
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    ASSERT_THAT(error.issues(), SizeIs(1)) << error.what();
    EXPECT_EQ(error.issues()[0].id, "world/map-too-complex");
  }
}

/// load_grey_image()'s error for a file with these bytes.
std::string picture_refusal(const std::string& bytes) {
  const test_support::TemporaryFolder folder;
  try {
    static_cast<void>(load_grey_image(folder.write("picture", bytes)));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "loaded";
}

std::string big_endian(std::uint32_t n) {
  return {static_cast<char>(n >> 24U), static_cast<char>(n >> 16U), static_cast<char>(n >> 8U),
          static_cast<char>(n)};
}

TEST(LoadGreyImage, HugePicture_RefusedByHeader) {
  const std::string start = std::string("\x89PNG\r\n\x1a\n") + big_endian(13) + "IHDR";
  for (const auto& [width, height] : {std::pair(0x7fffffffU, 0x7fffffffU), std::pair(100'000U, 1U),
                                      std::pair(16384U, 16384U), std::pair(8193U, 16384U)}) {
    EXPECT_THAT(picture_refusal(start + big_endian(width) + big_endian(height)),
                testing::HasSubstr("are supported"))
        << width << " x " << height;
    EXPECT_THAT(
        picture_refusal("P5 " + std::to_string(width) + ' ' + std::to_string(height) + " 255\n"),
        testing::HasSubstr("are supported"))
        << width << " x " << height;
  }
  // The size is within the limits, but the pixels are missing.
  EXPECT_THAT(picture_refusal("P5 8192 8192 255\n"), testing::HasSubstr("cut short"));
  EXPECT_THAT(picture_refusal("P2 8192 8192 255\n"), testing::HasSubstr("cut short"));
  EXPECT_THAT(picture_refusal("P5 99999999999999999999 1 255\n"),
              testing::HasSubstr("are supported"));
}

}  // namespace
}  // namespace sim::io
