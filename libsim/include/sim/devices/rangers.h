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

/// Settings that infrared and sonar rangers share: a few transducers, each mounted on its own.
struct RangerParams {
  double frequency_hz = 10.0;      ///< (0, 1000]
  double noise_m = 0.0;            ///< standard deviation of a range [m], >= 0
  double range_max_m = 1.0;        ///< (0, 1000] [m]
  double height_m = 0.05;          ///< above the floor [m]; lower obstacles are not seen
  double field_of_view_rad = 0.0;  ///< full angle of a transducer's cone, [0, pi]; 0: a single ray
  std::vector<Pose> X_BS;          ///< mountings of the transducers on the body, 1 to 64

  /// The most transducers that a ranger may have.
  static constexpr int kMaxTransducers = 64;
};

/// Infrared rangers; by default a ring of eight single rays round an S1R, to 0.8 m.
struct InfraredParams : RangerParams {
  InfraredParams();

  double voltage_gain_vm = 0.336;  ///< see infrared_voltage_v(), > 0 [V m]
  double voltage_shift_m = 0.04;   ///< > 0 [m]
};

/// Voltage that an infrared ranger puts out at a range: gain / (range + shift).
///
/// Such sensors see the spot of their own light by triangulation, so the output goes with the
/// inverse of the distance; Sharp's data sheet of the GP2D12 (OP13008EN) plots it over
/// 1 / (L + k). The defaults go through its typical values: 0.4 V at 80 cm, and 2.0 V more at
/// 10 cm. Unlike the real one, which falls again below 10 cm, it rises all the way to 0.
/// @param gain_vm, shift_m  as set, see InfraredParams.
/// @return [V]
[[nodiscard]] double infrared_voltage_v(double range_m, double gain_vm, double shift_m);

/// A sonar array; by default three cones of 30 degrees at an S1R's front, to 3 m.
struct SonarParams : RangerParams {
  SonarParams();
};

/// One round of all transducers. Their directions are the x axes of the frames X_BS.
struct RangerReading final : Reading {
  std::vector<double> ranges_m;    ///< one a transducer, in [0, range_max_m]; range_max_m: nothing
                                   ///< met
  std::vector<Pose> X_BS;          ///< where each sits on the body, as many
  double range_max_m = 0.0;        ///< as set
  double field_of_view_rad = 0.0;  ///< full angle of each cone; 0: single rays
  Pose X_WB;                       ///< where the robot was (for pictures; not told to clients)
};

/// Infrared or sonar rangers: RangerParams says what they are, RangerReading what they tell.
///
/// A transducer reads scan::least_range_in_cone_m(): the distance of the nearest point in its cone,
/// from where the first echo comes, or what its ray meets first. Edges are in single precision
/// about the robot, so the error is below 1e-7 of the greatest range. What is near the robot is
/// collected once for all transducers.
class Ranger final : public SensorOf<RangerReading> {
 public:
  /// @param type           "infrared" or "sonar".
  /// @param may_be_inside  whether any transducer may ever stand inside a solid, see Laser.
  Ranger(std::string name, std::string type, const RangerParams& params, bool may_be_inside,
         RandomStream noise);

  [[nodiscard]] const RangerParams& params() const noexcept { return params_; }
  void show(SimTime now_ns, RobotSnapshot& shot) const override;
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  /// Where the next shell begins [m].
  static constexpr std::array<double, 3> kShellLimits_m = {0.5, 1.0, 2.0};

  /// Of all edges in the shells, at most the range of the settings.
  [[nodiscard]] double least_range_m(const scan::Cone& cone);

  RangerParams params_;
  bool may_be_inside_;
  RandomStream noise_;
  double reach_m_ = 0.0;  ///< of the farthest transducer from the middle of the axle
  scan::EdgeBuffer edges_;
  /// Scratch: those that any transducer may see, in shells round the robot: an echo from a nearer
  /// one mostly makes it needless to look at the others.
  std::array<scan::EdgeColumns, kShellLimits_m.size() + 1> shells_;
};

}  // namespace sim
