// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "sim/devices/noisy_sensor.h"

namespace sim {

/// Settings of a semantic camera.
struct SemanticCameraParams : SensorMount {
  double frequency_hz = 10.0;                         ///< [Hz]
  double field_of_view_rad = std::numbers::pi / 3.0;  ///< horizontal, full angle, (0, 2 pi]
  double range_m = 100.0;                             ///< farther objects are not seen [m]
  std::string tag = "Object";                         ///< objects with this tag are seen
  bool relative = false;                              ///< poses are in the camera's frame, not in W
  bool occlusion = true;                              ///< objects behind others are not seen
  double noise_m = 0.0;                               ///< standard deviation of each coordinate [m]
  double latency_s = 0.0;                             ///< [s]
};

/// What a semantic camera sees.
struct SemanticCameraReading final : Reading {
  /// A tagged object.
  struct Object {
    std::string name;
    std::string type;                    ///< the tag by which it was found
    std::array<double, 3> position_m{};  ///< of its middle [m]
    std::array<double, 3> vector{};      ///< of the quaternion of its orientation
    double scalar = 1.0;                 ///< of the quaternion
  };
  std::vector<Object> objects;  ///< in the order of the world: obstacles, then robots
};

/// Names tagged obstacles and robots whose middle lies in its field of view and is not hidden, with
/// their poses (MORSE's SemanticCamera). It looks along its x axis. Poses in its frame are in the
/// axes of pictures, as in MORSE: x to the right, y down, z along the view.
///
/// Occlusion is that of the plane at the camera's height.
class SemanticCamera final : public MountedSensor<SemanticCameraParams, SemanticCameraReading> {
 public:
  SemanticCamera(std::string name, const SemanticCameraParams& params, RandomStream noise)
      : MountedSensor(std::move(name), "semantic_camera", params, std::move(noise)) {}

 protected:
  void measure(const StepContext& context) override;
};

}  // namespace sim
