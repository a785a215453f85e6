// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "render/text_outline.h"

#include <algorithm>

#include "render/modules/module_file.h"
#include "sim/core/utf8.h"

namespace sim::render {
namespace {

constexpr std::uint32_t kReplacement = 0xfffd;
constexpr std::size_t kMostCharacters = 256;
constexpr int kCurveParts = 6;  // segments per curve, sufficient for letters of 100 pixels

// Collects the contours of one character.
struct Collector {
  TextOutline& text;
  double x_px;
  double scale_px;

  void add(double x, double y) {
    text.contours.back().emplace_back(x_px + x * scale_px, -y * scale_px);
  }
  [[nodiscard]] Vec2 last() const {
    const Vec2& point = text.contours.back().back();
    return {(point.x() - x_px) / scale_px, -point.y() / scale_px};
  }
};

Collector& collector(void* context) { return *static_cast<Collector*>(context); }

modules::OutlineSink sink_of(Collector& into) {
  modules::OutlineSink sink{};
  sink.context = &into;
  sink.start = [](void* context, double x, double y) {
    collector(context).text.contours.emplace_back();
    collector(context).add(x, y);
  };
  sink.line = [](void* context, double x, double y) { collector(context).add(x, y); };
  sink.curve = [](void* context, double cx, double cy, double x, double y) {
    const Vec2 from = collector(context).last();
    for (int i = 1; i <= kCurveParts; ++i) {
      const double t = static_cast<double>(i) / kCurveParts;
      const Vec2 p =
          (1.0 - t) * (1.0 - t) * from + 2.0 * t * (1.0 - t) * Vec2(cx, cy) + t * t * Vec2(x, y);
      collector(context).add(p.x(), p.y());
    }
  };
  return sink;
}

// Adds a box as a placeholder for a character. @return width [heights of a capital letter].
double add_box(Collector& into) {
  constexpr double kWidth = 0.62;
  constexpr double kEdge = 0.09;
  constexpr double kSide = 0.1;  // margin on both sides
  const auto add = [&](double grown, bool hole) {
    std::vector<Vec2> corners = {{kSide - grown, -grown},
                                 {kSide - grown, 1.0 + grown},
                                 {kSide + kWidth + grown, 1.0 + grown},
                                 {kSide + kWidth + grown, -grown}};
    if (hole) std::reverse(corners.begin(), corners.end());
    into.text.contours.emplace_back();
    for (const Vec2& corner : corners) into.add(corner.x(), corner.y());
  };
  add(0.0, false);
  add(-kEdge, true);
  return kWidth + 2.0 * kSide;
}

}  // namespace

bool has_wide_characters(std::string_view text) {
  return std::any_of(text.begin(), text.end(),
                     [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
}

std::size_t end_of_character(std::string_view text, std::size_t begin) {
  return begin + std::max<std::size_t>(utf8_length(text.substr(begin)), 1);
}

std::vector<std::uint32_t> code_points(std::string_view text) {
  std::vector<std::uint32_t> all;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = end_of_character(text, begin);
    const auto lead = static_cast<unsigned char>(text[begin]);
    if (end == begin + 1) {
      all.push_back(lead < 0x80 ? lead : kReplacement);
    } else {
      std::uint32_t value = lead & (0x7fU >> (end - begin));
      for (std::size_t i = begin + 1; i < end; ++i) {
        value = value << 6U | (static_cast<unsigned char>(text[i]) & 0x3fU);
      }
      all.push_back(value);
    }
    begin = end;
  }
  return all;
}

void drop_cut_character(std::string& text) {
  constexpr std::size_t kLongest = 4;
  const std::size_t cut = find_invalid_utf8(text);
  if (cut != std::string_view::npos && text.size() - cut < kLongest) text.resize(cut);
}

TextOutline text_outline(std::string_view text, double cap_height_px) {
  TextOutline outline;
  std::size_t count = 0;
  for (const std::uint32_t code_point : code_points(text)) {
    if (++count > kMostCharacters) break;
    Collector into{outline, outline.width_px, cap_height_px};
    constexpr double kBlank = 0.44;
    double advance = kBlank;
    const bool blank = code_point <= 0x20 || (code_point >= 0x7f && code_point <= 0xa0);
    const std::size_t before = outline.contours.size();
    if (!blank && !modules::text_functions().outline(code_point, sink_of(into), &advance)) {
      outline.contours.resize(before);
      advance = add_box(into);
    }
    outline.width_px += advance * cap_height_px;
  }
  return outline;
}

}  // namespace sim::render
