// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

/// What stands below the picture.
struct StatusText {
  std::string status;              ///< what goes on, left
  std::string message;             ///< passing message, right
  std::vector<std::string> help;   ///< lines of help; two have room
  std::uint32_t robot_colour = 0;  ///< of the chosen robot, 0xRRGGBB
  bool paused = false;

  /// Takes a frame's text apart; see playerlike/view/protocol.h.
  [[nodiscard]] static StatusText parse(const std::string& text, std::uint32_t robot_colour,
                                        bool paused);
};

/// Height of the bar, whatever stands in it [pixels].
inline constexpr int kStatusBarHeight_px = 74;

/// Draws the bar into a BGR picture of kStatusBarHeight_px rows, all of which it fills.
void draw_status_bar(cv::Mat bar, const StatusText& text);
