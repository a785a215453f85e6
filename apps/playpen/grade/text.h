// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace playpen::grade {

/// A number with so many decimals, with a point whatever the locale.
[[nodiscard]] std::string fixed(double value, int decimals);

/// The shortest text that means the same number: 2, 0.98.
[[nodiscard]] std::string short_number(double value);

/// A number with so many decimals, or more if with these it could not be told from a limit that it
/// differs from: 0.97996 is not "0.980" beside a limit of 0.98.
[[nodiscard]] std::string telling_number(double value, double limit, int decimals);

}  // namespace playpen::grade
