// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "devices/device_kind.h"
#include "sim/core/math.h"

namespace sim {
namespace {

// If the goal's bearing exceeds this, the robot turns on the spot before it drives.
constexpr double kTurnOnSpot_rad = 0.5;
// A robot that was pushed away from its goal by more than this many tolerances drives again.
constexpr double kRestartTolerances = 3.0;
// After leaving a goal within its turning circle, a car turns back to it once the arc there has
// less than this fraction of its maximum curvature.
constexpr double kWideEnough = 0.8;
// A car seeks the goal's heading if the cosine of the angle between that heading and the direction
// to the goal exceeds kMinHeadingCosine. Its look-ahead point is the fraction kLookAheadFraction of
// the distance before the goal.
constexpr double kMinHeadingCosine = 0.2;
constexpr double kLookAheadFraction = 0.5;
// A car changes its driving direction only for goals clearly on the other side.
constexpr double kDirectionMargin_rad = 0.3;

// Maximum magnitude of a wheel's slip.
constexpr double kMostSlip = 0.5;
// Maximum number of commands that wait for their latency.
constexpr std::size_t kMostWaiting = 1000;

bool drives(const Command& command) {
  return std::holds_alternative<TwistCommand>(command) ||
         std::holds_alternative<HeadingCommand>(command) ||
         std::holds_alternative<PositionCommand>(command) ||
         std::holds_alternative<CarCommand>(command);
}

// One step of a ramp from `from` to `to`; with max_rate 0 it jumps.
double ramp(double from, double to, double max_rate, double dt_s) {
  if (max_rate <= 0.0) return to;
  return from + std::clamp(to - from, -max_rate * dt_s, max_rate * dt_s);
}

}  // namespace

// --- PositionControl

double PositionControl::speed_for(double distance_m) const {
  double speed_mps = std::min(command_.max_speed_mps, params_.approach_gain * distance_m);
  if (params_.max_acceleration_mps2 > 0.0) {
    speed_mps = std::min(speed_mps, std::sqrt(params_.max_acceleration_mps2 * distance_m));
  }
  return speed_mps;
}

double PositionControl::turn_rate_for(double error_rad) const {
  double rate = std::min(command_.max_turn_rate_radps, params_.turn_gain * std::abs(error_rad));
  if (params_.max_turn_acceleration_radps2 > 0.0) {
    rate = std::min(rate, std::sqrt(params_.max_turn_acceleration_radps2 * std::abs(error_rad)));
  }
  return std::copysign(rate, error_rad);
}

PositionControl::Step PositionControl::differential_step(const Pose& X_FB, double distance_m) {
  const double near_m = (aligning_ ? kRestartTolerances : 1.0) * params_.tolerance_m;
  aligning_ = distance_m <= near_m;
  if (aligning_) {
    const double error_rad = normalize_angle(command_.goal.yaw_rad - X_FB.yaw_rad);
    if (std::abs(error_rad) <= params_.heading_tolerance_rad) return {{}, 0.0, true};
    return {{0.0, turn_rate_for(error_rad), 0.0}};
  }
  const Vec2 way = command_.goal.position() - X_FB.position();
  const double bearing_rad = normalize_angle(math::atan2(way.y(), way.x()) - X_FB.yaw_rad);
  const double omega_radps = turn_rate_for(bearing_rad);
  if (std::abs(bearing_rad) > kTurnOnSpot_rad) return {{0.0, omega_radps, 0.0}};
  return {{speed_for(distance_m * math::cos(bearing_rad)), omega_radps, 0.0}};
}

PositionControl::Step PositionControl::omnidirectional_step(const Pose& X_FB,
                                                            double distance_m) const {
  const double error_rad = normalize_angle(command_.goal.yaw_rad - X_FB.yaw_rad);
  const bool there = distance_m <= params_.tolerance_m;
  if (there && std::abs(error_rad) <= params_.heading_tolerance_rad) return {{}, 0.0, true};
  const Vec2 way = command_.goal.position() - X_FB.position();
  const double bearing_rad = math::atan2(way.y(), way.x()) - X_FB.yaw_rad;
  const double speed_mps = speed_for(distance_m);
  return {{speed_mps * math::cos(bearing_rad), turn_rate_for(error_rad),
           speed_mps * math::sin(bearing_rad)}};
}

PositionControl::Step PositionControl::car_step(const Pose& X_FB, double distance_m) {
  if (distance_m <= params_.tolerance_m) return {{}, 0.0, true};
  const Vec2 way = command_.goal.position() - X_FB.position();
  const double bearing_rad = normalize_angle(math::atan2(way.y(), way.x()) - X_FB.yaw_rad);
  const double tightest = math::tan(drive_.max_steering_rad) / drive_.wheelbase_m;
  // Curvature of the circle that is tangent to the heading and passes through the goal, for both
  // driving directions.
  const double curvature = 2.0 * math::sin(bearing_rad) / distance_m;
  if (!leaving_) {
    const double side = 0.5 * std::numbers::pi + (backwards_ ? -1.0 : 1.0) * kDirectionMargin_rad;
    backwards_ = std::abs(bearing_rad) > side;
  }
  leaving_ = std::abs(curvature) > (leaving_ ? kWideEnough : 1.0) * tightest;
  // To leave a goal within its turning circle, the car drives in the opposite direction with the
  // wheels turned away from the goal. So the goal moves in front of it.
  const bool reverse = leaving_ ? !backwards_ : backwards_;
  double arc = leaving_ ? -std::copysign(tightest, curvature) : curvature;
  heading_abandoned_ = heading_abandoned_ || (sought_heading_ && leaving_);
  if (!leaving_ && !heading_abandoned_) {
    // The driving direction at the goal with the requested heading.
    const double through_rad = command_.goal.yaw_rad + (backwards_ ? std::numbers::pi : 0.0);
    const Vec2 through(math::cos(through_rad), math::sin(through_rad));
    const Vec2 look = way - kLookAheadFraction * distance_m * through;
    const double look_rad = math::atan2(look.y(), look.x()) - X_FB.yaw_rad;
    const double look_curvature = 2.0 * math::sin(look_rad) / look.norm();
    if (way.dot(through) > kMinHeadingCosine * distance_m && std::abs(look_curvature) <= tightest &&
        (math::cos(look_rad) > 0.0) != backwards_) {
      arc = look_curvature;
      sought_heading_ = true;
    }
  }
  arc = std::clamp(arc, -tightest, tightest);
  const double speed_mps = leaving_ ? speed_for(1.0 / tightest) : speed_for(distance_m);
  return {{reverse ? -speed_mps : speed_mps, 0.0, 0.0}, math::atan(drive_.wheelbase_m * arc)};
}

PositionControl::Step PositionControl::step(const Pose& X_FB) {
  const double distance_m = math::hypot(command_.goal.x_m - X_FB.x_m, command_.goal.y_m - X_FB.y_m);
  switch (drive_.kind) {
    case DriveKind::kOmnidirectional:
      return omnidirectional_step(X_FB, distance_m);
    case DriveKind::kCar:
      return car_step(X_FB, distance_m);
    case DriveKind::kDifferential:
      break;
  }
  return differential_step(X_FB, distance_m);
}

void PositionControl::archive(StateArchive& archive, const DriveDescription& drive,
                              const MotionParams& params) {
  archive.fields(command_);
  archive(aligning_, backwards_, leaving_, sought_heading_, heading_abandoned_);
  if (!archive.reading()) return;
  drive_ = drive;
  params_ = params;
}

// --- Motion

Motion::Motion(std::string name, const MotionParams& params, const DriveDescription& drive,
               const RandomStream& noise)
    : Actuator(std::move(name), "motion"),
      enabled_(params.enabled_at_start),
      params_(params),
      drive_(drive),
      latency_ns_(from_seconds(params.latency_s)) {
  if (params.slip <= 0.0) return;
  slip_ = std::make_unique<SlipProcess>(SlipProcess{noise, {}});
  // The process is stationary, so it begins with its distribution.
  WheelSlip& slip = slip_->slip;
  for (double* one : {&slip.left, &slip.right, &slip.side}) {
    *one = std::clamp(slip_->noise.gaussian(params.slip), -kMostSlip, kMostSlip);
  }
}

WheelSlip Motion::slip() const noexcept {
  if (slip_ == nullptr) return {};
  const WheelSlip& slip = slip_->slip;
  return drive_.kind == DriveKind::kCar ? WheelSlip{slip.left, slip.left, 0.0} : slip;
}

void Motion::advance_slip(double dt_s) {
  const double kept = math::exp(-dt_s / params_.slip_time_s);
  const double spread = params_.slip * std::sqrt(1.0 - kept * kept);
  WheelSlip& slip = slip_->slip;
  for (double* one : {&slip.left, &slip.right, &slip.side}) {
    *one = std::clamp(kept * *one + slip_->noise.gaussian(spread), -kMostSlip, kMostSlip);
  }
}

Twist Motion::slipped(const Twist& twist) const {
  const WheelSlip slip = this->slip();
  const double half_m = 0.5 * drive_.wheel_separation_m;
  const double left_mps = (twist.v_mps - half_m * twist.omega_radps) * (1.0 - slip.left);
  const double right_mps = (twist.v_mps + half_m * twist.omega_radps) * (1.0 - slip.right);
  return {0.5 * (left_mps + right_mps), (right_mps - left_mps) / drive_.wheel_separation_m,
          twist.lateral_mps * (1.0 - slip.side)};
}

void Motion::stop() {
  mode_ = Mode::kTwist;
  commanded_ = {};
  commanded_steering_rad_ = 0.0;
}

// Clamps speeds to what the drive can do.
void Motion::command_turn(double v_mps, double lateral_mps, double turn_rate_radps) {
  commanded_ = {
      std::clamp(v_mps, -params_.max_speed_mps, params_.max_speed_mps),
      std::clamp(turn_rate_radps, -params_.max_turn_rate_radps, params_.max_turn_rate_radps), 0.0};
  if (drive_.kind == DriveKind::kOmnidirectional) {
    commanded_.lateral_mps = std::clamp(lateral_mps, -params_.max_speed_mps, params_.max_speed_mps);
  } else if (drive_.kind == DriveKind::kCar) {
    // A bicycle model turns at v tan(steering) / wheelbase.
    const double v = commanded_.v_mps;
    command_car(v, v == 0.0 ? 0.0 : math::atan(drive_.wheelbase_m * commanded_.omega_radps / v));
  }
}

void Motion::command_twist(const Twist& twist) {
  mode_ = Mode::kTwist;
  if (steers_by_commands()) return command_front_wheels(twist.v_mps, twist.omega_radps);
  command_turn(twist.v_mps, twist.lateral_mps, twist.omega_radps);
}

bool Motion::steers_by_commands() const {
  return drive_.kind == DriveKind::kCar && drive_.steering_commands;
}

// DRIVE_CAR of libstage/model_position.cc of Stage 4.
void Motion::command_front_wheels(double v_mps, double steering_rad) {
  const double steering =
      std::clamp(steering_rad, -drive_.max_steering_rad, drive_.max_steering_rad);
  command_turn(v_mps * math::cos(steering), 0.0, v_mps * math::sin(steering) / drive_.wheelbase_m);
}

void Motion::command_car(double v_mps, double steering_rad) {
  const double steering =
      std::clamp(steering_rad, -drive_.max_steering_rad, drive_.max_steering_rad);
  if (drive_.kind != DriveKind::kCar) {
    command_turn(v_mps, 0.0, v_mps * math::tan(steering) / drive_.wheelbase_m);
    return;
  }
  commanded_ = {std::clamp(v_mps, -params_.max_speed_mps, params_.max_speed_mps), 0.0, 0.0};
  commanded_steering_rad_ = steering;
}

std::optional<std::string> Motion::apply(const Command& command) {
  if (const auto* motors = std::get_if<MotorEnableCommand>(&command)) {
    enabled_ = motors->enabled;
    if (!enabled_) {
      stop();
      target_ = {};
    }
    return std::nullopt;
  }
  if (const auto* twist = std::get_if<TwistCommand>(&command)) {
    if (enabled_) command_twist(twist->twist);
    return std::nullopt;
  }
  if (const auto* heading = std::get_if<HeadingCommand>(&command)) {
    if (!enabled_) return std::nullopt;
    mode_ = Mode::kHeading;
    heading_ = *heading;
    return std::nullopt;
  }
  if (const auto* position = std::get_if<PositionCommand>(&command)) {
    if (!enabled_) return std::nullopt;
    const auto limited = [](double wish, double limit) {
      return wish == 0.0 ? limit : std::min(std::abs(wish), limit);
    };
    PositionCommand bounded = *position;
    bounded.goal.yaw_rad = normalize_angle(bounded.goal.yaw_rad);
    bounded.max_speed_mps = limited(position->max_speed_mps, params_.max_speed_mps);
    bounded.max_turn_rate_radps =
        limited(position->max_turn_rate_radps, params_.max_turn_rate_radps);
    mode_ = Mode::kPosition;
    position_ = PositionControl(drive_, params_, bounded);
    return std::nullopt;
  }
  if (const auto* car = std::get_if<CarCommand>(&command)) {
    if (!enabled_) return std::nullopt;
    mode_ = Mode::kCar;
    if (steers_by_commands()) {
      command_front_wheels(car->v_mps, car->steering_rad);
    } else {
      command_car(car->v_mps, car->steering_rad);
    }
    return std::nullopt;
  }
  return Device::apply(command);
}

std::optional<std::string> Motion::check(const Command& command, const RobotControl& robot) const {
  const auto* heading = std::get_if<HeadingCommand>(&command);
  const auto* position = std::get_if<PositionCommand>(&command);
  if (heading == nullptr && position == nullptr) return std::nullopt;
  const int frame = heading != nullptr ? heading->frame : position->frame;
  if (frame < 0 || robot.pose_estimate_of(frame)) return std::nullopt;
  return "the robot's device number " + std::to_string(frame) +
         " is no localisation device, in whose frame the motors could be told where to go";
}

std::optional<std::string> Motion::execute(const Command& command, RobotControl& robot) {
  if (auto refusal = check(command, robot)) return refusal;
  if (latency_ns_ == 0) return execute_now(command, robot);
  if (!drives(command) && !std::holds_alternative<MotorEnableCommand>(command)) {
    return Device::apply(command);
  }
  if (waiting_.size() >= kMostWaiting) {
    return "over " + std::to_string(kMostWaiting) + " commands wait for the latency of the motors";
  }
  waiting_.push_back({robot.context().now_ns + latency_ns_, command});
  return std::nullopt;
}

std::optional<std::string> Motion::execute_now(const Command& command, RobotControl& robot) {
  if (enabled_ && drives(command)) static_cast<void>(robot.acquire_motors(*this));
  return apply(command);
}

void Motion::act(RobotControl& robot) {
  if (!waiting_.empty()) {
    const SimTime now_ns = robot.context().now_ns;
    std::size_t due = 0;
    while (due < waiting_.size() && waiting_[due].due_ns <= now_ns) ++due;
    for (std::size_t i = 0; i < due; ++i) {
      static_cast<void>(execute_now(waiting_[i].command, robot));
    }
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(due));
  }
  if (mode_ != Mode::kHeading && mode_ != Mode::kPosition) return;
  const int frame = mode_ == Mode::kHeading ? heading_.frame : position_.command().frame;
  const Pose X_FB = frame < 0 ? robot.body().X_WB : robot.pose_estimate_of(frame).value_or(Pose{});
  if (mode_ == Mode::kHeading) {
    const double error_rad = normalize_angle(heading_.yaw_rad - X_FB.yaw_rad);
    command_turn(heading_.v_mps, heading_.lateral_mps, params_.turn_gain * error_rad);
    return;
  }
  const PositionControl::Step next = position_.step(X_FB);
  if (next.arrived) {
    stop();
  } else if (drive_.kind == DriveKind::kCar) {
    command_car(next.twist.v_mps, next.steering_rad);
  } else {
    command_turn(next.twist.v_mps, next.twist.lateral_mps, next.twist.omega_radps);
  }
}

void Motion::on_motors_taken() {
  mode_ = Mode::kTwist;
  waiting_.clear();
}

void Motion::placed(const Pose&) {
  stop();
  target_ = {};
  waiting_.clear();
}

void Motion::take_over_from(const Device&, SimTime later_ns) {
  for (Waiting& one : waiting_) one.due_ns += later_ns;
}

void Motion::deactivated(RobotControl&) {
  stop();
  waiting_.clear();
}

Twist Motion::next_target(double dt_s) {
  Twist target = ramped(dt_s);
  if (params_.speed_loss_mps > 0.0) {
    const double speed_mps = math::hypot(target.v_mps, target.lateral_mps);
    const double left_mps = std::max(0.0, speed_mps - params_.speed_loss_mps);
    const double reached = speed_mps > 0.0 ? left_mps / speed_mps : 0.0;
    target = {reached * target.v_mps, target.omega_radps, reached * target.lateral_mps};
  }
  if (params_.turn_loss_radps > 0.0) {
    const double left_radps = std::max(0.0, std::abs(target.omega_radps) - params_.turn_loss_radps);
    target.omega_radps = std::copysign(left_radps, target.omega_radps);
  }
  if (slip_ == nullptr) return target;
  advance_slip(dt_s);
  return slipped(target);
}

Twist Motion::ramped(double dt_s) {
  target_.v_mps = ramp(target_.v_mps, commanded_.v_mps, params_.max_acceleration_mps2, dt_s);
  if (drive_.kind == DriveKind::kCar) {
    steering_rad_ =
        ramp(steering_rad_, commanded_steering_rad_, drive_.max_steering_rate_radps, dt_s);
    target_.omega_radps = target_.v_mps * math::tan(steering_rad_) / drive_.wheelbase_m;
    return target_;
  }
  target_.lateral_mps =
      ramp(target_.lateral_mps, commanded_.lateral_mps, params_.max_acceleration_mps2, dt_s);
  target_.omega_radps =
      ramp(target_.omega_radps, commanded_.omega_radps, params_.max_turn_acceleration_radps2, dt_s);
  return target_;
}

Command Motion::present_command() const {
  if (mode_ == Mode::kHeading) return heading_;
  if (mode_ == Mode::kPosition) return position_.command();
  if (drive_.kind == DriveKind::kCar) {
    const double share = steers_by_commands() ? math::cos(commanded_steering_rad_) : 1.0;
    return CarCommand{commanded_.v_mps / share, commanded_steering_rad_};
  }
  return TwistCommand{commanded_};
}

void Motion::archive(StateArchive& archive) {
  Actuator::archive(archive);
  archive.choice(mode_, Mode::kCar);
  archive(enabled_, commanded_, target_, commanded_steering_rad_, steering_rad_);
  archive.fields(heading_);
  position_.archive(archive, drive_, params_);
  if (slip_ != nullptr) {
    WheelSlip& slip = slip_->slip;
    archive(slip_->noise, slip.left, slip.right, slip.side);
    archive.expect(
        std::max({std::abs(slip.left), std::abs(slip.right), std::abs(slip.side)}) <= kMostSlip,
        "slip of at most 0.5");
  }
  if (latency_ns_ == 0) return;
  archive.list(waiting_, [&archive](Waiting& one) {
    archive.time(one.due_ns);
    std::size_t kind = one.command.index();
    archive.index(kind, command_kinds().size());
    if (archive.reading()) one.command = command_kinds()[kind].make();
    archive.table(command_kinds()[kind].fields(), object_in(one.command));
  });
  archive.expect(waiting_.size() <= kMostWaiting, "fewer commands that wait");
}

namespace {

// Maximum steering angle of robots without steering; the turn rate reaches its limit long before.
constexpr double kMostSteering_rad = 80.0 * kDegrees;

/// The drive as seen by the motors: for car commands, a robot that is not a car has its own length
/// as the wheelbase.
DriveDescription drive_of(const RobotModel& model) {
  DriveDescription drive = model.drive;
  if (drive.kind == DriveKind::kCar || model.footprint.empty()) return drive;
  const auto [rear, front] =
      std::minmax_element(model.footprint.begin(), model.footprint.end(),
                          [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); });
  drive.wheelbase_m = front->x() - rear->x();
  drive.max_steering_rad = kMostSteering_rad;
  return drive;
}

}  // namespace

constexpr Field kMotionSettings[] = {
    field<&MotionParams::max_speed_mps>("max_speed", "m/s",
                                        "commands beyond it are clamped, either way")
        .above(0.0, 20.0),
    field<&MotionParams::max_turn_rate_radps>(
        "max_turn_rate_deg", "degrees/s",
        "commands beyond it are clamped, either way; default 3 rad/s")
        .above(0.0, 3600.0),
    field<&MotionParams::max_acceleration_mps2>("max_acceleration", "m/s^2",
                                                "0: no limit, the speed changes within a step")
        .within(0.0, 1000.0),
    field<&MotionParams::max_turn_acceleration_radps2>("max_turn_acceleration_deg", "degrees/s^2",
                                                       "0: no limit")
        .within(0.0, 1e6),
    field<&MotionParams::enabled_at_start>("enabled", "", "whether the motors are on at the start")
        .not_property(),
    field<&MotionParams::approach_gain>("approach_gain", "1/s",
                                        "position control: speed per metre of error")
        .above(0.0, 50.0),
    field<&MotionParams::turn_gain>(
        "turn_gain", "1/s", "control of position and heading: turn rate per radian of error")
        .above(0.0, 50.0),
    field<&MotionParams::tolerance_m>(
        "tolerance", "m", "position control: distance from the goal at which it is reached")
        .above(0.0, 1000.0),
    field<&MotionParams::heading_tolerance_rad>(
        "heading_tolerance_deg", "degrees",
        "position control: heading error at which the heading is reached; default 0.01 rad")
        .above(0.0, 180.0),
    field<&MotionParams::slip>("slip", "", "standard deviation of each wheel's slip")
        .within(0.0, 0.2)
        .with_realism(0.0, 0.01)
        .unlisted(0.0),
    field<&MotionParams::slip_time_s>("slip_time", "s",
                                      "time constant of the correlation of the slip")
        .above(0.0, 1000.0)
        .unlisted(MotionParams{}.slip_time_s),
    field<&MotionParams::speed_loss_mps>("speed_loss", "m/s",
                                         "by which the robot is slower than commanded")
        .within(0.0, 10.0)
        .with_realism(0.0, 0.0)
        .unlisted(0.0),
    field<&MotionParams::turn_loss_radps>("turn_loss_deg", "degrees/s",
                                          "by which it turns more slowly than commanded")
        .within(0.0, 3600.0)
        .with_realism(0.0, 0.0)
        .unlisted(0.0),
    field<&MotionParams::latency_s>("latency", "s", "time from a command until it takes effect")
        .within(0.0, 10.0)
        .with_realism(0.0, 0.02)
        .unlisted(0.0),
};
SIM_FIELDS(MotionParams, kMotionSettings)

DeviceKind motion_kind() {
  return device_kind<MotionParams, void>(
      "motion", {}, [](const DeviceConstruction& construction, const MotionParams& params) {
        return std::make_unique<Motion>(construction.name(), params, drive_of(construction.model),
                                        construction.noise());
      });
}

}  // namespace sim
