// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

/// The text below the picture.
struct StatusText {
  std::string status;              ///< current state, left
  std::string message;             ///< temporary message, right
  std::vector<std::string> help;   ///< lines of help; there is room for two
  std::uint32_t robot_colour = 0;  ///< colour of the selected robot, 0xRRGGBB
  bool paused = false;

  /// Parses a frame's text; see playerlike/view/protocol.h.
  [[nodiscard]] static StatusText parse(const std::string& text, std::uint32_t robot_colour,
                                        bool paused);
};

/// Fixed height of the bar [pixels].
inline constexpr int kStatusBarHeight_px = 74;

/// Draws the bar into a BGR picture with kStatusBarHeight_px rows and fills all of it.
void draw_status_bar(cv::Mat bar, const StatusText& text);
