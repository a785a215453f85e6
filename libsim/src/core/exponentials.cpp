// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/double_double.h"
#include "sim/core/math.h"

namespace sim::math {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// 2^(i/16)
constexpr DoubleDouble kRootsOfTwo[16] = {{0x1.0000000000000p+0, 0.0},
                                          {0x1.0b5586cf9890fp+0, 0x1.8a62e4adc610bp-54},
                                          {0x1.172b83c7d517bp+0, -0x1.19041b9d78a76p-55},
                                          {0x1.2387a6e756238p+0, 0x1.9b07eb6c70573p-54},
                                          {0x1.306fe0a31b715p+0, 0x1.6f46ad23182e4p-55},
                                          {0x1.3dea64c123422p+0, 0x1.ada0911f09ebcp-55},
                                          {0x1.4bfdad5362a27p+0, 0x1.d4397afec42e2p-56},
                                          {0x1.5ab07dd485429p+0, 0x1.6324c054647adp-54},
                                          {0x1.6a09e667f3bcdp+0, -0x1.bdd3413b26456p-54},
                                          {0x1.7a11473eb0187p+0, -0x1.41577ee04992fp-55},
                                          {0x1.8ace5422aa0dbp+0, 0x1.6e9f156864b27p-54},
                                          {0x1.9c49182a3f090p+0, 0x1.c7c46b071f2bep-56},
                                          {0x1.ae89f995ad3adp+0, 0x1.7a1cd345dcc81p-54},
                                          {0x1.c199bdd85529cp+0, 0x1.11065895048ddp-55},
                                          {0x1.d5818dcfba487p+0, 0x1.2ed02d75b3707p-55},
                                          {0x1.ea4afa2a490dap+0, -0x1.e9c23179c2893p-54}};

/// 2^exponent, for -1022 <= exponent <= 1023.
double power_of_two(int exponent) noexcept {
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

/// value * 2^exponent, for values in [0.5, 2], also where the result is not a normal number.
double scaled(double value, int exponent) noexcept {
  if (exponent > 1000) return value * 0x1p+1000 * power_of_two(exponent - 1000);
  if (exponent < -1000) return value * power_of_two(exponent + 1000) * 0x1p-1000;
  return value * power_of_two(exponent);
}

/// e^x = 2^exponent (base + base * growth), with |growth| < 0.022.
struct Exponential {
  int exponent = 0;
  DoubleDouble base;
  double growth = 0.0;
};

/// For |x| < 800: x = (16 exponent + i) ln(2)/16 + r, with e^r - 1 by its Taylor series up to
/// r^7/7! and a table of 2^(i/16) (P. T. P. Tang, "Table-driven implementation of the exponential
/// function in IEEE floating-point arithmetic", ACM TOMS 15(2), 1989).
Exponential exponential(const DoubleDouble& x) noexcept {
  constexpr double kPerUnit = 0x1.71547652b82fep+4;
  constexpr double kUnitHigh = 0x1.62e42fef00000p-5;  // its multiples are exact
  constexpr double kUnitLow = 0x1.473de6af278edp-38;
  constexpr double kToInteger = 0x1.8p+52;
  const double units = (x.high * kPerUnit + kToInteger) - kToInteger;
  const DoubleDouble r = fast_sum(x.high - units * kUnitHigh, x.low - units * kUnitLow);
  const double z = r.high * r.high;
  const double cubic =
      z * r.high *
      (1.0 / 6 +
       r.high * (1.0 / 24 + r.high * (1.0 / 120 + r.high * (1.0 / 720 + r.high * (1.0 / 5040)))));
  const int whole = static_cast<int>(units);
  const int place = static_cast<int>(static_cast<unsigned>(whole) & 15U);
  return {(whole - place) / 16, kRootsOfTwo[static_cast<std::size_t>(place)],
          r.high + (r.low + (0.5 * z + cubic))};
}

double exp_of(const DoubleDouble& x) noexcept {
  if (x.high > 710.0) return kInfinity;
  if (x.high < -746.0) return 0.0;
  const Exponential e = exponential(x);
  return scaled(e.base.high + (e.base.low + e.base.high * e.growth), e.exponent);
}

/// x = 2^exponent * mantissa, with the mantissa in [1/sqrt(2), sqrt(2)). For positive finite x.
struct Parts {
  int exponent = 0;
  double mantissa = 1.0;
};

Parts parts_of(double x) noexcept {
  int exponent = 0;
  if (x < std::numeric_limits<double>::min()) {
    x *= 0x1p+54;
    exponent = -54;
  }
  constexpr std::uint64_t kRootOfHalf = 0x3fe6a09e667f3bcdULL;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t above = bits - kRootOfHalf;  // below sqrt(1/2), the exponent borrows
  const auto shift = static_cast<int>(static_cast<std::int64_t>(above) >> 52);
  return {exponent + shift,
          std::bit_cast<double>(bits - (static_cast<std::uint64_t>(shift) << 52))};
}

/// log(x) with about 65 bits: 2 artanh(s) for s = (m - 1) / (m + 1), of which the first two terms
/// of the series are double-doubles.
DoubleDouble long_log(double x) noexcept {
  const auto [exponent, mantissa] = parts_of(x);
  const DoubleDouble s = quotient({mantissa - 1.0, 0.0}, exact_sum(mantissa, 1.0));
  const DoubleDouble z = product(s, s);
  double rest = 0.0;  // 1/5 + z/7 + ... + z^10/25
  for (int n = 25; n >= 5; n -= 2) rest = rest * z.high + 1.0 / n;
  const DoubleDouble third{0x1.5555555555555p-2, 0x1.5555555555555p-56};
  const DoubleDouble inner = sum(third, {z.high * rest, 0.0});
  const DoubleDouble curve = product(product(s, z), inner);
  const DoubleDouble of_mantissa =
      sum({2.0 * s.high, 2.0 * s.low}, {2.0 * curve.high, 2.0 * curve.low});
  if (exponent == 0) return of_mantissa;
  const DoubleDouble ln2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};
  return sum(product({static_cast<double>(exponent), 0.0}, ln2), of_mantissa);
}

/// What log() gives where there is nothing to compute: for NaN, infinity, 0 and negative numbers.
bool is_log_trivial(double x) noexcept { return !(x > 0.0) || x == kInfinity; }
double trivial_log(double x) noexcept {
  if (x == 0.0) return -kInfinity;
  return x < 0.0 ? kNan : x;
}

/// Whether a number is an odd integer.
bool is_odd(double y) noexcept {
  return std::abs(y) < 0x1p+53 && std::fmod(std::abs(y), 2.0) == 1.0;
}

/// pow() with a base or an exponent that is 0, infinite or NaN. C's Annex F, section F.10.4.4.
double special_power(double x, double y) noexcept {
  if (y == 0.0 || x == 1.0) return 1.0;
  if (std::isnan(x) || std::isnan(y)) return x + y;
  if (std::isinf(y)) {
    const double size = std::abs(x);
    if (size == 1.0) return 1.0;
    return (size > 1.0) == (y > 0.0) ? kInfinity : 0.0;
  }
  const bool large = std::isinf(x) == (y > 0.0);  // x is 0 or infinite
  const double size = large ? kInfinity : 0.0;
  return std::signbit(x) && is_odd(y) ? -size : size;
}

}  // namespace

double exp(double x) noexcept { return std::isnan(x) ? x : exp_of({x, 0.0}); }

double expm1(double x) noexcept {
  if (std::isnan(x) || std::abs(x) < 0x1p-54) return x;
  if (x > 40.0) return exp(x);
  if (x < -40.0) return -1.0;
  if (std::abs(x) < 0.02) {  // Taylor's series
    double rest = 0.0;
    for (int n = 9; n >= 3; --n) rest = (rest + 1.0) * x / n;
    return x + 0.5 * x * x * (1.0 + rest);
  }
  const Exponential e = exponential({x, 0.0});
  const double scale = power_of_two(e.exponent);
  const DoubleDouble whole = exact_sum(scale * e.base.high, -1.0);
  return whole.high + (whole.low + scale * (e.base.low + e.base.high * e.growth));
}

// FDLIBM's polynomial and order of operations (Sun Microsystems, 1993; e_log.c).
double log(double x) noexcept {
  if (is_log_trivial(x)) return trivial_log(x);
  constexpr double kLn2High = 0x1.62e42fef00000p-1;
  constexpr double kLn2Low = 0x1.473de6af278edp-34;
  const auto [exponent, mantissa] = parts_of(x);
  const double f = mantissa - 1.0;
  const double s = f / (2.0 + f);
  const double z = s * s;
  const double w = z * z;
  const double even = w * (3.999999999940941908e-01 +
                           w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01));
  const double odd = z * (6.666666666666735130e-01 +
                          w * (2.857142874366239149e-01 +
                               w * (1.818357216161805012e-01 + w * 1.479819860511658591e-01)));
  const double half = 0.5 * f * f;
  const double k = exponent;
  return k * kLn2High - ((half - (s * (half + (odd + even)) + k * kLn2Low)) - f);
}

double log2(double x) noexcept {
  if (is_log_trivial(x)) return trivial_log(x);
  const auto [exponent, mantissa] = parts_of(x);
  const DoubleDouble fraction =
      product(long_log(mantissa), {0x1.71547652b82fep+0, 0x1.777d0ffda0d24p-56});
  const DoubleDouble whole = exact_sum(exponent, fraction.high);
  return whole.high + (whole.low + fraction.low);
}

double log10(double x) noexcept {
  if (is_log_trivial(x)) return trivial_log(x);
  return product(long_log(x), {0x1.bcb7b1526e50ep-2, 0x1.95355baaafad3p-57}).high;
}

double pow(double x, double y) noexcept {
  if (x == 0.0 || y == 0.0 || x == 1.0 || !std::isfinite(x) || !std::isfinite(y)) {
    return special_power(x, y);
  }
  if (x < 0.0) {
    if (y != std::floor(y)) return kNan;
    return is_odd(y) ? -pow(-x, y) : pow(-x, y);
  }
  const DoubleDouble l = long_log(x);
  const double size = l.high * y;
  if (!(std::abs(size) < 800.0)) return size > 0.0 ? kInfinity : 0.0;
  if (std::abs(size) < 0x1p-60) return 1.0;
  return exp_of(product(l, {y, 0.0}));
}

double cbrt(double x) noexcept {
  if (x == 0.0 || !std::isfinite(x)) return x;
  const double size = std::abs(x);
  const auto [exponent, mantissa] = parts_of(size);
  const int third = exponent >= 0 ? exponent / 3 : -((2 - exponent) / 3);
  const double reduced = mantissa * power_of_two(exponent - 3 * third);  // in [0.7, 5.7)
  double root = exp_of({log(reduced) / 3.0, 0.0});
  // One step of Newton's method, with an exact cube, removes the errors of exp() and log().
  const DoubleDouble cube = product(exact_product(root, root), {root, 0.0});
  root -= ((cube.high - reduced) + cube.low) / (3.0 * root * root);
  return std::copysign(scaled(root, third), x);
}

}  // namespace sim::math
