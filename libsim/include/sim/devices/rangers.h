// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "sim/devices/device.h"
#include "sim/scan/cone.h"
#include "sim/scan/scan_kernel.h"

namespace sim {

/// Settings shared by infrared and sonar rangers: a few transducers, each with its own mounting.
struct RangerParams {
  double frequency_hz = 10.0;      ///< [Hz]
  double noise_m = 0.0;            ///< standard deviation of a range [m]
  double noise_share = 0.0;        ///< standard deviation of a range r is max(noise_m, share * r)
  double dropouts = 0.0;           ///< probability that a range is lost
  double latency_s = 0.0;          ///< [s]
  double range_max_m = 1.0;        ///< [m]
  double height_m = 0.05;          ///< above the floor [m]; lower obstacles are not seen
  double field_of_view_rad = 0.0;  ///< full angle of a transducer's cone, [0, pi]; 0: a single ray
  bool single_ray = false;         ///< measures along a single ray, and states the cone to clients
  std::vector<Pose> X_BS;          ///< mountings of the transducers on the body, at most 1024
  std::vector<double>
      ranges_max_m;               ///< of each transducer, at most range_max_m; empty: range_max_m
  std::vector<double> heights_m;  ///< of each transducer; empty: height_m
  double range_min_m = 0.0;       ///< least range, for clients; ranges are not changed
  double intensity = 0.0;         ///< of each echo, for clients; 0: none is measured
};

/// Infrared rangers; by default a ring of eight single rays around an S1R, with 0.8 m range.
struct InfraredParams : RangerParams {
  InfraredParams();

  double voltage_gain_vm = 0.336;  ///< see infrared_voltage_v() [V m]
  double voltage_shift_m = 0.04;   ///< [m]
};

/// Output voltage of an infrared ranger at a range: gain / (range + shift).
///
/// Such sensors measure the position of their own light spot by triangulation, so the output is
/// inversely related to the distance; Sharp's data sheet of the GP2D12 (OP13008EN) plots it over 1
/// / (L + k). The defaults match its typical values: 0.4 V at 80 cm, and 2.0 V more at 10 cm. The
/// output of a real sensor falls again below 10 cm; this model rises down to range 0.
/// @param gain_vm, shift_m  see InfraredParams.
/// @return [V]
[[nodiscard]] double infrared_voltage_v(double range_m, double gain_vm, double shift_m);

/// A sonar array; by default three cones of 30 degrees at an S1R's front, with 3 m range.
struct SonarParams : RangerParams {
  SonarParams();
};

/// One measurement of all transducers. Their directions are the x axes of the frames X_BS.
struct RangerReading final : Reading {
  std::vector<double> ranges_m;     ///< one per transducer, in [0, range_max_m]; range_max_m:
                                    ///< nothing met
  std::vector<Pose> X_BS;           ///< mountings of the transducers on the body
  double range_max_m = 0.0;         ///< from the settings
  double field_of_view_rad = 0.0;   ///< full angle of each cone; 0: single rays
  Pose X_WB;                        ///< pose of the robot (for pictures; not sent to clients)
  std::vector<double> intensities;  ///< of the echoes of real rangers; empty: not measured
  std::vector<double> voltages_v;   ///< of real infrared rangers; empty: as infrared_voltage_v()
};

/// Infrared or sonar rangers.
///
/// A transducer measures scan::least_range_in_cone_m(): the distance of the nearest point in its
/// cone, where the first echo comes from, or of the first point on its ray. Edges have single
/// precision relative to the robot, so the error is below 1e-7 of the maximum range. Nearby edges
/// are collected once for all transducers. Noise and lost ranges are those of the laser
/// (range_deviation_m(), LaserParams).
class Ranger final : public SensorOf<RangerReading> {
 public:
  /// @param type           "infrared" or "sonar".
  /// @param may_be_inside  whether any transducer can ever be inside a solid, see Laser.
  Ranger(std::string name, std::string type, const RangerParams& params, bool may_be_inside,
         RandomStream noise);

  [[nodiscard]] const RangerParams& params() const noexcept { return params_; }
  void show(SimTime now_ns, RobotSnapshot& shot) const override;
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;
  void archive_reading(StateArchive& archive, RangerReading& reading) override;

 private:
  /// Inner radius of each shell except the innermost [m].
  static constexpr std::array<double, 3> kShellLimits_m = {0.5, 1.0, 2.0};

  /// Collects the edges that transducers at a height may see.
  void look_around(const StepContext& context, double height_m);
  /// Least range over the edges of all shells, at most the given one.
  [[nodiscard]] double least_range_m(const scan::Cone& cone, double range_max_m);

  RangerParams params_;
  bool may_be_inside_;
  RandomStream noise_;
  double reach_m_ = 0.0;  ///< of the farthest transducer from the centre of the axle
  scan::EdgeBuffer edges_;
  /// Scratch: the edges that any transducer may see, in shells around the robot. An echo from an
  /// inner shell usually makes it unnecessary to test the outer ones.
  std::array<scan::EdgeColumns, kShellLimits_m.size() + 1> shells_;
};

}  // namespace sim
