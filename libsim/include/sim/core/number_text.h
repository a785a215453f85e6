// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace sim {

/// The shortest text that reads back as the same number: "2", "0.98", "1e+22". The decimal
/// separator is always a point; unlike printf, the locale has no influence. Non-finite values give
/// "inf", "-inf" and "nan".
[[nodiscard]] std::string shortest_text(double value);
/// The shortest text that reads back as the same float; it needs fewer digits than a double.
[[nodiscard]] std::string shortest_text(float value);

/// A number with a fixed number of decimals, whatever the locale: "0.980".
/// @param decimals  digits after the point, 0..60.
[[nodiscard]] std::string fixed_text(double value, int decimals);

/// A number rounded to significant digits, without trailing zeros: "0.333333".
/// @param digits  significant digits, 1..60.
[[nodiscard]] std::string rounded_text(double value, int digits);

/// Returns the lowest `digits` hexadecimal digits of a number, in lower case, with leading zeros.
/// @param digits  0..16.
[[nodiscard]] std::string hexadecimal_text(std::uint64_t value, int digits);

}  // namespace sim
