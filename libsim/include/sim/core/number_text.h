// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace sim {

/// The shortest text that reads back as the same number: "2", "0.98", "1e+22". With a point
/// whatever the locale, unlike printf; "inf", "-inf" and "nan" for what is not finite.
[[nodiscard]] std::string shortest_text(double value);
/// The same of a float, which needs fewer digits.
[[nodiscard]] std::string shortest_text(float value);

/// A number with so many digits after its point, whatever the locale: "0.980".
/// @param decimals  0..60.
[[nodiscard]] std::string fixed_text(double value, int decimals);

/// A number rounded to so many digits that count, without zeros at its end: "0.333333".
/// @param digits  1..60.
[[nodiscard]] std::string rounded_text(double value, int digits);

/// Returns the lowest `digits` hexadecimal digits of a number, in lower case, with leading zeros.
/// @param digits  0..16.
[[nodiscard]] std::string hexadecimal_text(std::uint64_t value, int digits);

}  // namespace sim
