// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/laser.h"

#include <algorithm>
#include <cmath>

#include "devices/device_kind.h"
#include "physics/physics_world.h"
#include "sim/core/pose.h"
#include "sim/devices/robot_snapshot.h"

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

bool is_depth_edge(double range_m, double next_m, double step_rad, double range_max_m) {
  if (range_m >= range_max_m || next_m >= range_max_m) return false;
  constexpr double kLeast_m = 0.02;
  constexpr double kTanSteepest = 5.6713;  // tan 80 degrees
  const double by_wall_m = kTanSteepest * step_rad * std::min(range_m, next_m);
  return std::abs(range_m - next_m) > kLeast_m + by_wall_m;
}

Laser::Laser(std::string name, const LaserParams& params, bool may_be_inside, RandomStream noise)
    : SensorOf(std::move(name), "laser", params.frequency_hz, params.latency_s),
      params_(params),
      may_be_inside_(may_be_inside),
      noise_(std::move(noise)),
      geometry_{params.beam_count, params.resolution_rad, params.range_max_m} {
  auto& first = edit();
  first.ranges_m.assign(static_cast<std::size_t>(params.beam_count), 0.0);
  first.angle_min_rad = geometry_.angle_min_rad();
  first.resolution_rad = params.resolution_rad;
  first.range_max_m = params.range_max_m;
}

void Laser::measure(const StepContext& context) {
  auto& reading = next(context, Contents::kAnyEarlier);
  const Pose X_WL = context.body.X_WB * params_.X_BL;
  context.physics.scan(geometry_, X_WL, params_.height_m, context.robot, may_be_inside_,
                       reading.ranges_m);
  if (params_.mixed_pixels > 0.0) mix_pixels(reading.ranges_m);
  if (params_.noise_m > 0.0 || params_.noise_share > 0.0) {
    for (double& range : reading.ranges_m) {
      // A beam that met nothing stays at the maximum range: without an echo there is no noise.
      if (range >= params_.range_max_m) continue;
      const double sigma_m = range_deviation_m(range, params_.noise_m, params_.noise_share);
      range = std::clamp(range + noise_.gaussian(sigma_m), 0.0, params_.range_max_m);
    }
  }
  if (params_.dropouts > 0.0) {
    for (double& range : reading.ranges_m) {
      if (noise_.uniform() < params_.dropouts) range = params_.range_max_m;
    }
  }
  if (blind()) std::ranges::fill(reading.ranges_m, params_.range_max_m);
  reading.X_WB = context.body.X_WB;
}

LaserReading Laser::ideal_scan(const StepContext& context) const {
  LaserReading scan;
  scan.time_ns = context.now_ns;
  scan.ranges_m.assign(static_cast<std::size_t>(params_.beam_count), 0.0);
  scan.angle_min_rad = geometry_.angle_min_rad();
  scan.resolution_rad = params_.resolution_rad;
  scan.range_max_m = params_.range_max_m;
  scan.X_WB = context.body.X_WB;
  context.physics.scan(geometry_, scan.X_WB * params_.X_BL, params_.height_m, context.robot,
                       may_be_inside_, scan.ranges_m);
  return scan;
}

void Laser::ideal_scan(const StepContext& context, const scan::ScanGeometry& geometry,
                       scan::ScanWorkspace& workspace, std::span<float> ranges_m) const {
  context.physics.scan(workspace, geometry, context.body.X_WB * params_.X_BL, params_.height_m,
                       context.robot, may_be_inside_, ranges_m);
}

void Laser::mix_pixels(std::vector<double>& ranges_m) {
  // The edge is that of the true ranges, also if the beam before it was mixed.
  double before_m = ranges_m.front();
  for (std::size_t i = 1; i < ranges_m.size(); ++i) {
    const double here_m = ranges_m[i];
    if (is_depth_edge(before_m, here_m, params_.resolution_rad, params_.range_max_m) &&
        noise_.uniform() < params_.mixed_pixels) {
      const double mixed_m = before_m + noise_.uniform() * (here_m - before_m);
      ranges_m[noise_.uniform() < 0.5 ? i - 1 : i] = mixed_m;
    }
    before_m = here_m;
  }
}

void Laser::show(SimTime, RobotSnapshot& shot) const {
  const LaserReading& scan = reading();
  if (scan.sequence == 0 || !shot.scan_points.empty()) return;
  const Pose X_WL = scan.X_WB * params_.X_BL;
  shot.scan_origin = X_WL.position();
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const double angle = scan.angle_min_rad + scan.resolution_rad * static_cast<double>(beam);
    shot.scan_points.push_back(X_WL * (scan.ranges_m[beam] * unit_vector(angle)));
  }
}

void Laser::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(noise_);
}

void Laser::archive_reading(StateArchive& archive, LaserReading& reading) {
  SensorOf::archive_reading(archive, reading);
  archive(reading.X_WB);
  archive.expect(reading.ranges_m.size() == static_cast<std::size_t>(params_.beam_count),
                 "a range for each beam");
}

namespace {

std::optional<FieldError> check_laser_view(const void* object) {
  const auto& p = *static_cast<const LaserParams*>(object);
  const double field_of_view_rad = p.resolution_rad * (p.beam_count - 1);
  if (field_of_view_rad <= 2.0 * std::numbers::pi + 1e-9) return std::nullopt;
  return FieldError{"device/laser-field-of-view",
                    "beams that span at most 360 degrees together, (beams - 1) * resolution_deg",
                    rounded_text(field_of_view_rad / kDegrees, 6) + " degrees", ""};
}

}  // namespace

constexpr Field kLaserSettings[] = {
    frequency_field<&LaserParams::frequency_hz>("scans per simulated second"),
    // A third of the accuracy in the data sheet of the URG-04LX, see range_deviation_m().
    noise_field<&LaserParams::noise_m>("standard deviation of a range").with_realism(0.0, 0.0033),
    noise_share_field<&LaserParams::noise_share>(0.0033),
    field<&LaserParams::mixed_pixels>("mixed_pixels", "",
                                      "probability of a range between the two surfaces at an edge")
        .within(0.0, 1.0)
        .with_realism(0.0, 0.5)
        .unlisted(0.0),
    dropout_field<&LaserParams::dropouts>(0.005),
    latency_field<&LaserParams::latency_s>(),
    field<&LaserParams::beam_count>("beams", "", "number of beams").within(1, 8192),
    field<&LaserParams::resolution_rad>(
        "resolution_deg", "degrees",
        "angle between neighbouring beams; all beams together span at most 360")
        .within(1e-4, 360.0),
    range_max_field<&LaserParams::range_max_m>(
        "maximum range, and the reading of a beam that hits nothing"),
    mount_field<&LaserParams::X_BL>("mounting on the body, X_BL"),
    height_field<&LaserParams::height_m>("above the floor; lower obstacles are not seen"),
    field<&LaserParams::size_m>(
        "size", "m", "of its case along its own x and y, [0, 100] each; only for programs that ask")
        .within(0.0, 100.0),
    field<&LaserParams::size_height_m>("size_height", "m",
                                       "height of its case; only for programs that ask")
        .within(0.0, 100.0),
    range_min_field<&LaserParams::range_min_m>(),
    intensity_field<&LaserParams::intensity>(),
};
SIM_FIELDS(LaserParams, kLaserSettings, check_laser_view)

constexpr Field kLaserReading[] = {
    field<&LaserReading::ranges_m>("ranges", "m",
                                   "the rightmost beam first; `range_max`: nothing met"),
    field<&LaserReading::angle_min_rad>("angle_min", "rad",
                                        "direction of the first beam from the laser's x axis"),
    field<&LaserReading::resolution_rad>("resolution", "rad", "angle between beams"),
    field<&LaserReading::range_max_m>("range_max", "m", "limit of the ranges"),
};
SIM_FIELDS(LaserReading, kLaserReading)

DeviceKind laser_kind() {
  return device_kind<LaserParams, LaserReading>(
      "laser", {{"laser"}, {"ranger"}},
      [](const DeviceConstruction& construction, const LaserParams& params) {
        return std::make_unique<Laser>(construction.name(), params,
                                       !is_safely_inside(construction.model, params.X_BL),
                                       construction.noise());
      });
}

}  // namespace sim
