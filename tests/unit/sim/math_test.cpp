// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "nightly.h"
#include "sim/core/hash.h"
#include "sim/core/random_stream.h"

namespace sim::math {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Arguments of a function.
using Arguments = std::function<double(RandomStream&)>;

Arguments between(double least, double most) {
  return [=](RandomStream& random) { return least + (most - least) * random.uniform(); };
}

/// Any finite number, of all sizes with equal shares.
double any(RandomStream& random) {
  const double mantissa = 1.0 + random.uniform();
  const int exponent = static_cast<int>(2046.0 * random.uniform()) - 1023;
  return std::ldexp(random.uniform() < 0.5 ? mantissa : -mantissa, exponent);
}

double any_positive(RandomStream& random) { return std::abs(any(random)); }

/// Close to multiples of a quarter turn, where the reduction cancels.
double near_quarter_turns(RandomStream& random) {
  const double quarters = std::floor(40.0 * random.uniform()) - 20.0;
  const int exponent = -static_cast<int>(54.0 * random.uniform());
  const double off = std::ldexp(random.uniform() - 0.5, exponent);
  return quarters * 0.5 * std::numbers::pi * (1.0 + off);
}

double small(RandomStream& random) {
  const int exponent = -static_cast<int>(40.0 * random.uniform());
  return std::ldexp(random.uniform() - 0.5, exponent);
}

/// Error of a value against one in a longer format, in units in the last place of a double.
double error_ulp(double value, long double reference) {
  const auto rounded = static_cast<double>(reference);
  if (std::isnan(value) || std::isnan(rounded)) {
    return std::isnan(value) && std::isnan(rounded) ? 0.0 : kInfinity;
  }
  if (std::isinf(value) || std::isinf(rounded)) return value == rounded ? 0.0 : kInfinity;
  int exponent = 0;
  std::frexp(rounded, &exponent);
  exponent = std::max(exponent, -1021);  // subnormal numbers have equal steps
  return std::abs(static_cast<double>(std::ldexp(value - reference, 53 - exponent)));
}

struct OneArgument {
  const char* name;
  double (*function)(double) noexcept;
  long double (*reference)(long double);
  double error_ulp;  ///< as math.h states
  std::vector<Arguments> arguments;
};

/// The functions of one argument, where they are interesting.
std::vector<OneArgument> functions() {
  const std::vector<Arguments> angles{between(-4.0, 4.0), between(-26.0, 26.0), any,
                                      near_quarter_turns};
  const std::vector<Arguments> shares{between(-1.0, 1.0), small};
  const std::vector<Arguments> positive{between(0.0, 3.0), any_positive};
  return {{"sin", &sin, std::sin, 1.0, angles},
          {"cos", &cos, std::cos, 1.0, angles},
          {"tan", &tan, std::tan, 2.5, angles},
          {"atan", &atan, std::atan, 1.0, {between(-4.0, 4.0), any}},
          {"asin", &asin, std::asin, 2.0, shares},
          {"acos", &acos, std::acos, 2.0, shares},
          {"exp", &exp, std::exp, 1.0, {between(-750.0, 712.0), between(-4.0, 4.0), small}},
          {"expm1", &expm1, std::expm1, 2.0, {between(-60.0, 60.0), between(-1.0, 1.0), small}},
          {"log", &log, std::log, 1.0, positive},
          {"log2", &log2, std::log2, 1.0, positive},
          {"log10", &log10, std::log10, 1.0, positive},
          {"cbrt", &cbrt, std::cbrt, 1.0, {between(-4.0, 4.0), any}}};
}

struct TwoArguments {
  const char* name;
  double (*function)(double, double) noexcept;
  long double (*reference)(long double, long double);
  double error_ulp;
  std::vector<std::array<Arguments, 2>> arguments;
};

std::vector<TwoArguments> functions_of_two() {
  return {
      {"atan2", &atan2, std::atan2, 1.0, {{between(-4.0, 4.0), between(-4.0, 4.0)}, {any, any}}},
      {"hypot", &hypot, std::hypot, 1.0, {{between(-4.0, 4.0), between(-4.0, 4.0)}, {any, any}}},
      {"pow",
       &pow,
       std::pow,
       1.0,
       {{between(0.0, 3.0), between(-20.0, 20.0)},
        {any_positive, between(-1.1, 1.1)},
        {between(0.9, 1.1), between(-6e3, 6e3)}}}};
}

int samples() { return test_support::cases(5'000, 1'000'000); }

TEST(MathTest, Errors_AsStated) {
  RandomStream random(1, "arguments");
  for (const OneArgument& f : functions()) {
    double worst_ulp = 0.0;
    double at = 0.0;
    for (const Arguments& arguments : f.arguments) {
      for (int i = 0; i < samples(); ++i) {
        const double x = arguments(random);
        const double error = error_ulp(f.function(x), f.reference(x));
        if (error > worst_ulp) at = x;
        worst_ulp = std::max(worst_ulp, error);
      }
    }
    EXPECT_LE(worst_ulp, f.error_ulp) << f.name << " at " << at;
    RecordProperty(std::string(f.name) + "_ulp",
                   std::to_string(std::lround(1000.0 * worst_ulp)) + "e-3");
  }
  for (const TwoArguments& f : functions_of_two()) {
    double worst_ulp = 0.0;
    for (const auto& [first, second] : f.arguments) {
      for (int i = 0; i < samples(); ++i) {
        const double x = first(random);
        const double y = second(random);
        worst_ulp = std::max(worst_ulp, error_ulp(f.function(x, y), f.reference(x, y)));
      }
    }
    EXPECT_LE(worst_ulp, f.error_ulp) << f.name;
    RecordProperty(std::string(f.name) + "_ulp",
                   std::to_string(std::lround(1000.0 * worst_ulp)) + "e-3");
  }
}

TEST(MathTest, SinCos_SameAsSinAndCos) {
  RandomStream random(1, "angles");
  for (int i = 0; i < 1000; ++i) {
    for (const double x : {between(-7.0, 7.0)(random), any(random)}) {
      const SinCos both = sin_cos(x);
      EXPECT_EQ(both.sin, sin(x)) << x;
      EXPECT_EQ(both.cos, cos(x)) << x;
    }
  }
}

// The double that is nearest to a multiple of pi/2 (V. Lefevre and J.-M. Muller, "Worst cases for
// correct rounding of the elementary functions in double precision", ARITH 15, 2001).
TEST(MathTest, ClosestToQuarterTurn_Accurate) {
  EXPECT_LE(error_ulp(cos(0x1.6ac5b262ca1ffp+849), -4.687165924254627611e-19L), 1.0);
}

bool same(double value, double expected) {
  if (std::isnan(value) || std::isnan(expected)) return std::isnan(value) && std::isnan(expected);
  if (expected == 0.0 || std::isinf(expected)) {
    return value == expected && std::signbit(value) == std::signbit(expected);
  }
  return std::abs(value - expected) <= 4e-16 * std::abs(expected);
}

TEST(MathTest, SpecialArguments_AsInTheStandard) {
  const std::array<double, 23> special{0.0,           -0.0,    1.0,       -1.0,       0.5,   -0.5,
                                       2.0,           -2.0,    3.0,       -3.0,       1e308, -1e308,
                                       5e-324,        -5e-324, kInfinity, -kInfinity, kNan,  0x1p53,
                                       -0x1p52 - 1.0, 1e-300,  710.0,     -746.0,     1e5};
  for (const double x : special) {
    for (const OneArgument& f : functions()) {
      const auto expected = static_cast<double>(f.reference(x));
      EXPECT_TRUE(same(f.function(x), expected))
          << f.name << "(" << x << ") is " << f.function(x) << ", not " << expected;
    }
    for (const double y : special) {
      for (const TwoArguments& f : functions_of_two()) {
        const auto expected = static_cast<double>(f.reference(x, y));
        EXPECT_TRUE(same(f.function(x, y), expected)) << f.name << "(" << x << ", " << y << ") is "
                                                      << f.function(x, y) << ", not " << expected;
      }
    }
  }
}

// Through the dynamic linker, as a program calls them.
TEST(MathTest, CallsOfTheCLibrary_ComeHere) {
  if (!bound()) GTEST_SKIP() << "not on this system";
  double (*volatile const c_sin)(double) = &::sin;
  float (*volatile const c_cosf)(float) = &::cosf;
  double (*volatile const c_pow)(double, double) = &::pow;
  RandomStream random(1, "calls");
  for (int i = 0; i < 10'000; ++i) {
    const double x = 10.0 * random.uniform();
    ASSERT_EQ(c_sin(x), sin(x)) << x;
    ASSERT_EQ(c_cosf(static_cast<float>(x)), static_cast<float>(cos(static_cast<float>(x)))) << x;
    ASSERT_EQ(c_pow(x, 1.7), pow(x, 1.7)) << x;
  }
}

// The same in every build and on every machine; if a formula changes, so does this number, and
// results with it: say so in the changelog.
TEST(MathTest, Bits_SameEverywhere) {
  StateHash hash;
  RandomStream random(1, "bits");
  for (int i = 0; i < 2000; ++i) {
    for (const OneArgument& f : functions()) {
      for (const Arguments& arguments : f.arguments) {
        hash.add(f.function(arguments(random)));
      }
    }
    for (const TwoArguments& f : functions_of_two()) {
      for (const auto& [first, second] : f.arguments) {
        const double x = first(random);
        hash.add(f.function(x, second(random)));
      }
    }
  }
  EXPECT_EQ(hash.value(), 0xa2bfde83ba7b71f6ULL);
}

}  // namespace
}  // namespace sim::math
