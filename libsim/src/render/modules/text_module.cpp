// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <opencv2/imgproc.hpp>

#include "render/modules/module_interface.h"

namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;

int width(const char* text, double scale, int stroke) {
  try {
    int baseline = 0;
    return cv::getTextSize(text, kFont, scale, stroke, &baseline).width;
  } catch (const std::exception&) {
    return 0;
  }
}

bool draw(const char* text, int x, int y, double scale, int stroke, std::uint8_t* raster, int width,
          int height) {
  try {
    cv::Mat picture(height, width, CV_8UC1, raster);
    cv::putText(picture, text, {x, y}, kFont, scale, cv::Scalar(255), stroke, cv::LINE_AA);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const sim::render::modules::TextFunctions*
playpen_text_functions() {
  static const sim::render::modules::TextFunctions kFunctions = {PLAYPEN_VERSION, &width, &draw};
  return &kFunctions;
}
