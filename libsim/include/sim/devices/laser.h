// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include "sim/devices/device.h"
#include "sim/scan/scan_kernel.h"

namespace sim {

/// Settings of a scanning laser rangefinder; the defaults are the S1R's Hokuyo.
struct LaserParams {
  double frequency_hz = 10.0;  ///< [Hz]
  double noise_m = 0.0;        ///< standard deviation of a range [m]
  double noise_share = 0.0;    ///< standard deviation of a range r is max(noise_m, share * r)
  double mixed_pixels = 0.0;   ///< probability of a mixed pixel at a depth edge
  double dropouts = 0.0;       ///< probability that a range is lost and reads range_max
  double latency_s = 0.0;      ///< from a measurement until its reading [s]
  int beam_count = 682;        ///< number of beams
  double resolution_rad = 0.39589 * std::numbers::pi / 180.0;  ///< angle between neighbouring beams
  double range_max_m = 5.0;                                    ///< [m]
  Pose X_BL{0.035, 0.0, 0.0};                                  ///< mounting on the body
  double height_m = 0.125;      ///< of its case along L's axes, for clients
  Vec2 size_m{0.05, 0.05};      ///< of its case along L's axes, for clients
  double size_height_m = 0.07;  ///< height of its case, for clients
  double range_min_m = 0.0;     ///< least range, for clients; ranges are not changed
  double intensity = 0.0;       ///< of each echo, for clients; 0: none is measured
};

/// One scan. Beam i has the angle angle_min_rad + i * resolution_rad from L's x axis.
struct LaserReading final : Reading {
  std::vector<double> ranges_m;  ///< one per beam, in [0, range_max_m]; range_max_m: nothing met
  double angle_min_rad = 0.0;    ///< of beam 0, the rightmost
  double resolution_rad = 0.0;
  double range_max_m = 0.0;
  Pose X_WB;  ///< pose of the robot (for pictures; not sent to clients)
  /// Strength of each beam's echo, as a real laser states it; empty: not measured, as by all
  /// simulated lasers; see LaserParams::intensity.
  std::vector<double> intensities;

  /// The least of ranges_m; range_max_m before the first scan. O(beams).
  [[nodiscard]] double least_range_m() const;
  /// Angle of the first beam with the least range; 0 before the first scan. O(beams).
  [[nodiscard]] double least_angle_rad() const;
};

/// Standard deviation of a measured range: max(noise_m, share * range_m) [m].
///
/// Data sheets of the Hokuyo URG-04LX state the accuracy in this form: 10 mm up to 1 m, and 1 % of
/// the range beyond.
[[nodiscard]] inline double range_deviation_m(double range_m, double noise_m, double share) {
  const double in_proportion_m = share * range_m;
  return in_proportion_m > noise_m ? in_proportion_m : noise_m;
}

/// Whether there is a depth edge between two neighbouring beams: their ranges differ by more than
/// 20 mm and what a flat wall causes that the beams meet at up to 80 degrees from its normal.
/// @param step_rad  angle between the beams, > 0.
/// @return false if a beam meets nothing (range_max_m).
[[nodiscard]] bool is_depth_edge(double range_m, double next_m, double step_rad,
                                 double range_max_m);

/// A scanning laser rangefinder.
///
/// Errors, in this order: at each depth edge, with the probability mixed_pixels, one of its two
/// beams reads a range that is uniformly distributed between the two ranges, because its spot lies
/// on both surfaces (C. Ye and J. Borenstein, "Characterization of a 2-D laser scanner for mobile
/// robot obstacle negotiation", ICRA 2002); Gaussian noise of range_deviation_m(); lost
/// ranges. A beam that meets nothing has no noise.
class Laser final : public SensorOf<LaserReading> {
 public:
  /// @param may_be_inside  whether the laser can ever be inside a solid. False if it is mounted
  ///     well within its robot's footprint, which saves a search per scan.
  Laser(std::string name, const LaserParams& params, bool may_be_inside, RandomStream noise);

  [[nodiscard]] const LaserParams& params() const noexcept { return params_; }
  /// The scan without noise from the robot's present pose.
  [[nodiscard]] LaserReading ideal_scan(const StepContext& context) const;
  /// The same with other beams, see Simulation::ideal_scan().
  void ideal_scan(const StepContext& context, const scan::ScanGeometry& geometry,
                  scan::ScanWorkspace& workspace, std::span<float> ranges_m) const;
  /// Its own beams.
  [[nodiscard]] const scan::ScanGeometry& geometry() const noexcept { return geometry_; }
  void show(SimTime now_ns, RobotSnapshot& shot) const override;
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;
  void archive_reading(StateArchive& archive, LaserReading& reading) override;

 private:
  void mix_pixels(std::vector<double>& ranges_m);

  LaserParams params_;
  bool may_be_inside_;
  RandomStream noise_;
  scan::ScanGeometry geometry_;
};

}  // namespace sim
