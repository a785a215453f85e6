// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "physics/hilbert_curve.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <utility>

namespace sim {
namespace {

std::uint32_t along(int x, int y) {
  return along_hilbert_curve({kHilbertSquare_m * (x + 0.5), kHilbertSquare_m * (y + 0.5)});
}

TEST(HilbertCurve, VisitsEachSquareOnceFromNeighbourToNeighbour) {
  // The curve passes through every block of 32 x 32 squares, at multiples of 32, without leaving
  // it.
  for (const auto& [x0, y0] : {std::pair{0, 0}, {-32, 0}, {64, -96}, {-4096, 2048}}) {
    std::map<std::uint32_t, std::pair<int, int>> squares;
    for (int x = x0; x < x0 + 32; ++x) {
      for (int y = y0; y < y0 + 32; ++y) squares[along(x, y)] = {x, y};
    }
    ASSERT_EQ(squares.size(), 32U * 32U) << "no two squares at one place";
    ASSERT_EQ(squares.rbegin()->first - squares.begin()->first, 32U * 32U - 1U);
    for (auto it = squares.begin(), next = std::next(it); next != squares.end(); it = next++) {
      const auto& [ax, ay] = it->second;
      const auto& [bx, by] = next->second;
      ASSERT_EQ(std::abs(ax - bx) + std::abs(ay - by), 1) << ax << ", " << ay;
    }
  }
}

TEST(HilbertCurve, StartsAndEndsAtLowerCorners) {
  EXPECT_EQ(along_hilbert_curve({-1e9, -1e9}), 0U);
  EXPECT_EQ(along_hilbert_curve({1e9, -1e9}), 0xffffffffU);
  EXPECT_EQ(along_hilbert_curve({-8191.9, -8191.9}), 0U);
}

}  // namespace
}  // namespace sim
