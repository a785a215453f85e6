// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "canvas/png_codec.h"
#include "render/modules/module_file.h"
#include "render/png_file.h"
#include "sim/core/replace_file.h"
#include "sim/render/render.h"

namespace sim::render {
namespace {

[[noreturn]] void refuse_picture(const std::string& path, const std::string& reason) {
  throw std::runtime_error(path + ": cannot write the picture: " + reason);
}

}  // namespace

void write_png_file(const std::vector<std::uint8_t>& png, const std::string& path) {
  if (png.empty()) refuse_picture(path, "the PNG encoder failed");
  const std::string_view text(reinterpret_cast<const char*>(png.data()), png.size());
  if (const int error = replace_file(path, text)) refuse_picture(path, std::strerror(error));
}

void write_png(const Image& image, const std::string& path) {
  const std::size_t samples =
      3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.width <= 0 || image.height <= 0 || image.rgb.size() != samples) {
    refuse_picture(path, "it has no pixels, or not as many as its size says");
  }
  // Encoded in memory and written here, so that the reason of a failure is known.
  write_png_file(encode_png(image.width, image.height, image.rgb.data()), path);
}

}  // namespace sim::render
