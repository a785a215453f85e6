// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <numbers>
#include <vector>

#include "sim/devices/device.h"
#include "sim/scan/scan_kernel.h"

namespace sim {

/// Settings of a scanning laser rangefinder; the defaults are the S1R's Hokuyo.
struct LaserParams {
  double frequency_hz = 10.0;  ///< (0, 1000]
  double noise_m = 0.0;        ///< standard deviation of a range [m], >= 0
  int beam_count = 682;        ///< 1..8192
  double resolution_rad = 0.39589 * std::numbers::pi / 180.0;  ///< between neighbouring beams
  double range_max_m = 5.0;                                    ///< (0, 1000] [m]
  Pose X_BL{0.035, 0.0, 0.0};                                  ///< mounting on the body
  double height_m = 0.125;      ///< above the floor [m]; lower obstacles are not seen
  Vec2 size_m{0.05, 0.05};      ///< of its case along L's axes, as clients are told, >= 0
  double size_height_m = 0.07;  ///< the same upwards, >= 0
};

/// One scan. Beam i looks at angle_min_rad + i * resolution_rad from L's x axis.
struct LaserReading final : Reading {
  std::vector<double> ranges_m;  ///< one a beam, in [0, range_max_m]; range_max_m: nothing met
  double angle_min_rad = 0.0;    ///< of beam 0, the rightmost
  double resolution_rad = 0.0;
  double range_max_m = 0.0;
  Pose X_WB;  ///< where the robot was (for pictures; not told to clients)

  /// The least of ranges_m; range_max_m before the first scan. Cost: one pass over the ranges.
  [[nodiscard]] double least_range_m() const;
  /// Angle of the (first of the) beams that have it; 0 before the first scan. Cost as above.
  [[nodiscard]] double least_angle_rad() const;
};

/// The Hokuyo-like laser scanner: LaserParams says what it is, LaserReading what it tells.
class Laser final : public SensorOf<LaserReading> {
 public:
  /// @param may_be_inside  whether the laser may ever stand inside a solid: not if it is mounted
  ///                       well within its robot's footprint, which saves a search a scan.
  Laser(std::string name, const LaserParams& params, bool may_be_inside, RandomStream noise);

  [[nodiscard]] const LaserParams& params() const noexcept { return params_; }
  void show(SimTime now_ns, RobotSnapshot& shot) const override;
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  LaserParams params_;
  bool may_be_inside_;
  RandomStream noise_;
  scan::ScanGeometry geometry_;
};

}  // namespace sim
