// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/waypoint.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "devices/device_kind.h"
#include "devices/goal.h"
#include "sim/core/math.h"
#include "sim/core/number_text.h"
#include "sim/world/description.h"

namespace sim {

std::optional<std::string> refusal_of(const GotoCommand& goal) {
  if (!goal.goal_m.allFinite() || !std::isfinite(goal.z_m.value_or(0.0))) {
    return "a goal must be a point of finite coordinates";
  }
  if (!(goal.tolerance_m > 0.0) || !std::isfinite(goal.tolerance_m)) {
    return "the tolerance of a goal must be a number of metres greater than 0, not " +
           rounded_text(goal.tolerance_m, 6);
  }
  if (!(goal.speed_mps > 0.0) || !std::isfinite(goal.speed_mps)) {
    return "the speed to a goal must be a number of m/s greater than 0, not " +
           rounded_text(goal.speed_mps, 6);
  }
  return std::nullopt;
}

Twist waypoint_twist(const Pose& X_WB, const GotoCommand& goal, const WaypointParams& params) {
  const Vec2 way = goal.goal_m - X_WB.position();
  const double distance_m = math::hypot(way.x(), way.y());
  if (distance_m == 0.0) return {};
  const double bearing_rad = normalize_angle(math::atan2(way.y(), way.x()) - X_WB.yaw_rad);
  return {std::min(goal.speed_mps, params.approach_gain * distance_m) *
              std::max(0.0, math::cos(bearing_rad)),
          std::clamp(params.turn_gain * bearing_rad, -params.max_turn_rate_radps,
                     params.max_turn_rate_radps)};
}

Waypoint::Waypoint(std::string name, const WaypointParams& params, const Pose& X_WB_start)
    : SensorOf(std::move(name), "waypoint", params.frequency_hz),
      params_(params),
      goal_{X_WB_start.position(), params.tolerance_m, params.speed_mps},
      X_WB_(X_WB_start) {}

double Waypoint::distance_m() const {
  return math::hypot(goal_.goal_m.x() - X_WB_.x_m, goal_.goal_m.y() - X_WB_.y_m);
}

std::optional<std::string> Waypoint::execute(const Command& command, RobotControl& robot) {
  if (const auto* go = std::get_if<GotoCommand>(&command)) {
    if (auto refusal = refusal_of(*go)) return refusal;
    if (!robot.acquire_motors(*this)) return "the robot has no motors to drive to a goal with";
    goal_ = *go;
    has_goal_ = true;
    ++goal_number_;
    status_ = WaypointStatus::kTransit;
    controls_motors_ = true;
    return std::nullopt;
  }
  if (std::holds_alternative<StopCommand>(command)) {
    status_ = WaypointStatus::kStop;
    rolling_mps_ = params_.stop_deceleration_mps2 > 0.0 ? robot.body().twist.v_mps : 0.0;
    return std::nullopt;
  }
  if (std::holds_alternative<ResumeCommand>(command)) {
    if (!has_goal_) return "there is no goal to go on to: none was given yet";
    static_cast<void>(robot.acquire_motors(*this));
    status_ = WaypointStatus::kTransit;
    controls_motors_ = true;
    return std::nullopt;
  }
  return apply(command);
}

void Waypoint::act(RobotControl& robot) {
  X_WB_ = robot.body().X_WB;
  if (status_ == WaypointStatus::kTransit && distance_m() > goal_.tolerance_m) {
    robot.drive(waypoint_twist(X_WB_, goal_, params_));
  } else if (controls_motors_) {
    const double lost_mps =
        params_.stop_deceleration_mps2 * to_seconds(robot.context().world.simulation.step_ns);
    rolling_mps_ = status_ == WaypointStatus::kStop ? std::max(0.0, rolling_mps_ - lost_mps) : 0.0;
    robot.drive({rolling_mps_, 0.0, 0.0});
    controls_motors_ = rolling_mps_ > 0.0;
  }
}

void Waypoint::integrate(const StepContext& context) {
  X_WB_ = context.body.X_WB;
  if (status_ == WaypointStatus::kTransit && distance_m() <= goal_.tolerance_m) {
    status_ = WaypointStatus::kArrived;
  }
}

void Waypoint::on_motors_taken() {
  if (status_ == WaypointStatus::kTransit) status_ = WaypointStatus::kStop;
  controls_motors_ = false;  // another device drives the motors now
}

void Waypoint::placed(const Pose& X_WB) {
  X_WB_ = X_WB;
  on_motors_taken();
}

void Waypoint::take_over_from(const Device& before, SimTime later_ns) {
  SensorOf<WaypointReading>::take_over_from(before, later_ns);
  const auto& old = dynamic_cast<const Waypoint&>(before);
  goal_number_ = old.goal_number_ + (old.has_goal_ || has_goal_ ? 1 : 0);
}

void Waypoint::deactivated(RobotControl& robot) {
  if (status_ == WaypointStatus::kTransit) status_ = WaypointStatus::kStop;
  if (controls_motors_) robot.drive({});
  controls_motors_ = false;
}

void Waypoint::measure(const StepContext& context) {
  auto& reading = next(context);
  reading.status = status_;
  reading.goal_number = goal_number_;
  reading.goal_m = goal_.goal_m;
  reading.position_m = X_WB_.position();
  reading.distance_m = distance_m();
}

void Waypoint::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive.fields(goal_);
  archive(goal_number_, has_goal_, controls_motors_, X_WB_, rolling_mps_);
  archive.choice(status_, WaypointStatus::kStop);
}

constexpr const char* kWaypointWords[] = {"Arrived", "Transit", "Stop"};

constexpr Field kWaypointSettings[] = {
    frequency_field<&WaypointParams::frequency_hz>(
        "readings per simulated second; the controller runs in each step"),
    field<&WaypointParams::tolerance_m>(
        "tolerance", "m", "default distance from a goal at which the robot has arrived")
        .above(0.0, 1000.0),
    field<&WaypointParams::speed_mps>("speed", "m/s",
                                      "default maximum speed; the motors' limits also hold")
        .above(0.0, 20.0),
    field<&WaypointParams::turn_gain>("turn_gain", "1/s", "turn rate divided by the goal's bearing")
        .above(0.0, 50.0),
    field<&WaypointParams::approach_gain>("approach_gain", "1/s",
                                          "speed divided by the goal's distance")
        .above(0.0, 50.0),
    field<&WaypointParams::max_turn_rate_radps>("max_turn_rate_deg", "degrees/s",
                                                "maximum on the way to a goal; default 2 rad/s")
        .above(0.0, 3600.0),
    field<&WaypointParams::stop_deceleration_mps2>(
        "stop_deceleration", "m/s^2",
        "of a robot that is stopped before its goal; 0: it stops at once")
        .within(0.0, 1000.0)
        .unlisted(0.0),
};
SIM_FIELDS(WaypointParams, kWaypointSettings)

constexpr Field kWaypointReading[] = {
    field<&WaypointReading::status>("status", "", "what the robot does").one_of(kWaypointWords),
    field<&WaypointReading::goal_number>("goal_number", "", "goals so far"),
    field<&WaypointReading::goal_m>("", "m", "the goal"),
    field<&WaypointReading::distance_m>("distance", "m", "to the goal"),
};
SIM_FIELDS(WaypointReading, kWaypointReading)

std::string_view to_string(WaypointStatus status) noexcept {
  return kWaypointWords[static_cast<std::size_t>(status)];
}

DeviceKind waypoint_kind() {
  return device_kind<WaypointParams, WaypointReading>(
      "waypoint", {}, [](const DeviceConstruction& construction, const WaypointParams& params) {
        return std::make_unique<Waypoint>(construction.name(), params, construction.robot.pose);
      });
}

}  // namespace sim
