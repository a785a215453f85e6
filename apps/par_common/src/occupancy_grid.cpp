// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "par_common/occupancy_grid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "line.h"

namespace par {
namespace {

constexpr std::uint8_t kMiss = 1;
constexpr std::uint8_t kHit = 2;

double odds_to_probability(double log_odds) { return 1.0 / (1.0 + std::exp(-log_odds)); }

void check(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("OccupancyParams: ") + what);
}

}  // namespace

OccupancyGrid::OccupancyGrid(const GridFrame& frame, const OccupancyParams& params)
    : params_(params), log_odds_(frame, 0.0F), seen_(frame.size(), 0) {
  check(params.hit_log_odds > 0.0, "hit_log_odds must be more than 0");
  check(params.miss_log_odds < 0.0, "miss_log_odds must be less than 0");
  check(params.limit_log_odds > 0.0, "limit_log_odds must be more than 0");
  check(params.occupied_threshold >= 0.5 && params.occupied_threshold < 1.0,
        "occupied_threshold must be in [0.5, 1)");
  check(params.free_threshold <= 0.5 && params.free_threshold > 0.0,
        "free_threshold must be in (0, 0.5]");
  check(params.depth_m >= 0.0, "depth_m must be at least 0");
  check(params.usable_range_m > 0.0, "usable_range_m must be more than 0");
}

void OccupancyGrid::update(const Scan& scan) {
  const Point sensor{scan.sensor.x, scan.sensor.y};
  const Cell from = frame().cell_of(sensor);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range_m = scan.ranges_m[i];
    if (!(range_m > 0.0)) continue;
    const double angle_rad =
        scan.sensor.yaw + scan.first_bearing_rad + static_cast<double>(i) * scan.bearing_step_rad;
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    const auto cell_along = [&](double distance_m) {
      return frame().cell_of({sensor.x + distance_m * c, sensor.y + distance_m * s});
    };
    const bool hit = range_m < scan.max_range_m && range_m <= params_.usable_range_m;
    if (hit) {
      mark_ray(from, cell_along(range_m + params_.depth_m), true);
    } else {
      mark_ray(from, cell_along(std::min({range_m, scan.max_range_m, params_.usable_range_m})),
               false);
    }
  }
  // Apply the result of the whole scan to each cell.
  const float limit = static_cast<float>(params_.limit_log_odds);
  for (const std::size_t i : touched_) {
    const double change = seen_[i] == kHit ? params_.hit_log_odds : params_.miss_log_odds;
    float& cell = log_odds_.values()[i];
    cell = std::clamp(cell + static_cast<float>(change), -limit, limit);
    seen_[i] = 0;
  }
  touched_.clear();
}

void OccupancyGrid::mark_ray(const Cell& from, const Cell& to, bool hit) {
  walk_line(from, to, [&](const Cell& cell) {
    if (!frame().contains(cell)) return true;
    const std::size_t i = frame().index(cell);
    if (seen_[i] == 0) touched_.push_back(i);
    seen_[i] = std::max(seen_[i], hit && cell == to ? kHit : kMiss);
    return true;
  });
}

CellState OccupancyGrid::state(const Cell& cell) const {
  const double p = probability(cell);
  if (p > params_.occupied_threshold) return CellState::kOccupied;
  return p < params_.free_threshold ? CellState::kFree : CellState::kUnknown;
}

double OccupancyGrid::probability(const Cell& cell) const {
  return odds_to_probability(log_odds(cell));
}

Grid<float> OccupancyGrid::probabilities() const {
  Grid<float> grid(frame());
  std::transform(log_odds_.values().begin(), log_odds_.values().end(), grid.values().begin(),
                 [](float l) { return static_cast<float>(odds_to_probability(l)); });
  return grid;
}

Grid<CellState> OccupancyGrid::states() const {
  // Thresholds as log odds, which saves an exponential for each of 30 000 cells.
  const auto log_odds_of = [](double p) { return static_cast<float>(std::log(p / (1.0 - p))); };
  const float occupied = log_odds_of(params_.occupied_threshold);
  const float free = log_odds_of(params_.free_threshold);
  Grid<CellState> grid(frame(), CellState::kUnknown);
  std::transform(log_odds_.values().begin(), log_odds_.values().end(), grid.values().begin(),
                 [&](float l) {
                   if (l > occupied) return CellState::kOccupied;
                   return l < free ? CellState::kFree : CellState::kUnknown;
                 });
  return grid;
}

void OccupancyGrid::set_free(const Point& centre, double radius_m) {
  const Cell low = frame().cell_of({centre.x - radius_m, centre.y + radius_m});
  const Cell high = frame().cell_of({centre.x + radius_m, centre.y - radius_m});
  const float free = -static_cast<float>(params_.limit_log_odds);
  for (int row = std::max(0, low.row); row <= std::min(frame().height - 1, high.row); ++row) {
    for (int column = std::max(0, low.column); column <= std::min(frame().width - 1, high.column);
         ++column) {
      const Cell cell{column, row};
      if (distance_m(frame().centre_of(cell), centre) <= radius_m) log_odds_[cell] = free;
    }
  }
}

void OccupancyGrid::set_unknown(const Pose& centre, double length_m, double width_m) {
  const double reach_m = 0.5 * std::hypot(length_m, width_m);
  const Cell low = frame().cell_of({centre.x - reach_m, centre.y + reach_m});
  const Cell high = frame().cell_of({centre.x + reach_m, centre.y - reach_m});
  const double c = std::cos(centre.yaw);
  const double s = std::sin(centre.yaw);
  for (int row = std::max(0, low.row); row <= std::min(frame().height - 1, high.row); ++row) {
    for (int column = std::max(0, low.column); column <= std::min(frame().width - 1, high.column);
         ++column) {
      const Point point = frame().centre_of({column, row});
      const double dx = point.x - centre.x;
      const double dy = point.y - centre.y;
      if (std::fabs(c * dx + s * dy) <= 0.5 * length_m &&
          std::fabs(c * dy - s * dx) <= 0.5 * width_m) {
        log_odds_[{column, row}] = 0.0F;
      }
    }
  }
}

Mask cells_in_state(const Grid<CellState>& states, CellState state) {
  Mask mask(states.frame());
  std::transform(states.values().begin(), states.values().end(), mask.values().begin(),
                 [&](CellState s) { return static_cast<std::uint8_t>(s == state ? 1 : 0); });
  return mask;
}

}  // namespace par
