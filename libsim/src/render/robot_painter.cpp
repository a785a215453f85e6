// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "render/robot_painter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "render/robot_place.h"
#include "sim/core/math.h"
#include "sim/core/pose.h"
#include "sim/world/outline.h"

namespace sim::render {
namespace {

// Deviation of a line from its points that is invisible.
constexpr double kTolerance_px = 0.15;
constexpr double kAnyLength_px = 1e9;
// Links of arms: neither the robot's colour nor that of its nose.
constexpr Colour kArm{0xc6, 0xcd, 0xd8};
// Fans are short if there are more robots than this.
constexpr std::ptrdiff_t kMostFans = 20;
// Of one robot's particles at most this many are drawn.
constexpr std::size_t kMostParticles = 1500;

// Simplifies a polyline: the result passes all omitted points within `tolerance_px`, and none of
// its segments is longer than `longest_px` unless an original one was. Appending points changes
// only the last segment of the result, so lines stay still in a film.
//
// Each further point narrows the cone of directions, seen from the last kept point, in which a line
// passes all points since. The last point within the cone is kept next. (The idea is from Imai and
// Iri, Polygonal approximations of a curve, 1988, who minimise the number of points.)
std::vector<Vec2> simplified(const std::vector<Vec2>& points, double tolerance_px,
                             double longest_px) {
  const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
  std::vector<Vec2> kept;
  Vec2 last = Vec2::Zero();  // the newest point
  Vec2 left = Vec2::Zero();  // the cone's sides, of length 1
  Vec2 right = Vec2::Zero();
  bool cone = false;
  double reach_px = 0.0;  // distance of the farthest point since the last kept one
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

// The ellipse of a hypothesis' position at two standard deviations, in W; at least 2 cm wide.
std::vector<Vec2> ellipse_of(const PoseHypothesis& hypothesis) {
  constexpr int kCorners = 48;
  constexpr double kLeast_m2 = 1e-4;
  const auto [xx, yy, aa] = hypothesis.covariance.variance;
  const double xy = hypothesis.covariance.covariance[0];
  // Principal axes of a symmetric matrix of 2 x 2.
  const double turn = 0.5 * math::atan2(2.0 * xy, xx - yy);
  const double middle = 0.5 * (xx + yy);
  const double half = math::hypot(0.5 * (xx - yy), xy);
  const double major = 2.0 * std::sqrt(std::max(kLeast_m2, middle + half));
  const double minor = 2.0 * std::sqrt(std::max(kLeast_m2, middle - half));
  const Pose X_WE{hypothesis.mean.x_m, hypothesis.mean.y_m, turn};
  std::vector<Vec2> rim;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    rim.push_back(X_WE * Vec2(major * math::cos(angle), minor * math::sin(angle)));
  }
  return rim;
}

// The convex parts of a robot's body.
std::span<const Polygon> parts_of(const RobotSnapshot& robot) {
  return robot.parts.empty() ? std::span(&robot.footprint, 1) : std::span(robot.parts);
}

// The part of a body that is drawn with wheels and a nose: the largest one around the axle's centre
// if there is one.
const Polygon& part_at_origin(const RobotSnapshot& robot) {
  const Polygon* best = nullptr;
  for (const Polygon& part : parts_of(robot)) {
    if (!is_inside(part, Vec2::Zero())) continue;
    if (best == nullptr || area_m2(part) > area_m2(*best)) best = &part;
  }
  return best != nullptr ? *best : robot.footprint;
}

class RobotPainter {
 public:
  RobotPainter(const SceneSnapshot& scene, const Layout& layout, Painter& painter)
      : scene_(scene), layout_(layout), painter_(painter) {}

  void draw_fans(const std::vector<std::uint8_t>& cells) {
    if (fan_count() > kMostFans) {
      draw_short_fans();
      return;
    }
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

  // Draws sonar cones up to their ranges, with an arc at the echo's distance, and infrared rays
  // with a dot. Where cones of one robot overlap, the highest opacity counts.
  void draw_cones() {
    const auto count =
        std::count_if(scene_.robots.begin(), scene_.robots.end(),
                      [](const RobotSnapshot& robot) { return !robot.cones.empty(); });
    const double strength =
        1.0 / std::sqrt(static_cast<double>(std::max<std::ptrdiff_t>(count, 1)));
    for (const RobotSnapshot& robot : scene_.robots) {
      const Colour colour = opaque(robot.colour);
      // Fainter next to a laser's fan.
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
        painter_.accumulate(area, share * ray * (cone.met ? 0.16 : 0.07));
      }
      painter_.fill_accumulated(colour);
      painter_.fill(echoes, mix(colour, palette::kInk, 0.2), std::min(1.0, 0.75 * share + 0.1));
    }
  }

  // Draws thin lines from fiducial finders to the detected marks, which get a ring.
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
        painter_.fill_ring(b, radius, layout_.line_px(1.8, 1.0), opaque(robot.colour));
      }
      painter_.fill(lines, opaque(robot.colour), 0.7);
    }
  }

  // Draws the particles of robots' localisations as short strokes along their headings, with a dot
  // at their positions, and the ellipses of the hypotheses, with two standard deviations.
  void draw_localisations() {
    for (const RobotSnapshot& robot : scene_.robots) {
      if (robot.particles.empty()) continue;
      const Colour ink = mix(opaque(robot.colour), palette::kInk, 0.35);
      const std::size_t stride = 1 + (robot.particles.size() - 1) / kMostParticles;
      Shape strokes;
      Shape dots;
      for (std::size_t i = 0; i < robot.particles.size(); i += stride) {
        const Pose& X_WB = robot.particles[i];
        const Vec2 foot = layout_(X_WB.position());
        const Vec2 along = layout_(X_WB * Vec2(1.0, 0.0)) - foot;
        const double length = along.norm();
        if (!is_drawable(foot) || !is_drawable(along) || !(length > 0.0)) continue;
        strokes.add_line({foot, foot + along * (layout_.line_px(7.0, 4.0) / length)},
                         layout_.line_px(0.8, 0.6));
        dots.add_disc(foot, layout_.line_px(1.3, 0.8));
      }
      painter_.fill(strokes, ink, 0.55);
      painter_.fill(dots, ink, 0.75);
      for (const PoseHypothesis& hypothesis : robot.hypotheses) {
        const std::vector<Vec2> rim = layout_(ellipse_of(hypothesis));
        const Vec2 foot = layout_(hypothesis.mean.position());
        const Vec2 along = layout_(hypothesis.mean * Vec2(1.0, 0.0)) - foot;
        const double length = along.norm();
        if (!is_drawable(foot) || !is_drawable(along) || !(length > 0.0) ||
            !std::all_of(rim.begin(), rim.end(), [](const Vec2& p) { return is_drawable(p); })) {
          continue;
        }
        Shape lines;
        lines.add_line(rim, layout_.line_px(1.8, 1.2), true);
        lines.add_line({foot, foot + along * (layout_.line_px(22.0, 12.0) / length)},
                       layout_.line_px(1.8, 1.2));
        painter_.fill(lines, ink, 0.35 + 0.6 * hypothesis.weight);
      }
    }
  }

  // Draws the rims of the fans where they meet surfaces, on top of these surfaces.
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
          // Two neighbouring beams of the maximum length have most likely met nothing.
          const bool missed = std::min(a.norm(), b.norm()) >= farthest_px * (1.0 - 1e-6);
          const double cross = std::abs(a.x() * b.y() - a.y() * b.x());
          const double along_px = std::min(a.norm(), b.norm()) * math::atan2(cross, a.dot(b));
          const bool behind = (b - a).norm() > 8.0 * along_px + 1.5 * layout_.unit_px;
          if (missed || behind) end_surface();
        }
        surface.push_back(hit);
      }
      end_surface();
      painter_.fill(rim, opaque(robot.colour), 0.35 + 0.5 * strength);
    }
  }

  // Complete fans of many robots would mix their colours to grey. Therefore only the part near the
  // robot is drawn, and it fades out.
  void draw_short_fans() {
    constexpr double kRadii = 5.0;
    const Vec2 floor_px = scene_.arena.size * layout_.pixels_per_m;
    const double spacing_px =
        std::sqrt(floor_px.x() * floor_px.y() / static_cast<double>(fan_count()));
    for (const RobotSnapshot& robot : scene_.robots) {
      std::vector<Vec2> outline = hits_of(robot);
      if (outline.empty()) continue;
      const Vec2 origin = layout_(robot.scan_origin);
      const double reach_px =
          std::max(std::min(kRadii * radius_px(robot, layout_), 0.6 * spacing_px),
                   2.0 * marked_radius_px(robot, layout_));
      for (Vec2& hit : outline) {
        const Vec2 beam = hit - origin;
        const double length_px = beam.norm();
        if (length_px > reach_px) hit = origin + beam * (reach_px / length_px);
      }
      outline.push_back(origin);
      Shape fan;
      fan.add_outline(outline);
      painter_.fill_fading(fan, opaque(robot.colour), origin, reach_px, 0.42, 0.0);
    }
  }

  // Draws a line that fades with age. The segments' opacities are combined by their maximum, so
  // that neither joints nor crossings are visible.
  void draw_trails(const std::vector<std::uint8_t>& cells) {
    constexpr int kShades = 24;
    for (const RobotSnapshot& robot : scene_.robots) {
      // Long straight stretches are split, so that they fade too.
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
        painter_.accumulate(line, strength * (0.8 - 0.6 * age));
        first = last;
      }
      painter_.fill_accumulated(mix(opaque(robot.colour), palette::kInk, 0.12));
    }
  }

  void draw_robot(const RobotSnapshot& robot) {
    if (!has_place(robot, layout_)) return;
    const Colour colour = opaque(robot.colour);
    const Colour dark = mix(colour, palette::kWheel, 0.65);
    const Vec2 center = layout_(robot.X_WB.position());
    const double radius = radius_px(robot, layout_);
    const bool small = radius < marked_radius_px(robot, layout_);
    if (small) draw_marker(robot, center, colour);
    if (robot.stalled) draw_stall_ring(center, marked_radius_px(robot, layout_));
    if (robot.marked) draw_mark(center, marked_radius_px(robot, layout_));

    const Polygon& core = robot.parts.empty() ? robot.footprint : part_at_origin(robot);
    Vec2 low = core.front();
    Vec2 high = low;
    for (const Vec2& corner : core) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    const auto on_body = [&](const Vec2& p_B) { return layout_(robot.X_WB * p_B); };
    // Points given as fractions of the body's extent to the front and to the left.
    const auto at = [&](double x, double y) {
      return on_body({x * (x >= 0.0 ? high.x() : -low.x()), y * (y >= 0.0 ? high.y() : -low.y())});
    };

    std::vector<std::vector<Vec2>> body;  // its parts
    Shape area;
    for (const Polygon& part : parts_of(robot)) {
      body.emplace_back();
      for (const Vec2& corner : part) body.back().push_back(on_body(corner));
      area.add_piece(body.back());
    }
    for (const double distance : {1.0, 2.2, 3.4}) {
      Shape shadow;
      shadow.append(area, Vec2(0.8, 1.0) * distance * layout_.unit_px);
      painter_.fill(shadow, palette::kShadow, 0.09);
    }
    const auto outline_body = [&](double width_px) {
      for (const std::vector<Vec2>& part : body) outline(part, dark, width_px);
    };
    // Of several parts only the outer half of the lines is visible, none where parts meet.
    const bool several = body.size() > 1;
    if (several) outline_body(2.0 * layout_.line_px(1.5));
    painter_.fill(area, colour);
    if (small) {
      if (!several) outline_body(layout_.line_px(1.0));
      draw_lights(robot);
      return;  // the rest would be too small to recognise
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
    draw_superstructures(robot, colour, dark);
    Shape paddles;
    for (const Polygon& paddle : robot.paddles) {
      std::vector<Vec2> piece;
      for (const Vec2& p_B : paddle) piece.push_back(layout_(robot.X_WB * p_B));
      paddles.add_piece(piece);
    }
    painter_.fill(paddles, palette::kWheel);
    if (!several) outline_body(layout_.line_px(1.5));
    draw_bumpers(robot, dark);
    draw_lights(robot);
    draw_arms(robot);
  }

  // Draws the outline and the nose of a ghost over a half transparent body.
  void draw_ghost(const RobotSnapshot& ghost) {
    if (!has_place(ghost, layout_)) return;
    const Colour colour = opaque(ghost.colour);
    const Colour dark = mix(colour, palette::kWheel, 0.5);
    double front_m = 0.0;
    Shape area;
    Shape lines;
    for (const Polygon& part : parts_of(ghost)) {
      std::vector<Vec2> body;
      for (const Vec2& corner : part) {
        body.push_back(layout_(ghost.X_WB * corner));
        front_m = std::max(front_m, corner.x());
      }
      area.add_piece(body);
      lines.add_line(body, layout_.line_px(1.5), true);
    }
    painter_.fill(area, colour, 0.3);
    lines.add_line({layout_(ghost.X_WB.position()), layout_(ghost.X_WB * Vec2(front_m, 0.0))},
                   layout_.line_px(2.0));
    painter_.fill(lines, dark, 0.7);
  }

 private:
  // Draws what is higher than the body: a little lighter than it, with a thin line round it.
  void draw_superstructures(const RobotSnapshot& robot, const Colour& colour, const Colour& dark) {
    for (const Polygon& part : robot.superstructures) {
      std::vector<Vec2> corners;
      for (const Vec2& p_B : part) corners.push_back(layout_(robot.X_WB * p_B));
      Shape area;
      area.add_piece(corners);
      painter_.fill(area, mix(colour, palette::kLight, 0.25), 0.8);
      outline(corners, dark, layout_.line_px(0.8));
    }
  }

  // Points along the far end of a cone, from its right to its left side; one point for a ray.
  static std::vector<Vec2> rim_of(const ConeSnapshot& cone) {
    constexpr double kStep_rad = 0.05;
    const int steps =
        std::clamp(static_cast<int>(std::ceil(cone.field_of_view_rad / kStep_rad)), 0, 64);
    std::vector<Vec2> rim;
    for (int i = 0; i <= steps; ++i) {
      const double share = steps == 0 ? 0.5 : static_cast<double>(i) / steps;
      const double angle = cone.field_of_view_rad * (share - 0.5);
      rim.push_back(cone.X_WS * (cone.range_m * unit_vector(angle)));
    }
    return rim;
  }

  // Draws a thin line for each bumper segment, and a thick red one if it is pressed.
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

  // Draws each arm as light links with dark edges between dark joints; the tip is a ring. Links of
  // an upright arm cover each other.
  void draw_arms(const RobotSnapshot& robot) {
    constexpr double kLink_m = 0.03;
    const double link_px = std::max(kLink_m * layout_.pixels_per_m, layout_.line_px(2.0));
    const double edge_px = layout_.line_px(1.2);
    for (const std::vector<Vec2>& arm : robot.arms) {
      std::vector<Vec2> line;
      for (const Vec2& p_B : arm) line.push_back(layout_(robot.X_WB * p_B));
      if (line.empty() || !std::all_of(line.begin(), line.end(), is_drawable)) continue;
      Shape edges;
      Shape links;
      Shape joints;
      Shape tip;
      edges.add_line(line, link_px + 2.0 * edge_px);
      links.add_line(line, link_px);
      for (const Vec2& joint : line) joints.add_disc(joint, 0.4 * link_px);
      tip.add_disc(line.back(), 0.4 * link_px);
      painter_.fill(edges, palette::kWheel);
      painter_.fill(links, kArm);
      painter_.fill(joints, palette::kWheel);
      painter_.fill(tip, palette::kStalled);
    }
  }

  // Hits of a robot's newest scan, in picture coordinates.
  [[nodiscard]] std::vector<Vec2> hits_of(const RobotSnapshot& robot) const {
    std::vector<Vec2> hits;
    if (!is_drawable(layout_(robot.scan_origin))) return hits;
    hits = layout_(robot.scan_points);
    std::erase_if(hits, [](const Vec2& hit) { return !is_drawable(hit); });
    return hits;
  }

  [[nodiscard]] std::ptrdiff_t fan_count() const {
    return std::count_if(scene_.robots.begin(), scene_.robots.end(),
                         [](const auto& robot) { return !robot.scan_points.empty(); });
  }

  // Opacity factor for overlapping fans of many robots, which together must not hide the floor.
  [[nodiscard]] double fan_strength() const {
    const std::ptrdiff_t count = fan_count();
    return 1.0 / math::pow(static_cast<double>(std::max<std::ptrdiff_t>(count, 1)), 0.7);
  }

  // Fraction of the canvas's cells that are not empty.
  static double drawn_share(const std::vector<std::uint8_t>& cells) {
    std::size_t drawn = 0;
    for (std::size_t i = 3; i < cells.size(); i += 4) drawn += cells[i] > 0 ? 1 : 0;
    return cells.empty() ? 0.0
                         : 4.0 * static_cast<double>(drawn) / static_cast<double>(cells.size());
  }

  // Fraction of a trail's points that lie on coloured cells. White, grey and black do not count,
  // since they are probably a map and not a drawing of the path.
  [[nodiscard]] double coloured_share(const std::vector<Vec2>& trail,
                                      const std::vector<std::uint8_t>& cells) const {
    constexpr int kLeastDifference = 60;  // between the maximum and the minimum of red, green and
                                          // blue
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

  // Shows position and heading of a robot that is only a few pixels large.
  void draw_marker(const RobotSnapshot& robot, const Vec2& center, Colour colour) {
    const double radius = marked_radius_px(robot, layout_);
    Shape disc;
    disc.add_disc(center, radius);
    painter_.fill(disc, colour, 0.35);
    Shape rim;
    const Vec2 ahead(math::cos(robot.X_WB.yaw_rad), -math::sin(robot.X_WB.yaw_rad));
    rim.add_line({center, center + ahead * (1.7 * radius)}, layout_.line_px(2.0, 1.0));
    painter_.fill(rim, mix(colour, palette::kWheel, 0.3));
    painter_.fill_ring(center, radius, layout_.line_px(1.4), mix(colour, palette::kWheel, 0.3));
  }

  void draw_stall_ring(const Vec2& center, double robot_radius) {
    const double radius = robot_radius + 6.0 * layout_.unit_px;
    painter_.fill_ring(center, radius, layout_.line_px(6.0), palette::kHalo);
    painter_.fill_ring(center, radius, layout_.line_px(3.2), palette::kStalled);
  }

  // Draws the corners of a square around the robot that the user selected.
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

  // A light that is lit glows over its surroundings; one that is off is a dull dot.
  void draw_lights(const RobotSnapshot& robot) {
    const double radius = std::max(0.13 * radius_px(robot, layout_), layout_.line_px(2.6, 1.6));
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

  void outline(const std::vector<Vec2>& points, Colour colour, double width_px) {
    Shape line;
    line.add_line(points, width_px, true);
    painter_.fill(line, colour);
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
  robots.draw_localisations();
}

void draw_robots(const SceneSnapshot& scene, const Layout& layout, Painter& painter) {
  RobotPainter robots(scene, layout, painter);
  for (const RobotSnapshot& ghost : scene.ghosts) robots.draw_ghost(ghost);
  for (const RobotSnapshot& robot : scene.robots) robots.draw_robot(robot);
}

}  // namespace sim::render
