// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Elementary functions that give the same bits on every machine.
///
/// A C library rounds `sin` and its kind as its version and the processor's instructions suggest:
/// it has other code for processors with fused operations. These functions need the basic
/// operations of IEEE 754 only (addition, multiplication, division, square root in double
/// precision, rounded to nearest), whose results are fixed. So equal arguments have equal results
/// with every compiler, processor and C library. `std::sqrt`, `std::remainder`, `std::fmod`,
/// `std::floor` and their kind are exact by that standard and need no version of their own.
///
/// An error is stated in units in the last place of the result (ulp), as the most that
/// tests/unit/sim/math_test.cpp lets pass; it measures against a longer format. Infinite arguments,
/// NaN and zeros give what C's Annex F states; `errno` and the floating-point flags mean nothing.
/// All functions can be called in any thread.
namespace sim::math {

/// Sine and cosine of one angle.
struct SinCos {
  double sin = 0.0;
  double cos = 1.0;
};

/// Sine and cosine of an angle of any size [rad], in less time than by two calls. Error: at most
/// 1 ulp.
[[nodiscard]] SinCos sin_cos(double angle_rad) noexcept;
/// Sine of an angle of any size [rad]. Error: at most 1 ulp.
[[nodiscard]] double sin(double angle_rad) noexcept;
/// Cosine of an angle of any size [rad]. Error: at most 1 ulp.
[[nodiscard]] double cos(double angle_rad) noexcept;
/// Tangent of an angle of any size [rad]. Error: at most 2.5 ulp.
[[nodiscard]] double tan(double angle_rad) noexcept;

/// Angle from the x axis to the vector (x, y), in [-pi, pi] [rad]. Error: at most 1 ulp.
[[nodiscard]] double atan2(double y, double x) noexcept;
/// The angle in [-pi/2, pi/2] with this tangent [rad]. Error: at most 1 ulp.
[[nodiscard]] double atan(double x) noexcept;
/// The angle in [-pi/2, pi/2] with this sine [rad]; NaN for |x| > 1. Error: at most 2 ulp.
[[nodiscard]] double asin(double x) noexcept;
/// The angle in [0, pi] with this cosine [rad]; NaN for |x| > 1. Error: at most 2 ulp.
[[nodiscard]] double acos(double x) noexcept;

/// Length of the vector (x, y), without overflow on the way. Error: at most 1 ulp.
[[nodiscard]] double hypot(double x, double y) noexcept;
/// Cube root. Error: at most 1 ulp.
[[nodiscard]] double cbrt(double x) noexcept;

/// e to the power of x. Error: at most 1 ulp.
[[nodiscard]] double exp(double x) noexcept;
/// exp(x) - 1, also for small x. Error: at most 2 ulp.
[[nodiscard]] double expm1(double x) noexcept;
/// Natural logarithm; -infinity for 0, NaN below. Error: at most 1 ulp.
[[nodiscard]] double log(double x) noexcept;
/// Logarithm to the base 2. Error: at most 1 ulp.
[[nodiscard]] double log2(double x) noexcept;
/// Logarithm to the base 10. Error: at most 1 ulp.
[[nodiscard]] double log10(double x) noexcept;
/// x to the power of y. Error: at most 1 ulp.
[[nodiscard]] double pow(double x, double y) noexcept;

/// Whether calls of the C library's functions of these names, by the program and the libraries that
/// were loaded with it, come here. So it is with glibc on x86-64 and AArch64.
[[nodiscard]] bool bound() noexcept;

}  // namespace sim::math
