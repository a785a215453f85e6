// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/devices/device.h"

namespace sim {

/// Settings of a collision sensor.
struct CollisionParams {
  double frequency_hz = 10.0;  ///< [Hz]
};

/// What the robot has touched since the previous reading, including the current moment.
struct CollisionReading final : Reading {
  bool collision = false;            ///< whether it touched anything
  std::vector<std::string> objects;  ///< names of obstacles, dock separators and robots, "border"
                                     ///< and "wall" (of a map); sorted, without duplicates
};

/// Detects contacts all around the footprint. Checks in each step, so the second of two readings
/// also reports a contact that begins and ends between them. As in the physics, touching means that
/// the outlines are closer than 2 mm.
class CollisionSensor final : public SensorOf<CollisionReading> {
 public:
  CollisionSensor(std::string name, const CollisionParams& params);

  void integrate(const StepContext& context) override;
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  std::vector<std::string> touched_;  ///< names since the last reading; sorted, without duplicates
};

}  // namespace sim
