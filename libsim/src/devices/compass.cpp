// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/compass.h"

#include <utility>

#include "devices/device_kind.h"

namespace sim {

double compass_heading_rad(const Pose& X_WB, double north_rad) {
  return normalize_angle(X_WB.yaw_rad - north_rad);
}

Compass::Compass(std::string name, const CompassParams& params, RandomStream noise)
    : SensorOf(std::move(name), "compass", params.frequency_hz, params.latency_s),
      params_(params),
      noise_(std::move(noise)) {}

void Compass::measure(const StepContext& context) {
  next(context).heading_rad =
      normalize_angle(compass_heading_rad(context.body.X_WB, params_.north_rad) +
                      noise_.gaussian(params_.noise_rad));
}

void Compass::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(noise_);
}

constexpr Field kCompassSettings[] = {
    frequency_field<&CompassParams::frequency_hz>(),
    field<&CompassParams::noise_rad>("noise_deg", "degrees", "standard deviation of the heading")
        .within(0.0, 180.0)
        .with_realism(0.0, 1.0),
    north_field<&CompassParams::north_rad>(),
    latency_field<&CompassParams::latency_s>(),
};
SIM_FIELDS(CompassParams, kCompassSettings)

constexpr Field kCompassReading[] = {
    field<&CompassReading::heading_rad>("heading", "rad", "from magnetic north, counter-clockwise"),
};
SIM_FIELDS(CompassReading, kCompassReading)

DeviceKind compass_kind() {
  return device_kind<Compass, CompassParams, CompassReading>("compass", {{"imu", 1}});
}

}  // namespace sim
