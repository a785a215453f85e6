// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/navigation/likelihood_field.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sim/core/assert.h"
#include "sim/core/math.h"
#include "sim/core/pose.h"
#include "sim/navigation/distance_field.h"

namespace sim {

namespace {

constexpr float kOccupied = 0.65F;  // as distance_field() has it

/// The map of occupied cells that have a free or unknown one among their eight neighbours. Solids
/// are filled, but a beam ends at their surface.
OccupancyMap surface_of(const OccupancyMap& map) {
  OccupancyMap surface = map;
  const auto is_solid = [&map](int column, int row) {
    const int c = std::clamp(column, 0, map.width - 1);
    const int r = std::clamp(row, 0, map.height - 1);
    return map.at(c, r) > kOccupied;
  };
  std::size_t cell = 0;
  for (int row = 0; row < map.height; ++row) {
    for (int column = 0; column < map.width; ++column, ++cell) {
      bool is_inside = true;
      for (int dr = -1; dr <= 1 && is_inside; ++dr) {
        for (int dc = -1; dc <= 1 && is_inside; ++dc) {
          is_inside = is_solid(column + dc, row + dr);
        }
      }
      if (is_inside) surface.cells[cell] = 0.0F;
    }
  }
  return surface;
}

}  // namespace

ScanPoints scan_points(const Pose& X_BL, std::span<const double> ranges_m, double angle_min_rad,
                       double resolution_rad, double range_max_m, int most_beams) {
  SIM_ASSERT(most_beams >= 1);
  ScanPoints scan;
  const std::size_t count = ranges_m.size();
  const std::size_t used = std::min(count, static_cast<std::size_t>(most_beams));
  scan.p_BQ.reserve(used);
  for (std::size_t i = 0; i < used; ++i) {
    // The middle of the i-th of `used` equal parts of the scan.
    const std::size_t beam = (2 * i + 1) * count / (2 * used);
    const double range_m = ranges_m[beam];
    if (!(range_m > 0.0) || range_m >= range_max_m) continue;
    const double angle = angle_min_rad + static_cast<double>(beam) * resolution_rad;
    scan.p_BQ.push_back(X_BL * (range_m * unit_vector(angle)));
  }
  return scan;
}

LikelihoodField::LikelihoodField(const OccupancyMap& map, const LikelihoodSettings& settings)
    : width_(map.width),
      height_(map.height),
      cell_size_m_(map.cell_size_m),
      origin_(map.origin),
      log_bad_(static_cast<float>(math::log(settings.bad_share))) {
  SIM_ASSERT(settings.deviation_m > 0.0 && settings.bad_share > 0.0 && settings.bad_share < 1.0);
  // Beyond this the Gaussian part is below 1e-6.
  const DistanceField field = distance_field(surface_of(map), 5.3 * settings.deviation_m);
  log_p_.reserve(field.distances_m.size());
  for (int row = height_ - 1; row >= 0; --row) {
    for (int column = 0; column < width_; ++column) {
      if (map.at(column, row) < 0.5F) free_.push_back(static_cast<std::uint32_t>(log_p_.size()));
      const double share = double{field.at(column, row)} / settings.deviation_m;
      const double p =
          (1.0 - settings.bad_share) * math::exp(-0.5 * share * share) + settings.bad_share;
      log_p_.push_back(static_cast<float>(math::log(p)));
    }
  }
}

double LikelihoodField::mean_log_likelihood(const Pose& X_WB, const ScanPoints& scan) const {
  if (scan.p_BQ.empty()) return 0.0;
  const double per_m = 1.0 / cell_size_m_;
  const Vec2 along = per_m * unit_vector(X_WB.yaw_rad);
  const double c = along.x();
  const double s = along.y();
  const double x0 = (X_WB.x_m - origin_.x()) * per_m;
  const double y0 = (X_WB.y_m - origin_.y()) * per_m;
  const double columns = width_;
  const double rows = height_;
  double sum = 0.0;
  for (const Vec2& p : scan.p_BQ) {
    const double x = x0 + c * p.x() - s * p.y();
    const double y = y0 + s * p.x() + c * p.y();
    if (x >= 0.0 && y >= 0.0 && x < columns && y < rows) {
      sum += double{log_p_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                           static_cast<std::size_t>(x)]};
    } else {
      sum += double{log_bad_};
    }
  }
  return sum / static_cast<double>(scan.p_BQ.size());
}

Vec2 LikelihoodField::free_position(double uniform) const {
  if (free_.empty()) return origin_;
  const auto last = free_.size() - 1;
  const std::size_t index =
      free_[std::min(last, static_cast<std::size_t>(uniform * static_cast<double>(free_.size())))];
  const auto width = static_cast<std::size_t>(width_);
  const std::size_t column = index % width;
  const std::size_t row = index / width;
  return origin_ +
         cell_size_m_ * Vec2(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
}

}  // namespace sim
