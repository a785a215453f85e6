// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// JPEG pictures, as worlds of Stage have them; OpenCV writes them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "canvas/image_file.h"
#include "sim/simulation/simulation.h"
#include "temporary_folder.h"

namespace sim {
namespace {

using testing::HasSubstr;

// 64 x 48 pixels: the left half has one colour, the right half another.
std::string jpeg_of(int type, const cv::Scalar& left, const cv::Scalar& right,
                    bool progressive = false) {
  cv::Mat picture(48, 64, type, left);
  picture.colRange(32, 64).setTo(right);
  std::vector<std::uint8_t> bytes;
  EXPECT_TRUE(
      cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_PROGRESSIVE, progressive ? 1 : 0}));
  return {bytes.begin(), bytes.end()};
}

std::string message_of(const std::string& path) {
  try {
    static_cast<void>(load_first_samples(path));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Jpegs, GiveFirstSampleOfEachPixel) {
  test_support::TemporaryFolder folder;
  const auto check = [&](const std::string& bytes, int left, int right) {
    const GreyImage image = load_first_samples(folder.write("plan.jpg", bytes));
    ASSERT_EQ(image.width, 64);
    ASSERT_EQ(image.height, 48);
    ASSERT_EQ(image.pixels.size(), 64U * 48U);
    for (const int row : {0, 20, 47}) {
      const auto at = [&](int x) { return image.pixels[static_cast<std::size_t>(64 * row + x)]; };
      EXPECT_NEAR(at(5), left, 3);
      EXPECT_NEAR(at(60), right, 3);
    }
  };
  check(jpeg_of(CV_8UC1, {10}, {200}), 10, 200);
  check(jpeg_of(CV_8UC1, {10}, {200}, true), 10, 200);
  // OpenCV's order is blue, green, red.
  check(jpeg_of(CV_8UC3, {200, 200, 20}, {0, 0, 220}), 20, 220);
}

TEST(Jpegs, Damaged_Error) {
  test_support::TemporaryFolder folder;
  const std::string whole = jpeg_of(CV_8UC1, {10}, {200});
  EXPECT_THAT(message_of(folder.write("a.jpg", whole.substr(0, whole.size() / 2))),
              HasSubstr("a.jpg: the JPEG is damaged or cut short"));
  EXPECT_THAT(message_of(folder.write("a.jpg", whole.substr(0, 20))), HasSubstr("cut short"));
  EXPECT_THAT(message_of(folder.write("a.jpg", "\xff\xd8\xff" + std::string(100, 'x'))),
              HasSubstr("a.jpg: the JPEG is damaged"));
}

// The size is in the frame header (T.81, B.2.2): marker FF C0 or FF C2, length, precision, height,
// width.
std::string with_size(std::string jpeg, char marker, const std::string& size) {
  const std::size_t frame = jpeg.find(std::string("\xff") + marker);
  EXPECT_NE(frame, std::string::npos);
  return jpeg.replace(frame + 5, 4, size);
}

TEST(Jpegs, TooLarge_Error) {
  test_support::TemporaryFolder folder;
  const std::string whole = jpeg_of(CV_8UC1, {10}, {200});
  EXPECT_THAT(message_of(folder.write("a.jpg", with_size(whole, '\xc0', "\xfd\xe8\xfd\xe8"))),
              HasSubstr("65000 x 65000 pixels, at most 16384 a side"));
  const std::string progressive = jpeg_of(CV_8UC1, {10}, {200}, true);
  using namespace std::string_literals;
  EXPECT_THAT(
      message_of(folder.write("a.jpg", with_size(progressive, '\xc2', "\x1f\x40\x1f\x40"s))),
      HasSubstr("progressive and too large"));
}

TEST(Jpegs, UsableAsStageBitmaps) {
  test_support::TemporaryFolder folder;
  folder.write("plan.jpg", jpeg_of(CV_8UC3, {10, 10, 10}, {250, 250, 250}));
  const WorldDescription world = load_world(
      folder.write("w.world", "model ( bitmap \"plan.jpg\" size [ 4 6 1 ] pose [ 1 2 0 0 ] )"));
  // The dark half is stretched to the size.
  ASSERT_EQ(world.arena.walls.size(), 1U);
  Vec2 least(100.0, 100.0);
  Vec2 most = -least;
  for (const Vec2& vertex : world.arena.walls[0].vertices) {
    least = least.cwiseMin(vertex);
    most = most.cwiseMax(vertex);
  }
  EXPECT_NEAR((least - Vec2(-1.0, -1.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((most - Vec2(3.0, 5.0)).norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace sim
