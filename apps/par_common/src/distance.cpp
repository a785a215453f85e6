// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "par_common/distance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

namespace par {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// result[x] = min over q of (x - q)^2 + heights[q], for x = 0..n-1: the lower envelope of parabolas
// whose lowest points are at (q, heights[q]). Heights may be infinite.
class LowerEnvelope {
 public:
  explicit LowerEnvelope(std::size_t n) : apex_(n), begin_(n) {}

  void operator()(const std::vector<double>& heights, double* result) {
    const std::size_t n = heights.size();
    std::size_t parabolas = 0;
    for (std::size_t q = 0; q < n; ++q) {
      if (heights[q] == kInfinity) continue;
      // Remove the parabolas whose part of the envelope begins only where the new one is already
      // lower.
      double begin = -kInfinity;
      while (parabolas > 0) {
        const std::size_t p = apex_[parabolas - 1];
        begin = crossing(heights, p, q);
        if (begin > begin_[parabolas - 1]) break;
        --parabolas;
        begin = -kInfinity;
      }
      apex_[parabolas] = q;
      begin_[parabolas] = begin;
      ++parabolas;
    }
    if (parabolas == 0) {
      std::fill(result, result + n, kInfinity);
      return;
    }
    std::size_t k = 0;
    for (std::size_t x = 0; x < n; ++x) {
      const double at = static_cast<double>(x);
      while (k + 1 < parabolas && begin_[k + 1] < at) ++k;
      const double offset = at - static_cast<double>(apex_[k]);
      result[x] = offset * offset + heights[apex_[k]];
    }
  }

 private:
  // The x from which the parabola of q > p is lower than that of p.
  static double crossing(const std::vector<double>& heights, std::size_t p, std::size_t q) {
    const double a = static_cast<double>(p);
    const double b = static_cast<double>(q);
    return ((heights[q] + b * b) - (heights[p] + a * a)) / (2.0 * (b - a));
  }

  std::vector<std::size_t> apex_;  // the envelope's parabolas, from left to right
  std::vector<double> begin_;      // where each of them begins to be the lowest
};

// Squared distances in cells.
Grid<double> squared_distances(const Mask& blocked, Outside outside) {
  Grid<double> squared(blocked.frame());
  const int width = blocked.width();
  const int height = blocked.height();
  const double beyond = outside == Outside::kBlocked ? 1.0 : kInfinity;

  // Along a column, the nearest blocked cell is found by looking up and down.
  for (int column = 0; column < width; ++column) {
    double distance = beyond - 1.0;
    for (int row = 0; row < height; ++row) {
      distance = blocked[{column, row}] != 0 ? 0.0 : distance + 1.0;
      squared[{column, row}] = distance;
    }
    distance = beyond - 1.0;
    for (int row = height - 1; row >= 0; --row) {
      double& cell = squared[{column, row}];
      distance = std::min(cell, distance + 1.0);
      cell = distance * distance;
    }
  }

  LowerEnvelope envelope(static_cast<std::size_t>(width));
  std::vector<double> heights(static_cast<std::size_t>(width));
  for (int row = 0; row < height; ++row) {
    double* const cells = &squared[{0, row}];
    std::copy(cells, cells + width, heights.begin());
    envelope(heights, cells);
    if (outside == Outside::kBlocked) {
      for (int column = 0; column < width; ++column) {
        const double side = static_cast<double>(std::min(column + 1, width - column));
        cells[column] = std::min(cells[column], side * side);
      }
    }
  }
  return squared;
}

}  // namespace

Grid<double> distance_to_blocked_m(const Mask& blocked, Outside outside) {
  Grid<double> distances = squared_distances(blocked, outside);
  const double cell_size_m = blocked.frame().cell_size_m;
  for (double& value : distances.values()) value = std::sqrt(value) * cell_size_m;
  return distances;
}

Mask inflate(const Mask& blocked, double radius_m, Outside outside) {
  if (!(radius_m >= 0.0)) throw std::invalid_argument("inflate: the radius must be at least 0 m");
  const Grid<double> squared = squared_distances(blocked, outside);
  // Squared distances are integers. The tolerance keeps rounding from excluding cells exactly at
  // the radius.
  const double radius_cells = radius_m / blocked.frame().cell_size_m;
  const double limit = radius_cells * radius_cells * (1.0 + 1e-9);
  Mask grown(blocked.frame());
  for (std::size_t i = 0; i < grown.values().size(); ++i) {
    grown.values()[i] = squared.values()[i] <= limit ? 1 : 0;
  }
  return grown;
}

std::optional<Cell> nearest_free(const Mask& blocked, const Cell& from, double max_distance_m) {
  const double reach = max_distance_m / blocked.frame().cell_size_m * (1.0 + 1e-9);
  std::optional<Cell> nearest;
  double least = reach;
  for (int row = 0; row < blocked.height(); ++row) {
    if (std::abs(static_cast<double>(row) - from.row) > least) continue;
    for (int column = 0; column < blocked.width(); ++column) {
      const Cell cell{column, row};
      if (blocked[cell] != 0) continue;
      const double distance = distance_cells(cell, from);
      if (nearest ? distance < least : distance <= least) {
        nearest = cell;
        least = distance;
      }
    }
  }
  return nearest;
}

}  // namespace par
