// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "render/modules/yuv_converter.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sim::render::modules {
namespace {

// The planes of a film of 40 x 4 pixels, filled with a value that the converter must overwrite.
struct Frame {
  static constexpr int kWidth = 40;
  static constexpr int kHeight = 4;
  std::vector<std::uint8_t> y = std::vector<std::uint8_t>(42 * kHeight, 1);  // two more columns
  std::vector<std::uint8_t> u = std::vector<std::uint8_t>(21 * kHeight / 2, 1);
  std::vector<std::uint8_t> v = std::vector<std::uint8_t>(21 * kHeight / 2, 1);

  YuvConverter::Planes planes() { return {{y.data(), u.data(), v.data()}, {42, 21, 21}}; }
  friend bool operator==(const Frame&, const Frame&) = default;
};

using Picture = std::vector<std::uint8_t>;

Picture filled(int red, int green, int blue) {
  Picture picture;
  for (int i = 0; i < Frame::kWidth * Frame::kHeight; ++i) {
    for (const int channel : {red, green, blue}) {
      picture.push_back(static_cast<std::uint8_t>(channel));
    }
  }
  return picture;
}

constexpr std::size_t kStride = 3 * static_cast<std::size_t>(Frame::kWidth);

std::array<int, 3> yuv_of(const Picture& picture, bool full_range) {
  YuvConverter converter(Frame::kWidth, Frame::kHeight, full_range);
  Frame frame;
  converter.convert(picture.data(), kStride, frame.planes());
  return {frame.y[35], frame.u[7], frame.v[7]};
}

// BT.601-7, table 3: the colour bars of 100 %, in 8 bits.
TEST(YuvConverter, ColourBars_AsInTheStandard) {
  using Yuv = std::array<int, 3>;
  EXPECT_EQ(yuv_of(filled(255, 255, 255), false), (Yuv{235, 128, 128}));
  EXPECT_EQ(yuv_of(filled(0, 0, 0), false), (Yuv{16, 128, 128}));
  EXPECT_EQ(yuv_of(filled(255, 0, 0), false), (Yuv{81, 90, 240}));
  EXPECT_EQ(yuv_of(filled(0, 255, 0), false), (Yuv{145, 54, 34}));
  EXPECT_EQ(yuv_of(filled(0, 0, 255), false), (Yuv{41, 240, 110}));
  // In the full range, V of red is 128 + 127.5, which is limited to 255.
  EXPECT_EQ(yuv_of(filled(255, 255, 255), true), (Yuv{255, 128, 128}));
  EXPECT_EQ(yuv_of(filled(0, 0, 0), true), (Yuv{0, 128, 128}));
  EXPECT_EQ(yuv_of(filled(255, 0, 0), true), (Yuv{76, 85, 255}));
}

TEST(YuvConverter, Chroma_MeanOfFourPixels) {
  Picture picture = filled(0, 0, 0);
  picture[2 * kStride + 3 * 4 + 2] = 200;  // the blue of pixel (4, 2), in the square (2, 1)
  YuvConverter converter(Frame::kWidth, Frame::kHeight, false);
  Frame frame;
  converter.convert(picture.data(), kStride, frame.planes());
  // 128 + 224 / 255 * 0.5 * (200 / 4) = 149.96; V is 128 - 0.0814 * 224 / 255 * 50 = 124.4.
  EXPECT_EQ(frame.u[21 + 2], 150);
  EXPECT_EQ(frame.v[21 + 2], 124);
  EXPECT_EQ(frame.u[21 + 1], 128);
  EXPECT_EQ(frame.y[2 * 42 + 4], std::lround(16 + 0.114 * 200 * 219 / 255));
  EXPECT_EQ(frame.y[2 * 42 + 5], 16);
}

TEST(YuvConverter, AnySequenceOfChanges_SameAsConvertedAlone) {
  Picture picture = filled(200, 210, 220);
  YuvConverter converter(Frame::kWidth, Frame::kHeight, false);
  Frame frame;
  std::uint64_t state = 7;
  for (int round = 0; round < 300; ++round) {
    for (int changes = round % 4; changes > 0; --changes) {
      state = state * 6364136223846793005ULL + 1442695040888963407ULL;
      picture[(state >> 33) % picture.size()] = static_cast<std::uint8_t>(state >> 25);
    }
    converter.convert(picture.data(), kStride, frame.planes());
    Frame alone;
    YuvConverter(Frame::kWidth, Frame::kHeight, false)
        .convert(picture.data(), kStride, alone.planes());
    ASSERT_TRUE(frame == alone) << "in round " << round;
  }
}

}  // namespace
}  // namespace sim::render::modules
