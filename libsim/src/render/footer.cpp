// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "render/footer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "render/text_box.h"
#include "sim/core/number_text.h"

namespace sim::render {
namespace {

std::string number_text(double value) { return rounded_text(value, 6); }

std::string time_text(double time_s) { return "t = " + fixed_text(time_s, 1) + " s"; }

class FooterPainter {
 public:
  FooterPainter(const SceneSnapshot& scene, const Layout& layout, const Rectangle& place,
                double pixels_per_m, Painter& painter)
      : scene_(scene),
        layout_(layout),
        place_(place),
        pixels_per_m_(pixels_per_m),
        painter_(painter) {}

  void draw() {
    std::vector<const LayerInfo*> layers;
    for (const LayerInfo& layer : scene_.layers) {
      if (layer.style.visible && layer.id != kBaseLayer) layers.push_back(&layer);
    }
    const double height = place_.bottom - place_.top;
    const bool two_lines = !layers.empty() || scene_.verdict;
    draw_line(place_.top + (two_lines ? 0.3 : 0.5) * height, scene_.verdict && !layers.empty());
    if (!layers.empty()) {
      draw_layers(layers, place_.top + 0.72 * height);
    } else if (scene_.verdict) {
      draw_verdict(place_.left, place_.right, place_.top + 0.72 * height);
    }
  }

 private:
  // Scale bar on the left, the world's name or the verdict in the middle, the time on the right.
  void draw_line(double middle_y, bool with_verdict) {
    const TextStyle style = layout_.text_style(15.0, palette::kInk);
    const TextStyle small = layout_.text_style(12.5, palette::kInk);
    const double gap = 24.0 * layout_.unit_px;

    const double length_m = round_below(0.2 * layout_.width / pixels_per_m_);
    const double bar_px = length_m * pixels_per_m_;
    draw_scale_bar({place_.left, middle_y}, bar_px);
    const std::string length_text = number_text(length_m) + " m";
    const double text_left = place_.left + bar_px + 10.0 * layout_.unit_px;
    painter_.draw_text(length_text, {text_left, middle_y + 0.5 * small.cap_height_px}, small);
    const double left_end = text_left + Painter::text_width_px(length_text, small);

    const std::string time = time_text(scene_.time_s);
    const double time_left = place_.right - Painter::text_width_px(time, small);
    if (time_left < left_end + gap) return;
    painter_.draw_text(time, {time_left, middle_y + 0.5 * small.cap_height_px}, small);

    // Centred in the picture if there is room, otherwise in the remaining space.
    const double room_left = left_end + gap;
    const double room_right = time_left - gap;
    if (with_verdict) return draw_verdict(room_left, room_right, middle_y);
    const std::string name = shortened(scene_.world_name, style, room_right - room_left);
    if (name.empty()) return;
    const double name_px = Painter::text_width_px(name, style);
    const double name_left =
        std::clamp(0.5 * (layout_.width - name_px), room_left, room_right - name_px);
    painter_.draw_text(name, {name_left, middle_y + 0.5 * style.cap_height_px}, style);
  }

  // The arena controller's verdict: a coloured pill with one word, then the reason.
  void draw_verdict(double left, double right, double middle_y) {
    const Verdict& verdict = *scene_.verdict;
    TextStyle style = layout_.text_style(12.5, palette::kLight);
    const double cap = style.cap_height_px;
    const std::string word(verdict.passed ? "passed" : "failed");
    const double pill_px = Painter::text_width_px(word, style) + 1.6 * cap;
    if (pill_px > right - left) return;
    TextStyle reason_style = style;
    reason_style.colour = palette::kInk;
    const std::string reason =
        shortened(printable(verdict.reason), reason_style, right - left - pill_px - 0.8 * cap);
    const double reason_px =
        reason.empty() ? 0.0 : 0.8 * cap + Painter::text_width_px(reason, reason_style);
    const double width_px = pill_px + reason_px;
    const double x = std::clamp(0.5 * (layout_.width - width_px), left, right - width_px);
    Shape pill;
    pill.add_piece(rounded({x, middle_y - 1.1 * cap, x + pill_px, middle_y + 1.1 * cap}, cap));
    painter_.fill(pill, verdict.passed ? palette::kPassed : palette::kFailed);
    const double base = middle_y + 0.5 * cap;
    painter_.draw_text(word, {x + 0.8 * cap, base}, style);
    if (!reason.empty()) painter_.draw_text(reason, {x + pill_px + 0.8 * cap, base}, reason_style);
  }

  // A bar of two halves, the second hollow.
  void draw_scale_bar(const Vec2& start, double length_px) {
    const double half_height = layout_.line_px(4.0, 2.0);
    const double width_px = layout_.line_px(1.6, 1.0);
    Shape frame;
    frame.add_line({start + Vec2(0.0, -half_height), start + Vec2(length_px, -half_height),
                    start + Vec2(length_px, half_height), start + Vec2(0.0, half_height)},
                   width_px, true);
    Shape inside;
    inside.add_piece({start + Vec2(0.0, -half_height), start + Vec2(length_px, -half_height),
                      start + Vec2(length_px, half_height), start + Vec2(0.0, half_height)});
    painter_.fill(inside, palette::kFloor);
    Shape dark;
    dark.add_piece({start + Vec2(0.0, -half_height), start + Vec2(0.5 * length_px, -half_height),
                    start + Vec2(0.5 * length_px, half_height), start + Vec2(0.0, half_height)});
    painter_.fill(dark, palette::kInk);
    painter_.fill(frame, palette::kInk);
  }

  // An entry of the legend: swatches, each followed by its word.
  struct Entry {
    struct Swatch {
      Colour colour;
      std::string word;  // may be empty
    };
    std::string title;  // before the swatches; may be empty
    std::vector<Swatch> swatches;
  };

  // Widths of the legend's parts, proportional to the text size.
  struct Measures {
    explicit Measures(const TextStyle& style)
        : swatch_px(1.25 * style.cap_height_px),
          word_gap_px(0.55 * style.cap_height_px),
          inner_gap_px(0.8 * style.cap_height_px),
          outer_gap_px(1.9 * style.cap_height_px) {}
    double swatch_px;
    double word_gap_px;   // between a swatch and its word
    double inner_gap_px;  // between a word and the next swatch of the entry
    double outer_gap_px;  // between entries
  };

  // The colour of a layer's cells on white.
  static Colour on_white(const LayerStyle& style) {
    constexpr double kLeast = 0.25;  // a fainter swatch would be invisible
    const double opacity =
        std::clamp(style.colour.a / 255.0 * (1.0 - style.transparency), kLeast, 1.0);
    return mix(Colour{255, 255, 255}, opaque(style.colour), opacity);
  }

  static Entry entry_of(const LayerInfo& layer, bool words, double widest_name_px,
                        const TextStyle& style) {
    const std::string name = shortened(layer.style.name, style, widest_name_px);
    if (layer.kind != LayerKind::kGrey) return {"", {{on_white(layer.style), name}}};
    constexpr Colour kFree{255, 255, 255};
    constexpr Colour kUnknown{128, 128, 128};
    constexpr Colour kOccupied{0, 0, 0};
    if (!words) return {"", {{kFree, ""}, {kUnknown, ""}, {kOccupied, name}}};
    return {name, {{kFree, "free"}, {kUnknown, "unknown"}, {kOccupied, "occupied"}}};
  }

  static double width_px(const Entry& entry, const TextStyle& style) {
    const Measures measures(style);
    double width = entry.title.empty()
                       ? 0.0
                       : Painter::text_width_px(entry.title, style) + measures.inner_gap_px;
    for (std::size_t i = 0; i < entry.swatches.size(); ++i) {
      const Entry::Swatch& swatch = entry.swatches[i];
      width += measures.swatch_px;
      if (swatch.word.empty()) continue;  // the next swatch is adjacent to this one
      width += measures.word_gap_px + Painter::text_width_px(swatch.word, style);
      if (i + 1 < entry.swatches.size()) width += measures.inner_gap_px;
    }
    return width;
  }

  static double width_px(const std::vector<Entry>& entries, const TextStyle& style) {
    double width = 0.0;
    for (const Entry& entry : entries) width += width_px(entry, style);
    const auto gaps = static_cast<double>(entries.size()) - 1.0;
    return width + std::max(gaps, 0.0) * Measures(style).outer_gap_px;
  }

  // Draws one line with all layers in drawing order. Uses the first variant that fits: full text
  // size, smaller text, no words for shades, without the last layers.
  void draw_layers(const std::vector<const LayerInfo*>& layers, double middle_y) {
    const double room_px = place_.right - place_.left;
    std::vector<Entry> entries;
    TextStyle style;
    const auto fits = [&](std::size_t count, bool words, double cap_height) {
      style = layout_.text_style(cap_height, palette::kInk);
      style.cap_height_px = std::max(cap_height * layout_.unit_px, 5.5);
      entries.clear();
      for (std::size_t i = 0; i < count; ++i) {
        entries.push_back(entry_of(*layers[i], words, 0.4 * room_px, style));
      }
      if (count < layers.size()) {
        std::string more("+");
        more += std::to_string(layers.size() - count);
        entries.push_back({more, {}});
      }
      return width_px(entries, style) <= room_px;
    };
    bool good = false;
    for (const bool words : {true, false}) {
      for (const double cap_height : {12.5, 11.5, 10.5, 9.5}) {
        good = good || fits(layers.size(), words, cap_height);
        if (good) break;
      }
    }
    for (std::size_t count = layers.size(); !good && count-- > 0;) good = fits(count, false, 9.5);
    if (!good) return;

    const Measures measures(style);
    double x = place_.left + 0.5 * (room_px - width_px(entries, style));
    const auto write = [&](const std::string& text) {
      painter_.draw_text(text, {x, middle_y + 0.5 * style.cap_height_px}, style);
      x += Painter::text_width_px(text, style);
    };
    for (const Entry& entry : entries) {
      if (!entry.title.empty()) {
        write(entry.title);
        x += measures.inner_gap_px;
      }
      for (std::size_t i = 0; i < entry.swatches.size(); ++i) {
        draw_swatch(x, middle_y, measures.swatch_px, entry.swatches[i].colour);
        x += measures.swatch_px;
        if (entry.swatches[i].word.empty()) continue;
        x += measures.word_gap_px;
        write(entry.swatches[i].word);
        if (i + 1 < entry.swatches.size()) x += measures.inner_gap_px;
      }
      x += measures.outer_gap_px;
    }
  }

  // A square with an edge line, which white and light colours need; aligned to whole pixels to be
  // crisp.
  void draw_swatch(double left, double middle_y, double size_px, Colour colour) {
    const double edge_px = std::max(std::round(layout_.unit_px), 1.0);
    const double x = std::round(left);
    const double y = std::round(middle_y - 0.5 * size_px);
    const double size = std::round(left + size_px) - x;
    const Rectangle square{x, y, x + size, y + std::round(size_px)};
    Shape edge;
    edge.add_piece(rectangle_corners(square, 0.0));
    painter_.fill(edge, palette::kFaintInk);
    Shape inside;
    inside.add_piece(rectangle_corners(square, -edge_px));
    painter_.fill(inside, colour);
  }

  const SceneSnapshot& scene_;
  const Layout& layout_;
  Rectangle place_;
  double pixels_per_m_;
  Painter& painter_;
};

}  // namespace

void draw_footer(const SceneSnapshot& scene, const Layout& layout, const Rectangle& place,
                 double pixels_per_m, Painter& painter) {
  FooterPainter(scene, layout, place, pixels_per_m, painter).draw();
}

}  // namespace sim::render
