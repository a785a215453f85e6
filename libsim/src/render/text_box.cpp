// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "render/text_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "render/text_outline.h"
#include "sim/core/pose.h"

namespace sim::render {

std::string printable(const std::string& text) {
  std::string shown = text;
  for (char& c : shown) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) c = ' ';
  }
  return shown;
}

std::vector<std::string> wrapped(const std::string& text, const TextStyle& style, double width_px,
                                 int most_lines) {
  const auto fits = [&](const std::string& line) {
    return Painter::text_width_px(line, style) <= width_px;
  };
  std::vector<std::string> lines;
  std::string rest = text;
  for (;;) {
    rest.erase(0, std::min(rest.find_first_not_of(' '), rest.size()));
    const bool is_last = static_cast<int>(lines.size()) + 1 >= most_lines;
    if (rest.empty() || (fits(rest) && (!is_last || lines.empty()))) break;
    if (is_last) {
      rest = shortened(rest, style, width_px);
      break;
    }
    std::size_t end = 0;  // end of this line
    for (std::size_t at = rest.find(' '); at != std::string::npos; at = rest.find(' ', at + 1)) {
      if (!fits(rest.substr(0, at))) break;
      end = at;
    }
    if (end == 0) {  // a word longer than a line
      end = end_of_character(rest, 0);
      while (end < rest.size() && fits(rest.substr(0, end_of_character(rest, end)))) {
        end = end_of_character(rest, end);
      }
    }
    lines.push_back(rest.substr(0, end));
    rest.erase(0, end);
  }
  lines.push_back(std::move(rest));
  return lines;
}

std::vector<Vec2> rounded(const Rectangle& place, double radius_px) {
  constexpr int kParts = 6;  // of a corner
  constexpr double kQuarter = 1.5707963267948966;
  const double r =
      std::min({radius_px, 0.5 * (place.right - place.left), 0.5 * (place.bottom - place.top)});
  const std::array<Vec2, 4> centers = {
      Vec2(place.right - r, place.bottom - r), Vec2(place.left + r, place.bottom - r),
      Vec2(place.left + r, place.top + r), Vec2(place.right - r, place.top + r)};
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    for (int k = 0; k <= kParts; ++k) {
      const double angle = kQuarter * (static_cast<double>(i) + static_cast<double>(k) / kParts);
      points.emplace_back(centers[i] + r * unit_vector(angle));
    }
  }
  return points;
}

TextBox::TextBox(std::vector<std::string> text_lines, const TextStyle& text_style)
    : lines(std::move(text_lines)),
      style(text_style),
      padding_px(0.75 * text_style.cap_height_px),
      line_px(1.75 * text_style.cap_height_px) {}

Vec2 TextBox::half_size() const {
  double width_px = 0.0;
  for (const std::string& line : lines) {
    width_px = std::max(width_px, Painter::text_width_px(line, style));
  }
  const auto further_lines = static_cast<double>(lines.size()) - 1.0;
  return {0.5 * width_px + 1.2 * padding_px,
          0.5 * (style.cap_height_px + further_lines * line_px) + padding_px};
}

void TextBox::draw_lines(Painter& painter) const {
  double base = place.top + padding_px + style.cap_height_px;
  for (const std::string& line : lines) {
    const double width_px = Painter::text_width_px(line, style);
    painter.draw_text(line, {0.5 * (place.left + place.right - width_px), base}, style);
    base += line_px;
  }
}

}  // namespace sim::render
