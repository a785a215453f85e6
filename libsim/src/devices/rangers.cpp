// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/rangers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "devices/device_kind.h"
#include "physics/physics_world.h"
#include "sim/core/degrees.h"
#include "sim/core/number_text.h"
#include "sim/devices/laser.h"
#include "sim/devices/robot_snapshot.h"
#include "sim/io/reader.h"
#include "sim/world/limits.h"
#include "sim/world/outline.h"

namespace sim {
namespace {

// An edge as seen from the origin. Its squared distance is kept as a fraction, so that it can be
// compared without a division, which takes longer than everything else here.
struct EdgeDistance {
  explicit EdgeDistance(const scan::Edge& edge)
      : a(static_cast<double>(edge.x0_m), static_cast<double>(edge.y0_m)),
        b(static_cast<double>(edge.x1_m), static_cast<double>(edge.y1_m)) {
    const Vec2 along = b - a;
    behind = a.x() * along.y() - a.y() * along.x();
    length2 = along.squaredNorm();
    const double to_foot = -a.dot(along);
    if (to_foot > 0.0 && to_foot < length2) {
      numerator = behind * behind;
      denominator = length2;
    } else {
      numerator = to_foot > 0.0 ? b.squaredNorm() : a.squaredNorm();
    }
  }

  // Whether no point within this distance of the origin sees the edge from its front.
  [[nodiscard]] bool turns_away(double reach_m) const {
    return behind > 0.0 && behind * behind > reach_m * reach_m * length2;
  }
  [[nodiscard]] bool is_beyond(double distance_m) const {
    return numerator > distance_m * distance_m * denominator;
  }

  Vec2 a, b;
  double behind;   // twice the area of the triangle with the origin; > 0: the origin is behind it
  double length2;  // [m2]
  double numerator;
  double denominator = 1.0;
};

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
  for (const Pose& X_BS : params.X_BS) reach_m_ = std::max(reach_m_, X_BS.position().norm());
  auto& first = edit();
  first.ranges_m.assign(params.X_BS.size(), 0.0);
  first.X_BS = params.X_BS;
  first.range_max_m = params.range_max_m;
  first.field_of_view_rad = params.field_of_view_rad;
}

void Ranger::look_around(const StepContext& context, double height_m) {
  context.physics.collect_edges(context.body.X_WB.position(), params_.range_max_m + reach_m_,
                                height_m, context.robot, false, edges_);
  for (scan::EdgeColumns& shell : shells_) shell.clear();
  const double farthest_m = reach_m_ + params_.range_max_m;
  for (const scan::Edge& edge : edges_.edges()) {
    const EdgeDistance distance(edge);
    if (distance.turns_away(reach_m_) || distance.is_beyond(farthest_m)) continue;
    const auto shell = std::count_if(kShellLimits_m.begin(), kShellLimits_m.end(),
                                     [&](double limit_m) { return distance.is_beyond(limit_m); });
    shells_[static_cast<std::size_t>(shell)].add(edge);
  }
}

void Ranger::measure(const StepContext& context) {
  auto& reading = next(context);
  const Pose& X_WB = context.body.X_WB;
  const Frame body(X_WB);
  reading.X_WB = X_WB;
  if (params_.heights_m.empty()) look_around(context, params_.height_m);
  double height_m = params_.height_m;
  double range_max_m = params_.range_max_m;
  const double view_rad = params_.single_ray ? 0.0 : params_.field_of_view_rad;
  for (std::size_t i = 0; i < params_.X_BS.size(); ++i) {
    const Pose X_WS = body * params_.X_BS[i];
    const Vec2 p_BS_W = X_WS.position() - X_WB.position();
    if (!params_.heights_m.empty() && (i == 0 || params_.heights_m[i] != height_m)) {
      height_m = params_.heights_m[i];
      look_around(context, height_m);
    }
    if (!params_.ranges_max_m.empty()) range_max_m = params_.ranges_max_m[i];
    double range_m = 0.0;
    if (!may_be_inside_ ||
        !context.physics.is_inside_solid(X_WS.position(), height_m, context.robot)) {
      range_m = least_range_m({p_BS_W.x(), p_BS_W.y(), X_WS.yaw_rad, view_rad}, range_max_m);
    }
    // As for the laser: without an echo there is no noise.
    const double sigma_m = range_deviation_m(range_m, params_.noise_m, params_.noise_share);
    if (sigma_m > 0.0 && range_m < range_max_m) {
      range_m = std::clamp(range_m + noise_.gaussian(sigma_m), 0.0, range_max_m);
    }
    if (params_.dropouts > 0.0 && noise_.uniform() < params_.dropouts) range_m = range_max_m;
    if (blind()) range_m = range_max_m;
    reading.ranges_m[i] = range_m;
  }
}

double Ranger::least_range_m(const scan::Cone& cone, double range_max_m) {
  // Far above rounding errors.
  constexpr double kSlack_m = 1e-6;
  double least_m = range_max_m;
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
    const double range_max_m =
        params_.ranges_max_m.empty() ? params_.range_max_m : params_.ranges_max_m[i];
    shot.cones.push_back({round.X_WB * round.X_BS[i], round.ranges_m[i], round.field_of_view_rad,
                          round.ranges_m[i] < range_max_m});
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

constexpr double kMostMetres = 1000.0;

std::optional<FieldError> check_mountings(const void* object) {
  const auto& reading = *static_cast<const RangerReading*>(object);
  if (reading.X_BS.size() == reading.ranges_m.size()) return std::nullopt;
  return FieldError{"", "as many as there are ranges", "", "", "mountings"};
}

bool read_metres(const io::Reader& value, void* into) {
  double& metres = *static_cast<double*>(into);
  const std::optional<std::string> text = value.is_number() ? value.scalar_text() : std::nullopt;
  if (!text) return false;
  std::from_chars(text->data(), text->data() + text->size(), metres);
  return metres >= 0.0 && metres <= kMostMetres;
}

constexpr ElementType kMetres{
    read_metres,
    [](const void* metres) { return shortest_text(*static_cast<const double*>(metres)); },
    R"({"type": "number", "minimum": 0, "maximum": 1000})"};

std::optional<FieldError> check_transducers(const RangerParams& params) {
  const std::size_t count = params.X_BS.size();
  for (const auto& [list, what] :
       {std::pair(&params.ranges_max_m, "ranges_max"), std::pair(&params.heights_m, "heights")}) {
    if (list->empty() || list->size() == count) continue;
    return FieldError{"device/transducers", "as many as there are mounts: " + std::to_string(count),
                      "a list of " + std::to_string(list->size()), "", what};
  }
  if (params.intensity > 0.0 && !params.ranges_max_m.empty()) {
    return FieldError{"device/transducers",
                      "no ranges_max together with intensity: programs know one range, so they "
                      "cannot tell what has an echo",
                      "both", "", "ranges_max"};
  }
  const auto over = std::ranges::find_if(
      params.ranges_max_m, [&](double range_m) { return range_m > params.range_max_m; });
  if (over == params.ranges_max_m.end()) return std::nullopt;
  return FieldError{"device/transducers",
                    "ranges up to range_max, " + shortest_text(params.range_max_m) + " m",
                    shortest_text(*over) + " m", "", "ranges_max"};
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
                               "poses of the transducers on the body, X_BS; at most 1024 of them")
        .counting(0, kMostTransducers)
        .property_name("mount")
        .listing_elements(),
    field<&RangerParams::ranges_max_m>(
        "ranges_max", "m", "maximum range of each transducer; an empty list: `range_max` of all")
        .of(kMetres)
        .with_issue("world/out-of-range", "a length in [0, 1000] m")
        .not_property(),
    field<&RangerParams::heights_m>("heights", "m",
                                    "height of each transducer; an empty list: `height` of all")
        .of(kMetres)
        .with_issue("world/out-of-range", "a length in [0, 1000] m")
        .not_property(),
    range_min_field<&RangerParams::range_min_m>(),
    intensity_field<&RangerParams::intensity>(),
};
SIM_FIELDS(RangerParams, kRangerSettings)

static_assert(kMostTransducers == 1024, "the texts above say so");

constexpr Field kInfrared[] = {
    include<InfraredParams, RangerParams>(),
    field<&InfraredParams::field_of_view_rad>("field_of_view", "rad").as_read_only(),
    field<&InfraredParams::voltage_gain_vm>("voltage_gain", "V m",
                                            "of the sensor curve, gain / (range + shift)")
        .above(0.0, 1000.0),
    field<&InfraredParams::voltage_shift_m>("voltage_shift", "m", "of the sensor curve")
        .above(0.0, 10.0),
};
SIM_FIELDS(InfraredParams, kInfrared, [](const void* params) {
  return check_transducers(*static_cast<const InfraredParams*>(params));
})

constexpr Field kSonar[] = {
    include<SonarParams, RangerParams>(),
    field<&SonarParams::field_of_view_rad>("field_of_view_deg", "degrees",
                                           "full angle of each transducer's cone")
        .within(0.01, 180.0),
    field<&SonarParams::single_ray>(
        "single_ray", "", "it measures along the axis of the cone only, as sonars of Stage do")
        .not_property(),
};
SIM_FIELDS(SonarParams, kSonar, [](const void* params) {
  return check_transducers(*static_cast<const SonarParams*>(params));
})

constexpr Field kRangerReading[] = {
    field<&RangerReading::ranges_m>("ranges", "m", "one per transducer"),
    field<&RangerReading::X_BS>("mountings", "m, rad", "poses on the robot, one per transducer"),
    field<&RangerReading::range_max_m>("range_max", "m", "limit of the ranges"),
    field<&RangerReading::field_of_view_rad>("field_of_view", "rad",
                                             "full angle of a cone, 0 for a ray"),
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
