// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The encoding of a replay's numbers. viewer/columns.js decodes it.
namespace playerlike::replay {

/// Columns of whole numbers, as bytes.
///
/// Each number is written as its difference from the number `lag` places before it in its column
/// (from 0 for the first ones), zigzag-coded (0, -1, 1, -2, ... become 0, 1, 2, 3, ...) and as a
/// little-endian base-128 varint, as in Protocol Buffers. Small differences take one byte, and
/// equal ones give runs that deflate() removes. Not thread-safe.
class Columns {
 public:
  /// Where a column is, and how it is read.
  struct Entry {
    std::size_t offset = 0;  ///< of its first byte
    std::size_t count = 0;   ///< of its numbers
    std::size_t lag = 1;     ///< >= 1
    bool wide = false;       ///< whether some numbers need more than 32 bits
  };

  /// Appends a column.
  /// @param values  each in [-2^52, 2^52], so that JavaScript's numbers hold it; others are
  /// clamped.
  /// @param lag  distance of the numbers that are compared, >= 1: the length of a record if the
  ///     column has records of equal length one after the other.
  /// @return its index in entries().
  std::size_t add(std::span<const std::int64_t> values, std::size_t lag = 1);

  [[nodiscard]] const std::vector<Entry>& entries() const noexcept { return entries_; }
  [[nodiscard]] const std::string& bytes() const noexcept { return bytes_; }

 private:
  std::vector<Entry> entries_;
  std::string bytes_;
};

/// Value of a number that is not finite, in columns of quantised(); JavaScript reads it as NaN.
inline constexpr std::int64_t kNoNumber = -(std::int64_t{1} << 31);

/// The nearest whole multiple of `unit`. @return kNoNumber if the value is not finite or too large.
/// @pre unit > 0
[[nodiscard]] std::int64_t quantised(double value, double unit);

}  // namespace playerlike::replay
