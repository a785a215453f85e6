// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/core/pose.h"
#include "sim/core/random_stream.h"

namespace sim {

/// Noise of a motion measured by odometry, as variances: the robot turns, drives straight, and
/// turns again (Probabilistic Robotics, section 5.4).
struct OdometryNoise {
  double turn_from_turn = 0.05;    ///< alpha 1 [rad^2 per rad^2], >= 0
  double turn_from_drive = 0.05;   ///< alpha 2 [rad^2 per m^2], >= 0
  double drive_from_drive = 0.05;  ///< alpha 3 [m^2 per m^2], >= 0
  double drive_from_turn = 0.05;   ///< alpha 4 [m^2 per rad^2], >= 0
};

/// Draws possible true motions for a motion that odometry has measured: the algorithm
/// sample_motion_model_odometry of S. Thrun, W. Burgard, D. Fox, "Probabilistic Robotics" (2005),
/// table 5.6.
///
/// Unlike the book, a drive backwards counts as little turning, not as two half turns, and a motion
/// below 1 mm has no first turn, because its direction is arbitrary.
class OdometryMotion {
 public:
  /// @param X_AB  measured motion from pose A to pose B.
  OdometryMotion(const Pose& X_AB, const OdometryNoise& noise);

  /// A random motion, to be appended to a pose. Draws three normal deviates.
  [[nodiscard]] Pose sample(RandomStream& random) const;

 private:
  double turn1_rad_ = 0.0;
  double drive_m_ = 0.0;
  double turn2_rad_ = 0.0;
  double turn1_deviation_rad_ = 0.0;
  double drive_deviation_m_ = 0.0;
  double turn2_deviation_rad_ = 0.0;
};

}  // namespace sim
