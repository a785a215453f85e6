// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/replay/columns.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace playerlike::replay {

std::size_t Columns::add(std::span<const std::int64_t> values, std::size_t lag) {
  constexpr std::int64_t kGreatest = std::int64_t{1} << 52;
  Entry entry{.offset = bytes_.size(), .count = values.size(), .lag = lag, .wide = false};
  const auto at = [&](std::size_t i) { return std::clamp(values[i], -kGreatest, kGreatest); };
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::int64_t value = at(i);
    entry.wide = entry.wide || value < std::numeric_limits<std::int32_t>::min() ||
                 value > std::numeric_limits<std::int32_t>::max();
    const std::int64_t difference = value - (i >= lag ? at(i - lag) : 0);
    auto code = (static_cast<std::uint64_t>(difference) << 1) ^
                static_cast<std::uint64_t>(difference >> 63);
    for (; code >= 0x80; code >>= 7) bytes_ += static_cast<char>(0x80 | (code & 0x7f));
    bytes_ += static_cast<char>(code);
  }
  entries_.push_back(entry);
  return entries_.size() - 1;
}

std::int64_t quantised(double value, double unit) {
  constexpr double kGreatest = 2147483647.0;
  const double number = std::round(value / unit);
  return std::abs(number) <= kGreatest ? static_cast<std::int64_t>(number) : kNoNumber;
}

}  // namespace playerlike::replay
