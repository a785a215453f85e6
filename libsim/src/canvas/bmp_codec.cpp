// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "canvas/bmp_codec.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace sim {
namespace {

/// Reads numbers of a BMP, whose lowest byte comes first; 0 behind its end.
class Numbers {
 public:
  explicit Numbers(const std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}

  [[nodiscard]] std::uint32_t at(std::size_t place, int count) const {
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i) {
      const std::size_t one = place + static_cast<std::size_t>(i);
      if (one < bytes_.size()) value |= std::uint32_t{bytes_[one]} << (8 * i);
    }
    return value;
  }

 private:
  const std::vector<std::uint8_t>& bytes_;
};

}  // namespace

std::string decode_bmp(const std::vector<std::uint8_t>& bytes, const PictureVisitor& visitor) {
  constexpr std::size_t kFileHeader = 14;
  constexpr std::uint32_t kLeastInfoHeader = 40;
  constexpr std::uint32_t kBitFields = 3;  // with 32 bits: the usual order of channels
  const Numbers number(bytes);
  const std::size_t pixels = number.at(10, 4);
  const std::uint32_t info = number.at(kFileHeader, 4);
  const auto width = static_cast<std::int32_t>(number.at(18, 4));
  const auto signed_height = static_cast<std::int32_t>(number.at(22, 4));
  const std::uint32_t bits = number.at(28, 2);
  const std::uint32_t compression = number.at(30, 4);
  if (info < kLeastInfoHeader) return "the BMP is of an old kind: save it anew";
  if (compression != 0 && !(compression == kBitFields && bits == 32)) {
    return "the BMP is compressed: save it without compression";
  }
  if (bits != 1 && bits != 4 && bits != 8 && bits != 24 && bits != 32) {
    return "a BMP of " + std::to_string(bits) + " bits a pixel; 1, 4, 8, 24 and 32 are supported";
  }
  if (width < 1 || signed_height == 0 || signed_height == INT32_MIN) {
    return "the picture has no pixels";
  }
  const auto height = static_cast<std::uint32_t>(std::abs(signed_height));
  if (!visitor.begin(static_cast<std::uint32_t>(width), height)) return "";
  const auto columns = static_cast<std::size_t>(width);
  const std::size_t stride = (columns * bits + 31) / 32 * 4;
  if (pixels > bytes.size() || (bytes.size() - pixels) / stride < height) {
    return "the BMP is cut short";
  }
  const std::size_t palette = kFileHeader + info;
  std::vector<std::uint8_t> rgb(3 * columns);
  for (std::uint32_t y = 0; y < height; ++y) {
    // With a positive height the lowest row comes first.
    const std::uint32_t row = signed_height > 0 ? height - 1 - y : y;
    const std::uint8_t* const samples = bytes.data() + pixels + stride * row;
    for (std::size_t x = 0; x < columns; ++x) {
      std::uint32_t bgr = 0;
      if (bits >= 24) {
        const std::uint8_t* const pixel = samples + x * bits / 8;
        bgr =
            std::uint32_t{pixel[0]} | std::uint32_t{pixel[1]} << 8 | std::uint32_t{pixel[2]} << 16;
      } else {
        const std::size_t bit = x * bits;
        const std::uint32_t shift = 8 - bits - static_cast<std::uint32_t>(bit % 8);
        const std::uint32_t index = samples[bit / 8] >> shift & ((1U << bits) - 1U);
        bgr = number.at(palette + 4 * index, 3);
      }
      for (std::size_t i = 0; i < 3; ++i) {
        rgb[3 * x + i] = static_cast<std::uint8_t>(bgr >> (16 - 8 * i) & 0xff);
      }
    }
    visitor.row(rgb.data(), 3);
  }
  return "";
}

}  // namespace sim
