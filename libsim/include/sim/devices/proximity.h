// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/devices/device.h"

namespace sim {

/// Settings of a proximity sensor.
struct ProximityParams {
  double frequency_hz = 10.0;  ///< (0, 1000]
  double range_m = 1.0;        ///< how far it sees [m], (0, 1000]
  bool obstacles = false;      ///< tells obstacles and dock separators, too, not robots alone
};

/// Who is near.
struct ProximityReading final : Reading {
  /// Somebody within range.
  struct Neighbour {
    std::string name;         ///< of the robot, obstacle or dock separator
    double distance_m = 0.0;  ///< from middle to middle [m], in [0, range]

    friend bool operator==(const Neighbour&, const Neighbour&) = default;
  };
  std::vector<Neighbour> near_objects;  ///< in order of name; should a robot and an obstacle have
                                        ///< one name, the nearer one comes first
};

/// Tells which robots are near, as if each carried a radio beacon: all round, through walls, true.
/// Distances go from the middle of the axle (origin of B) to that of the other robot, or to the
/// middle of an obstacle's box; exactly `range` is near. Retracted obstacles are not there, nor is
/// the robot itself.
class Proximity final : public SensorOf<ProximityReading> {
 public:
  Proximity(std::string name, const ProximityParams& params);

 protected:
  void measure(const StepContext& context) override;

 private:
  ProximityParams params_;
};

}  // namespace sim
