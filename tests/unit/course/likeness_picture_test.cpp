// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "course/likeness_picture.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>

namespace playpen::course {
namespace {

Drive line(double from_x, double to_x, double y) {
  Drive drive;
  for (int k = 0; k <= 10; ++k) {
    drive.time_s.push_back(k);
    drive.X_WB.push_back({from_x + (to_x - from_x) * 0.1 * k, y, 0.0});
  }
  return drive;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

struct Pictures {
  sim::ArenaDescription arena;
  Drive first = line(0.5, 2.5, 1.0);
  Drive second = line(0.5, 2.5, 1.1);

  [[nodiscard]] sim::render::Drawing of(std::optional<double> parted_s) const {
    return pair_picture({"ada", "bob <b>", "cave, seed 3", arena, first, second, parted_s});
  }
};

TEST(LikenessPicture, TwoDrives_HaveNamesRunAndEnd) {
  const std::string svg = Pictures().of(4.0).svg();
  for (const char* text : {"ada", "bob &lt;b&gt;", "cave, seed 3", "part after 4 s (crosses)"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
  EXPECT_NE(Pictures().of(std::nullopt).svg().find("never part"), std::string::npos);
}

TEST(LikenessPicture, PartedDrives_HaveCrossesAndFaintRests) {
  // A cross has two lines, a rest one; two drives.
  const std::size_t together = count(Pictures().of(std::nullopt).svg(), "<polyline");
  ASSERT_GT(together, 0U);
  EXPECT_EQ(count(Pictures().of(4.0).svg(), "<polyline"), together + 6);
}

TEST(LikenessPicture, HighArena_GetsAHighPage) {
  Pictures pictures;
  const int height = pictures.of(std::nullopt).image().height;
  pictures.arena.size.y() *= 1.2;
  EXPECT_GT(pictures.of(std::nullopt).image().height, height);
  pictures.arena.size = {0.01, 100.0};
  EXPECT_LE(pictures.of(std::nullopt).image().height, 8192);
}

TEST(LikenessPicture, EmptyDrives_DrawTheArenaOnly) {
  Pictures pictures;
  pictures.first = pictures.second = {};
  EXPECT_GT(pictures.of(1.0).image().width, 0);
}

}  // namespace
}  // namespace playpen::course
