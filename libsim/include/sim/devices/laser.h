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
  double resolution_rad = 0.39589 * std::numbers::pi / 180.0;  ///< angle between neighbouring beams
  double range_max_m = 5.0;                                    ///< (0, 1000] [m]
  Pose X_BL{0.035, 0.0, 0.0};                                  ///< mounting on the body
  double height_m = 0.125;      ///< of its case along L's axes, for clients, >= 0
  Vec2 size_m{0.05, 0.05};      ///< of its case along L's axes, for clients, >= 0
  double size_height_m = 0.07;  ///< height of its case, for clients, >= 0
};

/// One scan. Beam i has the angle angle_min_rad + i * resolution_rad from L's x axis.
struct LaserReading final : Reading {
  std::vector<double> ranges_m;  ///< one per beam, in [0, range_max_m]; range_max_m: nothing met
  double angle_min_rad = 0.0;    ///< of beam 0, the rightmost
  double resolution_rad = 0.0;
  double range_max_m = 0.0;
  Pose X_WB;  ///< pose of the robot (for pictures; not sent to clients)

  /// The least of ranges_m; range_max_m before the first scan. O(beams).
  [[nodiscard]] double least_range_m() const;
  /// Angle of the first beam with the least range; 0 before the first scan. O(beams).
  [[nodiscard]] double least_angle_rad() const;
};

/// A scanning laser rangefinder.
class Laser final : public SensorOf<LaserReading> {
 public:
  /// @param may_be_inside  whether the laser can ever be inside a solid. False if it is mounted
  ///     well within its robot's footprint, which saves a search per scan.
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
