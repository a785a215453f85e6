// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/devices/device.h"
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
};

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

  [[nodiscard]] std::unique_ptr<Reading> clone() const override {
    return std::make_unique<RangerReading>(*this);
  }
};

/// The beams that stand for a transducer's cone: at most 0.25 degrees apart, the cone's middle and
/// both its sides among them; a single one for a cone of 0.
[[nodiscard]] scan::ScanGeometry cone_geometry(double field_of_view_rad, double range_max_m);

/// Infrared or sonar rangers: RangerParams says what they are, RangerReading what they tell.
///
/// A transducer reads the least range of the beams of its cone_geometry(): nothing is nearer that
/// it could see, so no echo of another direction comes first. Against the exact least distance
/// within the cone a wall reads at most 1e-5 of the range too far; a corner that lies between two
/// beams up to half a beam's distance to the next (0.0022 of the range) times the slope of its
/// sides, and a thing narrower than that may be missed.
class Ranger final : public Sensor {
 public:
  /// @param type           "infrared" or "sonar".
  /// @param may_be_inside  whether any transducer may ever stand inside a solid, see Laser.
  Ranger(std::string name, std::string type, const RangerParams& params, bool may_be_inside,
         RandomStream noise);

  [[nodiscard]] const RangerReading& reading() const noexcept override { return reading_; }
  [[nodiscard]] const RangerParams& params() const noexcept { return params_; }
  void hash(StateHash& hash) const override;

 protected:
  void measure(const StepContext& context) override;

 private:
  RangerParams params_;
  bool may_be_inside_;
  RandomStream noise_;
  scan::ScanKernel kernel_;
  scan::EdgeBuffer edges_;
  std::vector<double> beams_m_;  ///< scratch, one transducer's
  RangerReading reading_;
};

}  // namespace sim
