// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/replay/columns.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "grade/text.h"
#include "replay/replay_page.h"

namespace {

using playerlike::replay::Columns;
using playerlike::replay::kNoNumber;
using playerlike::replay::quantised;
using playpen::grade::markup_escaped;
using playpen::replay::deflated;

std::vector<int> bytes_of(const std::vector<std::int64_t>& values, std::size_t lag = 1) {
  Columns columns;
  columns.add(values, lag);
  std::vector<int> bytes;
  for (const char byte : columns.bytes()) bytes.push_back(static_cast<unsigned char>(byte));
  return bytes;
}

TEST(ReplayColumns, DifferencesAreZigzagVarints) {
  // Differences 5, -6, 1, 300: zigzag 10, 11, 2, 600 = 0b100'1011000.
  EXPECT_THAT(bytes_of({5, -1, 0, 300}), testing::ElementsAre(10, 11, 2, 0xd8, 0x04));
}

TEST(ReplayColumns, LagComparesRecords) {
  // Records (7, 100) and (8, 100): differences 7, 100, 1, 0.
  EXPECT_THAT(bytes_of({7, 100, 8, 100}, 2), testing::ElementsAre(14, 0xc8, 0x01, 2, 0));
}

TEST(ReplayColumns, WideColumnsAreMarked) {
  Columns columns;
  columns.add(std::vector<std::int64_t>{std::numeric_limits<std::int32_t>::max()});
  columns.add(std::vector<std::int64_t>{std::int64_t{1} << 31});
  columns.add(std::vector<std::int64_t>{});
  ASSERT_EQ(columns.entries().size(), 3U);
  EXPECT_FALSE(columns.entries()[0].wide);
  EXPECT_TRUE(columns.entries()[1].wide);
  EXPECT_EQ(columns.entries()[1].offset, 5U);
  EXPECT_EQ(columns.entries()[2].count, 0U);
  EXPECT_EQ(columns.entries()[2].offset, 10U);
}

TEST(ReplayColumns, NumbersBeyondJavaScriptAreClamped) {
  EXPECT_EQ(bytes_of({std::numeric_limits<std::int64_t>::max()}),
            bytes_of({std::int64_t{1} << 52}));
}

TEST(ReplayColumns, QuantisedRoundsAndMarksWhatIsNoNumber) {
  EXPECT_EQ(quantised(1.23456, 1e-4), 12346);
  EXPECT_EQ(quantised(-0.00005001, 1e-4), -1);
  EXPECT_EQ(quantised(std::nan(""), 1e-4), kNoNumber);
  EXPECT_EQ(quantised(std::numeric_limits<double>::infinity(), 1e-4), kNoNumber);
  EXPECT_EQ(quantised(1e9, 1e-4), kNoNumber);
}

TEST(ReplayColumns, DeflatedIsZlibFormat) {
  const std::vector<std::uint8_t> packed = deflated(std::string(10000, 'a'));
  ASSERT_GT(packed.size(), 2U);
  EXPECT_LT(packed.size(), 100U);
  // RFC 1950: the first byte says deflate with a window of 32 KB; both bytes are a multiple of 31.
  EXPECT_EQ(packed[0], 0x78);
  EXPECT_EQ((packed[0] * 256 + packed[1]) % 31, 0);
}

TEST(ReplayColumns, MarkupIsEscaped) {
  EXPECT_EQ(markup_escaped("</title><script>\"'&"), "&lt;/title&gt;&lt;script&gt;&quot;&#39;&amp;");
}

}  // namespace
