// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/render/drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "canvas/png_codec.h"
#include "render/layout.h"
#include "render/painter.h"
#include "sim/core/base64.h"
#include "sim/core/math.h"
#include "sim/core/number_text.h"

namespace sim::render {
namespace {

constexpr double kDash = 4.0;  // length of a dash, in widths of the line
constexpr double kGap = 2.6;

TextStyle style_of(double cap_height_px, Colour colour) {
  TextStyle style;
  style.cap_height_px = cap_height_px;
  style.colour = colour;
  return style;
}

// Adds the dashes of a line to a path.
void add_dashes(Shape& shape, const std::vector<Vec2>& points, double width_px) {
  std::vector<Vec2> dash;
  double left_px = kDash * width_px;  // rest of the current dash or gap
  bool drawn = true;
  const auto end_dash = [&] {
    if (dash.size() > 1) shape.add_line(dash, width_px);
    dash.clear();
  };
  for (std::size_t i = 1; i < points.size(); ++i) {
    Vec2 from = points[i - 1];
    const Vec2 way = points[i] - from;
    double rest_px = way.norm();
    if (!(rest_px > 0.0)) continue;
    const Vec2 along = way / rest_px;
    if (drawn && dash.empty()) dash.push_back(from);
    while (rest_px > left_px) {
      from += along * left_px;
      rest_px -= left_px;
      if (drawn) {
        dash.push_back(from);
        end_dash();
      } else {
        dash.push_back(from);
      }
      drawn = !drawn;
      left_px = (drawn ? kDash : kGap) * width_px;
    }
    left_px -= rest_px;
    if (drawn) dash.push_back(points[i]);
  }
  end_dash();
}

std::string number(double value) { return rounded_text(std::round(value * 100.0) / 100.0, 8); }

std::string hex(Colour colour) { return to_string(Colour{colour.r, colour.g, colour.b, 255}); }

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&') {
      safe += "&amp;";
    } else if (c == '<') {
      safe += "&lt;";
    } else if (c == '>') {
      safe += "&gt;";
    } else if (c == '"') {
      safe += "&quot;";
    } else if (static_cast<unsigned char>(c) >= 0x20) {
      safe += c;
    }
  }
  return safe;
}

std::string points_text(const std::vector<Vec2>& points) {
  std::string text;
  for (const Vec2& p : points) {
    if (!text.empty()) text += ' ';
    text += number(p.x());
    text += ',';
    text += number(p.y());
  }
  return text;
}

}  // namespace

/// Draws items as pixels.
struct Drawing::PixelWriter {
  Painter& painter;

  void operator()(const Line& line) const {
    Shape shape;
    if (line.dashed) {
      add_dashes(shape, line.points, line.width_px);
    } else {
      shape.add_line(line.points, line.width_px);
    }
    painter.fill(shape, line.colour);
  }
  void operator()(const Area& area) const {
    Shape shape;
    shape.add_piece(area.corners);
    painter.fill(shape, area.colour);
  }
  void operator()(const Text& text) const {
    const TextStyle style = style_of(text.cap_height_px, text.colour);
    const double width_px = Painter::text_width_px(text.text, style);
    const double share = text.align == Align::kLeft     ? 0.0
                         : text.align == Align::kMiddle ? 0.5
                                                        : 1.0;
    painter.draw_text(text.text, text.place - Vec2(share * width_px, 0.0), style);
  }
  void operator()(const Picture& picture) const {
    Image& page = painter.image();
    const int first = std::max(0, -picture.left);
    const int last = std::min(picture.image.width, page.width - picture.left);
    for (int y = 0; y < picture.image.height; ++y) {
      const int row = picture.top + y;
      if (row < 0 || row >= page.height || last <= first) continue;
      const auto at = [](const Image& image, int x, int line) {
        return 3 * (static_cast<std::ptrdiff_t>(line) * image.width + x);
      };
      std::copy(picture.image.rgb.begin() + at(picture.image, first, y),
                picture.image.rgb.begin() + at(picture.image, last, y),
                page.rgb.begin() + at(page, picture.left + first, row));
    }
  }
};

/// Writes items as elements of SVG.
struct Drawing::SvgWriter {
  std::string& out;

  void operator()(const Line& line) const {
    out += "<polyline fill=\"none\" stroke=\"" + hex(line.colour) + "\" stroke-width=\"" +
           number(line.width_px) + "\" stroke-linejoin=\"round\"";
    if (line.dashed) {
      out += " stroke-dasharray=\"" + number(kDash * line.width_px) + ' ' +
             number(kGap * line.width_px) + '"';
    }
    out += " points=\"" + points_text(line.points) + "\"/>\n";
  }
  void operator()(const Area& area) const {
    out += "<polygon fill=\"" + hex(area.colour) + "\" points=\"" + points_text(area.corners) +
           "\"/>\n";
  }
  void operator()(const Text& text) const {
    constexpr double kFontSize = 1.37;  // font size of common fonts, in heights of a capital letter
    constexpr std::array<const char*, 3> kAnchors = {"start", "middle", "end"};
    out += "<text x=\"" + number(text.place.x()) + "\" y=\"" + number(text.place.y()) +
           "\" font-size=\"" + number(kFontSize * text.cap_height_px) + "\" fill=\"" +
           hex(text.colour) + "\" text-anchor=\"" +
           kAnchors.at(static_cast<std::size_t>(text.align)) + "\">" + escaped(text.text) +
           "</text>\n";
  }
  void operator()(const Picture& picture) const {
    const std::vector<std::uint8_t> png =
        encode_png(picture.image.width, picture.image.height, picture.image.rgb.data());
    out += "<image x=\"" + std::to_string(picture.left) + "\" y=\"" + std::to_string(picture.top) +
           "\" width=\"" + std::to_string(picture.image.width) + "\" height=\"" +
           std::to_string(picture.image.height) + "\" xlink:href=\"data:image/png;base64," +
           to_base64(png) + "\"/>\n";
  }
};

Drawing::Drawing(int width_px, int height_px) : width_(width_px), height_(height_px) {
  constexpr int kLeast = 64;
  constexpr int kMost = 8192;
  if (std::min(width_px, height_px) < kLeast || std::max(width_px, height_px) > kMost) {
    throw std::invalid_argument("a page's sides must be in 64..8192 pixels");
  }
}

void Drawing::add_line(std::vector<Vec2> points, Colour colour, double width_px, bool dashed) {
  items_.emplace_back(Line{std::move(points), colour, width_px, dashed});
}

void Drawing::add_area(std::vector<Vec2> corners, Colour colour) {
  items_.emplace_back(Area{std::move(corners), colour});
}

void Drawing::add_text(std::string text, const Vec2& place, double cap_height_px, Colour colour,
                       Align align) {
  items_.emplace_back(Text{std::move(text), place, cap_height_px, colour, align});
}

void Drawing::add_picture(Image image, const Vec2& place) {
  items_.emplace_back(Picture{std::move(image), static_cast<int>(std::lround(place.x())),
                              static_cast<int>(std::lround(place.y()))});
}

double Drawing::text_width_px(const std::string& text, double cap_height_px) {
  return Painter::text_width_px(text, style_of(cap_height_px, {}));
}

Image Drawing::image() const {
  Painter painter(width_, height_, Colour{255, 255, 255, 255});
  for (const Item& item : items_) std::visit(PixelWriter{painter}, item);
  return painter.image();
}

std::string Drawing::svg() const {
  const std::string size = std::to_string(width_) + "\" height=\"" + std::to_string(height_);
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  out += "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\"";
  out += " width=\"" + size + "\" viewBox=\"0 0 " + std::to_string(width_) + ' ' +
         std::to_string(height_) + "\" font-family=\"DejaVu Sans, Verdana, sans-serif\">\n";
  out += "<rect width=\"" + size + "\" fill=\"#ffffff\"/>\n";
  for (const Item& item : items_) std::visit(SvgWriter{out}, item);
  return out + "</svg>\n";
}

Colour distinct_colour(std::size_t number) {
  constexpr std::array<Colour, 10> kColours = {{{0xe6, 0x7e, 0x22},
                                                {0x1f, 0x77, 0xb4},
                                                {0x2c, 0xa0, 0x2c},
                                                {0xd6, 0x2f, 0x4b},
                                                {0x8e, 0x5b, 0xc4},
                                                {0x11, 0xa7, 0xa7},
                                                {0xc7, 0x9a, 0x00},
                                                {0xd9, 0x5f, 0xa8},
                                                {0x7f, 0x5a, 0x3c},
                                                {0x4c, 0x5b, 0x9e}}};
  // Each repetition of the series is darker or lighter.
  const std::size_t round = number / kColours.size();
  const Colour colour = kColours.at(number % kColours.size());
  if (round == 0) return colour;
  const double share = std::min(0.15 * std::ceil(0.5 * static_cast<double>(round)), 0.6);
  return mix(colour, round % 2 == 1 ? palette::kWheel : palette::kLight, share);
}

std::vector<Tick> ticks(double least, double most, int count) {
  constexpr double kTolerance = 1e-9;  // of a step, for the rounding of 1 / 10 and the like
  constexpr double kResolved = 1e-12;  // of the numbers
  const double largest = std::max(std::abs(least), std::abs(most));
  const double rough = (most - least) / std::max(count, 1);
  if (!(rough > kResolved * largest) || !std::isfinite(rough)) return {};
  const double power = math::pow(10.0, std::floor(math::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * power >= rough * (1.0 - kTolerance)) step = factor * power;
  }
  const int needed = 2 + static_cast<int>(std::floor(math::log10(largest) - math::log10(power)));
  std::vector<Tick> all;
  for (double i = std::ceil(least / step - kTolerance); i * step <= most + kTolerance * step;
       i += 1.0) {
    all.push_back({i * step, rounded_text(i == 0.0 ? 0.0 : i * step, std::max(needed, 6))});
  }
  return all;
}

}  // namespace sim::render
