// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "parallel/rows.h"

#include <cmath>
#include <string>

namespace sim::parallel {
namespace {

// With larger strides, the place of a row could not be computed.
constexpr std::ptrdiff_t kGreatestStride = std::ptrdiff_t{1} << 31;

std::string text_of(const Shape& shape) {
  return std::to_string(shape.simulations) + " x " + std::to_string(shape.robots) + " x " +
         std::to_string(shape.width) + " (simulations x robots x numbers)";
}

[[noreturn]] void fail_array(const char* name, const std::string& what) {
  throw BatchError(std::string(name) + ": " + what);
}

// Whether no two rows share an element.
bool are_apart(const Shape& shape, const Strides& strides) {
  if (shape.simulations == 1 && shape.robots == 1) return true;
  const bool robots_inside =
      (shape.robots == 1 || strides.robot >= shape.width) &&
      (shape.simulations == 1 ||
       strides.simulation >= (shape.robots - 1) * strides.robot + shape.width);
  const bool simulations_inside =
      (shape.simulations == 1 || strides.simulation >= shape.width) &&
      (shape.robots == 1 ||
       strides.robot >= (shape.simulations - 1) * strides.simulation + shape.width);
  return robots_inside || simulations_inside;
}

}  // namespace

Strides checked_strides(const char* name, const Shape& shape, std::size_t size,
                        std::ptrdiff_t simulation_stride, std::ptrdiff_t robot_stride) {
  for (const std::ptrdiff_t stride : {simulation_stride, robot_stride}) {
    if (stride < 0 || stride > kGreatestStride) {
      fail_array(name, "expected strides of 0 to 2^31 elements, found " + std::to_string(stride));
    }
  }
  Strides strides{simulation_stride, robot_stride};
  if (strides.robot == 0) strides.robot = shape.width;
  if (strides.simulation == 0) strides.simulation = shape.robots * strides.robot;
  const std::ptrdiff_t needed = (shape.simulations - 1) * strides.simulation +
                                (shape.robots - 1) * strides.robot + shape.width;
  const bool without_gaps = simulation_stride == 0 && robot_stride == 0;
  const auto least = static_cast<std::size_t>(needed);
  if (size < least || (without_gaps && size != least)) {
    fail_array(name, std::string("expected ") + (without_gaps ? "" : "at least ") +
                         std::to_string(needed) + " elements for " + text_of(shape) + ", found " +
                         std::to_string(size));
  }
  if (!are_apart(shape, strides)) {
    fail_array(name, "expected strides with which no two rows of " + text_of(shape) +
                         " overlap, found the strides " + std::to_string(strides.simulation) +
                         " of simulations and " + std::to_string(strides.robot) + " of robots");
  }
  return strides;
}

ObservationRows::ObservationRows(const BatchObservations& out, int simulations, int robots,
                                 int beams)
    : poses("poses", out.poses, {simulations, robots, 3}),
      twists("twists", out.twists, {simulations, robots, 3}),
      clearances("clearances", out.clearances, {simulations, robots, 1}),
      collisions("collisions", out.collisions, {simulations, robots, 1}),
      done("done", out.done, {simulations, 1, 1}),
      times("times", out.times, {simulations, 1, 1}) {
  if (out.scans.values.empty()) return;
  if (beams == 0) fail_array("scans", "expected no array: no robot has a laser");
  scans = Rows<float>("scans", out.scans, {simulations, robots, beams});
}

void check_finite(const char* name, const Rows<const double>& rows, int simulation, int robots,
                  std::span<const char* const> names) {
  for (int r = 0; r < robots; ++r) {
    const auto row = rows.row(static_cast<std::size_t>(simulation), static_cast<std::size_t>(r));
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (std::isfinite(row[k])) continue;
      fail_array(name, "expected finite numbers, found " +
                           std::string(std::isnan(row[k]) ? "NaN" : "an infinite one") + " as " +
                           names[k] + " of simulation " + std::to_string(simulation) + ", robot " +
                           std::to_string(r));
    }
  }
}

}  // namespace sim::parallel
