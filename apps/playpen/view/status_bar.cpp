// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "status_bar.h"

#include <algorithm>
#include <cstddef>
#include <opencv2/imgproc.hpp>
#include <sstream>

namespace {

// Blue, green, red.
const cv::Scalar kGround(0x2e, 0x29, 0x26);
const cv::Scalar kPausedGround(0x20, 0x44, 0x63);
const cv::Scalar kInk(0xf2, 0xf2, 0xf0);
const cv::Scalar kFaintInk(0xa4, 0x9c, 0x96);
const cv::Scalar kKeyInk(0xe2, 0xdd, 0xd9);
const cv::Scalar kMessageInk(0x6b, 0xcb, 0xff);

constexpr int kMargin_px = 14;
constexpr int kDot_px = 6;
// Text is drawn larger by this factor and scaled down, for smooth edges.
constexpr int kFine = 4;
constexpr int kFont = cv::FONT_HERSHEY_DUPLEX;
// Height of a capital letter at scale 1 in this font, measured with getTextSize.
constexpr double kCapHeight_px = 22.0;

/// Draws a line of text, scaled down if it is wider than `room`.
/// @return its width.
int write_text(cv::Mat& bar, const std::string& text, cv::Point start, double cap_height_px,
               const cv::Scalar& colour, int room, bool ends_there = false) {
  if (text.empty() || room <= 0) return 0;
  double scale = kFine * cap_height_px / kCapHeight_px;
  constexpr int kStroke = 5;
  int base_line = 0;
  cv::Size size = cv::getTextSize(text, kFont, scale, kStroke, &base_line);
  if (size.width > kFine * room) {
    scale *= static_cast<double>(kFine * room) / size.width;
    size = cv::getTextSize(text, kFont, scale, kStroke, &base_line);
  }
  const int width = size.width / kFine + 2;
  const int height = (size.height + base_line) / kFine + 4;
  cv::Mat fine(height * kFine, width * kFine, CV_8UC1, cv::Scalar(0));
  const int ascent = size.height / kFine + 2;
  cv::putText(fine, text, {0, ascent * kFine}, kFont, scale, cv::Scalar(255), kStroke, cv::LINE_8);
  cv::Mat mask;
  cv::resize(fine, mask, {width, height}, 0.0, 0.0, cv::INTER_AREA);

  if (ends_there) start.x -= width;
  for (int y = 0; y < height; ++y) {
    const int row = start.y - ascent + y;
    if (row < 0 || row >= bar.rows) continue;
    for (int x = 0; x < width; ++x) {
      const int column = start.x + x;
      if (column < 0 || column >= bar.cols) continue;
      const double share = mask.at<std::uint8_t>(y, x) / 255.0;
      cv::Vec3b& pixel = bar.at<cv::Vec3b>(row, column);
      for (int i = 0; i < 3; ++i) {
        pixel[i] = cv::saturate_cast<std::uint8_t>(pixel[i] + share * (colour[i] - pixel[i]));
      }
    }
  }
  return width;
}

/// Draws a line of help: keys and their meanings alternate, two or more blanks apart.
void write_help(cv::Mat& bar, const std::string& line, int base_line, int right) {
  int x = kMargin_px;
  bool is_key = true;
  for (std::size_t at = 0; at < line.size(); is_key = !is_key) {
    const std::size_t end = std::min(line.find("  ", at), line.size());
    x += write_text(bar, line.substr(at, end - at), {x, base_line}, 9.5,
                    is_key ? kKeyInk : kFaintInk, right - x);
    x += is_key ? 8 : 24;
    at = std::min(line.find_first_not_of(' ', end), line.size());
  }
}

}  // namespace

StatusText StatusText::parse(const std::string& text, std::uint32_t robot_colour, bool paused) {
  StatusText result;
  result.robot_colour = robot_colour;
  result.paused = paused;
  std::istringstream lines(text);
  std::getline(lines, result.status);
  std::getline(lines, result.message);
  for (std::string line; std::getline(lines, line);) result.help.push_back(line);
  return result;
}

void draw_status_bar(cv::Mat bar, const StatusText& text) {
  bar.setTo(text.paused ? kPausedGround : kGround);
  const cv::Scalar robot(text.robot_colour & 0xffU, text.robot_colour >> 8U & 0xffU,
                         text.robot_colour >> 16U & 0xffU);
  cv::circle(bar, {kMargin_px + kDot_px, 18}, kDot_px, robot, cv::FILLED, cv::LINE_AA);
  const int left = kMargin_px + 2 * kDot_px + 10;
  const int right = bar.cols - kMargin_px;
  const int used = write_text(bar, text.status, {left, 24}, 12.0, kInk, right - left);
  write_text(bar, text.message, {right, 24}, 12.0, kMessageInk, right - left - used - 20, true);
  int base_line = 47;
  for (std::size_t i = 0; i < std::min<std::size_t>(text.help.size(), 2); ++i, base_line += 19) {
    write_help(bar, text.help[i], base_line, right);
  }
}
