// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/semantic_camera.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "devices/device_kind.h"
#include "physics/physics_world.h"
#include "sim/core/math.h"
#include "sim/world/description.h"

namespace sim {
namespace {

// From the axes of pictures (x right, y down, z along the view) to x forward, y left, z up.
Eigen::Matrix3d axes_of_pictures() {
  Eigen::Matrix3d R;
  R << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return R;
}

}  // namespace

void SemanticCamera::measure(const StepContext& context) {
  using Contact = PhysicsWorld::Contact;
  auto& reading = next(context);
  reading.objects.clear();
  const Eigen::Isometry3d X_WS = mounting().in_world(context.body);
  const Eigen::Vector3d p_WS = X_WS.translation();
  const auto look_at = [&](const std::string& name, const std::vector<std::string>& tags,
                           const Eigen::Isometry3d& X_WT, const Contact& target) {
    if (!std::ranges::binary_search(tags, params().tag)) return;
    const Eigen::Vector3d p_ST = X_WS.inverse() * X_WT.translation();
    if (p_ST.norm() > params().range_m) return;
    if (std::abs(math::atan2(p_ST.y(), p_ST.x())) > 0.5 * params().field_of_view_rad) return;
    if (params().occlusion &&
        !context.physics.is_line_free({p_WS.x(), p_WS.y()},
                                      {X_WT.translation().x(), X_WT.translation().y()}, p_WS.z(),
                                      context.robot, target)) {
      return;
    }
    Eigen::Isometry3d shown = X_WT;
    if (params().relative) {
      Eigen::Isometry3d X_WC = X_WS;
      X_WC.linear() *= axes_of_pictures();
      shown = X_WC.inverse() * X_WT;
    }
    const Eigen::Quaterniond turn(shown.linear());
    SemanticCameraReading::Object object;
    object.name = name;
    object.type = params().tag;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      object.position_m[k] = shown.translation()[i] + noise().gaussian(params().noise_m);
    }
    object.vector = {turn.x(), turn.y(), turn.z()};
    object.scalar = turn.w();
    reading.objects.push_back(std::move(object));
  };
  const auto& obstacles = context.world.arena.obstacles;
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const ObstacleDescription& o = obstacles[i];
    if (o.state != ObstacleState::kExtended || o.carried_by == context.robot) continue;
    look_at(o.name, o.tags,
            in_space({o.center.x(), o.center.y(), o.yaw_rad}, {0.5 * standing_height_m(o), 0, 0}),
            {-1, Contact::Kind::kObstacle, static_cast<int>(i)});
  }
  for (int i = 0; i < context.physics.robot_count(); ++i) {
    if (i == context.robot) continue;
    const RobotDescription& robot = context.world.robots[static_cast<std::size_t>(i)];
    const BodyState& body = context.physics.body(i);
    look_at(robot.name, robot.tags, in_space(body.X_WB, body.elevation),
            {i, Contact::Kind::kRobot, i});
  }
}

constexpr Field kSemanticCameraSettings[] = {
    frequency_field<&SemanticCameraParams::frequency_hz>(),
    field<&SemanticCameraParams::field_of_view_rad>("field_of_view_deg", "degrees",
                                                    "horizontal, from side to side")
        .above(0.0, 360.0),
    field<&SemanticCameraParams::range_m>("range", "m", "farther objects are not seen")
        .above(0.0, 1000.0),
    field<&SemanticCameraParams::tag>("tag", "", "robots and obstacles with this tag are seen"),
    field<&SemanticCameraParams::relative>("relative", "",
                                           "poses are in the camera's frame, not in the world's"),
    field<&SemanticCameraParams::occlusion>("occlusion", "",
                                            "whether objects hide those behind them"),
    noise_field<&SemanticCameraParams::noise_m>("standard deviation of each coordinate")
        .with_realism(0.0, 0.02),
    latency_field<&SemanticCameraParams::latency_s>(),
    include<SemanticCameraParams, SensorMount>(),
};
SIM_FIELDS(SemanticCameraParams, kSemanticCameraSettings)

constexpr Field kSemanticObject[] = {
    field<&SemanticCameraReading::Object::name>("name"),
    field<&SemanticCameraReading::Object::type>("type"),
    field<&SemanticCameraReading::Object::position_m>("position", "m"),
    field<&SemanticCameraReading::Object::vector>("orientation_vector"),
    field<&SemanticCameraReading::Object::scalar>("orientation_scalar"),
};
SIM_FIELDS(SemanticCameraReading::Object, kSemanticObject)

constexpr Field kSemanticCameraReading[] = {
    field<&SemanticCameraReading::objects>(
        "objects", "", "seen objects; positions in m; the orientation is a quaternion"),
};
SIM_FIELDS(SemanticCameraReading, kSemanticCameraReading)

DeviceKind semantic_camera_kind() {
  return device_kind<SemanticCamera, SemanticCameraParams, SemanticCameraReading>("semantic_camera",
                                                                                  {});
}

}  // namespace sim
