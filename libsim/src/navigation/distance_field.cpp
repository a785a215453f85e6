// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/navigation/distance_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/assert.h"

namespace sim {
namespace {

/// Scratch memory for the distance transform of one row or column.
struct Envelope {
  explicit Envelope(std::size_t size) : vertices(size), bounds(size + 1), squares(size) {}
  std::vector<std::size_t> vertices;  // parabolas of the lower envelope
  std::vector<double> bounds;         // where one parabola ends and the next one begins
  std::vector<double> squares;        // result
};

/// Replaces squares of distances f(q) by the least f(q) + (p - q)^2 for each p.
/// @param f  one finite number per cell; kFar for cells without an occupied one.
void transform(std::vector<double>& f, Envelope& scratch) {
  const std::size_t size = f.size();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<std::size_t>& v = scratch.vertices;
  std::vector<double>& z = scratch.bounds;
  std::size_t last = 0;
  v[0] = 0;
  z[0] = -kInfinity;
  z[1] = kInfinity;
  const auto intersection = [&f](std::size_t q, std::size_t p) {
    const auto a = static_cast<double>(q);
    const auto b = static_cast<double>(p);
    return ((f[q] + a * a) - (f[p] + b * b)) / (2.0 * (a - b));
  };
  for (std::size_t q = 1; q < size; ++q) {
    double s = intersection(q, v[last]);
    while (s <= z[last]) {
      --last;
      s = intersection(q, v[last]);
    }
    ++last;
    v[last] = q;
    z[last] = s;
    z[last + 1] = kInfinity;
  }
  last = 0;
  for (std::size_t p = 0; p < size; ++p) {
    while (z[last + 1] < static_cast<double>(p)) ++last;
    const double offset = static_cast<double>(p) - static_cast<double>(v[last]);
    scratch.squares[p] = offset * offset + f[v[last]];
  }
  std::copy_n(scratch.squares.begin(), size, f.begin());
}

}  // namespace

DistanceField distance_field(const OccupancyMap& map, double limit_m, double threshold) {
  SIM_ASSERT(map.width >= 1 && map.height >= 1 && map.cell_size_m > 0.0 && limit_m > 0.0);
  // Farther than any cell, but small enough for exact arithmetic with whole numbers.
  constexpr double kFar = 1e12;
  const auto width = static_cast<std::size_t>(map.width);
  const auto height = static_cast<std::size_t>(map.height);
  std::vector<double> squares(width * height);
  Envelope scratch(std::max(width, height));
  std::vector<double> line(height);
  for (std::size_t column = 0; column < width; ++column) {
    for (std::size_t row = 0; row < height; ++row) {
      line[row] = double{map.cells[row * width + column]} > threshold ? 0.0 : kFar;
    }
    transform(line, scratch);
    for (std::size_t row = 0; row < height; ++row) squares[row * width + column] = line[row];
  }
  DistanceField field{map.width, map.height, map.cell_size_m, map.origin, {}};
  field.distances_m.resize(width * height);
  line.resize(width);
  for (std::size_t row = 0; row < height; ++row) {
    std::copy_n(squares.begin() + static_cast<std::ptrdiff_t>(row * width), width, line.begin());
    transform(line, scratch);
    for (std::size_t column = 0; column < width; ++column) {
      field.distances_m[row * width + column] =
          static_cast<float>(std::min(limit_m, map.cell_size_m * std::sqrt(line[column])));
    }
  }
  return field;
}

}  // namespace sim
