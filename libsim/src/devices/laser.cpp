// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/laser.h"

#include <algorithm>

#include "physics/physics_world.h"

namespace sim {

double LaserReading::least_range_m() const {
  if (ranges_m.empty()) return range_max_m;
  return *std::min_element(ranges_m.begin(), ranges_m.end());
}

double LaserReading::least_angle_rad() const {
  if (ranges_m.empty()) return 0.0;
  const auto least = std::min_element(ranges_m.begin(), ranges_m.end());
  return angle_min_rad + resolution_rad * static_cast<double>(least - ranges_m.begin());
}

Laser::Laser(std::string name, const LaserParams& params, bool may_be_inside, RandomStream noise)
    : Sensor(std::move(name), "laser", params.frequency_hz),
      params_(params),
      may_be_inside_(may_be_inside),
      noise_(std::move(noise)),
      geometry_{params.beam_count, params.resolution_rad, params.range_max_m} {
  reading_.ranges_m.assign(static_cast<std::size_t>(params.beam_count), 0.0);
  reading_.angle_min_rad = geometry_.angle_min_rad();
  reading_.resolution_rad = params.resolution_rad;
  reading_.range_max_m = params.range_max_m;
}

void Laser::measure(const StepContext& context) {
  stamp(context, reading_);
  const Pose X_WL = context.body.X_WB * params_.X_BL;
  context.physics.scan(geometry_, X_WL, params_.height_m, context.robot, may_be_inside_,
                       reading_.ranges_m);
  if (params_.noise_m > 0.0) {
    for (double& range : reading_.ranges_m) {
      // A beam that met nothing stays at the limit: there is no echo to be uncertain about.
      if (range >= params_.range_max_m) continue;
      range = std::clamp(range + noise_.gaussian(params_.noise_m), 0.0, params_.range_max_m);
    }
  }
  reading_.X_WB = context.body.X_WB;
}

void Laser::hash(StateHash& hash) const {
  Sensor::hash(hash);
  hash.add(noise_.draws());
  hash.add_bytes(reading_.ranges_m.data(), reading_.ranges_m.size() * sizeof(double));
}

}  // namespace sim
