// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "render/robot_painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace sim::render {
namespace {

// Much less than this far a line may be off its points without anybody seeing it.
constexpr double kTolerance_px = 0.15;
constexpr double kAnyLength_px = 1e9;

// A polyline with fewer points that passes all of those left out within `tolerance_px`, and none of
// whose parts is longer than `longest_px` unless one was. What comes of points does not
// change when more are added behind them, but for the last part: in a film, lines lie still.
//
// From a point that is kept, each further one narrows the cone of directions in which a line passes
// all since; the last one within the cone is kept next. (The idea is in Imai and Iri, Polygonal
// approximations of a curve, 1988, there for the least number of points.)
std::vector<Vec2> simplified(const std::vector<Vec2>& points, double tolerance_px,
                             double longest_px) {
  const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
  std::vector<Vec2> kept;
  Vec2 last = Vec2::Zero();  // the newest point
  Vec2 left = Vec2::Zero();  // the cone's sides, of length 1
  Vec2 right = Vec2::Zero();
  bool cone = false;
  double reach_px = 0.0;  // of the points since the last one kept
  for (const Vec2& point : points) {
    if (!is_drawable(point)) continue;
    if (kept.empty()) {
      kept.push_back(point);
      last = point;
      continue;
    }
    Vec2 way = point - kept.back();
    double distance_px = way.norm();
    const bool fits = distance_px <= longest_px && distance_px >= reach_px - tolerance_px &&
                      (!cone || (way.dot(left + right) > 0.0 && cross(right, way) >= 0.0 &&
                                 cross(way, left) >= 0.0));
    if (!fits && last != kept.back()) {
      kept.push_back(last);
      way = point - last;
      distance_px = way.norm();
      cone = false;
      reach_px = 0.0;
    }
    last = point;
    reach_px = std::max(reach_px, distance_px);
    if (distance_px <= tolerance_px) continue;
    const double sine = tolerance_px / distance_px;
    const double cosine = std::sqrt(1.0 - sine * sine);
    const Vec2 ahead = way / distance_px;
    const Vec2 aside(-ahead.y(), ahead.x());
    const Vec2 new_left = ahead * cosine + aside * sine;
    const Vec2 new_right = ahead * cosine - aside * sine;
    if (!cone || cross(new_left, left) > 0.0) left = new_left;
    if (!cone || cross(right, new_right) > 0.0) right = new_right;
    cone = true;
  }
  if (!kept.empty() && last != kept.back()) kept.push_back(last);
  return kept;
}

class RobotPainter {
 public:
  RobotPainter(const SceneSnapshot& scene, const Layout& layout, Painter& painter)
      : scene_(scene), layout_(layout), painter_(painter) {}

  void draw_fans(const std::vector<std::uint8_t>& cells) {
    const double strength = fan_strength() * (1.0 - 0.4 * drawn_share(cells));
    for (const RobotSnapshot& robot : scene_.robots) {
      std::vector<Vec2> outline = hits_of(robot);
      if (outline.empty()) continue;
      const Vec2 origin = layout_(robot.scan_origin);
      double farthest_px = 1.0;
      for (const Vec2& hit : outline) farthest_px = std::max(farthest_px, (hit - origin).norm());
      Shape sides;
      sides.add_line({outline.front(), origin, outline.back()}, layout_.line_px(0.9, 0.7));
      outline.push_back(origin);
      Shape fan;
      fan.add_outline(outline);
      const Colour colour = opaque(robot.colour);
      painter_.fill_fading(fan, colour, origin, farthest_px, 0.34 * strength, 0.13 * strength);
      painter_.fill(sides, colour, 0.6 * strength);
    }
  }

  // Sonar cones up to their ranges, with an arc where the echo came from, and infrared rays with a
  // dot. Cones lie upon each other: of one robot's the most opaque counts.
  void draw_cones() {
    const auto count =
        std::count_if(scene_.robots.begin(), scene_.robots.end(),
                      [](const RobotSnapshot& robot) { return !robot.cones.empty(); });
    const double strength =
        1.0 / std::sqrt(static_cast<double>(std::max<std::ptrdiff_t>(count, 1)));
    for (const RobotSnapshot& robot : scene_.robots) {
      const Colour colour = opaque(robot.colour);
      // Beside a laser's fan they are only hinted at.
      const double share = strength * (robot.scan_points.empty() ? 1.0 : 0.55);
      Shape echoes;
      for (const ConeSnapshot& cone : robot.cones) {
        const Vec2 apex = layout_(cone.X_WS.position());
        const std::vector<Vec2> rim = layout_(rim_of(cone));
        if (!is_drawable(apex) ||
            !std::all_of(rim.begin(), rim.end(), [](const Vec2& p) { return is_drawable(p); })) {
          continue;
        }
        Shape area;
        if (cone.field_of_view_rad > 0.0) {
          std::vector<Vec2> outline = rim;
          outline.push_back(apex);
          area.add_piece(outline);
          if (cone.met) echoes.add_line(rim, layout_.line_px(1.6, 0.9));
        } else {
          area.add_line({apex, rim.front()}, layout_.line_px(1.2, 0.8));
          if (cone.met) echoes.add_disc(rim.front(), layout_.line_px(2.6, 1.4));
        }
        const double ray = cone.field_of_view_rad > 0.0 ? 1.0 : 2.2;
        painter_.unite(area, share * ray * (cone.met ? 0.16 : 0.07));
      }
      painter_.fill_united(colour);
      painter_.fill(echoes, mix(colour, palette::kInk, 0.2), std::min(1.0, 0.75 * share + 0.1));
    }
  }

  // Thin lines from fiducial finders to what they see, which gets a ring.
  void draw_sights() {
    for (const RobotSnapshot& robot : scene_.robots) {
      Shape lines;
      for (const auto& [from, to] : robot.sights) {
        const Vec2 a = layout_(from);
        const Vec2 b = layout_(to);
        if (!is_drawable(a) || !is_drawable(b)) continue;
        const double radius = layout_.line_px(5.0, 3.0);
        const double length = (b - a).norm();
        if (length > radius) {
          lines.add_line({a, b - (b - a) * (radius / length)}, layout_.line_px(1.1, 0.7));
        }
        Shape halo;
        halo.add_disc(b, radius + layout_.line_px(1.6, 0.9));
        painter_.fill(halo, palette::kHalo, 0.85);
        ring(b, radius, layout_.line_px(1.8, 1.0), opaque(robot.colour));
      }
      painter_.fill(lines, opaque(robot.colour), 0.7);
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
        if (surface.size() > 1)
          rim.add_line(simplified(surface, kTolerance_px, kAnyLength_px),
                       layout_.line_px(1.8, 1.0));
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
          const bool behind = (b - a).norm() > 8.0 * along_px + 1.5 * layout_.unit_px;
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
  void draw_trails(const std::vector<std::uint8_t>& cells) {
    constexpr int kShades = 24;
    for (const RobotSnapshot& robot : scene_.robots) {
      // A long straight stretch is cut, so that it gets its shades, too.
      const std::vector<Vec2> points =
          simplified(layout_(robot.trail), kTolerance_px, 24.0 * layout_.unit_px);
      if (points.size() < 2) continue;
      const double strength = 1.0 - 0.9 * coloured_share(robot.trail, cells);
      double length_px = 0.0;
      for (std::size_t i = 1; i < points.size(); ++i)
        length_px += (points[i] - points[i - 1]).norm();
      double done_px = 0.0;
      std::size_t first = 0;
      for (int shade = 0; shade < kShades && first + 1 < points.size(); ++shade) {
        const double end_px = length_px * (shade + 1) / kShades;
        std::size_t last = first;
        while (last + 1 < points.size() && (done_px < end_px || shade + 1 == kShades)) {
          ++last;
          done_px += (points[last] - points[last - 1]).norm();
        }
        if (last == first) continue;
        Shape line;
        line.add_line({points.begin() + static_cast<std::ptrdiff_t>(first),
                       points.begin() + static_cast<std::ptrdiff_t>(last) + 1},
                      layout_.line_px(2.4, 1.2));
        const double age = 1.0 - static_cast<double>(shade + 1) / kShades;
        painter_.unite(line, strength * (0.8 - 0.6 * age));
        first = last;
      }
      painter_.fill_united(mix(opaque(robot.colour), palette::kInk, 0.12));
    }
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
    if (robot.marked) draw_mark(center, marked_radius_px(robot));

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
      shadow.append(area, Vec2(0.8, 1.0) * distance * layout_.unit_px);
      painter_.fill(shadow, palette::kShadow, 0.09);
    }
    painter_.fill(area, colour);
    if (small) {
      outline(body, dark, layout_.line_px(1.0));
      draw_lights(robot);
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
                  std::max(0.1 * radius, layout_.line_px(1.2)));
    painter_.fill(nose, mark);
    if (!robot.scan_points.empty()) {
      Shape sensor;
      sensor.add_disc(at(0.40, 0.0), 0.12 * radius);
      painter_.fill(sensor, palette::kWheel);
    }
    Shape paddles;
    for (const Polygon& paddle : robot.paddles) {
      std::vector<Vec2> piece;
      for (const Vec2& p_B : paddle) piece.push_back(layout_(robot.X_WB * p_B));
      paddles.add_piece(piece);
    }
    painter_.fill(paddles, palette::kWheel);
    outline(body, dark, layout_.line_px(1.5));
    draw_bumpers(robot, dark);
    draw_lights(robot);
  }

  // Bubbles beside the robots that say something, none over another if there is room.
  void draw_speech() {
    for (const Bubble& bubble : bubbles()) {
      Shape shape;
      shape.add_piece(rounded(bubble.place, layout_.line_px(5.0, 2.0)));
      shape.add_piece(bubble.tail);
      for (const double distance : {1.2, 2.6}) {
        Shape shadow;
        shadow.append(shape, Vec2(0.6, 1.0) * distance * layout_.unit_px);
        painter_.fill(shadow, palette::kShadow, 0.1);
      }
      // The inner half of the rim is covered by the bubble itself, and so is what divides its
      // parts.
      const double rim_px = 2.0 * layout_.line_px(1.5, 1.0);
      Shape rim;
      rim.add_line(rounded(bubble.place, layout_.line_px(5.0, 2.0)), rim_px, true);
      rim.add_line(bubble.tail, rim_px, true);
      painter_.fill(rim, bubble.rim);
      painter_.fill(shape, palette::kLight);
      double base = bubble.place.top + bubble.padding_px + bubble.style.cap_height_px;
      for (const std::string& line : bubble.lines) {
        const double width_px = Painter::text_width_px(line, bubble.style);
        painter_.draw_text(line, {0.5 * (bubble.place.left + bubble.place.right - width_px), base},
                           bubble.style);
        base += bubble.line_px;
      }
    }
  }

  // Names beside the robots. Each takes, of places all round its robot, the one that covers least
  // of other names and robots; a second round lets early names give way to later ones.
  void draw_names() {
    std::vector<Label> labels;
    std::vector<Rectangle> bodies;
    for (const RobotSnapshot& robot : scene_.robots) {
      if (!has_place(robot)) continue;
      Label label;
      label.center = layout_(robot.X_WB.position());
      label.radius_px = marked_radius_px(robot) + (robot.marked    ? 15.0
                                                   : robot.stalled ? 8.0
                                                                   : 0.0) *
                                                      layout_.unit_px;
      const Vec2 reach = Vec2::Constant(0.9 * label.radius_px);
      bodies.push_back(rectangle(label.center - reach, label.center + reach));
      const Colour colour = opaque(robot.colour);
      label.style =
          layout_.text_style(11.5, mix(colour, palette::kInk, luma(colour) > 0.5 ? 0.8 : 0.55));
      label.style.weight = 0.15;
      label.style.halo = palette::kHalo;
      label.style.halo_px = std::max(2.4 * layout_.unit_px, 1.5);
      label.text = shortened(robot.name, label.style, 0.4 * layout_.width);
      label.width_px = Painter::text_width_px(label.text, label.style);
      if (!label.text.empty()) labels.push_back(std::move(label));
    }
    for (const Bubble& bubble : bubbles()) bodies.push_back(bubble.place);
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

 private:
  // Points along a cone's end, from its right side to its left; one for a ray.
  static std::vector<Vec2> rim_of(const ConeSnapshot& cone) {
    constexpr double kStep_rad = 0.05;
    const int steps =
        std::clamp(static_cast<int>(std::ceil(cone.field_of_view_rad / kStep_rad)), 0, 64);
    std::vector<Vec2> rim;
    for (int i = 0; i <= steps; ++i) {
      const double share = steps == 0 ? 0.5 : static_cast<double>(i) / steps;
      const double angle = cone.field_of_view_rad * (share - 0.5);
      rim.push_back(cone.X_WS *
                    Vec2(cone.range_m * std::cos(angle), cone.range_m * std::sin(angle)));
    }
    return rim;
  }

  // A thin line for each segment of a bumper, a thick red one where it is pressed.
  void draw_bumpers(const RobotSnapshot& robot, Colour dark) {
    Shape idle;
    Shape halo;
    Shape pressed;
    for (const BumperSnapshot& bumper : robot.bumpers) {
      std::vector<Vec2> line;
      for (const Vec2& p_B : bumper.line) line.push_back(layout_(robot.X_WB * p_B));
      if (bumper.pressed) {
        halo.add_line(line, layout_.line_px(6.5));
        pressed.add_line(line, layout_.line_px(4.0));
      } else {
        idle.add_line(line, layout_.line_px(2.2));
      }
    }
    painter_.fill(idle, dark);
    painter_.fill(halo, palette::kHalo);
    painter_.fill(pressed, palette::kStalled);
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

  // Share of the canvas's cells that hold something.
  static double drawn_share(const std::vector<std::uint8_t>& cells) {
    std::size_t drawn = 0;
    for (std::size_t i = 3; i < cells.size(); i += 4) drawn += cells[i] > 0 ? 1 : 0;
    return cells.empty() ? 0.0
                         : 4.0 * static_cast<double>(drawn) / static_cast<double>(cells.size());
  }

  // Share of a trail's points that lie on cells of a colour. White, grey and black do not count:
  // they are a map rather than a drawing of the way.
  [[nodiscard]] double coloured_share(const std::vector<Vec2>& trail,
                                      const std::vector<std::uint8_t>& cells) const {
    constexpr int kLeastDifference = 60;  // of the greatest and the least of red, green and blue
    constexpr int kLeastAlpha = 128;
    if (cells.empty() || trail.empty()) return 0.0;
    const CanvasDescription& canvas = scene_.canvas_description;
    std::size_t coloured = 0;
    for (const Vec2& point : trail) {
      const Vec2 place = (point - canvas.origin) / canvas.cell_size_m;
      if (!(place.x() >= 0.0 && place.x() < canvas.width && place.y() >= 0.0 &&
            place.y() < canvas.height)) {
        continue;
      }
      const auto column = static_cast<std::size_t>(place.x());
      const auto row = static_cast<std::size_t>(canvas.height - 1 - static_cast<int>(place.y()));
      const std::uint8_t* cell =
          &cells[4 * (row * static_cast<std::size_t>(canvas.width) + column)];
      const auto [least, most] = std::minmax_element(cell, cell + 3);
      coloured += *most - *least >= kLeastDifference && cell[3] >= kLeastAlpha ? 1 : 0;
    }
    return static_cast<double>(coloured) / static_cast<double>(trail.size());
  }

  // Distance from the axle's centre to the footprint's farthest corner.
  [[nodiscard]] double radius_px(const RobotSnapshot& robot) const {
    double radius_m = 0.0;
    for (const Vec2& corner : robot.footprint) radius_m = std::max(radius_m, corner.norm());
    return radius_m * layout_.pixels_per_m;
  }

  // Radius of a robot with the disc that marks it where it is small.
  [[nodiscard]] double marked_radius_px(const RobotSnapshot& robot) const {
    return std::max(radius_px(robot), 8.0 * layout_.unit_px);
  }

  // Shows where a robot is, and where it heads, that is only a few pixels large.
  void draw_marker(const RobotSnapshot& robot, const Vec2& center, Colour colour) {
    const double radius = marked_radius_px(robot);
    Shape disc;
    disc.add_disc(center, radius);
    painter_.fill(disc, colour, 0.35);
    Shape rim;
    const Vec2 ahead(std::cos(robot.X_WB.yaw_rad), -std::sin(robot.X_WB.yaw_rad));
    rim.add_line({center, center + ahead * (1.7 * radius)}, layout_.line_px(2.0, 1.0));
    painter_.fill(rim, mix(colour, palette::kWheel, 0.3));
    ring(center, radius, layout_.line_px(1.4), mix(colour, palette::kWheel, 0.3));
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
    const double radius = robot_radius + 6.0 * layout_.unit_px;
    ring(center, radius, layout_.line_px(6.0), palette::kHalo);
    ring(center, radius, layout_.line_px(3.2), palette::kStalled);
  }

  // The corners of a square round the robot that a user chose.
  void draw_mark(const Vec2& center, double robot_radius) {
    const double reach = robot_radius + 13.0 * layout_.unit_px;
    const double arm = 0.45 * reach;
    const auto corners = [&](double width_px) {
      Shape marks;
      for (const Vec2& side : {Vec2(1, 1), Vec2(1, -1), Vec2(-1, -1), Vec2(-1, 1)}) {
        const Vec2 corner = center + reach * side;
        marks.add_line(
            {corner - Vec2(arm * side.x(), 0.0), corner, corner - Vec2(0.0, arm * side.y())},
            width_px);
      }
      return marks;
    };
    painter_.fill(corners(layout_.line_px(6.5)), palette::kHalo);
    painter_.fill(corners(layout_.line_px(3.4)), palette::kInk);
  }

  // A light glows over what is round it; one that is dark is a dull dot.
  void draw_lights(const RobotSnapshot& robot) {
    const double radius = std::max(0.13 * radius_px(robot), layout_.line_px(2.6, 1.6));
    for (const LightSnapshot& light : robot.lights) {
      const Vec2 center = layout_(robot.X_WB * light.p_BL);
      if (!is_drawable(center)) continue;
      const Colour colour = opaque(light.colour);
      if (light.lit) {
        const double glow_px = 7.0 * radius;
        Shape glow;
        glow.add_disc(center, glow_px);
        painter_.fill_fading(glow, colour, center, glow_px, 0.85, 0.0);
      }
      const auto disc = [&](double size, Colour fill, double opacity = 1.0) {
        Shape shape;
        shape.add_disc(center, size);
        painter_.fill(shape, fill, opacity);
      };
      disc(radius + layout_.line_px(1.0, 0.6), palette::kWheel);
      disc(radius, light.lit ? colour : mix(colour, palette::kWheel, 0.7));
      if (light.lit) disc(0.5 * radius, palette::kLight, 0.85);
    }
  }

  struct Bubble {
    std::vector<std::string> lines;
    TextStyle style;
    double padding_px = 0.0;
    double line_px = 0.0;  // from one base line to the next
    Colour rim;
    Rectangle place;
    std::vector<Vec2> tail;
  };

  // A text as the painter can write it: one '?' for each character that is not ASCII.
  static std::string plain(const std::string& text) {
    std::string ascii;
    for (const char c : text) {
      const auto byte = static_cast<unsigned char>(c);
      if (byte < 0x80) {
        ascii += byte < 0x20 || byte == 0x7f ? ' ' : c;
      } else if (byte >= 0xc0) {
        ascii += '?';
      }
    }
    return ascii;
  }

  // A text in two lines at most, parted between words; dots stand for what has no room.
  static std::vector<std::string> wrapped(const std::string& text, const TextStyle& style,
                                          double width_px) {
    const auto fits = [&](const std::string& line) {
      return Painter::text_width_px(line, style) <= width_px;
    };
    std::string rest = text;
    rest.erase(0, std::min(rest.find_first_not_of(' '), rest.size()));
    if (rest.empty() || fits(rest)) return {rest};
    std::size_t end = 0;  // of the first line
    for (std::size_t at = rest.find(' '); at != std::string::npos; at = rest.find(' ', at + 1)) {
      if (!fits(rest.substr(0, at))) break;
      end = at;
    }
    if (end == 0) {  // a word that is longer than a line
      end = 1;
      while (end < rest.size() && fits(rest.substr(0, end + 1))) ++end;
    }
    std::string second = rest.substr(end);
    second.erase(0, std::min(second.find_first_not_of(' '), second.size()));
    return {rest.substr(0, end), shortened(second, style, width_px)};
  }

  [[nodiscard]] std::vector<Bubble> bubbles() const {
    std::vector<Bubble> all;
    std::vector<Rectangle> bodies;
    for (const RobotSnapshot& robot : scene_.robots) {
      if (!has_place(robot)) continue;
      const Vec2 center = layout_(robot.X_WB.position());
      const Vec2 reach = Vec2::Constant(marked_radius_px(robot));
      bodies.push_back(rectangle(center - reach, center + reach));
    }
    for (const RobotSnapshot& robot : scene_.robots) {
      if (robot.says.empty() || !has_place(robot)) continue;
      Bubble bubble;
      bubble.style = layout_.text_style(12.5, palette::kInk);
      bubble.padding_px = 0.75 * bubble.style.cap_height_px;
      bubble.line_px = 1.75 * bubble.style.cap_height_px;
      bubble.rim = mix(opaque(robot.colour), palette::kInk, 0.55);
      bubble.lines = wrapped(plain(robot.says), bubble.style, 0.32 * layout_.width);
      put_bubble(bubble, layout_(robot.X_WB.position()), marked_radius_px(robot), all, bodies);
      all.push_back(std::move(bubble));
    }
    return all;
  }

  // Gives a bubble the place round its robot where it covers least of others, and its tail.
  void put_bubble(Bubble& bubble, const Vec2& center, double radius,
                  const std::vector<Bubble>& others, const std::vector<Rectangle>& bodies) const {
    double width_px = 0.0;
    for (const std::string& line : bubble.lines) {
      width_px = std::max(width_px, Painter::text_width_px(line, bubble.style));
    }
    const auto further_lines = static_cast<double>(bubble.lines.size()) - 1.0;
    const Vec2 half(
        0.5 * width_px + 1.2 * bubble.padding_px,
        0.5 * (bubble.style.cap_height_px + further_lines * bubble.line_px) + bubble.padding_px);
    const double gap = 13.0 * layout_.unit_px;
    const double edge = 4.0 * layout_.unit_px;
    const double area = 4.0 * half.x() * half.y();
    constexpr std::array<std::array<double, 2>, 8> kDirections = {
        {{0.5, -1}, {-0.5, -1}, {0, -1}, {0.5, 1}, {-0.5, 1}, {0, 1}, {1, 0}, {-1, 0}}};
    double least_cost = std::numeric_limits<double>::infinity();
    double preference = 0.0;
    for (const auto& direction : kDirections) {
      const bool beside = direction[1] == 0.0;
      Vec2 middle = center + Vec2(direction[0] * (beside ? radius + gap + half.x() : half.x()),
                                  direction[1] * (radius + gap + half.y()));
      const Vec2 wanted = middle;
      const double bottom = std::max(layout_.floor.bottom, 2.0 * half.y() + 2.0 * edge);
      // Over the floor where it is wide enough, else anywhere in the picture.
      const bool fits = layout_.floor.right - layout_.floor.left > 2.0 * (half.x() + edge);
      const double least_x = (fits ? layout_.floor.left : 0.0) + half.x() + edge;
      const double most_x = (fits ? layout_.floor.right : layout_.width) - half.x() - edge;
      middle.x() = std::clamp(middle.x(), least_x, std::max(most_x, least_x));
      middle.y() = std::clamp(middle.y(), half.y() + edge,
                              std::max(bottom - half.y() - edge, half.y() + edge));
      const Rectangle place = rectangle(middle - half, middle + half);
      double cost = preference + 0.5 * (middle - wanted).norm() / half.norm();
      for (const Bubble& other : others) cost += 20.0 * place.overlap(other.place) / area;
      for (const Rectangle& body : bodies) cost += 8.0 * place.overlap(body) / area;
      preference += 0.05;
      if (cost >= least_cost) continue;
      least_cost = cost;
      bubble.place = place;
    }
    // From the edge that faces the robot to a little before its rim.
    const Rectangle& place = bubble.place;
    const double foot = std::min(7.0 * layout_.unit_px, 0.4 * half.y());
    const double corner = layout_.line_px(5.0, 2.0) + foot;
    const Vec2 from(std::clamp(center.x(), place.left + corner,
                               std::max(place.right - corner, place.left + corner)),
                    std::clamp(center.y(), place.top + corner,
                               std::max(place.bottom - corner, place.top + corner)));
    const bool above = place.bottom <= center.y();
    const bool below = place.top >= center.y();
    const Vec2 root(above || below            ? from.x()
                    : place.left > center.x() ? place.left + 1.0
                                              : place.right - 1.0,
                    above   ? place.bottom - 1.0
                    : below ? place.top + 1.0
                            : from.y());
    const Vec2 aside = above || below ? Vec2(foot, 0.0) : Vec2(0.0, foot);
    const Vec2 way = root - center;
    const double length = way.norm();
    if (length < radius) {  // it lies on its robot: there is nothing to point from
      bubble.tail = {root - aside, root + aside, root};
      return;
    }
    const Vec2 tip = center + way * ((radius + 2.0 * layout_.unit_px) / length);
    bubble.tail = {root - aside, root + aside, tip};
  }

  // A rectangle with round corners.
  static std::vector<Vec2> rounded(const Rectangle& place, double radius_px) {
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
        points.emplace_back(centers[i] + r * Vec2(std::cos(angle), std::sin(angle)));
      }
    }
    return points;
  }

  struct Label {
    std::string text;
    TextStyle style;
    double width_px = 0.0;
    Vec2 center = Vec2::Zero();  // of the robot
    double radius_px = 0.0;      // of the robot
    Rectangle place;
  };

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
        const double reach = label.radius_px + gap * layout_.unit_px;
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

  void outline(const std::vector<Vec2>& points, Colour colour, double width_px) {
    Shape line;
    line.add_line(points, width_px, true);
    painter_.fill(line, colour);
  }

  [[nodiscard]] bool has_place(const RobotSnapshot& robot) const {
    const Vec2 center = layout_(robot.X_WB.position());
    if (robot.footprint.empty() || !is_drawable(center) || !std::isfinite(robot.X_WB.yaw_rad)) {
      return false;
    }
    const Vec2 reach = Vec2::Constant(marked_radius_px(robot));
    return !layout_.floor_only ||
           rectangle(center - reach, center + reach).overlap(layout_.floor) > 0.0;
  }
  static Rectangle rectangle(const Vec2& low, const Vec2& high) {
    return {low.x(), low.y(), high.x(), high.y()};
  }

  const SceneSnapshot& scene_;
  const Layout& layout_;
  Painter& painter_;
};

}  // namespace

void draw_fans(const SceneSnapshot& scene, const std::vector<std::uint8_t>& cells,
               const Layout& layout, Painter& painter) {
  RobotPainter robots(scene, layout, painter);
  robots.draw_cones();
  robots.draw_fans(cells);
}

void draw_trails(const SceneSnapshot& scene, const std::vector<std::uint8_t>& cells,
                 const Layout& layout, Painter& painter) {
  RobotPainter(scene, layout, painter).draw_trails(cells);
}

void draw_seen_surfaces(const SceneSnapshot& scene, const Layout& layout, Painter& painter) {
  RobotPainter robots(scene, layout, painter);
  robots.draw_seen_surfaces();
  robots.draw_sights();
}

void draw_robots(const SceneSnapshot& scene, const Layout& layout, Painter& painter) {
  RobotPainter robots(scene, layout, painter);
  for (const RobotSnapshot& robot : scene.robots) robots.draw_robot(robot);
}

void draw_speech(const SceneSnapshot& scene, const Layout& layout, Painter& painter) {
  RobotPainter(scene, layout, painter).draw_speech();
}

void draw_names(const SceneSnapshot& scene, const Layout& layout, Painter& painter) {
  RobotPainter(scene, layout, painter).draw_names();
}

}  // namespace sim::render
