// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "canvas/png_codec.h"
#include "render/canvas_view.h"
#include "render/png_file.h"
#include "sim/render/render.h"

namespace sim::render {
namespace {

constexpr int kGreatestCanvasPicturePx = 32768;

void check(const CanvasDescription& description, const std::vector<std::uint8_t>& rgba, int scale) {
  if (scale < 1 || description.width > kGreatestCanvasPicturePx / scale ||
      description.height > kGreatestCanvasPicturePx / scale) {
    throw std::invalid_argument("scale of a canvas picture must be at least 1, and its sides at " +
                                std::string("most ") + std::to_string(kGreatestCanvasPicturePx) +
                                " pixels");
  }
  if (rgba.empty() || rgba.size() != canvas_bytes(description)) {
    throw std::invalid_argument("a canvas must have 4 bytes a cell");
  }
}

// The canvas with `scale` pixels a cell in each row, but one row of pixels a row of cells.
Image widened(const CanvasDescription& description, const std::vector<std::uint8_t>& rgba,
              int scale) {
  Image image{description.width * scale, description.height, {}};
  image.rgb.resize(3 * static_cast<std::size_t>(image.width) *
                   static_cast<std::size_t>(image.height));
  std::uint8_t* pixel = image.rgb.data();
  for (std::size_t at = 0; at < rgba.size(); at += 4) {
    const std::uint8_t* const cell = rgba.data() + at;
    std::array<std::uint8_t, 3> over_white{};
    for (std::size_t i = 0; i < 3; ++i) {
      over_white[i] =
          static_cast<std::uint8_t>((cell[i] * cell[3] + 255 * (255 - cell[3]) + 127) / 255);
    }
    for (int copy = 0; copy < scale; ++copy) {
      for (const std::uint8_t channel : over_white) *pixel++ = channel;
    }
  }
  return image;
}

}  // namespace

Image draw_canvas(const CanvasDescription& description, const std::vector<std::uint8_t>& rgba,
                  int scale) {
  check(description, rgba, scale);
  const Image rows = widened(description, rgba, scale);
  Image image{rows.width, description.height * scale, {}};
  const std::ptrdiff_t row_bytes = 3 * static_cast<std::ptrdiff_t>(rows.width);
  image.rgb.reserve(static_cast<std::size_t>(row_bytes) * static_cast<std::size_t>(image.height));
  for (auto row = rows.rgb.begin(); row != rows.rgb.end(); row += row_bytes) {
    for (int copy = 0; copy < scale; ++copy) {
      image.rgb.insert(image.rgb.end(), row, row + row_bytes);
    }
  }
  return image;
}

void CanvasPngWriter::write(const CanvasDescription& description,
                            const std::vector<std::uint8_t>& rgba, int scale,
                            const std::string& path) {
  check(description, rgba, scale);
  if (description.width != width_ || scale != scale_ || rgba != rgba_) {
    const Image rows = widened(description, rgba, scale);
    png_ = encode_png(rows.width, rows.height, rows.rgb.data(), scale);
    width_ = description.width;
    scale_ = scale;
    rgba_ = rgba;
  }
  write_png_file(png_, path);
}

}  // namespace sim::render
