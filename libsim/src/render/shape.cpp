// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "render/painter.h"
#include "sim/core/math.h"

namespace sim::render {
namespace {

double signed_area(const std::vector<Vec2>& points) {
  double twice = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2& a = points[i];
    const Vec2& b = points[(i + 1) % points.size()];
    twice += a.x() * b.y() - b.x() * a.y();
  }
  return 0.5 * twice;
}

}  // namespace

void Shape::add_outline(const std::vector<Vec2>& points) {
  for (const Vec2& point : points) {
    if (!is_drawable(point)) return;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    edges_.push_back({points[i], points[(i + 1) % points.size()]});
  }
}

void Shape::add_piece(std::vector<Vec2> points) {
  if (signed_area(points) < 0.0) std::reverse(points.begin(), points.end());
  add_outline(points);
}

void Shape::add_disc(const Vec2& center, double radius_px) {
  // The number of corners keeps the polygon within 1/20 pixel of the circle.
  const int corners = std::clamp(static_cast<int>(std::ceil(10.0 * std::sqrt(radius_px))), 8, 256);
  std::vector<Vec2> points;
  points.reserve(static_cast<std::size_t>(corners));
  for (int i = 0; i < corners; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / corners;
    points.emplace_back(center.x() + radius_px * math::cos(angle_rad),
                        center.y() + radius_px * math::sin(angle_rad));
  }
  add_piece(std::move(points));
}

void Shape::add_line(const std::vector<Vec2>& points, double width_px, bool closed) {
  const std::size_t segments = closed || points.empty() ? points.size() : points.size() - 1;
  for (std::size_t i = 0; i < segments; ++i) {
    const Vec2& a = points[i];
    const Vec2& b = points[(i + 1) % points.size()];
    const Vec2 along = b - a;
    const double length = along.norm();
    if (!(length > 0.0)) continue;
    const Vec2 side = Vec2(-along.y(), along.x()) * (0.5 * width_px / length);
    add_piece({a + side, b + side, b - side, a - side});
  }
  const double radius_px = 0.5 * width_px;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool end = !closed && (i == 0 || i + 1 == points.size());
    if (!end) {
      // At a joint that turns by t, the open wedge on the outside is radius (1 - cos(t / 2)) high.
      constexpr double kLeastGap_px = 0.02;
      const Vec2 in = points[i] - points[(i + points.size() - 1) % points.size()];
      const Vec2 out = points[(i + 1) % points.size()] - points[i];
      const double lengths = in.norm() * out.norm();
      if (lengths > 0.0) {
        const double half_angle_cosine =
            std::sqrt(std::max(0.0, 0.5 * (1.0 + in.dot(out) / lengths)));
        if (radius_px * (1.0 - half_angle_cosine) < kLeastGap_px) continue;
      }
    }
    add_disc(points[i], radius_px);
  }
}

void Shape::add_dashed_outline(const std::vector<Vec2>& points, double width_px, double dash_px) {
  // Bounds the work for an outline far longer than the picture.
  constexpr double kMostPeriods = 8000.0;
  const double most_per_side = std::max(1.0, kMostPeriods / static_cast<double>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2& a = points[i];
    const Vec2& b = points[(i + 1) % points.size()];
    // A side consists of half a dash, alternating gaps and dashes, and half a dash: n periods.
    const double length = (b - a).norm();
    if (!std::isfinite(length)) continue;
    const int periods =
        static_cast<int>(std::clamp(std::round(length / (2.0 * dash_px)), 1.0, most_per_side));
    for (int k = 0; k <= periods; ++k) {
      const double begin = std::max(0.0, (k - 0.25) / periods);
      const double end = std::min(1.0, (k + 0.25) / periods);
      add_line({a + (b - a) * begin, a + (b - a) * end}, width_px);
    }
  }
}

void Shape::append(const Shape& other, const Vec2& offset) {
  for (const Edge& edge : other.edges_) edges_.push_back({edge.from + offset, edge.to + offset});
}

void Shape::cut(const Shape& hole) {
  for (const Edge& edge : hole.edges_) edges_.push_back({edge.to, edge.from});
}

}  // namespace sim::render
