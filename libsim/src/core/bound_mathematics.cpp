// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// When Playpen's library is loaded, calls of the C library's elementary functions by the program
// and by the libraries that it has loaded go to those of sim/core/math.h. So a program's own
// computations, and those of Box2D, have the same bits on every machine. See docs/trust.md.
#include "core/loaded_files.h"

#ifdef PLAYPEN_LOADED_FILES

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>

#include "sim/core/math.h"

namespace sim {
namespace {

// A double has more than twice the bits of a float: the second rounding changes next to no value.
template <double (*kFunction)(double) noexcept>
float in_float(float x) noexcept {
  return static_cast<float>(kFunction(static_cast<double>(x)));
}
template <double (*kFunction)(double, double) noexcept>
float in_float(float x, float y) noexcept {
  return static_cast<float>(kFunction(static_cast<double>(x), static_cast<double>(y)));
}

void sine_and_cosine(double angle_rad, double* sine, double* cosine) noexcept {
  const math::SinCos both = math::sin_cos(angle_rad);
  *sine = both.sin;
  *cosine = both.cos;
}
void sine_and_cosine(float angle_rad, float* sine, float* cosine) noexcept {
  const math::SinCos both = math::sin_cos(static_cast<double>(angle_rad));
  *sine = static_cast<float>(both.sin);
  *cosine = static_cast<float>(both.cos);
}

using One = double (*)(double) noexcept;
using Two = double (*)(double, double) noexcept;
using OneFloat = float (*)(float) noexcept;
using TwoFloats = float (*)(float, float) noexcept;

template <One kFunction>
void add(std::map<std::string_view, Address>& functions, std::string_view name,
         std::string_view float_name) {
  functions[name] = reinterpret_cast<Address>(kFunction);
  functions[float_name] = reinterpret_cast<Address>(OneFloat{in_float<kFunction>});
}
template <Two kFunction>
void add(std::map<std::string_view, Address>& functions, std::string_view name,
         std::string_view float_name) {
  functions[name] = reinterpret_cast<Address>(kFunction);
  functions[float_name] = reinterpret_cast<Address>(TwoFloats{in_float<kFunction>});
}

/// Addresses of our functions by the C library's names.
std::map<std::string_view, Address> mathematics() {
  std::map<std::string_view, Address> functions;
  add<math::sin>(functions, "sin", "sinf");
  add<math::cos>(functions, "cos", "cosf");
  add<math::tan>(functions, "tan", "tanf");
  add<math::asin>(functions, "asin", "asinf");
  add<math::acos>(functions, "acos", "acosf");
  add<math::atan>(functions, "atan", "atanf");
  add<math::atan2>(functions, "atan2", "atan2f");
  add<math::hypot>(functions, "hypot", "hypotf");
  add<math::cbrt>(functions, "cbrt", "cbrtf");
  add<math::exp>(functions, "exp", "expf");
  add<math::expm1>(functions, "expm1", "expm1f");
  add<math::log>(functions, "log", "logf");
  add<math::log2>(functions, "log2", "log2f");
  add<math::log10>(functions, "log10", "log10f");
  add<math::pow>(functions, "pow", "powf");
  functions["sincos"] = reinterpret_cast<Address>(
      static_cast<void (*)(double, double*, double*) noexcept>(sine_and_cosine));
  functions["sincosf"] = reinterpret_cast<Address>(
      static_cast<void (*)(float, float*, float*) noexcept>(sine_and_cosine));
  return functions;
}

bool is_bound = false;

// After the constructor that keeps a program's functions out of the libraries.
__attribute__((constructor(102))) void bind_mathematics() {
  is_bound = true;
  const std::map<std::string_view, Address> functions = mathematics();
  for (const LoadedFile& file : loaded_files()) {
    if (std::find(file.needed.begin(), file.needed.end(), "libm.so.6") == file.needed.end())
      continue;
    file.redirect([&functions](std::string_view name) -> std::optional<Address> {
      if (name.size() > 7) return std::nullopt;
      const auto function = functions.find(name);
      if (function == functions.end()) return std::nullopt;
      return function->second;
    });
  }
}

}  // namespace

bool math::bound() noexcept { return is_bound; }

}  // namespace sim

#else

#include "sim/core/math.h"

bool sim::math::bound() noexcept { return false; }

#endif
