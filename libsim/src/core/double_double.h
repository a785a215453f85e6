// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace sim::math {

/// The sum of two doubles, the second at most half a unit in the last place of the first: a number
/// of about 106 bits (T. J. Dekker, "A floating-point technique for extending the available
/// precision", Numerische Mathematik 18, 1971).
struct DoubleDouble {
  double high = 0.0;
  double low = 0.0;
};

/// a + b without an error, if |a| >= |b| or a is 0 (Dekker).
inline DoubleDouble fast_sum(double a, double b) noexcept {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a + b without an error (D. E. Knuth, "The Art of Computer Programming", vol. 2, section 4.2.2).
inline DoubleDouble exact_sum(double a, double b) noexcept {
  const double sum = a + b;
  const double of_b = sum - a;
  return {sum, (a - (sum - of_b)) + (b - of_b)};
}

/// The upper 26 bits of a number below 2^996, and the rest (G. W. Veltkamp, in Dekker).
inline DoubleDouble halves(double a) noexcept {
  const double scaled = a * 0x1.0000002p+27;
  const double high = scaled - (scaled - a);
  return {high, a - high};
}

/// a * b without an error, if neither it nor its error leaves the range of normal numbers (Dekker).
inline DoubleDouble exact_product(double a, double b) noexcept {
  const double product = a * b;
  const DoubleDouble x = halves(a);
  const DoubleDouble y = halves(b);
  return {product,
          x.low * y.low - (((product - x.high * y.high) - x.low * y.high) - x.high * y.low)};
}

inline DoubleDouble product(const DoubleDouble& a, const DoubleDouble& b) noexcept {
  DoubleDouble result = exact_product(a.high, b.high);
  result.low += a.high * b.low + a.low * b.high;
  return fast_sum(result.high, result.low);
}

/// For |a| >= |b|, or sums that do not cancel.
inline DoubleDouble sum(const DoubleDouble& a, const DoubleDouble& b) noexcept {
  const DoubleDouble high = exact_sum(a.high, b.high);
  return fast_sum(high.high, high.low + (a.low + b.low));
}

inline DoubleDouble quotient(const DoubleDouble& a, const DoubleDouble& b) noexcept {
  const double high = a.high / b.high;
  const DoubleDouble back = exact_product(high, b.high);
  const double rest = ((a.high - back.high) - back.low + a.low) - high * b.low;
  return fast_sum(high, rest / b.high);
}

}  // namespace sim::math
