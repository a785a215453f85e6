// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace playpen::grade {

/// A number with the given number of decimals, or with more if rounding would make it equal to a
/// limit that it differs from: 0.97996 is not "0.980" beside a limit of 0.98.
[[nodiscard]] std::string telling_number(double value, double limit, int decimals);

}  // namespace playpen::grade
