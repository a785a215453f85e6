// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/rangers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "physics/physics_world.h"
#include "sim/core/assert.h"

namespace sim {
namespace {

constexpr double kDegrees = std::numbers::pi / 180.0;
constexpr double kConeResolution_rad = 0.25 * kDegrees;

}  // namespace

// Mountings are 6 mm and more within the S1R's shell, which no solid reaches: then there is no need
// to ask whether they are inside one.
InfraredParams::InfraredParams() {
  range_max_m = 0.8;
  height_m = 0.05;
  X_BS = {{0.081, 0.0, 0.0},
          {0.061, 0.061, 45.0 * kDegrees},
          {0.0, 0.075, 90.0 * kDegrees},
          {-0.061, 0.061, 135.0 * kDegrees},
          {-0.081, 0.0, 180.0 * kDegrees},
          {-0.061, -0.061, -135.0 * kDegrees},
          {0.0, -0.075, -90.0 * kDegrees},
          {0.061, -0.061, -45.0 * kDegrees}};
}

SonarParams::SonarParams() {
  range_max_m = 3.0;
  height_m = 0.1;
  field_of_view_rad = 30.0 * kDegrees;
  X_BS = {{0.061, 0.061, 45.0 * kDegrees}, {0.081, 0.0, 0.0}, {0.061, -0.061, -45.0 * kDegrees}};
}

scan::ScanGeometry cone_geometry(double field_of_view_rad, double range_max_m) {
  // A little less, so that rounding does not add a beam.
  const int half =
      static_cast<int>(std::ceil(0.5 * field_of_view_rad / kConeResolution_rad - 1e-9));
  if (half == 0) return {1, kConeResolution_rad, range_max_m};
  return {2 * half + 1, 0.5 * field_of_view_rad / half, range_max_m};
}

Ranger::Ranger(std::string name, std::string type, const RangerParams& params, bool may_be_inside,
               RandomStream noise)
    : Sensor(std::move(name), std::move(type), params.frequency_hz),
      params_(params),
      may_be_inside_(may_be_inside),
      noise_(std::move(noise)),
      kernel_(cone_geometry(params.field_of_view_rad, params.range_max_m)) {
  SIM_ASSERT(!params.X_BS.empty());
  beams_m_.assign(static_cast<std::size_t>(kernel_.geometry().beam_count), 0.0);
  reading_.ranges_m.assign(params.X_BS.size(), 0.0);
  reading_.X_BS = params.X_BS;
  reading_.range_max_m = params.range_max_m;
  reading_.field_of_view_rad = params.field_of_view_rad;
}

void Ranger::measure(const StepContext& context) {
  stamp(context, reading_);
  for (std::size_t i = 0; i < params_.X_BS.size(); ++i) {
    const Pose X_WS = context.body.X_WB * params_.X_BS[i];
    context.physics.collect_edges(X_WS.position(), params_.range_max_m, params_.height_m,
                                  context.robot, may_be_inside_, edges_);
    kernel_.scan(edges_, X_WS.yaw_rad, beams_m_);
    double range_m = *std::min_element(beams_m_.begin(), beams_m_.end());
    // As with the laser: without an echo there is nothing to be uncertain about.
    if (params_.noise_m > 0.0 && range_m < params_.range_max_m) {
      range_m = std::clamp(range_m + noise_.gaussian(params_.noise_m), 0.0, params_.range_max_m);
    }
    reading_.ranges_m[i] = range_m;
  }
}

void Ranger::hash(StateHash& hash) const {
  Sensor::hash(hash);
  hash.add(noise_.draws());
  hash.add_bytes(reading_.ranges_m.data(), reading_.ranges_m.size() * sizeof(double));
}

}  // namespace sim
