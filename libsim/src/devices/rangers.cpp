// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/rangers.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "devices/device_kind.h"
#include "physics/physics_world.h"
#include "sim/core/assert.h"
#include "sim/core/degrees.h"
#include "sim/devices/laser.h"
#include "sim/devices/robot_snapshot.h"
#include "sim/world/outline.h"

namespace sim {
namespace {

// Square of the distance of an edge from the origin [m2]; nullopt if no point within reach_m of the
// origin sees the edge within range_m.
std::optional<double> distance2_if_seen(const scan::Edge& edge, double reach_m, double range_m) {
  const Vec2 a(static_cast<double>(edge.x0_m), static_cast<double>(edge.y0_m));
  const Vec2 b(static_cast<double>(edge.x1_m), static_cast<double>(edge.y1_m));
  const Vec2 along = b - a;
  const double behind = a.x() * along.y() - a.y() * along.x();
  if (behind > 0.0 && behind * behind > reach_m * reach_m * along.squaredNorm()) {
    return std::nullopt;
  }
  const double farthest_m = reach_m + range_m;
  const double distance2 = nearest_on_segment(Vec2::Zero(), a, b).squaredNorm();
  if (distance2 > farthest_m * farthest_m) return std::nullopt;
  return distance2;
}

}  // namespace

double infrared_voltage_v(double range_m, double gain_vm, double shift_m) {
  return gain_vm / (range_m + shift_m);
}

// The mountings are at least 6 mm inside the S1R's shell, where no solid reaches, so the test for
// being inside a solid is not needed.
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

Ranger::Ranger(std::string name, std::string type, const RangerParams& params, bool may_be_inside,
               RandomStream noise)
    : SensorOf(std::move(name), std::move(type), params.frequency_hz, params.latency_s),
      params_(params),
      may_be_inside_(may_be_inside),
      noise_(std::move(noise)) {
  SIM_ASSERT(!params.X_BS.empty());
  for (const Pose& X_BS : params.X_BS) reach_m_ = std::max(reach_m_, X_BS.position().norm());
  auto& first = edit();
  first.ranges_m.assign(params.X_BS.size(), 0.0);
  first.X_BS = params.X_BS;
  first.range_max_m = params.range_max_m;
  first.field_of_view_rad = params.field_of_view_rad;
}

void Ranger::measure(const StepContext& context) {
  auto& reading = next(context);
  const Pose& X_WB = context.body.X_WB;
  context.physics.collect_edges(X_WB.position(), params_.range_max_m + reach_m_, params_.height_m,
                                context.robot, false, edges_);
  reading.X_WB = X_WB;
  for (scan::EdgeColumns& shell : shells_) shell.clear();
  for (const scan::Edge& edge : edges_.edges()) {
    const auto distance2 = distance2_if_seen(edge, reach_m_, params_.range_max_m);
    if (!distance2) continue;
    const auto shell =
        std::count_if(kShellLimits_m.begin(), kShellLimits_m.end(),
                      [&](double limit_m) { return *distance2 >= limit_m * limit_m; });
    shells_[static_cast<std::size_t>(shell)].add(edge);
  }
  for (std::size_t i = 0; i < params_.X_BS.size(); ++i) {
    const Pose X_WS = X_WB * params_.X_BS[i];
    const Vec2 p_BS_W = X_WS.position() - X_WB.position();
    double range_m = 0.0;
    if (!may_be_inside_ ||
        !context.physics.is_inside_solid(X_WS.position(), params_.height_m, context.robot)) {
      range_m = least_range_m({p_BS_W.x(), p_BS_W.y(), X_WS.yaw_rad, params_.field_of_view_rad});
    }
    // As for the laser: without an echo there is no noise.
    const double sigma_m = range_deviation_m(range_m, params_.noise_m, params_.noise_share);
    if (sigma_m > 0.0 && range_m < params_.range_max_m) {
      range_m = std::clamp(range_m + noise_.gaussian(sigma_m), 0.0, params_.range_max_m);
    }
    if (params_.dropouts > 0.0 && noise_.uniform() < params_.dropouts) {
      range_m = params_.range_max_m;
    }
    reading.ranges_m[i] = range_m;
  }
}

double Ranger::least_range_m(const scan::Cone& cone) {
  // Far above rounding errors.
  constexpr double kSlack_m = 1e-6;
  double least_m = params_.range_max_m;
  for (std::size_t i = 0; i < shells_.size(); ++i) {
    if (i > 0 && least_m < kShellLimits_m[i - 1] - reach_m_ - kSlack_m) break;
    if (shells_[i].size() > 0) least_m = shells_[i].least_range_in_cone_m(cone, least_m);
  }
  if (edges_.circles().empty()) return least_m;
  return scan::least_range_in_cone_m(edges_.circles(), cone, least_m);
}

void Ranger::show(SimTime, RobotSnapshot& shot) const {
  const RangerReading& round = reading();
  if (round.sequence == 0) return;
  for (std::size_t i = 0; i < round.ranges_m.size(); ++i) {
    shot.cones.push_back({round.X_WB * round.X_BS[i], round.ranges_m[i], round.field_of_view_rad,
                          round.ranges_m[i] < round.range_max_m});
  }
}

void Ranger::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(noise_);
}

void Ranger::archive_reading(StateArchive& archive, RangerReading& reading) {
  SensorOf::archive_reading(archive, reading);
  archive(reading.X_WB);
  archive.expect(
      reading.ranges_m.size() == params_.X_BS.size() && reading.X_BS.size() == params_.X_BS.size(),
      "a range for each transducer");
}

namespace {

std::optional<FieldError> check_mountings(const void* object) {
  const auto& reading = *static_cast<const RangerReading*>(object);
  if (reading.X_BS.size() == reading.ranges_m.size()) return std::nullopt;
  return FieldError{"", "as many as there are ranges", "", "", "mountings"};
}

constexpr auto kMakeRanger = [](const DeviceConstruction& construction,
                                const RangerParams& params) {
  const bool may_be_inside = !std::ranges::all_of(params.X_BS, [&construction](const Pose& X_BS) {
    return is_safely_inside(construction.model, X_BS);
  });
  return std::make_unique<Ranger>(construction.name(), construction.device.type, params,
                                  may_be_inside, construction.noise());
};

}  // namespace

constexpr Field kRangerSettings[] = {
    frequency_field<&RangerParams::frequency_hz>(),
    noise_field<&RangerParams::noise_m>("standard deviation of a range").with_realism(0.0, 0.005),
    noise_share_field<&RangerParams::noise_share>(0.01),
    dropout_field<&RangerParams::dropouts>(0.01),
    latency_field<&RangerParams::latency_s>(),
    range_max_field<&RangerParams::range_max_m>("maximum range, and the reading if nothing is hit"),
    height_field<&RangerParams::height_m>("above the floor; lower obstacles are not seen"),
    field<&RangerParams::X_BS>("mounts", "m, degrees",
                               "poses of the transducers on the body, X_BS; 1 to 64 of them")
        .counting(1, RangerParams::kMaxTransducers)
        .with_issue("device/ranger-mounts",
                    "a list of 1 to 64 poses {\"x\", \"y\", \"yaw_deg\"}, one for each transducer")
        .property_name("mount")
        .listing_elements(),
};
SIM_FIELDS(RangerParams, kRangerSettings)

static_assert(RangerParams::kMaxTransducers == 64, "the texts above say so");

constexpr Field kInfrared[] = {
    include<InfraredParams, RangerParams>(),
    field<&InfraredParams::field_of_view_rad>("field_of_view", "rad").as_read_only(),
    field<&InfraredParams::voltage_gain_vm>("voltage_gain", "V m",
                                            "of the sensor curve, gain / (range + shift)")
        .above(0.0, 1000.0),
    field<&InfraredParams::voltage_shift_m>("voltage_shift", "m", "of the sensor curve")
        .above(0.0, 10.0),
};
SIM_FIELDS(InfraredParams, kInfrared)

constexpr Field kSonar[] = {
    include<SonarParams, RangerParams>(),
    field<&SonarParams::field_of_view_rad>("field_of_view_deg", "degrees",
                                           "full angle of each transducer's cone")
        .within(0.01, 180.0),
};
SIM_FIELDS(SonarParams, kSonar)

constexpr Field kRangerReading[] = {
    field<&RangerReading::ranges_m>("ranges", "m"),
    field<&RangerReading::X_BS>("mountings", "m, rad"),
    field<&RangerReading::range_max_m>("range_max", "m"),
    field<&RangerReading::field_of_view_rad>("field_of_view", "rad"),
};
SIM_FIELDS(RangerReading, kRangerReading, check_mountings)

DeviceKind infrared_kind() {
  return device_kind<InfraredParams, RangerReading>("infrared", {{"ir"}, {"ranger", 2}},
                                                    kMakeRanger);
}

DeviceKind sonar_kind() {
  return device_kind<SonarParams, RangerReading>("sonar", {{"ranger", 1}, {"sonar"}}, kMakeRanger);
}

}  // namespace sim
