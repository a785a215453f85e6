// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/results/seen_floor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/core/math.h"
#include "sim/core/pose.h"
#include "sim/devices/rangers.h"
#include "sim/world/occupancy_map.h"
#include "sim/world/outline.h"

namespace playerlike {
namespace {

int cells_along(double length_m, double cell_m) {
  // 1e-9 absorbs rounding: 3.42 / 0.02 > 171.
  return std::max(1, static_cast<int>(std::ceil(length_m / cell_m - 1e-9)));
}

/// The map of the solids that stand where they are during the whole run.
sim::OccupancyMap map_of_walls(const sim::WorldDescription& world,
                               const sim::CanvasDescription& grid) {
  sim::ArenaDescription arena = world.arena;
  std::erase_if(arena.obstacles, [&world](const sim::ObstacleDescription& o) {
    // A controller may move any obstacle.
    return !world.controller.empty() || o.type != sim::ObstacleType::kStatic || o.portable ||
           o.motion || o.mass_kg;
  });
  return sim::true_map(arena, grid);
}

/// Transforms points of W into the frame of a sensor. Unlike Pose, it computes its sine only once.
class ToFrame {
 public:
  explicit ToFrame(const sim::Pose& X_WS)
      : p_WS_(X_WS.position()),
        cos_(sim::math::cos(X_WS.yaw_rad)),
        sin_(sim::math::sin(X_WS.yaw_rad)) {}
  [[nodiscard]] sim::Vec2 operator()(const sim::Vec2& p_W) const {
    const sim::Vec2 p = p_W - p_WS_;
    return {cos_ * p.x() + sin_ * p.y(), cos_ * p.y() - sin_ * p.x()};
  }

 private:
  sim::Vec2 p_WS_;
  double cos_;
  double sin_;
};

double radius_of(const sim::Polygon& outline) {
  double radius_m = 0.0;
  for (const sim::Vec2& corner : outline) radius_m = std::max(radius_m, corner.norm());
  return radius_m;
}

}  // namespace

SeenFloor::SeenFloor(const sim::Simulation& simulation, int robot)
    : robot_(robot), origin_(simulation.world().arena.origin) {
  const sim::ArenaDescription& arena = simulation.world().arena;
  const auto count = [&arena, this] {
    return static_cast<std::size_t>(cells_along(arena.size.x(), cell_m_)) *
           static_cast<std::size_t>(cells_along(arena.size.y(), cell_m_));
  };
  while (count() > kMostCells) cell_m_ *= 2.0;
  width_ = cells_along(arena.size.x(), cell_m_);
  height_ = cells_along(arena.size.y(), cell_m_);
  cells_.assign(count(), kUnseen);
  covered_from_.x_m = std::numeric_limits<double>::quiet_NaN();
  // Cells that are never free need not be looked at in each scan. A larger cell may be free in
  // part.
  if (cell_m_ != kCell_m) return;
  sim::CanvasDescription grid;
  grid.cell_size_m = cell_m_;
  grid.origin = origin_;
  grid.width = width_;
  grid.height = height_;
  const sim::OccupancyMap walls = map_of_walls(simulation.world(), grid);
  for (int row = 0; row < height_; ++row) {
    for (int column = 0; column < width_; ++column) {
      if (walls.at(column, height_ - 1 - row) < 0.5F) continue;
      cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
             static_cast<std::size_t>(column)] = kSolid;
    }
  }
}

template <typename Sees>
void SeenFloor::mark_within(const sim::Vec2& middle, double radius_m, Sees sees) {
  const auto index = [this](double offset_m, int cells) {
    return static_cast<int>(std::clamp(std::floor(offset_m / cell_m_), 0.0, cells - 1.0));
  };
  const sim::Vec2 p = middle - origin_;
  const int left = index(p.x() - radius_m, width_);
  const int right = index(p.x() + radius_m, width_);
  const int top = index(p.y() + radius_m, height_);
  for (int row = index(p.y() - radius_m, height_); row <= top; ++row) {
    std::uint8_t* const cells =
        cells_.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(width_);
    for (int column = left; column <= right; ++column) {
      if (cells[column] != kUnseen) continue;
      if (!sees(sim::Vec2(origin_ + cell_m_ * sim::Vec2(column + 0.5, row + 0.5)))) continue;
      cells[column] = kSeen;
      ++count_;
    }
  }
}

void SeenFloor::see_area() {
  const auto to_cells = [this](const sim::Vec2& corner) {
    return sim::Vec2((corner - origin_) / cell_m_ - sim::Vec2::Constant(0.5));
  };
  crossings_.resize(static_cast<std::size_t>(height_));
  sim::Vec2 from = to_cells(corners_.back());
  for (const sim::Vec2& corner : corners_) {
    const sim::Vec2 to = to_cells(corner);
    const auto& [low, high] = from.y() < to.y() ? std::pair(from, to) : std::pair(to, from);
    // The rows whose centres lie in [low.y, high.y).
    const double first = std::max(std::ceil(low.y()), 0.0);
    const double last = std::min(std::ceil(high.y()), static_cast<double>(height_));
    const double slope = (high.x() - low.x()) / std::max(high.y() - low.y(), 1e-300);
    for (double row = first; row < last; row += 1.0) {
      crossings_[static_cast<std::size_t>(row)].push_back(low.x() + slope * (row - low.y()));
    }
    from = to;
  }
  for (std::size_t row = 0; row < crossings_.size(); ++row) {
    std::vector<double>& xs = crossings_[row];
    std::sort(xs.begin(), xs.end());
    std::uint8_t* const cells = cells_.data() + row * static_cast<std::size_t>(width_);
    for (std::size_t i = 1; i < xs.size(); i += 2) {
      const auto first = static_cast<int>(std::max(std::ceil(xs[i - 1]), 0.0));
      const auto last = static_cast<int>(std::min(std::ceil(xs[i]), static_cast<double>(width_)));
      for (int column = first; column < last; ++column) {
        if (cells[column] != kUnseen) continue;
        cells[column] = kSeen;
        ++count_;
      }
    }
    xs.clear();
  }
}

void SeenFloor::see_scan(const sim::Pose& X_WL, const sim::LaserReading& scan) {
  const std::size_t beams = scan.ranges_m.size();
  if (beams < 2 || !(scan.resolution_rad > 0.0)) return;
  if (directions_.size() != beams || first_angle_rad_ != scan.angle_min_rad ||
      resolution_rad_ != scan.resolution_rad) {
    directions_.clear();
    first_angle_rad_ = scan.angle_min_rad;
    resolution_rad_ = scan.resolution_rad;
    for (std::size_t i = 0; i < beams; ++i) {
      const double angle = first_angle_rad_ + resolution_rad_ * static_cast<double>(i);
      directions_.emplace_back(sim::math::cos(angle), sim::math::sin(angle));
    }
  }
  const sim::math::SinCos turn = sim::math::sin_cos(X_WL.yaw_rad);
  const double s = turn.sin;
  const double c = turn.cos;
  const sim::Vec2 p_WL = X_WL.position();
  const auto end_of = [&](std::size_t beam, double range_m) {
    const sim::Vec2& d = directions_[beam];
    return sim::Vec2(p_WL + range_m * sim::Vec2(c * d.x() - s * d.y(), s * d.x() + c * d.y()));
  };
  corners_.assign(1, p_WL);
  for (std::size_t i = 1; i < beams; ++i) {
    const double range_m = std::max(scan.ranges_m[i - 1], scan.ranges_m[i]);
    corners_.push_back(end_of(i - 1, range_m));
    corners_.push_back(end_of(i, range_m));
  }
  see_area();
}

void SeenFloor::see_cone(const sim::Pose& X_WS, double field_of_view_rad, double range_m) {
  if (!(range_m > 0.0)) return;
  // A single ray sees the cells whose centres are at most half a cell from it.
  const double half_rad =
      std::max(0.5 * field_of_view_rad, sim::math::asin(std::min(0.5 * cell_m_ / range_m, 1.0)));
  constexpr double kStep_rad = 0.05;  // the chord is 0.03 % shorter than the arc's radius
  const int steps = 1 + static_cast<int>(2.0 * half_rad / kStep_rad);
  corners_.assign(1, X_WS.position());
  for (int i = 0; i <= steps; ++i) {
    const double angle = X_WS.yaw_rad - half_rad + 2.0 * half_rad * i / steps;
    corners_.push_back(X_WS.position() + range_m * sim::unit_vector(angle));
  }
  see_area();
}

void SeenFloor::cover(const sim::Simulation& simulation) {
  const sim::Pose& X_WB = simulation.body(robot_).X_WB;
  if (X_WB == covered_from_) return;
  covered_from_ = X_WB;
  const sim::Polygon& footprint = simulation.model(robot_).footprint;
  const ToFrame to_body(X_WB);
  mark_within(X_WB.position(), radius_of(footprint),
              [&](const sim::Vec2& centre) { return sim::is_inside(footprint, to_body(centre)); });
}

void SeenFloor::observe(const sim::Simulation& simulation) {
  cover(simulation);
  const sim::Pose& X_WB = simulation.body(robot_).X_WB;
  for (const sim::Simulation::DeviceId& id : simulation.updated()) {
    if (id.robot != robot_) continue;
    const sim::Device& device = simulation.device(id.robot, id.device);
    if (const auto* laser = dynamic_cast<const sim::Laser*>(&device)) {
      if (const auto scan = simulation.ideal_scan(id)) see_scan(X_WB * laser->params().X_BL, *scan);
    } else if (const auto* ranger = dynamic_cast<const sim::Ranger*>(&device)) {
      const sim::RangerReading& reading = ranger->reading();
      for (std::size_t i = 0; i < std::min(reading.ranges_m.size(), reading.X_BS.size()); ++i) {
        see_cone(reading.X_WB * reading.X_BS[i], reading.field_of_view_rad, reading.ranges_m[i]);
      }
    }
  }
}

std::vector<std::uint8_t> SeenFloor::bits() const {
  std::vector<std::uint8_t> bits((cells_.size() + 7) / 8, 0);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (cells_[i] == kSeen) bits[i / 8] |= static_cast<std::uint8_t>(0x80U >> (i % 8));
  }
  return bits;
}

}  // namespace playerlike
