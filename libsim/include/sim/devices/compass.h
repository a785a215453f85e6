// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>
#include <string>

#include "sim/devices/device.h"

namespace sim {

/// Settings of a magnetic compass.
struct CompassParams {
  double frequency_hz = 10.0;                 ///< [Hz]
  double noise_rad = 0.0;                     ///< standard deviation of the heading [rad]
  double north_rad = 0.5 * std::numbers::pi;  ///< direction of magnetic north in W,
                                              ///< counter-clockwise from x [rad]
  double latency_s = 0.0;                     ///< from a measurement until its reading [s]
};

/// A compass reading.
struct CompassReading final : Reading {
  double heading_rad = 0.0;  ///< of B's x axis from magnetic north, counter-clockwise, (-pi, pi]
};

/// Noise-free heading of a robot relative to magnetic north.
///
/// Frames: W world; B body.
/// @param X_WB       pose of B in W [m, rad].
/// @param north_rad  direction of magnetic north in W, counter-clockwise from x [rad].
/// @return [rad], counter-clockwise, in (-pi, pi].
[[nodiscard]] double compass_heading_rad(const Pose& X_WB, double north_rad);

/// A compass: compass_heading_rad() plus Gaussian noise.
class Compass final : public SensorOf<CompassReading> {
 public:
  Compass(std::string name, const CompassParams& params, RandomStream noise);

  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  CompassParams params_;
  RandomStream noise_;
};

}  // namespace sim
