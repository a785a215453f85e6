// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

#include "core/double_double.h"
#include "sim/core/math.h"

namespace sim::math {
namespace {

constexpr DoubleDouble kHalfPi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

/// An angle as a number of quarter turns, of which the last two bits count, and a rest of at most
/// an eighth of a turn [rad].
struct ReducedAngle {
  unsigned quarters = 0;
  DoubleDouble rest;
};

/// For |angle_rad| < 25: pi/2 in three parts, the first two so short that their multiples are exact
/// (W. J. Cody and W. Waite, "Software Manual for the Elementary Functions", 1980).
ReducedAngle reduced_small(double angle_rad) noexcept {
  constexpr double kFirst = 0x1.921fb54442d10p+0;
  constexpr double kSecond = 0x1.08d313198a2e0p-49;
  constexpr double kThird = 0x1.b839a252049c1p-104;
  constexpr double kToInteger = 0x1.8p+52;  // the sum's last bit is worth 1
  const double quarters = (angle_rad * (2.0 / std::numbers::pi) + kToInteger) - kToInteger;
  const DoubleDouble rest = exact_sum(angle_rad - quarters * kFirst, -quarters * kSecond);
  return {static_cast<unsigned>(static_cast<int>(quarters)),
          fast_sum(rest.high, rest.low - quarters * kThird)};
}

/// 2/pi after the binary point.
constexpr std::array<std::uint64_t, 19> kTwoByPi{
    0xa2f9836e4e441529ULL, 0xfc2757d1f534ddc0ULL, 0xdb6295993c439041ULL, 0xfe5163abdebbc561ULL,
    0xb7246e3a424dd2e0ULL, 0x06492eea09d1921cULL, 0xfe1deb1cb129a73eULL, 0xe88235f52ebb4484ULL,
    0xe99c7026b45f7e41ULL, 0x3991d639835339f4ULL, 0x9c845f8bbdf9283bULL, 0x1ff897ffde05980fULL,
    0xef2f118b5a0a6d1fULL, 0x6d367ecf27cb09b7ULL, 0x4f463f669e5fea2dULL, 0x7527bac7ebe5f17bULL,
    0x3d0739f78a5292eaULL, 0x6bfb5fb11f8d5d08ULL, 0x56033046fc7b6babULL};

/// 64 bits of 2/pi from a bit on; 0 is the first after the binary point, those before it are 0.
std::uint64_t bits_of_two_by_pi(int first) noexcept {
  const auto word = [](int index) {
    return index < 0 ? std::uint64_t{0} : kTwoByPi.at(static_cast<std::size_t>(index));
  };
  const int index = first >= 0 ? first / 64 : -((63 - first) / 64);
  const int shift = first - 64 * index;
  const std::uint64_t upper = word(index) << shift;
  return shift == 0 ? upper : upper | word(index + 1) >> (64 - shift);
}

__extension__ using Wide = unsigned __int128;

/// For finite angles of 1 rad and more: of the product with 2/pi, only bits that matter are
/// computed (M. H. Payne and R. N. Hanek, "Radian reduction for trigonometric functions", ACM
/// SIGNUM Newsletter 18(1), 1983).
ReducedAngle reduced_large(double angle_rad) noexcept {
  const auto bits = std::bit_cast<std::uint64_t>(angle_rad);
  const int exponent = static_cast<int>(bits >> 52 & 0x7ff) - 1075;
  const std::uint64_t mantissa = (bits & 0xfffffffffffffULL) | 0x10000000000000ULL;
  // The angle is mantissa * 2^exponent. Bits of 2/pi before this one give whole turns. The product
  // counts units of 2^-190 quarter turns, modulo 2^192.
  const int first = exponent - 2;
  const Wide low = Wide{mantissa} * bits_of_two_by_pi(first + 128);
  const Wide middle = Wide{mantissa} * bits_of_two_by_pi(first + 64) + (low >> 64);
  const std::uint64_t top =
      mantissa * bits_of_two_by_pi(first) + static_cast<std::uint64_t>(middle >> 64);
  auto quarters = static_cast<unsigned>(top >> 62);
  // The fraction of a quarter turn, in units of 2^-128 and rounded to the nearest quarter turn.
  Wide fraction = (Wide{top} << 64 | static_cast<std::uint64_t>(middle)) << 2 |
                  static_cast<std::uint64_t>(low) >> 62;
  const bool negative = fraction >> 127 != 0;
  if (negative) {
    ++quarters;
    fraction = ~fraction;  // but for one unit in the last place
  }
  // The bits below those of `fraction` matter if it begins with zeros.
  int shift = 0;
  if (fraction >> 64 == 0) {
    const std::uint64_t rest = static_cast<std::uint64_t>(low) << 2;
    fraction = fraction << 64 | (negative ? ~rest : rest);
    shift = 64;
  }
  const int zeros =
      fraction >> 64 == 0 ? 0 : std::countl_zero(static_cast<std::uint64_t>(fraction >> 64));
  fraction <<= zeros;
  const auto upper = static_cast<std::uint64_t>(fraction >> 75);                        // 53 bits
  const auto lower = static_cast<std::uint64_t>(fraction >> 22) & 0x1fffffffffffffULL;  // 53 bits
  const double unit = std::ldexp(1.0, -53 - zeros - shift);
  DoubleDouble rest = product(
      fast_sum(static_cast<double>(upper) * unit, static_cast<double>(lower) * unit * 0x1p-53),
      kHalfPi);
  if (negative) rest = {-rest.high, -rest.low};
  if (angle_rad < 0.0) return {-quarters, {-rest.high, -rest.low}};
  return {quarters, rest};
}

/// NaN for infinite angles and NaN.
ReducedAngle reduced(double angle_rad) noexcept {
  constexpr double kSmall_rad = 25.0;
  if (angle_rad >= -0.25 * std::numbers::pi && angle_rad <= 0.25 * std::numbers::pi) {
    return {0, {angle_rad, 0.0}};
  }
  if (angle_rad > -kSmall_rad && angle_rad < kSmall_rad) return reduced_small(angle_rad);
  if (!std::isfinite(angle_rad)) return {0, {std::numeric_limits<double>::quiet_NaN(), 0.0}};
  return reduced_large(angle_rad);
}

/// Minimax polynomials on [-pi/4, pi/4], with the coefficients and the order of operations of
/// FDLIBM's kernels (Sun Microsystems, 1993; k_sin.c and k_cos.c). x.low is a small correction.
double sine_kernel(const DoubleDouble& x, double z) noexcept {
  constexpr double k1 = -1.66666666666666324348e-01;
  constexpr double k2 = 8.33333333332248946124e-03;
  constexpr double k3 = -1.98412698298579493134e-04;
  constexpr double k4 = 2.75573137070700676789e-06;
  constexpr double k5 = -2.50507602534068634195e-08;
  constexpr double k6 = 1.58969099521155010221e-10;
  const double cube = z * x.high;
  const double rest = k2 + z * (k3 + z * (k4 + z * (k5 + z * k6)));
  return x.high - ((z * (0.5 * x.low - cube * rest) - x.low) - cube * k1);
}

double cosine_kernel(const DoubleDouble& x, double z) noexcept {
  constexpr double k1 = 4.16666666666666019037e-02;
  constexpr double k2 = -1.38888888888741095749e-03;
  constexpr double k3 = 2.48015872894767294178e-05;
  constexpr double k4 = -2.75573143513906633035e-07;
  constexpr double k5 = 2.08757232129817482790e-09;
  constexpr double k6 = -1.13596475577881948265e-11;
  const double rest = z * (k1 + z * (k2 + z * (k3 + z * (k4 + z * (k5 + z * k6)))));
  const double half = 0.5 * z;
  const double near = 1.0 - half;
  return near + (((1.0 - near) - half) + (z * rest - x.high * x.low));
}

/// atan(t) - t, for |t| <= 7/16: FDLIBM's polynomial (s_atan.c).
double arctangent_rest(double t) noexcept {
  const double z = t * t;
  const double w = z * z;
  const double odd =
      z * (3.33333333333329318027e-01 +
           w * (1.42857142725034663711e-01 +
                w * (9.09088713343650656196e-02 +
                     w * (6.66107313738753120669e-02 +
                          w * (4.97687799461593236017e-02 + w * 1.62858201153657823623e-02)))));
  const double even =
      w * (-1.99999999998764832476e-01 +
           w * (-1.11111104054623557880e-01 +
                w * (-7.69187620504482999495e-02 +
                     w * (-5.83357013379057348645e-02 + w * -3.65315727442169155270e-02))));
  return -t * (odd + even);
}

/// pi/2 k + atan(c) or pi/2 k - atan(c), for c = 0, 1/2, 1.
constexpr DoubleDouble kCorners[4][3] = {{{0.0, 0.0},
                                          {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                          {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}},
                                         {kHalfPi,
                                          {0x1.1b6e192ebbe44p+0, 0x1.b1b466a88828ep-54},
                                          {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}},
                                         {kHalfPi,
                                          {0x1.0468a8ace4df6p+1, 0x1.0620bf7406affp-55},
                                          {0x1.2d97c7f3321d2p+1, 0x1.a79394c9e8a0ap-54}},
                                         {{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53},
                                          {0x1.56c6e7397f5aep+1, 0x1.660b64ece6f4bp-53},
                                          {0x1.2d97c7f3321d2p+1, 0x1.a79394c9e8a0ap-54}}};

/// atan2() of finite numbers that are not 0, for y > 0.
double arctangent(double y, double x) noexcept {
  const double width = std::abs(x);
  const bool steep = y > width;
  const double a = steep ? width : y;
  const double b = steep ? y : width;
  const std::size_t quadrant = (x < 0.0 ? 3U : 0U) ^ (steep ? 1U : 0U);
  // atan(a/b) = atan(c) + atan((a - c b) / (b + c a)). The numerators are exact (Sterbenz).
  std::size_t corner = 0;
  double numerator = a;
  DoubleDouble denominator{b, 0.0};
  if (a > 0.4375 * b) {
    corner = a > 0.6875 * b ? 2 : 1;
    numerator = corner == 2 ? a - b : 2.0 * a - b;
    denominator = exact_sum(corner == 2 ? b : 2.0 * b, a);
  }
  const DoubleDouble t = quotient({numerator, 0.0}, denominator);
  const double angle_rest_rad = arctangent_rest(t.high) + t.low;
  const DoubleDouble& base = kCorners[quadrant][corner];
  // A flat angle grows with a/b in the first and the third case, else it shrinks.
  const bool grows = quadrant % 2 == 0;
  const double turn = grows ? t.high : -t.high;
  const double rest = grows ? angle_rest_rad : -angle_rest_rad;
  if (base.high == 0.0) return turn + rest;
  const DoubleDouble high = fast_sum(base.high, turn);
  return high.high + (high.low + (base.low + rest));
}

}  // namespace

SinCos sin_cos(double angle_rad) noexcept {
  const auto [quarters, rest] = reduced(angle_rad);
  const double z = rest.high * rest.high;
  const double s = sine_kernel(rest, z);
  const double c = cosine_kernel(rest, z);
  switch (quarters & 3U) {
    case 0:
      return {angle_rad == 0.0 ? angle_rad : s, c};  // the sign of zero stays
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

double sin(double angle_rad) noexcept {
  const auto [quarters, rest] = reduced(angle_rad);
  const double z = rest.high * rest.high;
  const double value = (quarters & 1U) == 0 ? sine_kernel(rest, z) : cosine_kernel(rest, z);
  if (angle_rad == 0.0) return angle_rad;
  return (quarters & 2U) == 0 ? value : -value;
}

double cos(double angle_rad) noexcept {
  const auto [quarters, rest] = reduced(angle_rad);
  const double z = rest.high * rest.high;
  const double value = (quarters & 1U) == 0 ? cosine_kernel(rest, z) : sine_kernel(rest, z);
  return ((quarters + 1U) & 2U) == 0 ? value : -value;
}

double tan(double angle_rad) noexcept {
  const SinCos both = sin_cos(angle_rad);
  return both.sin / both.cos;
}

double atan2(double y, double x) noexcept {
  if (std::isnan(x) || std::isnan(y)) return x + y;
  constexpr double kPi = std::numbers::pi;
  if (y == 0.0) return std::signbit(x) ? std::copysign(kPi, y) : y;
  if (x == 0.0) return std::copysign(0.5 * kPi, y);
  double height = std::abs(y);
  double width = std::abs(x);
  if (std::isinf(height) || std::isinf(width)) {
    const double angle_rad =
        std::isinf(height) ? (std::isinf(width) ? 0.25 * kPi : 0.5 * kPi) : 0.0;
    return std::copysign(x < 0.0 ? kPi - angle_rad : angle_rad, y);
  }
  constexpr double kTiny = 0x1p-60;  // of a ratio: it changes no angle but a small one
  if (height * kTiny > width) return std::copysign(0.5 * kPi, y);
  if (width * kTiny > height) return std::copysign(x < 0.0 ? kPi : height / width, y);
  // Products of parts must not leave the range.
  const double greater = height > width ? height : width;
  const double scale = greater > 0x1p+500 ? 0x1p-600 : greater < 0x1p-400 ? 0x1p+600 : 1.0;
  return std::copysign(arctangent(height * scale, x * scale), y);
}

double atan(double x) noexcept { return std::abs(x) < 0x1p-30 ? x : atan2(x, 1.0); }

double asin(double x) noexcept {
  return std::abs(x) < 0x1p-30 ? x : atan2(x, std::sqrt((1.0 - x) * (1.0 + x)));
}

double acos(double x) noexcept { return atan2(std::sqrt((1.0 - x) * (1.0 + x)), x); }

double hypot(double x, double y) noexcept {
  x = std::abs(x);
  y = std::abs(y);
  if (std::isinf(x) || std::isinf(y)) return std::numeric_limits<double>::infinity();
  if (x < y) {
    const double swapped = x;
    x = y;
    y = swapped;
  }
  if (y == 0.0 || !(y > x * 0x1p-54)) return x + y;  // NaN, too
  double unit = 1.0;
  if (x > 0x1p+500) unit = 0x1p+600;
  if (y < 0x1p-400) unit = 0x1p-600;
  if (unit != 1.0) {
    x /= unit;
    y /= unit;
  }
  const DoubleDouble x2 = exact_product(x, x);
  const DoubleDouble y2 = exact_product(y, y);
  const DoubleDouble square = fast_sum(x2.high, y2.high);
  const double root = std::sqrt(square.high);
  const DoubleDouble back = exact_product(root, root);
  const double rest = (square.high - back.high) - back.low + (square.low + (x2.low + y2.low));
  return (root + 0.5 * rest / root) * unit;
}

}  // namespace sim::math
