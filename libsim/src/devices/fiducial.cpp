// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/fiducial.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "devices/device_kind.h"
#include "physics/physics_world.h"
#include "sim/core/math.h"
#include "sim/devices/robot_snapshot.h"
#include "sim/world/description.h"
#include "sim/world/limits.h"

namespace sim {
namespace {

double distance2(const FiducialReading::Mark& mark) { return mark.X_ST.position().squaredNorm(); }

}  // namespace

FiducialFinder::FiducialFinder(std::string name, const FiducialParams& params, RandomStream noise)
    : SensorOf(std::move(name), "fiducial", params.frequency_hz, params.latency_s),
      params_(params),
      noise_(std::move(noise)) {}

void FiducialFinder::measure(const StepContext& context) {
  using Contact = PhysicsWorld::Contact;
  auto& reading = next(context);
  reading.marks.clear();
  const Pose X_WS = context.body.X_WB * params_.X_BS;
  const Pose X_SW = X_WS.inverse();
  reading.X_WS = X_WS;
  const auto look_at = [&](int id, const Pose& X_WT, double height_m, const Contact& target) {
    if (id == 0 || !reaches_height(height_m, params_.height_m)) return;
    if ((X_WT.position() - X_WS.position()).squaredNorm() >
        params_.range_max_m * params_.range_max_m) {
      return;
    }
    const Pose X_ST = X_SW * X_WT;
    const double bearing = math::atan2(X_ST.y_m, X_ST.x_m);
    if (std::abs(bearing) > 0.5 * params_.field_of_view_rad) return;
    if (!context.physics.is_line_free(X_WS.position(), X_WT.position(), params_.height_m,
                                      context.robot, target)) {
      return;
    }
    const double distance_m = X_ST.position().norm();
    const double measured_m = std::max(0.0, distance_m + noise_.gaussian(params_.noise_m));
    const double direction = bearing + noise_.gaussian(params_.noise_bearing_rad);
    FiducialReading::Mark mark;
    mark.id = distance_m <= params_.range_max_id_m ? id : 0;
    mark.X_ST = {measured_m * math::cos(direction), measured_m * math::sin(direction),
                 normalize_angle(X_ST.yaw_rad + noise_.gaussian(params_.noise_yaw_rad))};
    reading.marks.push_back(mark);
  };
  const auto& robots = context.world.robots;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const int robot = static_cast<int>(i);
    if (robot == context.robot) continue;
    look_at(robots[i].fiducial, context.physics.body(robot).X_WB, context.physics.height_m(robot),
            {robot, Contact::Kind::kRobot, robot});
  }
  const auto& obstacles = context.world.arena.obstacles;
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const ObstacleDescription& o = obstacles[i];
    if (o.state != ObstacleState::kExtended || o.carried_by == context.robot) continue;
    look_at(o.fiducial, {o.center.x(), o.center.y(), o.yaw_rad}, standing_height_m(o),
            {-1, Contact::Kind::kObstacle, static_cast<int>(i)});
  }
  std::stable_sort(reading.marks.begin(), reading.marks.end(),
                   [](const auto& a, const auto& b) { return distance2(a) < distance2(b); });
}

void FiducialFinder::show(SimTime, RobotSnapshot& shot) const {
  for (const FiducialReading::Mark& mark : reading().marks) {
    shot.sights.emplace_back(reading().X_WS.position(), reading().X_WS * mark.X_ST.position());
  }
}

void FiducialFinder::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(noise_);
}

void FiducialFinder::archive_reading(StateArchive& archive, FiducialReading& reading) {
  SensorOf::archive_reading(archive, reading);
  archive(reading.X_WS);
}

constexpr Field kFiducialSettings[] = {
    frequency_field<&FiducialParams::frequency_hz>(),
    range_max_field<&FiducialParams::range_max_m>(),
    field<&FiducialParams::range_max_id_m>("range_max_id", "m",
                                           "the number of farther objects cannot be read")
        .within(0.0, 1000.0),
    field<&FiducialParams::field_of_view_rad>("field_of_view_deg", "degrees", "full angle of view")
        .within(0.01, 360.0),
    mount_field<&FiducialParams::X_BS>("pose of the sensor on the body, X_BS"),
    height_field<&FiducialParams::height_m>(
        "above the floor; lower objects are invisible and do not occlude"),
    noise_field<&FiducialParams::noise_m>("standard deviation of a distance")
        .with_realism(0.0, 0.01),
    field<&FiducialParams::noise_bearing_rad>("noise_bearing_deg", "degrees",
                                              "standard deviation of a direction")
        .within(0.0, 180.0)
        .with_realism(0.0, 0.5),
    field<&FiducialParams::noise_yaw_rad>("noise_yaw_deg", "degrees",
                                          "standard deviation of an object's heading")
        .within(0.0, 360.0)
        .with_realism(0.0, 2.0),
    latency_field<&FiducialParams::latency_s>(),
};
SIM_FIELDS(FiducialParams, kFiducialSettings)

constexpr Field kMark[] = {
    field<&FiducialReading::Mark::id>("id"),
    field<&FiducialReading::Mark::X_ST>("", "m, rad"),
};
SIM_FIELDS(FiducialReading::Mark, kMark)

constexpr Field kFiducialReading[] = {
    field<&FiducialReading::marks>(
        "marks", "", "nearest first, seen from the sensor; id 0: too far away to be read"),
};
SIM_FIELDS(FiducialReading, kFiducialReading)

DeviceKind fiducial_kind() {
  return device_kind<FiducialFinder, FiducialParams, FiducialReading>("fiducial", {{"fiducial"}});
}

}  // namespace sim
