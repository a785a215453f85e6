// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sim/parallel/batch.h"

namespace sim::parallel {

/// The shape of an array: rows of `width` numbers.
struct Shape {
  std::ptrdiff_t simulations;
  std::ptrdiff_t robots;
  std::ptrdiff_t width;
};

/// Strides of an array that were checked.
struct Strides {
  std::ptrdiff_t simulation;
  std::ptrdiff_t robot;
};

/// Checks the size and the strides of an array, and computes the strides that are 0.
/// @param name  of the array in messages.
/// @param size  its number of elements, > 0.
/// @throws BatchError
[[nodiscard]] Strides checked_strides(const char* name, const Shape& shape, std::size_t size,
                                      std::ptrdiff_t simulation_stride,
                                      std::ptrdiff_t robot_stride);

/// A checked array: the rows of a caller's array.
template <typename T>
class Rows {
 public:
  Rows() = default;
  /// @throws BatchError as checked_strides().
  Rows(const char* name, const BatchArray<T>& array, const Shape& shape)
      : first_(array.values.empty() ? nullptr : array.values.data()),
        width_(static_cast<std::size_t>(shape.width)),
        strides_{} {
    if (first_ == nullptr) return;
    strides_ = checked_strides(name, shape, array.values.size(), array.simulation_stride,
                               array.robot_stride);
  }

  /// Whether the caller has such an array.
  [[nodiscard]] explicit operator bool() const noexcept { return first_ != nullptr; }
  [[nodiscard]] std::span<T> row(std::size_t simulation, std::size_t robot = 0) const noexcept {
    return {first_ + static_cast<std::ptrdiff_t>(simulation) * strides_.simulation +
                static_cast<std::ptrdiff_t>(robot) * strides_.robot,
            width_};
  }

 private:
  T* first_ = nullptr;
  std::size_t width_ = 0;
  Strides strides_{};
};

/// The checked arrays of a BatchObservations.
struct ObservationRows {
  ObservationRows(const BatchObservations& out, int simulations, int robots, int beams);

  Rows<double> poses;
  Rows<double> twists;
  Rows<float> scans;
  Rows<double> clearances;
  Rows<std::int32_t> collisions;
  Rows<std::uint8_t> done;
  Rows<double> times;
};

/// Checks that all numbers of one simulation's rows are finite.
/// @param name   of the array.
/// @param names  of the numbers of a row.
/// @throws BatchError that names the first one that is not.
void check_finite(const char* name, const Rows<const double>& rows, int simulation, int robots,
                  std::span<const char* const> names);

}  // namespace sim::parallel
