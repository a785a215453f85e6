// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/bumper.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "devices/device_kind.h"
#include "physics/physics_world.h"
#include "sim/core/math.h"
#include "sim/core/pose.h"
#include "sim/devices/robot_snapshot.h"

namespace sim {
namespace {

constexpr double kStep_m = 0.005;   // distance of the samples along a touch
constexpr double kJoint_m = 0.001;  // segments at most this much farther than the nearest are
                                    // pressed too

}  // namespace

std::vector<BumperSegment> segments_round(const Polygon& footprint) {
  std::vector<BumperSegment> segments;
  for (std::size_t i = 0; i < footprint.size(); ++i) {
    const Vec2& a = footprint[i];
    const Vec2& b = footprint[(i + 1) % footprint.size()];
    const Vec2 along = b - a;
    const Vec2 middle = 0.5 * (a + b);
    // The outline is counter-clockwise, so its outside is on the right.
    segments.push_back(
        {{middle.x(), middle.y(), math::atan2(-along.x(), along.y())}, along.norm(), 0.0});
  }
  return segments;
}

std::vector<Vec2> line_of(const BumperSegment& segment) {
  const double half_m = 0.5 * segment.length_m;
  if (segment.radius_m <= 0.0) {
    return {segment.X_BS * Vec2(0.0, -half_m), segment.X_BS * Vec2(0.0, half_m)};
  }
  constexpr double kStep_rad = 5.0 * std::numbers::pi / 180.0;
  const double half_angle = half_m / segment.radius_m;
  const int steps = std::max(1, static_cast<int>(std::ceil(2.0 * half_angle / kStep_rad)));
  std::vector<Vec2> points;
  for (int i = 0; i <= steps; ++i) {
    const double angle = half_angle * (2.0 * i / steps - 1.0);
    points.push_back(segment.X_BS * Vec2(segment.radius_m * (math::cos(angle) - 1.0),
                                         segment.radius_m * math::sin(angle)));
  }
  return points;
}

double distance_to_segment_m(const BumperSegment& segment, const Vec2& p_B) {
  const Vec2 p_S = segment.X_BS.inverse() * p_B;
  const double half_m = 0.5 * segment.length_m;
  if (segment.radius_m <= 0.0) {
    return math::hypot(p_S.x(), std::max(std::abs(p_S.y()) - half_m, 0.0));
  }
  const Vec2 from_center = p_S + Vec2(segment.radius_m, 0.0);
  const double half_angle = half_m / segment.radius_m;
  const double angle = std::abs(math::atan2(from_center.y(), from_center.x()));
  if (angle <= half_angle) return std::abs(from_center.norm() - segment.radius_m);
  const Vec2 end = segment.radius_m * unit_vector(half_angle);
  return (Vec2(from_center.x(), std::abs(from_center.y())) - end).norm();
}

void press_segments(const std::vector<BumperSegment>& segments, double reach_m, const Vec2& p_BA,
                    const Vec2& p_BC, std::vector<std::uint8_t>& pressed) {
  const int steps = std::max(1, static_cast<int>(std::ceil((p_BC - p_BA).norm() / kStep_m)));
  for (int step = 0; step <= steps; ++step) {
    const Vec2 p_B = p_BA + (p_BC - p_BA) * (static_cast<double>(step) / steps);
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const BumperSegment& segment : segments) {
      nearest_m = std::min(nearest_m, distance_to_segment_m(segment, p_B));
    }
    if (nearest_m > reach_m) continue;
    for (std::size_t i = 0; i < segments.size(); ++i) {
      if (distance_to_segment_m(segments[i], p_B) <= nearest_m + kJoint_m) pressed[i] = 1;
    }
  }
}

Bumper::Bumper(std::string name, const BumperParams& params, const Polygon& footprint)
    : SensorOf(std::move(name), "bumper", params.frequency_hz), params_(params) {
  if (params_.segments.empty()) params_.segments = segments_round(footprint);
  pressed_.assign(params_.segments.size(), 0);
  edit().pressed = pressed_;
}

void Bumper::integrate(const StepContext& context) {
  const std::vector<PhysicsWorld::Touch> touches = context.physics.touches_of(context.robot);
  if (touches.empty()) return;
  const Pose X_BW = context.body.X_WB.inverse();
  for (const PhysicsWorld::Touch& touch : touches) {
    press_segments(params_.segments, params_.reach_m, X_BW * touch.p_WA, X_BW * touch.p_WC,
                   pressed_);
  }
}

void Bumper::measure(const StepContext& context) {
  auto& reading = next(context);
  reading.pressed = pressed_;
  std::fill(pressed_.begin(), pressed_.end(), std::uint8_t{0});
}

void Bumper::show(SimTime, RobotSnapshot& shot) const {
  for (std::size_t i = 0; i < segments().size(); ++i) {
    shot.bumpers.push_back({line_of(segments()[i]), reading().pressed[i] != 0});
  }
}

void Bumper::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(pressed_);
  archive.expect(
      pressed_.size() == segments().size() && reading().pressed.size() == pressed_.size(),
      "a flag for each segment");
}

namespace {

std::optional<FieldError> check_segment(const void* object) {
  const auto& segment = *static_cast<const BumperSegment*>(object);
  if (segment.radius_m <= 0.0 ||
      segment.length_m <= 2.0 * std::numbers::pi * segment.radius_m * (1.0 + 1e-9)) {
    return std::nullopt;
  }
  return FieldError{"device/bumper-segment", "an arc that is at most a whole circle, 2 pi radius",
                    rounded_text(segment.length_m, 6) + " m long with a radius of " +
                        rounded_text(segment.radius_m, 6) + " m",
                    ""};
}

}  // namespace

constexpr Field kSegment[] = {
    field<&BumperSegment::X_BS, &Pose::x_m>("x", "m",
                                            "of its middle, ahead of the middle of the axle")
        .within(-100.0, 100.0)
        .property_name("mount_x"),
    field<&BumperSegment::X_BS, &Pose::y_m>("y", "m", "of its middle, to the left")
        .within(-100.0, 100.0)
        .property_name("mount_y"),
    field<&BumperSegment::X_BS, &Pose::yaw_rad>(
        "yaw_deg", "degrees", "where it looks, outwards, counter-clockwise from ahead")
        .property_name("mount_yaw"),
    field<&BumperSegment::length_m>("length", "m", "along the piece").within(kLeastLength_m, 100.0),
    field<&BumperSegment::radius_m>("radius", "m", "of the arc; 0: straight").within(0.0, 100.0),
};
SIM_FIELDS(BumperSegment, kSegment, check_segment)

constexpr Field kBumperSettings[] = {
    frequency_field<&BumperParams::frequency_hz>(),
    field<&BumperParams::reach_m>("reach", "m",
                                  "a contact farther than this from all segments presses none")
        .above(0.0, 1.0),
    field<&BumperParams::segments>("segments", "m, degrees",
                                   "list of at most 64 segments, in the order of their indexes; "
                                   "none: a straight one for each side of the footprint")
        .counting(0, BumperParams::kMaxSegments)
        .listing_elements(),
};
SIM_FIELDS(BumperParams, kBumperSettings)

constexpr Field kBumperReading[] = {
    field<&BumperReading::pressed>(
        "pressed", "", "one per segment: 1 if it was pressed since the last reading, else 0")
        .as_octets(),
};
SIM_FIELDS(BumperReading, kBumperReading)

DeviceKind bumper_kind() {
  DeviceKind row = device_kind<BumperParams, BumperReading>(
      "bumper", {{"bumper"}},
      [](const DeviceConstruction& construction, const BumperParams& params) {
        return std::make_unique<Bumper>(construction.name(), params, construction.model.footprint);
      });
  return with_model<BumperParams>(std::move(row),
                                  [](BumperParams& params, const RobotModel& model) {
                                    if (params.segments.empty())
                                      params.segments = segments_round(model.footprint);
                                  });
}

}  // namespace sim
