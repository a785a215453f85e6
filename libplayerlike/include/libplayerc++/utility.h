// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "libplayerc++/playerbase.h"

namespace PlayerCc {

/// Default port of clients: the port of the world's first robot.
const int PLAYER_PORTNUM = 6665;
/// Default host of clients: the simulation of this process.
const std::string PLAYER_HOSTNAME = "localhost";

// These functions are templates, so that overload resolution prefers a program's own non-template
// function of the same name and the call is not ambiguous.

/// Converts radians to degrees.
template <typename = void>
inline double rtod(double aVal) {
  return aVal * 180.0 / M_PI;
}

/// Converts degrees to radians.
template <typename = void>
inline double dtor(double aVal) {
  return aVal * M_PI / 180.0;
}

/// Normalizes an angle [rad] to [-pi, pi]. Returns NaN for an infinite angle or NaN.
template <typename = void>
inline double normalize(double aVal) {
  return std::remainder(aVal, 2.0 * M_PI);
}

// These are the standard functions, not new ones, so that min(a, b) is not ambiguous in a program
// with `using namespace` for both std and PlayerCc.
using std::max;
using std::min;

/// Clamps `value` to [min, max].
/// @pre min <= max; otherwise the result is one of the two.
template <typename T>
inline T limit(T value, T min, T max) {
  return value < min ? min : (max < value ? max : value);
}

}  // namespace PlayerCc
