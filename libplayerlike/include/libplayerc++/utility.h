// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "libplayerc++/playerbase.h"

namespace PlayerCc {

/// Port of a world's first robot, where clients look by default.
const int PLAYER_PORTNUM = 6665;
/// Host that clients look on by default: the simulation of this process.
const std::string PLAYER_HOSTNAME = "localhost";

// Templates without need: when a program has a plain function of the same name, the compiler
// prefers that one instead of calling the two ambiguous.

/// Radians to degrees.
template <typename = void>
inline double rtod(double aVal) {
  return aVal * 180.0 / M_PI;
}

/// Degrees to radians.
template <typename = void>
inline double dtor(double aVal) {
  return aVal * M_PI / 180.0;
}

/// The same direction as an angle [rad], in [-pi, pi]; not a number for an infinite angle or NaN.
template <typename = void>
inline double normalize(double aVal) {
  return std::remainder(aVal, 2.0 * M_PI);
}

// The standard's own, not functions beside them: with `using namespace` for std and for PlayerCc
// together, min(a, b) means one function.
using std::max;
using std::min;

/// The value nearest to `value` in [min, max].
/// @pre min <= max; otherwise the result is one of the two.
template <typename T>
inline T limit(T value, T min, T max) {
  return value < min ? min : (max < value ? max : value);
}

}  // namespace PlayerCc
