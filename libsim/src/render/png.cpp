// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "canvas/png_codec.h"
#include "render/modules/module_file.h"
#include "sim/core/replace_file.h"
#include "sim/render/render.h"

namespace sim::render {
namespace {

[[noreturn]] void refuse_picture(const std::string& path, const std::string& reason) {
  throw std::runtime_error(path + ": cannot write the picture: " + reason);
}

}  // namespace

void write_png(const Image& image, const std::string& path) {
  const std::size_t samples =
      3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.width <= 0 || image.height <= 0 || image.rgb.size() != samples) {
    refuse_picture(path, "it has no pixels, or not as many as its size says");
  }
  // Encoded in memory and written here, so that the reason of a failure is known.
  const std::vector<std::uint8_t> bytes = encode_png(image.width, image.height, image.rgb.data());
  if (bytes.empty()) refuse_picture(path, "the PNG encoder failed");
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (const int error = replace_file(path, text)) refuse_picture(path, std::strerror(error));
}

}  // namespace sim::render
