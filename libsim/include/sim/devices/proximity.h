// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/devices/device.h"

namespace sim {

/// Settings of a proximity sensor.
struct ProximityParams {
  double frequency_hz = 10.0;  ///< [Hz]
  double range_m = 1.0;        ///< detection range [m]
  bool obstacles = false;      ///< also report obstacles and dock separators
  std::string track;           ///< report only robots and obstacles with this tag; empty: all
};

/// Nearby objects.
struct ProximityReading final : Reading {
  /// An object within range.
  struct Neighbour {
    std::string name;         ///< of the robot, obstacle or dock separator
    double distance_m = 0.0;  ///< between the centres [m], in [0, range]

    friend bool operator==(const Neighbour&, const Neighbour&) = default;
  };
  std::vector<Neighbour> near_objects;  ///< sorted by name; if a robot and an obstacle have the
                                        ///< same name, the nearer one comes first
};

/// Reports nearby robots as if each carried a radio beacon: in all directions, through walls,
/// without errors. Distances are measured from the centre of the axle (origin of B) to that of the
/// other robot, or to the centre of an obstacle's box. A distance of exactly `range` counts as
/// near. Retracted obstacles and the robot itself are not reported.
class Proximity final : public SensorOf<ProximityReading> {
 public:
  Proximity(std::string name, const ProximityParams& params);

  std::optional<std::string> apply(const Command& command) override;
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  ProximityParams params_;
};

}  // namespace sim
