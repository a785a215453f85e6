// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstring>
#include <deque>
#include <vector>

/// What the expressions of faults.ini use.
namespace planted {

/// Name of the fault that the program has.
inline const char* fault = "none";

inline bool has(const char* name) { return std::strcmp(fault, name) == 0; }

/// A value as it was so many calls ago.
template <typename Value>
Value delayed(const Value& value, std::size_t calls) {
  static std::deque<Value> values;
  values.push_back(value);
  if (values.size() > calls + 1) values.pop_front();
  return values.front();
}

/// Whether the robot leaves a pillar: for 2 s after it has turned by 1.5 rounds to one side.
/// @param turn_radps  its turn rate, once in each scan [rad/s].
inline bool leaves_pillar(double turn_radps) {
  constexpr double kScan_s = 0.1;
  constexpr double kRounds_rad = 9.4;
  static double turned_rad = 0.0;
  static int scans = 0;
  // Turns to the other side let it forget.
  turned_rad = turned_rad * turn_radps < 0.0 ? 0.98 * turned_rad : turned_rad;
  turned_rad += turn_radps * kScan_s;
  if (turned_rad > kRounds_rad || turned_rad < -kRounds_rad) {
    turned_rad = 0.0;
    scans = 20;
  }
  return scans > 0 && scans-- > 0;
}

/// Counts in one of so many sectors. @return the value, so that it can be used in an expression.
inline double counted(double value, double first, double width, std::size_t sectors) {
  static std::vector<unsigned> counts;
  counts.resize(sectors);
  ++counts.at(static_cast<std::size_t>(static_cast<int>((value - first) / width)));
  return value;
}

}  // namespace planted
