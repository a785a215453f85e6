// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/devices/device.h"

namespace sim {

/// Settings of a collision sensor.
struct CollisionParams {
  double frequency_hz = 10.0;  ///< (0, 1000]
};

/// What a robot has touched since the reading before, this moment included.
struct CollisionReading final : Reading {
  bool collision = false;            ///< anything at all
  std::vector<std::string> objects;  ///< names of obstacles, dock separators and robots; "border"
                                     ///< and "wall" (of a map); sorted, each once
};

/// Bumpers all round the footprint. They are looked at in each step, so that a contact which begins
/// and ends between two readings is told in the second. Touching is what the physics calls so:
/// outlines closer than 2 mm.
class CollisionSensor final : public SensorOf<CollisionReading> {
 public:
  CollisionSensor(std::string name, const CollisionParams& params);

  void integrate(const StepContext& context) override;
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  std::vector<std::string> touched_;  ///< names, since the last reading; sorted, each once
};

}  // namespace sim
