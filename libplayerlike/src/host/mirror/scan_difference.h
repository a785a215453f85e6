// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sim/core/pose.h"
#include "sim/devices/laser.h"

namespace playerlike {

/// How a real scan differs from the one that a world predicts for the same pose.
struct ScanDifference {
  /// A place where the two differ by more than kDifferentRange_m.
  struct Place {
    sim::Vec2 p_L = sim::Vec2::Zero();  ///< in the laser's frame [m]
    bool unexpected = false;  ///< true: something that the world lacks; false: something that only
                              ///< the world has
  };
  int beams = 0;              ///< number of compared beams
  double mean_m = 0.0;        ///< mean of the absolute differences of ranges [m]
  double share = 0.0;         ///< share of beams that differ by more than kDifferentRange_m
  std::vector<Place> places;  ///< by beam
};

/// Ranges that differ by more count as different [m]: several standard deviations of a scanner's
/// noise, and the effect of small errors of the pose.
inline constexpr double kDifferentRange_m = 0.1;

/// Compares each beam of a real scan with the beam of the predicted scan that has the nearest
/// angle. Beams outside of the predicted scan's field of view are not compared. Ranges beyond the
/// shorter of the two maximum ranges count as that maximum.
[[nodiscard]] ScanDifference compare_scans(const sim::LaserReading& real,
                                           const sim::LaserReading& predicted);

}  // namespace playerlike
