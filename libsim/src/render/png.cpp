// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "sim/render/render.h"

namespace sim::render {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw std::runtime_error(path + ": cannot write the picture: " + reason);
}

}  // namespace

void prepare_pictures() { static_cast<void>(cv::haveImageWriter("picture.png")); }

void write_png(const Image& image, const std::string& path, PngEffort effort) {
  const std::size_t samples =
      3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.width <= 0 || image.height <= 0 || image.rgb.size() != samples) {
    fail(path, "it has no pixels, or not as many as its size says");
  }
  // Swapped by hand: cv::cvtColor may use OpenCV's pool of threads.
  cv::Mat bgr(image.height, image.width, CV_8UC3);
  for (std::size_t i = 0; i < samples; i += 3) {
    bgr.data[i] = image.rgb[i + 2];
    bgr.data[i + 1] = image.rgb[i + 1];
    bgr.data[i + 2] = image.rgb[i];
  }
  // Encoded in memory and written here, so that the reason of a failure is known. The bytes depend
  // on the picture alone: the PNG holds no time or name.
  std::vector<std::uint8_t> bytes;
  bool encoded = false;
  try {
    encoded = cv::imencode(".png", bgr, bytes,
                           {cv::IMWRITE_PNG_COMPRESSION, effort == PngEffort::kQuick ? 1 : 6});
  } catch (const cv::Exception& error) {
    fail(path, error.what());
  }
  if (!encoded) fail(path, "the PNG encoder failed");
  errno = 0;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  if (file) {
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    file.close();
  }
  if (!file) fail(path, errno != 0 ? std::strerror(errno) : "unknown reason");
}

}  // namespace sim::render
