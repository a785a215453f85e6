// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>

#include "render/painter.h"
#include "sim/render/render.h"

namespace sim::render {
namespace {

/// All colours but those that robots bring along.
namespace palette {
constexpr Colour kPaper{0xf1, 0xef, 0xea};
constexpr Colour kFloor{0xfc, 0xfb, 0xf8};
constexpr Colour kGrid{0xe6, 0xe3, 0xdb};
constexpr Colour kShadow{0x2b, 0x26, 0x20};
constexpr Colour kBorder{0x8c, 0x5e, 0x3c};
constexpr Colour kBorderEdge{0x66, 0x42, 0x28};
constexpr Colour kStatic{0xcd, 0xd1, 0xd6};
constexpr Colour kStaticEdge{0x97, 0x9d, 0xa6};
constexpr Colour kDynamic{0xd6, 0x45, 0x41};
constexpr Colour kDynamicEdge{0x9f, 0x2b, 0x2b};
constexpr Colour kWall{0x45, 0x4b, 0x54};
constexpr Colour kWallEdge{0x2d, 0x31, 0x38};
constexpr Colour kDock{0xd5, 0xea, 0xe4};
constexpr Colour kDockInk{0x4f, 0x9a, 0x8b};
constexpr Colour kInk{0x35, 0x38, 0x3d};
constexpr Colour kFaintInk{0x7d, 0x7f, 0x82};
constexpr Colour kHalo{0xff, 0xff, 0xff};
constexpr Colour kWheel{0x2c, 0x2e, 0x33};
constexpr Colour kLight{0xff, 0xff, 0xff};
constexpr Colour kStalled{0xe0, 0x1e, 0x37};
}  // namespace palette

constexpr int kLeastSizePx = 64;
constexpr int kGreatestSizePx = 8192;
constexpr int kLeastSizeWithTextPx = 200;
constexpr int kGreatestCanvasPicturePx = 32768;

std::uint8_t mix(std::uint8_t a, std::uint8_t b, double share) {
  return static_cast<std::uint8_t>(std::lround(a + (b - a) * share));
}

Colour mix(Colour a, Colour b, double share) {
  return {mix(a.r, b.r, share), mix(a.g, b.g, share), mix(a.b, b.b, share)};
}

// Luma of BT.601, 0..1.
double luma(Colour colour) {
  return (0.299 * colour.r + 0.587 * colour.g + 0.114 * colour.b) / 255.0;
}

// The greatest of ..., 0.1, 0.2, 0.5, 1, 2, 5, 10, ... that is at most `limit` > 0.
double round_below(double limit) {
  const double power = std::pow(10.0, std::floor(std::log10(limit)));
  // The tolerance takes 0.999...9 that logarithm and power make of a whole power of ten.
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= limit * (1.0 + 1e-9)) return factor * power;
  }
  return power;
}

// Shortest text of a number; independent of the locale, unlike printf.
std::string number_text(double value) {
  std::array<char, 32> text{};
  const auto [end, error] =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 6);
  return error == std::errc() ? std::string(text.data(), end) : "?";
}

std::string time_text(double time_s) {
  std::array<char, 400> text{};  // the longest double has 309 digits before the point
  const auto [end, error] =
      std::to_chars(text.data(), text.data() + text.size(), time_s, std::chars_format::fixed, 1);
  return "t = " + (error == std::errc() ? std::string(text.data(), end) : "?") + " s";
}

// `text`, cut and ended with dots if it is longer than allowed; "" where not even that fits.
std::string shortened(const std::string& text, const TextStyle& style, double width_px) {
  constexpr std::size_t kMaxLength = 64;
  std::string shown = text.size() > kMaxLength ? text.substr(0, kMaxLength - 3) + "..." : text;
  while (Painter::text_width_px(shown, style) > width_px) {
    if (shown.size() <= 8) return "";  // less than that names nothing
    const std::size_t kept = shown.size() - (shown.ends_with("...") ? 4 : 3);
    shown.resize(kept);
    while (shown.ends_with(' ')) shown.pop_back();
    shown += "...";
  }
  return shown;
}

// Number at the end of a dock's name, e.g. "7" of "dock7"; the count where it has none.
std::string dock_label(const std::string& name, std::size_t index) {
  const std::size_t last = name.find_last_not_of("0123456789");
  const std::string digits = last == std::string::npos ? name : name.substr(last + 1);
  return digits.empty() || digits.size() > 3 ? std::to_string(index + 1) : digits;
}

struct Rectangle {
  double left = 0.0;
  double top = 0.0;
  double right = 0.0;
  double bottom = 0.0;

  [[nodiscard]] double overlap(const Rectangle& other) const {
    const double width = std::min(right, other.right) - std::max(left, other.left);
    const double height = std::min(bottom, other.bottom) - std::max(top, other.top);
    return width > 0.0 && height > 0.0 ? width * height : 0.0;
  }
};

// Where things lie in the picture.
struct Layout {
  double unit_px = 1.0;  // a thousandth of the longer side: all line widths and texts scale by it
  bool text = true;      // whether there is room for any text
  int width = 0;
  int height = 0;
  double margin_px = 0.0;
  double footer_px = 0.0;  // height of what is below the arena
  double pixels_per_m = 1.0;
  Rectangle floor;
  Vec2 origin = Vec2::Zero();  // W position of the floor's bottom left corner

  Layout(const ArenaDescription& arena, const RenderOptions& options) {
    const int size = options.size_px;
    unit_px = size / 1000.0;
    text = size >= kLeastSizeWithTextPx;
    const bool legend = options.legend && text;
    const double margin = std::round(38.0 * unit_px);
    const double footer = legend ? std::round(74.0 * unit_px) : margin;
    const Vec2 size_m = arena.size.cwiseMax(1e-3);
    const double room_x = size - 2.0 * margin;
    const double room_y = size - margin - footer;
    pixels_per_m = std::min(room_x / size_m.x(), room_y / size_m.y());
    const Vec2 size_px = size_m * pixels_per_m;
    // A narrow arena stands in the middle of a picture wide enough for the footer; a flat one gets
    // a picture of at least a hand's breadth.
    const double least_width = legend ? std::min<double>(size, 480.0 * unit_px) : 0.0;
    width = static_cast<int>(std::lround(std::max(size_px.x() + 2.0 * margin, least_width)));
    height = static_cast<int>(std::lround(size_px.y() + margin + footer));
    margin_px = margin;
    footer_px = footer;
    floor.left = std::round((width - size_px.x()) / 2.0);
    floor.top = margin;
    floor.right = floor.left + size_px.x();
    floor.bottom = floor.top + size_px.y();
    origin = arena.origin;
  }

  [[nodiscard]] Vec2 operator()(const Vec2& p_W) const {
    return {floor.left + (p_W.x() - origin.x()) * pixels_per_m,
            floor.bottom - (p_W.y() - origin.y()) * pixels_per_m};
  }
  [[nodiscard]] std::vector<Vec2> operator()(const std::vector<Vec2>& points_W) const {
    std::vector<Vec2> points;
    points.reserve(points_W.size());
    for (const Vec2& point : points_W) points.push_back((*this)(point));
    return points;
  }
};

std::vector<Vec2> box_corners(const Pose& X_WB, const Vec2& size) {
  const Vec2 half = 0.5 * size;
  return {X_WB * Vec2(-half.x(), -half.y()), X_WB * Vec2(half.x(), -half.y()),
          X_WB * Vec2(half.x(), half.y()), X_WB * Vec2(-half.x(), half.y())};
}

std::vector<Vec2> box_corners(const ObstacleDescription& box) {
  return box_corners({box.center.x(), box.center.y(), box.yaw_rad}, box.size);
}

std::vector<Vec2> rectangle_corners(const Rectangle& rectangle, double grown_px) {
  return {{rectangle.left - grown_px, rectangle.top - grown_px},
          {rectangle.right + grown_px, rectangle.top - grown_px},
          {rectangle.right + grown_px, rectangle.bottom + grown_px},
          {rectangle.left - grown_px, rectangle.bottom + grown_px}};
}

// Drops points of a polyline that lie within `least_px` of the last kept one; keeps the last.
std::vector<Vec2> thinned(const std::vector<Vec2>& points, double least_px) {
  std::vector<Vec2> kept;
  for (const Vec2& point : points) {
    if (!is_drawable(point)) continue;
    if (kept.empty() || (point - kept.back()).squaredNorm() >= least_px * least_px) {
      kept.push_back(point);
    }
  }
  if (!points.empty() && is_drawable(points.back()) && !kept.empty() &&
      points.back() != kept.back()) {
    kept.push_back(points.back());
  }
  return kept;
}

// The shares of canvas cells in each pixel along one axis.
struct CellSpan {
  int first = 0;
  std::vector<float> weights;  // of cell first, first + 1, ...; empty: off the canvas
};

// Span of cells under [begin, end), in cells from the canvas's edge. Weights sum up to the share
// of the pixel that lies on the canvas.
CellSpan cell_span(double begin, double end, int cells) {
  CellSpan span;
  const double low = std::max(begin, 0.0);
  const double high = std::min(end, static_cast<double>(cells));
  if (!(high > low)) return span;
  span.first = static_cast<int>(low);
  for (int cell = span.first; cell < high; ++cell) {
    const double length = std::min(high, cell + 1.0) - std::max(low, static_cast<double>(cell));
    span.weights.push_back(static_cast<float>(length / (end - begin)));
  }
  return span;
}

class ScenePainter {
 public:
  ScenePainter(const SceneSnapshot& scene, const RenderOptions& options)
      : scene_(scene),
        options_(options),
        layout_(scene.arena, options),
        unit_px_(layout_.unit_px),
        painter_(layout_.width, layout_.height, palette::kPaper) {}

  Image draw() && {
    draw_floor();
    draw_docks();
    if (options_.canvas) draw_canvas_on_floor();
    draw_retracted();
    // What robots see and where they went may reach beyond the floor where there are no borders.
    painter_.set_clip(static_cast<int>(std::floor(layout_.floor.left)),
                      static_cast<int>(std::floor(layout_.floor.top)),
                      static_cast<int>(std::ceil(layout_.floor.right)),
                      static_cast<int>(std::ceil(layout_.floor.bottom)));
    if (options_.scans) draw_fans();
    if (options_.trails) draw_trails();
    painter_.clear_clip();
    draw_solids();
    if (options_.scans) draw_seen_surfaces();
    for (const RobotSnapshot& robot : scene_.robots) draw_robot(robot);
    if (options_.names && layout_.text) draw_names();
    if (options_.legend && layout_.text) draw_legend();
    return std::move(painter_).take();
  }

 private:
  // A length that is the same share of every picture, but never thinner than `least_px`.
  [[nodiscard]] double line_px(double thousandths, double least_px = 0.8) const {
    return std::max(thousandths * unit_px_, least_px);
  }

  [[nodiscard]] TextStyle text_style(double cap_height, Colour colour) const {
    TextStyle style;
    style.cap_height_px = std::max(cap_height * unit_px_, 7.0);
    style.colour = colour;
    return style;
  }

  void draw_floor() {
    Shape floor;
    floor.add_piece(rectangle_corners(layout_.floor, 0.0));
    painter_.fill(floor, palette::kFloor);
    // Half a metre between lines, unless that is too dense or too sparse to help.
    double step_m = 0.5;
    if (step_m * layout_.pixels_per_m < 28.0 * unit_px_) {
      step_m = round_below(100.0 * unit_px_ / layout_.pixels_per_m);
    } else if (step_m * layout_.pixels_per_m > 450.0 * unit_px_) {
      step_m = round_below(200.0 * unit_px_ / layout_.pixels_per_m);
    }
    const double width_px = line_px(1.0, 0.7);
    Shape grid;
    const Vec2 end = layout_.origin + scene_.arena.size;
    const auto line = [&](const Vec2& from_W, const Vec2& to_W) {
      const Vec2 a = layout_(from_W);
      const Vec2 b = layout_(to_W);
      const Vec2 half(0.5 * width_px, 0.5 * width_px);
      grid.add_piece({a.cwiseMin(b) - half,
                      {std::max(a.x(), b.x()) + half.x(), std::min(a.y(), b.y()) - half.y()},
                      a.cwiseMax(b) + half,
                      {std::min(a.x(), b.x()) - half.x(), std::max(a.y(), b.y()) + half.y()}});
    };
    // Counted in whole steps: a sum of steps would drift, and stop far away from zero.
    const auto lines_along = [&](int axis) {
      const double first = std::floor(layout_.origin[axis] / step_m) + 1.0;
      const int count = static_cast<int>(std::ceil(end[axis] / step_m) - first);
      for (int i = 0; i < count; ++i) {
        Vec2 from = layout_.origin;
        Vec2 to = end;
        from[axis] = to[axis] = (first + i) * step_m;
        line(from, to);
      }
    };
    lines_along(0);
    lines_along(1);
    painter_.fill(grid, palette::kGrid);
  }

  // Each pixel takes the mean of the cells under it, weighted by area: cells larger than pixels
  // keep crisp edges and equal widths, and lines of cells smaller than pixels do not vanish.
  void draw_canvas_on_floor() {
    const CanvasDescription& canvas = scene_.canvas_description;
    const std::vector<std::uint8_t>& cells = scene_.canvas;
    if (cells.empty()) return;
    const double cells_per_px = 1.0 / (layout_.pixels_per_m * canvas.cell_size_m);
    const Vec2 top_left =
        layout_(Vec2(canvas.origin.x(), canvas.origin.y() + canvas.height * canvas.cell_size_m));
    const auto span_of = [&](int pixel, double start_px, int count) {
      return cell_span((pixel - start_px) * cells_per_px, (pixel + 1 - start_px) * cells_per_px,
                       count);
    };
    const int left = static_cast<int>(layout_.floor.left);
    const int right = std::min(static_cast<int>(std::ceil(layout_.floor.right)), layout_.width);
    const int top = static_cast<int>(layout_.floor.top);
    const int bottom = std::min(static_cast<int>(std::ceil(layout_.floor.bottom)), layout_.height);
    const std::size_t row_bytes = 4 * static_cast<std::size_t>(canvas.width);
    // Most of a canvas is often bare: rows without any drawing are passed over.
    std::vector<char> drawn(static_cast<std::size_t>(canvas.height));
    for (std::size_t row = 0; row < drawn.size(); ++row) {
      const auto begin = cells.begin() + static_cast<std::ptrdiff_t>(row * row_bytes);
      drawn[row] = std::any_of(begin, begin + static_cast<std::ptrdiff_t>(row_bytes),
                               [](std::uint8_t byte) { return byte != 0; });
    }
    std::vector<CellSpan> columns;
    for (int x = left; x < right; ++x) columns.push_back(span_of(x, top_left.x(), canvas.width));
    for (int y = top; y < bottom; ++y) {
      const CellSpan rows = span_of(y, top_left.y(), canvas.height);
      const auto first_row = drawn.begin() + rows.first;
      const auto row_count = static_cast<std::ptrdiff_t>(rows.weights.size());
      if (std::none_of(first_row, first_row + row_count, [](char any) { return any != 0; })) {
        continue;
      }
      for (int x = left; x < right; ++x) {
        const CellSpan& span = columns[static_cast<std::size_t>(x - left)];
        std::array<float, 4> sum{};  // red, green, blue, each by alpha; alpha
        for (std::size_t i = 0; i < rows.weights.size(); ++i) {
          const std::uint8_t* cell = cells.data() +
                                     (static_cast<std::size_t>(rows.first) + i) * row_bytes +
                                     4 * static_cast<std::size_t>(span.first);
          for (const float weight : span.weights) {
            const float alpha = rows.weights[i] * weight * static_cast<float>(cell[3]);
            sum[0] += alpha * static_cast<float>(cell[0]);
            sum[1] += alpha * static_cast<float>(cell[1]);
            sum[2] += alpha * static_cast<float>(cell[2]);
            sum[3] += alpha;
            cell += 4;
          }
        }
        if (sum[3] <= 0.0F) continue;
        const auto channel = [&](std::size_t i) {
          return static_cast<std::uint8_t>(std::min(sum[i] / sum[3] + 0.5F, 255.0F));
        };
        painter_.blend(x, y, {channel(0), channel(1), channel(2), 255},
                       std::min(sum[3] / 255.0F, 1.0F));
      }
    }
  }

  void draw_docks() {
    std::size_t index = 0;
    for (const DockDescription& dock : scene_.arena.docks) {
      const std::vector<Vec2> corners = layout_(box_corners(dock.pose, dock.size));
      Shape area;
      area.add_piece(corners);
      painter_.fill(area, palette::kDock);
      draw_dock_corners(corners);
      const Vec2 center = layout_(dock.pose.position());
      const double side_px = dock.size.minCoeff() * layout_.pixels_per_m;
      draw_bolt(center, 0.3 * side_px);
      draw_dock_number(dock_label(dock.name, index++), dock, side_px);
    }
  }

  // Marks of a parking place: an angle at each corner.
  void draw_dock_corners(const std::vector<Vec2>& corners) {
    Shape marks;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec2& corner = corners[i];
      const Vec2 to_next = (corners[(i + 1) % 4] - corner) * 0.18;
      const Vec2 to_last = (corners[(i + 3) % 4] - corner) * 0.18;
      marks.add_line({corner + to_next, corner, corner + to_last}, line_px(2.0));
    }
    painter_.fill(marks, palette::kDockInk);
  }

  // A flash of lightning, the sign of charging, always upright.
  void draw_bolt(const Vec2& center, double half_height_px) {
    const double h = half_height_px;
    Shape bolt;
    bolt.add_outline({center + h * Vec2(0.22, -1.0), center + h * Vec2(-0.52, 0.16),
                      center + h * Vec2(-0.06, 0.16), center + h * Vec2(-0.22, 1.0),
                      center + h * Vec2(0.52, -0.16), center + h * Vec2(0.06, -0.16)});
    painter_.fill(bolt, palette::kDockInk, 0.75);
  }

  void draw_dock_number(const std::string& label, const DockDescription& dock, double side_px) {
    if (!layout_.text) return;
    TextStyle style;
    style.cap_height_px = std::min(0.15 * side_px, 40.0 * unit_px_);
    style.weight = 0.14;
    style.colour = palette::kDockInk;
    if (style.cap_height_px < 5.0) return;  // would not be legible
    const Vec2 corner = layout_(dock.pose * Vec2(-0.5 * dock.size.x(), -0.5 * dock.size.y()));
    const Vec2 center = layout_(dock.pose.position());
    // In the rear right corner, which a docked robot leaves free.
    const Vec2 middle = corner + (center - corner) * 0.38;
    painter_.draw_text(label,
                       {middle.x() - 0.5 * Painter::text_width_px(label, style),
                        middle.y() + 0.5 * style.cap_height_px},
                       style);
  }

  void draw_retracted() {
    Shape outlines;
    for (const ObstacleDescription& obstacle : scene_.arena.obstacles) {
      if (!is_retracted(obstacle)) continue;
      outlines.add_dashed_outline(layout_(box_corners(obstacle)), line_px(1.6), line_px(5.0, 3.0));
    }
    painter_.fill(outlines, palette::kDynamic, 0.6);
  }

  // Hits of a robot's newest scan in the picture.
  [[nodiscard]] std::vector<Vec2> hits_of(const RobotSnapshot& robot) const {
    std::vector<Vec2> hits;
    if (!is_drawable(layout_(robot.scan_origin))) return hits;
    hits = layout_(robot.scan_points);
    std::erase_if(hits, [](const Vec2& hit) { return !is_drawable(hit); });
    return hits;
  }

  // Fans of many robots lie upon each other: together they must not hide the floor.
  [[nodiscard]] double fan_strength() const {
    const auto count = std::count_if(scene_.robots.begin(), scene_.robots.end(),
                                     [](const auto& robot) { return !robot.scan_points.empty(); });
    return 1.0 / std::pow(static_cast<double>(std::max<std::ptrdiff_t>(count, 1)), 0.7);
  }

  void draw_fans() {
    const double strength = fan_strength();
    for (const RobotSnapshot& robot : scene_.robots) {
      std::vector<Vec2> outline = hits_of(robot);
      if (outline.empty()) continue;
      const Vec2 origin = layout_(robot.scan_origin);
      double farthest_px = 1.0;
      for (const Vec2& hit : outline) farthest_px = std::max(farthest_px, (hit - origin).norm());
      Shape sides;
      sides.add_line({outline.front(), origin, outline.back()}, line_px(0.9, 0.7));
      outline.push_back(origin);
      Shape fan;
      fan.add_outline(outline);
      const Colour colour = opaque(robot.colour);
      painter_.fill_fading(fan, colour, origin, farthest_px, 0.34 * strength, 0.13 * strength);
      painter_.fill(sides, colour, 0.6 * strength);
    }
  }

  // The rims of the fans where they meet something, on top of what they meet.
  void draw_seen_surfaces() {
    const double strength = fan_strength();
    for (const RobotSnapshot& robot : scene_.robots) {
      const std::vector<Vec2> hits = hits_of(robot);
      if (hits.empty()) continue;
      const Vec2 origin = layout_(robot.scan_origin);
      double farthest_px = 0.0;
      for (const Vec2& hit : hits) farthest_px = std::max(farthest_px, (hit - origin).norm());
      Shape rim;
      std::vector<Vec2> surface;
      const auto end_surface = [&] {
        if (surface.size() > 1) rim.add_line(thinned(surface, 0.75), line_px(1.8, 1.0));
        surface.clear();
      };
      for (const Vec2& hit : hits) {
        const Vec2 b = hit - origin;
        if (!surface.empty()) {
          const Vec2 a = surface.back() - origin;
          // Beams that end at the farthest reach both have most likely met nothing.
          const bool missed = std::min(a.norm(), b.norm()) >= farthest_px * (1.0 - 1e-6);
          const double cross = std::abs(a.x() * b.y() - a.y() * b.x());
          const double along_px = std::min(a.norm(), b.norm()) * std::atan2(cross, a.dot(b));
          const bool behind = (b - a).norm() > 8.0 * along_px + 1.5 * unit_px_;
          if (missed || behind) end_surface();
        }
        surface.push_back(hit);
      }
      end_surface();
      painter_.fill(rim, opaque(robot.colour), 0.35 + 0.5 * strength);
    }
  }

  // A line that is fainter where it is older. The parts' opacities are united by the greatest one,
  // so that neither joints nor crossings stand out.
  void draw_trails() {
    constexpr std::size_t kShades = 24;
    for (const RobotSnapshot& robot : scene_.robots) {
      const std::vector<Vec2> points = thinned(layout_(robot.trail), std::max(0.75, unit_px_));
      if (points.size() < 2) continue;
      const std::size_t segments = points.size() - 1;
      const std::size_t parts = std::min(kShades, segments);
      std::vector<Mask> masks;
      for (std::size_t part = 0; part < parts; ++part) {
        const std::size_t first = segments * part / parts;
        const std::size_t last = segments * (part + 1) / parts;
        Shape line;
        line.add_line({points.begin() + static_cast<std::ptrdiff_t>(first),
                       points.begin() + static_cast<std::ptrdiff_t>(last) + 1},
                      line_px(2.4, 1.2));
        const double age = 1.0 - static_cast<double>(part + 1) / static_cast<double>(parts);
        masks.push_back(painter_.mask(line));
        for (float& coverage : masks.back().coverage) {
          coverage *= static_cast<float>(0.8 - 0.6 * age);
        }
      }
      painter_.fill(greatest(masks), mix(opaque(robot.colour), palette::kInk, 0.12));
    }
  }

  // The greatest of the masks in each pixel.
  static Mask greatest(const std::vector<Mask>& masks) {
    Mask all = masks.front();
    int right = all.left + all.width;
    int bottom = all.top + all.height;
    for (const Mask& mask : masks) {
      all.left = std::min(all.left, mask.left);
      all.top = std::min(all.top, mask.top);
      right = std::max(right, mask.left + mask.width);
      bottom = std::max(bottom, mask.top + mask.height);
    }
    all.width = right - all.left;
    all.height = bottom - all.top;
    all.coverage.assign(static_cast<std::size_t>(all.width) * static_cast<std::size_t>(all.height),
                        0.0F);
    for (const Mask& mask : masks) {
      const float* in = mask.coverage.data();
      for (int y = mask.top - all.top; y < mask.top - all.top + mask.height; ++y) {
        float* out = all.coverage.data() +
                     static_cast<std::size_t>(y) * static_cast<std::size_t>(all.width) +
                     (mask.left - all.left);
        for (int x = 0; x < mask.width; ++x, ++out, ++in) *out = std::max(*out, *in);
      }
    }
    return all;
  }

  // Borders, separators, blocks and walls: shadows first, so that none falls on a neighbour's top.
  void draw_solids() {
    const ArenaDescription& arena = scene_.arena;
    Shape borders;
    Shape separators;
    Shape statics;
    Shape dynamics;
    Shape walls;
    const double border_px = border_width_px();
    if (arena.border) {
      borders.add_outline(rectangle_corners(layout_.floor, border_px));
      std::vector<Vec2> inner = rectangle_corners(layout_.floor, 0.0);
      std::reverse(inner.begin(), inner.end());
      borders.add_outline(inner);
    }
    for (const ObstacleDescription& box : arena.dock_separators) {
      separators.add_piece(layout_(box_corners(box)));
    }
    for (const ObstacleDescription& box : arena.obstacles) {
      if (is_retracted(box)) continue;
      (box.type == ObstacleType::kDynamic ? dynamics : statics)
          .add_piece(layout_(box_corners(box)));
    }
    for (const WallLoop& loop : arena.walls) walls.add_outline(layout_(loop.vertices));

    draw_shadows({&separators, &statics, &dynamics, &walls});
    if (arena.border) {
      draw_border_shade();
    } else {
      outline(rectangle_corners(layout_.floor, 0.0), palette::kFaintInk, line_px(1.2), 0.6);
    }
    painter_.fill(walls, palette::kWall);
    for (const WallLoop& loop : arena.walls) {
      outline(layout_(loop.vertices), palette::kWallEdge, line_px(1.0, 0.7));
    }
    painter_.fill(borders, palette::kBorder);
    if (arena.border) {
      outline(rectangle_corners(layout_.floor, border_px), palette::kBorderEdge, line_px(1.2));
      outline(rectangle_corners(layout_.floor, 0.0), palette::kBorderEdge, line_px(1.2));
    }
    painter_.fill(separators, palette::kBorder);
    for (const ObstacleDescription& box : arena.dock_separators) {
      outline(layout_(box_corners(box)), palette::kBorderEdge, line_px(1.2));
    }
    painter_.fill(statics, palette::kStatic);
    painter_.fill(dynamics, palette::kDynamic);
    for (const ObstacleDescription& box : arena.obstacles) {
      if (is_retracted(box)) continue;
      const bool dynamic = box.type == ObstacleType::kDynamic;
      draw_block_edge(box, dynamic ? palette::kDynamicEdge : palette::kStaticEdge);
    }
  }

  // Edge within the block's outline, so that blocks side by side do not grow into each other.
  void draw_block_edge(const ObstacleDescription& box, Colour colour) {
    const double width_px = line_px(1.6);
    const double inset_m = width_px / layout_.pixels_per_m;
    if (box.size.minCoeff() <= 2.0 * inset_m) return;
    const Pose X_WB{box.center.x(), box.center.y(), box.yaw_rad};
    outline(layout_(box_corners(X_WB, box.size - Vec2(inset_m, inset_m))), colour, width_px);
  }

  void outline(const std::vector<Vec2>& points, Colour colour, double width_px,
               double opacity = 1.0) {
    Shape line;
    line.add_line(points, width_px, true);
    painter_.fill(line, colour, opacity);
  }

  // Soft shadows to the lower right: copies at growing distance, each fainter.
  void draw_shadows(const std::vector<const Shape*>& solids) {
    Shape all;
    for (const Shape* solid : solids) all.append(*solid, Vec2::Zero());
    for (const double distance : {1.0, 2.2, 3.6, 5.0}) {
      Shape moved;
      moved.append(all, Vec2(0.8, 1.0) * distance * unit_px_);
      painter_.fill(moved, palette::kShadow, 0.075);
    }
  }

  // The border's shade on the floor along its upper and left side.
  void draw_border_shade() {
    const Rectangle& floor = layout_.floor;
    for (const double depth : {1.5, 3.0, 5.0}) {
      const double d = depth * unit_px_;
      Shape shade;
      shade.add_piece({{floor.left, floor.top},
                       {floor.right, floor.top},
                       {floor.right, floor.top + d},
                       {floor.left + 0.8 * d, floor.top + d},
                       {floor.left + 0.8 * d, floor.bottom},
                       {floor.left, floor.bottom}});
      painter_.fill(shade, palette::kShadow, 0.06);
    }
  }

  // Distance from the axle's centre to the footprint's farthest corner.
  [[nodiscard]] double radius_px(const RobotSnapshot& robot) const {
    double radius_m = 0.0;
    for (const Vec2& corner : robot.footprint) radius_m = std::max(radius_m, corner.norm());
    return radius_m * layout_.pixels_per_m;
  }

  // Radius of a robot with the disc that marks it where it is small.
  [[nodiscard]] double marked_radius_px(const RobotSnapshot& robot) const {
    return std::max(radius_px(robot), 8.0 * unit_px_);
  }

  void draw_robot(const RobotSnapshot& robot) {
    if (!has_place(robot)) return;
    const Colour colour = opaque(robot.colour);
    const Colour dark = mix(colour, palette::kWheel, 0.65);
    const Vec2 center = layout_(robot.X_WB.position());
    const double radius = radius_px(robot);
    const bool small = radius < marked_radius_px(robot);
    if (small) draw_marker(robot, center, colour);
    if (robot.stalled) draw_stall_ring(center, marked_radius_px(robot));

    Vec2 low = robot.footprint.front();
    Vec2 high = low;
    for (const Vec2& corner : robot.footprint) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    const auto on_body = [&](const Vec2& p_B) { return layout_(robot.X_WB * p_B); };
    // Points given as shares of the body's reach ahead and to the left.
    const auto at = [&](double x, double y) {
      return on_body({x * (x >= 0.0 ? high.x() : -low.x()), y * (y >= 0.0 ? high.y() : -low.y())});
    };

    std::vector<Vec2> body;
    for (const Vec2& corner : robot.footprint) body.push_back(on_body(corner));
    Shape area;
    area.add_piece(body);
    for (const double distance : {1.0, 2.2, 3.4}) {
      Shape shadow;
      shadow.append(area, Vec2(0.8, 1.0) * distance * unit_px_);
      painter_.fill(shadow, palette::kShadow, 0.09);
    }
    painter_.fill(area, colour);
    if (small) {
      outline(body, dark, line_px(1.0));
      return;  // of the rest nothing could be told apart
    }
    Shape wheels;
    for (const double side : {-1.0, 1.0}) {
      wheels.add_piece({at(-0.42, side * 0.98), at(0.42, side * 0.98), at(0.42, side * 0.74),
                        at(-0.42, side * 0.74)});
    }
    painter_.fill(wheels, palette::kWheel);
    // The nose: an arrow head, light on dark robots and dark on light ones.
    const Colour mark = luma(colour) > 0.78 ? palette::kWheel : palette::kLight;
    Shape nose;
    nose.add_line({at(0.50, 0.46), at(0.82, 0.0), at(0.50, -0.46)},
                  std::max(0.1 * radius, line_px(1.2)));
    painter_.fill(nose, mark);
    if (!robot.scan_points.empty()) {
      Shape sensor;
      sensor.add_disc(at(0.40, 0.0), 0.12 * radius);
      painter_.fill(sensor, palette::kWheel);
    }
    outline(body, dark, line_px(1.5));
  }

  // Shows where a robot is, and where it heads, that is only a few pixels large.
  void draw_marker(const RobotSnapshot& robot, const Vec2& center, Colour colour) {
    const double radius = marked_radius_px(robot);
    Shape disc;
    disc.add_disc(center, radius);
    painter_.fill(disc, colour, 0.35);
    Shape rim;
    const Vec2 ahead(std::cos(robot.X_WB.yaw_rad), -std::sin(robot.X_WB.yaw_rad));
    rim.add_line({center, center + ahead * (1.7 * radius)}, line_px(2.0, 1.0));
    painter_.fill(rim, mix(colour, palette::kWheel, 0.3));
    ring(center, radius, line_px(1.4), mix(colour, palette::kWheel, 0.3));
  }

  void ring(const Vec2& center, double radius, double width_px, Colour colour) {
    Shape outer;
    outer.add_disc(center, radius + 0.5 * width_px);
    Shape inner;
    inner.add_disc(center, std::max(radius - 0.5 * width_px, 0.0));
    outer.cut(inner);
    painter_.fill(outer, colour);
  }

  void draw_stall_ring(const Vec2& center, double robot_radius) {
    const double radius = robot_radius + 6.0 * unit_px_;
    ring(center, radius, line_px(6.0), palette::kHalo);
    ring(center, radius, line_px(3.2), palette::kStalled);
  }

  struct Label {
    std::string text;
    TextStyle style;
    double width_px = 0.0;
    Vec2 center = Vec2::Zero();  // of the robot
    double radius_px = 0.0;      // of the robot
    Rectangle place;
  };

  // Names beside the robots. Each takes, of places all round its robot, the one that covers least
  // of other names and robots; a second round lets early names give way to later ones.
  void draw_names() {
    std::vector<Label> labels;
    std::vector<Rectangle> bodies;
    for (const RobotSnapshot& robot : scene_.robots) {
      if (!has_place(robot)) continue;
      Label label;
      label.center = layout_(robot.X_WB.position());
      label.radius_px = marked_radius_px(robot) + (robot.stalled ? 8.0 * unit_px_ : 0.0);
      const Vec2 reach = Vec2::Constant(0.9 * label.radius_px);
      bodies.push_back(rectangle(label.center - reach, label.center + reach));
      const Colour colour = opaque(robot.colour);
      label.style = text_style(11.5, mix(colour, palette::kInk, luma(colour) > 0.5 ? 0.8 : 0.55));
      label.style.weight = 0.15;
      label.style.halo = palette::kHalo;
      label.style.halo_px = std::max(2.4 * unit_px_, 1.5);
      label.text = shortened(robot.name, label.style, 0.4 * layout_.width);
      label.width_px = Painter::text_width_px(label.text, label.style);
      if (!label.text.empty()) labels.push_back(std::move(label));
    }
    for (const int round : {0, 1}) {
      for (std::size_t i = 0; i < labels.size(); ++i) {
        std::vector<Rectangle> names;
        for (std::size_t j = 0; j < labels.size(); ++j) {
          if (j != i && (round == 1 || j < i)) names.push_back(labels[j].place);
        }
        labels[i].place = best_place(labels[i], names, bodies);
      }
    }
    for (const Label& label : labels) {
      painter_.draw_text(label.text, {label.place.left, label.place.bottom}, label.style);
    }
  }

  [[nodiscard]] Rectangle best_place(const Label& label, const std::vector<Rectangle>& names,
                                     const std::vector<Rectangle>& bodies) const {
    // Directions by preference: above, below, right, left, then the corners.
    constexpr std::array<std::array<double, 2>, 8> kDirections = {
        {{0, -1}, {0, 1}, {1, 0}, {-1, 0}, {0.8, -0.8}, {-0.8, -0.8}, {0.8, 0.8}, {-0.8, 0.8}}};
    const Vec2 half(0.5 * label.width_px, 0.5 * label.style.cap_height_px);
    const double area = 4.0 * half.x() * half.y();
    const double edge = label.style.halo_px + 1.0;
    Rectangle best;
    double least_cost = std::numeric_limits<double>::infinity();
    double preference = 0.0;
    for (const double gap : {5.5, 16.0}) {
      for (const auto& direction : kDirections) {
        const double reach = label.radius_px + gap * unit_px_;
        Vec2 middle = label.center +
                      Vec2(direction[0] * (reach + half.x()), direction[1] * (reach + half.y()));
        // On the floor where it is wide enough, else in the picture and above the footer.
        const bool fits = layout_.floor.right - layout_.floor.left > 2.0 * (half.x() + edge);
        const double least_x = fits ? layout_.floor.left : 0.0;
        const double most_x = fits ? layout_.floor.right : layout_.width;
        const double least_y = half.y() + edge;
        middle.x() = std::clamp(middle.x(), least_x + half.x() + edge,
                                std::max(most_x - half.x() - edge, least_x + half.x() + edge));
        middle.y() = std::clamp(middle.y(), least_y,
                                std::max(least_y, layout_.floor.bottom - half.y() - edge));
        const Rectangle place = rectangle(middle - half, middle + half);
        const Rectangle with_halo =
            rectangle(middle - half - Vec2(edge, edge), middle + half + Vec2(edge, edge));
        double cost = preference;
        for (const Rectangle& name : names) cost += 12.0 * with_halo.overlap(name) / area;
        for (const Rectangle& body : bodies) cost += 5.0 * with_halo.overlap(body) / area;
        cost += 3.0 * (1.0 - place.overlap(layout_.floor) / area);
        if (cost < least_cost) {
          least_cost = cost;
          best = place;
        }
        preference += 0.12;
      }
    }
    return best;
  }

  // The footer: scale bar on the left, the world's name in the middle, the time on the right.
  void draw_legend() {
    const TextStyle style = text_style(15.0, palette::kInk);
    TextStyle small = text_style(12.5, palette::kInk);
    const double border_px = border_width_px();
    const double left = std::min(layout_.floor.left - border_px, layout_.margin_px);
    const double right = layout_.width - left;
    const double middle_y =
        layout_.floor.bottom + border_px + 0.5 * (layout_.footer_px - border_px);
    const double gap = 24.0 * unit_px_;

    const double length_m = round_below(0.2 * layout_.width / layout_.pixels_per_m);
    const double bar_px = length_m * layout_.pixels_per_m;
    draw_scale_bar({left, middle_y}, bar_px);
    const std::string length_text = number_text(length_m) + " m";
    const double text_left = left + bar_px + 10.0 * unit_px_;
    painter_.draw_text(length_text, {text_left, middle_y + 0.5 * small.cap_height_px}, small);
    const double left_end = text_left + Painter::text_width_px(length_text, small);

    const std::string time = time_text(scene_.time_s);
    const double time_left = right - Painter::text_width_px(time, small);
    if (time_left < left_end + gap) return;
    painter_.draw_text(time, {time_left, middle_y + 0.5 * small.cap_height_px}, small);

    // In the middle of the picture if there is room, else of what room there is.
    const double room_left = left_end + gap;
    const double room_right = time_left - gap;
    const std::string name = shortened(scene_.world_name, style, room_right - room_left);
    if (name.empty()) return;
    const double name_px = Painter::text_width_px(name, style);
    const double name_left =
        std::clamp(0.5 * (layout_.width - name_px), room_left, room_right - name_px);
    painter_.draw_text(name, {name_left, middle_y + 0.5 * style.cap_height_px}, style);
  }

  // A bar of two halves, the second hollow.
  void draw_scale_bar(const Vec2& start, double length_px) {
    const double half_height = line_px(4.0, 2.0);
    const double width_px = line_px(1.6, 1.0);
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

  [[nodiscard]] double border_width_px() const {
    if (!scene_.arena.border) return 0.0;
    return std::clamp(0.035 * layout_.pixels_per_m, 6.0 * unit_px_, 0.5 * layout_.margin_px);
  }

  static bool is_retracted(const ObstacleDescription& obstacle) {
    return obstacle.type == ObstacleType::kDynamic && obstacle.state == ObstacleState::kRetracted;
  }
  [[nodiscard]] bool has_place(const RobotSnapshot& robot) const {
    return !robot.footprint.empty() && is_drawable(layout_(robot.X_WB.position())) &&
           std::isfinite(robot.X_WB.yaw_rad);
  }
  static Colour opaque(Colour colour) { return {colour.r, colour.g, colour.b, 255}; }
  static Rectangle rectangle(const Vec2& low, const Vec2& high) {
    return {low.x(), low.y(), high.x(), high.y()};
  }

  const SceneSnapshot& scene_;
  const RenderOptions& options_;
  Layout layout_;
  double unit_px_;
  Painter painter_;
};

std::size_t canvas_bytes(const CanvasDescription& description) {
  if (description.width < 1 || description.height < 1) return 0;
  return 4 * static_cast<std::size_t>(description.width) *
         static_cast<std::size_t>(description.height);
}

}  // namespace

Image draw_scene(const SceneSnapshot& scene, const RenderOptions& options) {
  if (options.size_px < kLeastSizePx || options.size_px > kGreatestSizePx) {
    throw std::invalid_argument("size of a picture must be in " + std::to_string(kLeastSizePx) +
                                ".." + std::to_string(kGreatestSizePx) + " pixels, found " +
                                std::to_string(options.size_px));
  }
  if (!scene.canvas.empty() && scene.canvas.size() != canvas_bytes(scene.canvas_description)) {
    throw std::invalid_argument("a scene's canvas must have 4 bytes a cell");
  }
  return ScenePainter(scene, options).draw();
}

Image draw_canvas(const CanvasDescription& description, const std::vector<std::uint8_t>& rgba,
                  int scale) {
  if (scale < 1 || description.width > kGreatestCanvasPicturePx / scale ||
      description.height > kGreatestCanvasPicturePx / scale) {
    throw std::invalid_argument("scale of a canvas picture must be at least 1, and its sides at " +
                                std::string("most ") + std::to_string(kGreatestCanvasPicturePx) +
                                " pixels");
  }
  if (rgba.empty() || rgba.size() != canvas_bytes(description)) {
    throw std::invalid_argument("a canvas must have 4 bytes a cell");
  }
  Image image{description.width * scale, description.height * scale, {}};
  const auto copies = static_cast<std::size_t>(scale);
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(image.width);
  image.rgb.reserve(row_bytes * static_cast<std::size_t>(image.height));
  const std::uint8_t* cell = rgba.data();
  for (int row = 0; row < description.height; ++row) {
    for (int column = 0; column < description.width; ++column, cell += 4) {
      std::array<std::uint8_t, 3> over_white{};
      for (std::size_t i = 0; i < 3; ++i) {
        over_white[i] =
            static_cast<std::uint8_t>((cell[i] * cell[3] + 255 * (255 - cell[3]) + 127) / 255);
      }
      for (std::size_t copy = 0; copy < copies; ++copy) {
        image.rgb.insert(image.rgb.end(), over_white.begin(), over_white.end());
      }
    }
    for (std::size_t copy = 1; copy < copies; ++copy) {
      image.rgb.insert(image.rgb.end(), image.rgb.end() - static_cast<std::ptrdiff_t>(row_bytes),
                       image.rgb.end());
    }
  }
  return image;
}

}  // namespace sim::render
