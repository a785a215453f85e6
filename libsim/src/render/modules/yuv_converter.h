// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace sim::render::modules {

/// Converts the frames of a film to YUV 4:2:0 (ITU-R BT.601-7): a luma sample a pixel, and a sample
/// of both chroma components for each square of four pixels, the mean of these. Pixels that are the
/// same as in the last frame are not converted again: a robot that drives changes little of a
/// picture.
class YuvConverter {
 public:
  /// Where a frame is written. The first frame writes all of it. Later ones write what changes, so
  /// the planes must keep their content.
  struct Planes {
    std::array<std::uint8_t*, 3> rows;  ///< the first row of Y, U (blue) and V (red)
    std::array<int, 3> strides;         ///< bytes from one row to the next
  };

  /// @param width, height  of the frames [pixels], even.
  /// @param full_range     false: luma is in 16..235 and chroma in 16..240; true: both in 0..255.
  YuvConverter(int width, int height, bool full_range)
      : width_(static_cast<std::size_t>(width)),
        height_(static_cast<std::size_t>(height)),
        last_(3 * width_ * height_) {
    // Weights of red and blue in luma: BT.601-7, section 2.5.1; the ranges: section 2.5.3.
    constexpr double kRed = 0.299;
    constexpr double kBlue = 0.114;
    constexpr double kGreen = 1.0 - kRed - kBlue;
    const double luma = full_range ? 1.0 : 219.0 / 255.0;
    const double chroma = full_range ? 1.0 : 224.0 / 255.0;
    const double blue = 0.5 * chroma / (1.0 - kBlue);
    const double red = 0.5 * chroma / (1.0 - kRed);
    const int least = full_range ? 0 : 16;
    components_ = {Component{{luma * kRed, luma * kGreen, luma * kBlue}, least, kBits},
                   Component{{-blue * kRed, -blue * kGreen, blue * (1.0 - kBlue)}, 128, kBits + 2},
                   Component{{red * (1.0 - kRed), -red * kGreen, -red * kBlue}, 128, kBits + 2}};
  }

  /// Converts a frame.
  /// @param rgb     RGB bytes, row-major from the top left.
  /// @param stride  bytes from one row to the next.
  void convert(const std::uint8_t* rgb, std::size_t stride, const Planes& planes) {
    const std::size_t row_bytes = 3 * width_;
    for (std::size_t y = 0; y < height_; y += 2) {
      const std::array<const std::uint8_t*, 2> rows = {rgb + y * stride, rgb + (y + 1) * stride};
      std::size_t begin = width_;
      std::size_t end = 0;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        std::uint8_t* const last = last_.data() + (y + i) * row_bytes;
        if (!first_ && std::memcmp(last, rows[i], row_bytes) == 0) continue;
        if (first_) {
          begin = 0;
          end = width_;
        } else {
          const auto [from, to] = changed_bytes(last, rows[i], row_bytes);
          begin = std::min(begin, from / 6 * 2);
          end = std::max(end, (to + 5) / 6 * 2);
        }
        std::memcpy(last, rows[i], row_bytes);
      }
      if (begin < end) convert_rows(y, begin, end, planes);
    }
    first_ = false;
  }

 private:
  static constexpr int kBits = 16;  // of the fraction

  // One of the three components as a weighted sum of red, green and blue.
  struct Component {
    Component() = default;
    // @param bits  of the fraction of a sum, whose colours may have a factor of 2^(bits - kBits).
    Component(const std::array<double, 3>& shares, int offset, int bits) : shift(bits) {
      for (std::size_t i = 0; i < weights.size(); ++i) {
        weights[i] = static_cast<std::int32_t>(std::lround(shares[i] * (1 << kBits)));
      }
      rest = (offset << bits) + (1 << (bits - 1));
    }
    [[nodiscard]] std::uint8_t of(std::int32_t red, std::int32_t green, std::int32_t blue) const {
      const std::int32_t sum =
          (weights[0] * red + weights[1] * green + weights[2] * blue + rest) >> shift;
      return static_cast<std::uint8_t>(std::min(sum, 255));
    }

    std::array<std::int32_t, 3> weights{};
    std::int32_t rest = 0;
    int shift = 0;
  };

  // The range of bytes outside of which two different rows are equal. It may be some bytes too
  // long.
  static std::pair<std::size_t, std::size_t> changed_bytes(const std::uint8_t* last,
                                                           const std::uint8_t* row,
                                                           std::size_t size) {
    constexpr std::size_t kAtOnce = 48;
    std::size_t from = 0;
    while (from + kAtOnce <= size && std::memcmp(last + from, row + from, kAtOnce) == 0) {
      from += kAtOnce;
    }
    std::size_t to = size;
    while (to >= from + kAtOnce &&
           std::memcmp(last + to - kAtOnce, row + to - kAtOnce, kAtOnce) == 0) {
      to -= kAtOnce;
    }
    return {from, to};
  }

  // Converts the columns [begin, end) of two rows of the last frame.
  void convert_rows(std::size_t y, std::size_t begin, std::size_t end, const Planes& planes) const {
    const auto row_of = [&](std::size_t plane, std::size_t row) {
      return planes.rows[plane] + static_cast<std::ptrdiff_t>(row) * planes.strides[plane];
    };
    const std::uint8_t* above = last_.data() + 3 * (y * width_ + begin);
    const std::uint8_t* below = above + 3 * width_;
    std::uint8_t* const luma_above = row_of(0, y);
    std::uint8_t* const luma_below = row_of(0, y + 1);
    std::uint8_t* const blue = row_of(1, y / 2);
    std::uint8_t* const red = row_of(2, y / 2);
    const auto [luma, u, v] = components_;
    for (std::size_t x = begin; x < end; x += 2, above += 6, below += 6) {
      // Drawings have many squares that are the same as the one to the left.
      if (x > begin && std::memcmp(above, above - 6, 6) == 0 &&
          std::memcmp(below, below - 6, 6) == 0) {
        std::memcpy(luma_above + x, luma_above + x - 2, 2);
        std::memcpy(luma_below + x, luma_below + x - 2, 2);
        blue[x / 2] = blue[x / 2 - 1];
        red[x / 2] = red[x / 2 - 1];
        continue;
      }
      luma_above[x] = luma.of(above[0], above[1], above[2]);
      luma_above[x + 1] = luma.of(above[3], above[4], above[5]);
      luma_below[x] = luma.of(below[0], below[1], below[2]);
      luma_below[x + 1] = luma.of(below[3], below[4], below[5]);
      std::array<std::int32_t, 3> sum{};
      for (std::size_t i = 0; i < sum.size(); ++i) {
        sum[i] = above[i] + above[i + 3] + below[i] + below[i + 3];
      }
      blue[x / 2] = u.of(sum[0], sum[1], sum[2]);
      red[x / 2] = v.of(sum[0], sum[1], sum[2]);
    }
  }

  std::size_t width_;
  std::size_t height_;
  std::vector<std::uint8_t> last_;  // RGB of the last frame
  bool first_ = true;
  std::array<Component, 3> components_;
};

}  // namespace sim::render::modules
