// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/actarray.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "devices/device_kind.h"
#include "sim/core/assert.h"
#include "sim/core/math.h"
#include "sim/devices/arm_kinematics.h"
#include "sim/devices/robot_snapshot.h"
#include "sim/world/description.h"

namespace sim {
namespace {

// A joint whose braking distance ends within this distance of the goal brakes [m or rad]. It is far
// above the rounding errors of a movement, and invisible.
constexpr double kReached = 1e-10;

constexpr double kPi = std::numbers::pi;

}  // namespace

JointTravel travel_of(const JointParams& joint) {
  const bool is_linear = joint.type == JointType::kLinear;
  JointTravel travel;
  travel.min = is_linear ? joint.min_m.value_or(0.0) : joint.min_rad.value_or(-0.5 * kPi);
  travel.max = is_linear ? joint.max_m.value_or(0.1) : joint.max_rad.value_or(0.5 * kPi);
  travel.centre =
      (is_linear ? joint.centre_m : joint.centre_rad).value_or(0.5 * (travel.min + travel.max));
  travel.home = (is_linear ? joint.home_m : joint.home_rad).value_or(travel.centre);
  travel.speed_max =
      is_linear ? joint.speed_max_mps.value_or(0.1) : joint.speed_max_radps.value_or(0.5 * kPi);
  travel.speed = (is_linear ? joint.speed_mps : joint.speed_radps).value_or(0.5 * travel.speed_max);
  travel.acceleration_max = is_linear ? joint.acceleration_max_mps2.value_or(0.2)
                                      : joint.acceleration_max_radps2.value_or(kPi);
  travel.acceleration = (is_linear ? joint.acceleration_mps2 : joint.acceleration_radps2)
                            .value_or(0.5 * travel.acceleration_max);
  return travel;
}

std::vector<JointParams> default_joints() {
  std::vector<JointParams> joints(5);
  const auto set = [&joints](std::size_t i, JointAxis axis, double length_m) {
    joints[i].axis = axis;
    joints[i].length_m = length_m;
  };
  set(0, JointAxis::kZ, 0.07);
  set(1, JointAxis::kMinusY, 0.16);
  set(2, JointAxis::kMinusY, 0.14);
  set(3, JointAxis::kX, 0.05);
  set(4, JointAxis::kMinusY, 0.08);
  return joints;
}

JointMotion advance_to_goal(JointMotion motion, double goal, double speed, double acceleration,
                            double dt_s) {
  // A movement has at most five phases: braking, braking to the maximum speed, accelerating,
  // cruising and braking to the goal. Rounding can split a phase.
  constexpr int kMostPhases = 16;
  for (int phase = 0; phase < kMostPhases && dt_s > 0.0; ++phase) {
    const double braking = 0.5 * motion.speed * std::abs(motion.speed) / acceleration;
    const double missing = goal - (motion.position + braking);
    if (std::abs(missing) <= kReached) {
      if (std::abs(motion.speed) <= acceleration * dt_s) return {goal, 0.0};
      const double change = -std::copysign(acceleration * dt_s, motion.speed);
      return {motion.position + (motion.speed + 0.5 * change) * dt_s, motion.speed + change};
    }
    // From here on along the direction in which the goal is missed.
    const double side = std::copysign(1.0, missing);
    const double v = side * motion.speed;
    double rate = 0.0;
    double time_s = std::abs(missing) / speed;
    double end_speed = speed;
    if (v < 0.0) {
      rate = acceleration;
      time_s = -v / acceleration;
      end_speed = 0.0;
    } else if (v > speed) {
      rate = -acceleration;
      time_s = (v - speed) / acceleration;
    } else if (v < speed) {
      // Up to the maximum speed, or to the speed from which braking ends at the goal:
      // 2 v t + a t^2 = missing.
      rate = acceleration;
      time_s = (speed - v) / acceleration;
      const double peak = std::sqrt(v * v + acceleration * std::abs(missing));
      if (peak < speed) {
        time_s = (peak - v) / acceleration;
        end_speed = peak;
      }
    }
    const bool ends = time_s <= dt_s;
    const double t_s = ends ? time_s : dt_s;
    motion.position += side * (v + 0.5 * rate * t_s) * t_s;
    motion.speed = side * (ends ? end_speed : v + rate * t_s);
    dt_s -= t_s;
  }
  return motion;
}

JointMotion advance_with_current(JointMotion motion, double current_share,
                                 const JointTravel& travel, double dt_s) {
  const double final_speed = current_share * travel.speed_max;
  const double per_s = travel.acceleration_max / travel.speed_max;
  const double gone = -math::expm1(-per_s * dt_s);  // share of the difference that has vanished
  const double difference = motion.speed - final_speed;
  return {motion.position + final_speed * dt_s + difference * gone / per_s,
          final_speed + difference * (1.0 - gone)};
}

Eigen::Isometry3d ActArray::end_in_body() const { return arm_frames(params_, positions()).back(); }

bool ActArray::at_rest() const noexcept {
  return !trajectory_ && std::ranges::all_of(joints_, [](const Joint& joint) {
    return joint.mode == Mode::kStill ||
           (joint.mode == Mode::kGoal && joint.motion.position == joint.goal &&
            joint.motion.speed == 0.0);
  });
}

std::vector<std::string> ActArray::joint_names() const {
  std::vector<std::string> names;
  for (const JointParams& joint : params_.joints) {
    names.push_back(joint.name.empty() ? "joint" + std::to_string(names.size() + 1) : joint.name);
  }
  return names;
}

std::vector<double> ActArray::positions() const {
  std::vector<double> all;
  for (const Joint& joint : joints_) all.push_back(joint.motion.position);
  return all;
}

// --- one joint

void ActArray::Joint::go_to(double position) {
  mode = Mode::kGoal;
  goal = std::clamp(position, travel.min, travel.max);
  speed = speed_setting;
  acceleration = acceleration_setting;
  is_stalled = false;
}

void ActArray::Joint::move_at(double wanted) {
  if (wanted == 0.0) {  // to the point at which it stops if it brakes now
    const double braking = 0.5 * motion.speed * std::abs(motion.speed) / acceleration_setting;
    go_to(motion.position + braking);
    speed = travel.speed_max;
    return;
  }
  go_to(wanted > 0.0 ? travel.max : travel.min);
  mode = Mode::kSpeed;
  speed = std::min(std::abs(wanted), travel.speed_max);
}

void ActArray::Joint::push(double wanted_a) {
  mode = Mode::kCurrent;
  current_share = std::clamp(wanted_a / current_max_a, -1.0, 1.0);
  is_stalled = false;
}

void ActArray::Joint::stop() {
  mode = Mode::kStill;
  motion.speed = 0.0;
  is_stalled = false;
}

void ActArray::Joint::step(double dt_s) {
  const double speed_before = motion.speed;
  if (mode != Mode::kStill && !is_stalled) {
    motion = mode == Mode::kCurrent ? advance_with_current(motion, current_share, travel, dt_s)
                                    : advance_to_goal(motion, goal, speed, acceleration, dt_s);
    const bool passed_max = motion.position > travel.max;
    const bool passed_min = motion.position < travel.min;
    if (passed_max || passed_min) {
      motion = {passed_max ? travel.max : travel.min, 0.0};
      is_stalled =
          mode == Mode::kCurrent && (passed_max ? current_share > 0.0 : current_share < 0.0);
    }
    if (mode == Mode::kSpeed && motion.speed == 0.0 && motion.position == goal) is_stalled = true;
  }
  mean_acceleration = (motion.speed - speed_before) / dt_s;
}

double ActArray::Joint::current_a() const {
  switch (mode) {
    case Mode::kStill:
      return 0.0;
    case Mode::kCurrent:
      return current_share * current_max_a;
    case Mode::kSpeed:
      if (is_stalled) return goal == travel.max ? current_max_a : -current_max_a;
      break;
    case Mode::kGoal:
      break;
  }
  return current_max_a *
         (mean_acceleration / travel.acceleration_max + motion.speed / travel.speed_max);
}

void ActArray::Joint::archive(StateArchive& archive) {
  archive(motion.position, motion.speed, mean_acceleration, speed_setting, acceleration_setting);
  archive.choice(mode, Mode::kCurrent);
  archive(goal, speed, acceleration, current_share, is_stalled);
  const auto within = [this](double position) {
    return travel.min <= position && position <= travel.max;
  };
  archive.expect(within(motion.position) && within(goal), "a joint within its limits");
  archive.expect(speed_setting > 0.0 && acceleration_setting > 0.0 && speed > 0.0 &&
                     acceleration > 0.0 && std::abs(current_share) <= 1.0,
                 "a joint that can move");
}

// --- the arm

ActArray::ActArray(std::string name, const ActArrayParams& params)
    : SensorOf(std::move(name), "actarray", params.frequency_hz),
      params_(params),
      is_powered_(params.is_powered) {
  if (params_.joints.empty()) params_.joints = default_joints();
  SIM_ASSERT(params_.joints.size() <= ActArrayParams::kMaxJoints);
  for (const JointParams& settings : params_.joints) {
    Joint& joint = joints_.emplace_back();
    joint.travel = travel_of(settings);
    joint.current_max_a = settings.current_max_a;
    joint.has_brake = settings.has_brake;
    joint.motion.position = joint.goal = joint.travel.home;
    joint.speed_setting = joint.speed = joint.travel.speed;
    joint.acceleration_setting = joint.acceleration = joint.travel.acceleration;
  }
}

std::optional<std::string> ActArray::apply(const Command& command) {
  if (const auto* move = std::get_if<JointCommand>(&command)) return apply(*move);
  if (const auto* setting = std::get_if<JointSettingCommand>(&command)) return apply(*setting);
  if (const auto* path = std::get_if<TrajectoryCommand>(&command)) return apply(*path);
  return Sensor::apply(command);
}

std::string ActArray::no_such_joint(int joint) const {
  return "device " + name() + " has " + std::to_string(joints_.size()) +
         " joints, counted from 0; there is no joint " + std::to_string(joint);
}

std::optional<std::string> ActArray::apply(const JointCommand& command) {
  const bool goes_home = command.mode == JointCommand::Mode::kHome;
  const bool moves_all = command.joint == -1;
  const std::size_t least = goes_home ? 0 : 1;
  const std::size_t most = goes_home ? 0 : (moves_all ? 1 : ActArrayParams::kMaxJoints);
  if (command.values.size() < least || command.values.size() > most) {
    return "a command to joints of device " + name() + " has " +
           std::to_string(command.values.size()) + " values; a joint needs " +
           (goes_home ? "none to go home" : "one, and all joints together need one");
  }
  if (!std::ranges::all_of(command.values, [](double value) { return std::isfinite(value); })) {
    return "a value for a joint of device " + name() + " is not finite";
  }
  const int count = static_cast<int>(joints_.size());
  const int first = moves_all ? 0 : command.joint;
  const int moved = goes_home ? 1 : static_cast<int>(command.values.size());
  if (first < 0 || first >= count) return no_such_joint(command.joint);
  const int end = moves_all ? count : first + moved;
  if (end > count) return no_such_joint(end - 1);
  if (!is_powered_) return std::nullopt;
  trajectory_.reset();
  for (int i = first; i < end; ++i) {
    Joint& joint = joints_[static_cast<std::size_t>(i)];
    if (is_braked(joint)) continue;
    const double value = goes_home
                             ? joint.travel.home
                             : command.values[moves_all ? 0 : static_cast<std::size_t>(i - first)];
    switch (command.mode) {
      case JointCommand::Mode::kPosition:
      case JointCommand::Mode::kHome:
        joint.go_to(value);
        break;
      case JointCommand::Mode::kPlace:
        joint.motion = {std::clamp(value, joint.travel.min, joint.travel.max), 0.0};
        joint.stop();
        break;
      case JointCommand::Mode::kSpeed:
        joint.move_at(value);
        break;
      case JointCommand::Mode::kCurrent:
        joint.push(value);
        break;
    }
  }
  return std::nullopt;
}

std::optional<std::string> ActArray::apply(const JointSettingCommand& command) {
  if (command.setting == JointSettingCommand::Setting::kPower) {
    is_powered_ = command.value != 0.0;
    if (!is_powered_) trajectory_.reset();
    for (Joint& joint : joints_) {
      if (!is_powered_) joint.stop();
    }
    return std::nullopt;
  }
  if (command.setting == JointSettingCommand::Setting::kBrakes) {
    return set_brakes(command.value != 0.0);
  }
  const bool is_speed = command.setting == JointSettingCommand::Setting::kSpeed;
  const auto count = static_cast<int>(joints_.size());
  if (command.joint < -1 || command.joint >= count) return no_such_joint(command.joint);
  if (!std::isfinite(command.value) || command.value == 0.0) {
    return std::string("the ") + (is_speed ? "speed" : "acceleration") + " of a joint of device " +
           name() + " cannot be set to 0";
  }
  const int first = command.joint == -1 ? 0 : command.joint;
  const int end = command.joint == -1 ? count : command.joint + 1;
  for (int i = first; i < end; ++i) {
    Joint& joint = joints_[static_cast<std::size_t>(i)];
    if (is_speed) {
      joint.speed_setting = std::min(std::abs(command.value), joint.travel.speed_max);
    } else {
      joint.acceleration_setting = std::min(std::abs(command.value), joint.travel.acceleration_max);
    }
  }
  return std::nullopt;
}

std::optional<std::string> ActArray::set_brakes(bool applied) {
  const bool has_any =
      std::ranges::any_of(joints_, [](const Joint& joint) { return joint.has_brake; });
  if (applied && !has_any) return "no joint of device " + name() + " has a brake";
  brakes_ = applied;
  for (Joint& joint : joints_) {
    if (is_braked(joint)) joint.stop();
  }
  return std::nullopt;
}

// --- trajectories

void ArmTrajectory::archive(StateArchive& archive) {
  archive.time(start_ns);
  archive(has_started, origin, times_s, positions);
}

double ArmTrajectory::position(std::size_t joint, double time_s) const {
  const std::size_t joints = origin.size();
  double from = origin[joint];
  double from_s = 0.0;
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    const double to = positions[i * joints + joint];
    if (time_s < times_s[i]) return from + (to - from) * (time_s - from_s) / (times_s[i] - from_s);
    from = to;
    from_s = times_s[i];
  }
  return from;
}

std::optional<std::string> ActArray::apply(const TrajectoryCommand& command) {
  const auto refuse = [this](const std::string& text) {
    return "a trajectory of device " + name() + " " + text;
  };
  if (command.times_s.empty() || command.times_s.size() > kMaxTrajectory) {
    return refuse("has 1 to " + std::to_string(kMaxTrajectory) + " points, not " +
                  std::to_string(command.times_s.size()));
  }
  if (command.positions.size() != command.times_s.size() * joints_.size()) {
    return refuse("needs " + std::to_string(joints_.size()) + " positions for each of its " +
                  std::to_string(command.times_s.size()) + " points, and has " +
                  std::to_string(command.positions.size()) + " in all");
  }
  if (command.times_s.front() < 0.0 || !std::ranges::is_sorted(command.times_s)) {
    return refuse("needs times in ascending order, from 0 on");
  }
  const auto is_finite = [](double value) { return std::isfinite(value); };
  if (!std::ranges::all_of(command.times_s, is_finite) ||
      !std::ranges::all_of(command.positions, is_finite)) {
    return refuse("has a number that is not finite");
  }
  constexpr double kLatest_s = 1e9;
  if (command.times_s.back() > kLatest_s || command.start_s.value_or(0.0) > kLatest_s) {
    return refuse("has a time after 1e9 s");
  }
  if (!is_powered_) return std::nullopt;
  for (Joint& joint : joints_) joint.stop();
  trajectory_.emplace();
  trajectory_->start_ns = from_seconds(std::max(0.0, command.start_s.value_or(0.0)));
  trajectory_->origin = positions();
  trajectory_->times_s = command.times_s;
  trajectory_->positions = command.positions;
  return std::nullopt;
}

// The times count from the wanted start, or from the beginning of the first step after the command.
void ActArray::follow_trajectory(const StepContext& context) {
  const SimTime step_ns = context.world.simulation.step_ns;
  const double dt_s = to_seconds(step_ns);
  if (!trajectory_->has_started) {
    trajectory_->has_started = true;
    trajectory_->start_ns = std::max(trajectory_->start_ns, context.now_ns - step_ns);
    trajectory_->origin = positions();
  }
  const double time_s = to_seconds(context.now_ns - trajectory_->start_ns);
  bool arrived = time_s >= trajectory_->times_s.back();
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    Joint& joint = joints_[i];
    const double speed_before = joint.motion.speed;
    const double wanted =
        std::clamp(trajectory_->position(i, time_s), joint.travel.min, joint.travel.max);
    const double most = joint.travel.speed_max * dt_s;
    const double way =
        is_braked(joint) ? 0.0 : std::clamp(wanted - joint.motion.position, -most, most);
    const bool is_there = is_braked(joint) || wanted - joint.motion.position == way;
    joint.motion = {is_there && way != 0.0 ? wanted : joint.motion.position + way, way / dt_s};
    joint.mean_acceleration = (joint.motion.speed - speed_before) / dt_s;
    arrived = arrived && is_there;
  }
  if (!arrived) return;
  trajectory_.reset();
  for (Joint& joint : joints_) joint.stop();
}

void ActArray::integrate(const StepContext& context) {
  const double dt_s = to_seconds(context.world.simulation.step_ns);
  if (trajectory_ && context.now_ns > trajectory_->start_ns) return follow_trajectory(context);
  for (Joint& joint : joints_) joint.step(dt_s);
}

JointState ActArray::state_of(const Joint& joint) const {
  if (is_braked(joint)) return JointState::kBraked;
  if (joint.is_stalled) return JointState::kStalled;
  bool moves = joint.motion.speed != 0.0;
  switch (joint.mode) {
    case Mode::kStill:
      break;
    case Mode::kGoal:
      moves = moves || joint.motion.position != joint.goal;
      break;
    case Mode::kSpeed:
      moves = true;
      break;
    case Mode::kCurrent:
      moves = moves || joint.current_share != 0.0;
      break;
  }
  return moves ? JointState::kMoving : JointState::kIdle;
}

void ActArray::measure(const StepContext& context) {
  auto& reading = next(context);
  reading.is_powered = is_powered_;
  reading.joints.resize(joints_.size());
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const Joint& joint = joints_[i];
    reading.joints[i] = {state_of(joint),           joint.motion.position, joint.motion.speed,
                         joint.mean_acceleration,   joint.current_a(),     joint.speed_setting,
                         joint.acceleration_setting};
  }
}

void ActArray::show(SimTime, RobotSnapshot& shot) const {
  std::vector<Vec2>& seen = shot.arms.emplace_back();
  for (const std::array<double, 3>& p : arm_points_m(params_, positions())) {
    seen.emplace_back(p[0], p[1]);
  }
}

void ActArray::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(is_powered_, brakes_, trajectory_);
  archive.expect(!trajectory_ || (!trajectory_->times_s.empty() &&
                                  trajectory_->positions.size() ==
                                      trajectory_->times_s.size() * joints_.size() &&
                                  trajectory_->origin.size() == joints_.size()),
                 "a trajectory of all joints");
  for (Joint& joint : joints_) archive(joint);
  const std::size_t measured = reading().joints.size();
  archive.expect(measured == 0 || measured == joints_.size(), "a reading of each joint");
}

// --- fields

namespace {

template <typename... Members>
bool any_of(const Members&... members) {
  return (members.has_value() || ...);
}

std::optional<FieldError> check_joint(const void* object) {
  const auto& j = *static_cast<const JointParams*>(object);
  const bool is_linear = j.type == JointType::kLinear;
  const bool has_angles =
      any_of(j.min_rad, j.centre_rad, j.max_rad, j.home_rad, j.speed_radps, j.speed_max_radps,
             j.acceleration_radps2, j.acceleration_max_radps2);
  const bool has_lengths = any_of(j.min_m, j.centre_m, j.max_m, j.home_m, j.speed_mps,
                                  j.speed_max_mps, j.acceleration_mps2, j.acceleration_max_mps2);
  if (is_linear ? has_angles : has_lengths) {
    return FieldError{"device/joint-unit",
                      is_linear ? "limits and speeds of a linear joint in metres"
                                : "limits and speeds of a rotary joint in degrees",
                      is_linear ? "keys that end in _deg" : "keys without _deg",
                      is_linear ? "write \"min\", \"max\", \"speed\", ... without \"_deg\""
                                : "write \"min_deg\", \"max_deg\", \"speed_deg\", ..."};
  }
  const JointTravel t = travel_of(j);
  const double unit = is_linear ? 1.0 : kDegrees;
  const auto text = [&](double value) {
    return rounded_text(value / unit, 6) + (is_linear ? " m" : " degrees");
  };
  const auto error = [](std::string expected, std::string found) {
    return FieldError{"device/joint-range", std::move(expected), std::move(found), ""};
  };
  if (!(t.min < t.max)) {
    return error("a minimum of a joint that is less than its maximum",
                 text(t.min) + " and " + text(t.max));
  }
  for (const auto& [name, value] : {std::pair("centre", t.centre), std::pair("home", t.home)}) {
    if (value >= t.min && value <= t.max) continue;
    return error(
        std::string("a ") + name + " of a joint between " + text(t.min) + " and " + text(t.max),
        text(value));
  }
  if (t.speed > t.speed_max) {
    return error("a speed of a joint of at most " + text(t.speed_max) + "/s", text(t.speed) + "/s");
  }
  if (t.acceleration > t.acceleration_max) {
    return error("an acceleration of a joint of at most " + text(t.acceleration_max) + "/s^2",
                 text(t.acceleration) + "/s^2");
  }
  return std::nullopt;
}

template <auto kMember>
constexpr Field angle_limit(const char* name, const char* meaning) {
  return field<kMember>(name, "degrees", meaning).within(-3600.0, 3600.0);
}
template <auto kMember>
constexpr Field angle_rate(const char* name, const char* unit, const char* meaning) {
  return field<kMember>(name, unit, meaning).within(0.001, 36000.0);
}
template <auto kMember>
constexpr Field length_limit(const char* name, const char* meaning) {
  return field<kMember>(name, "m", meaning).within(-10.0, 10.0);
}
template <auto kMember>
constexpr Field length_rate(const char* name, const char* unit, const char* meaning) {
  return field<kMember>(name, unit, meaning).within(1e-5, 100.0);
}

}  // namespace

constexpr const char* kJointTypes[] = {"rotary", "linear"};
constexpr const char* kJointAxes[] = {"x", "y", "z", "-x", "-y", "-z"};
constexpr const char* kJointStates[] = {"idle", "moving", "braked", "stalled"};

constexpr Field kJointParams[] = {
    field<&JointParams::name>("name", "",
                              "for posture devices; `\"\"`: joint1, joint2, ... by place"),
    field<&JointParams::type>("type", "", "whether the joint turns or slides").one_of(kJointTypes),
    field<&JointParams::length_m>("length", "m", "of the link between this joint and the next one")
        .within(0.0, 10.0),
    field<&JointParams::roll_rad>("roll_deg", "degrees",
                                  "orientation at position 0, relative to the previous link"),
    field<&JointParams::pitch_rad>("pitch_deg", "degrees", "as roll_deg; positive: downwards"),
    field<&JointParams::yaw_rad>("yaw_deg", "degrees", "as roll_deg; counter-clockwise"),
    field<&JointParams::axis>(
        "axis", "", "axis about which the joint turns or along which it slides, in its own frame")
        .one_of(kJointAxes),
    angle_limit<&JointParams::min_rad>("min_deg", "minimum position of a rotary joint"),
    angle_limit<&JointParams::centre_rad>("centre_deg", "centre position of a rotary joint"),
    angle_limit<&JointParams::max_rad>("max_deg", "maximum position of a rotary joint"),
    angle_limit<&JointParams::home_rad>("home_deg", "home position of a rotary joint"),
    angle_rate<&JointParams::speed_radps>("speed_deg", "degrees/s",
                                          "initial speed of a rotary joint for position commands"),
    angle_rate<&JointParams::speed_max_radps>("speed_max_deg", "degrees/s",
                                              "maximum speed of a rotary joint"),
    angle_rate<&JointParams::acceleration_radps2>("acceleration_deg", "degrees/s^2",
                                                  "initial acceleration of a rotary joint"),
    angle_rate<&JointParams::acceleration_max_radps2>("acceleration_max_deg", "degrees/s^2",
                                                      "maximum acceleration of a rotary joint"),
    length_limit<&JointParams::min_m>("min", "minimum position of a linear joint"),
    length_limit<&JointParams::centre_m>("centre", "centre position of a linear joint"),
    length_limit<&JointParams::max_m>("max", "maximum position of a linear joint"),
    length_limit<&JointParams::home_m>("home", "home position of a linear joint"),
    length_rate<&JointParams::speed_mps>("speed", "m/s",
                                         "initial speed of a linear joint for position commands"),
    length_rate<&JointParams::speed_max_mps>("speed_max", "m/s", "maximum speed of a linear joint"),
    length_rate<&JointParams::acceleration_mps2>("acceleration", "m/s^2",
                                                 "initial acceleration of a linear joint"),
    length_rate<&JointParams::acceleration_max_mps2>("acceleration_max", "m/s^2",
                                                     "maximum acceleration of a linear joint"),
    field<&JointParams::has_brake>("brake", "", "whether the joint has a brake"),
    field<&JointParams::current_max_a>("current_max", "A", "maximum current of the motor")
        .above(0.0, 1000.0),
};
SIM_FIELDS(JointParams, kJointParams, check_joint)

constexpr Field kActArraySettings[] = {
    frequency_field<&ActArrayParams::frequency_hz>(),
    mount_field<&ActArrayParams::X_BA>("pose of the arm's base on the body, seen from above"),
    height_field<&ActArrayParams::height_m>("of the base above the floor"),
    field<&ActArrayParams::roll_rad>("roll_deg", "degrees",
                                     "turn of the base about its x axis, after yaw and pitch"),
    field<&ActArrayParams::pitch_rad>("pitch_deg", "degrees",
                                      "turn of the base about its y axis; positive: downwards"),
    field<&ActArrayParams::is_powered>("power", "", "whether the motors are on at the start"),
    field<&ActArrayParams::joints>("joints", "m, degrees",
                                   "list of at most 16 joints, from the base outwards; none: an "
                                   "arm of five rotary joints")
        .counting(0, ActArrayParams::kMaxJoints)
        .listing_elements(),
};
SIM_FIELDS(ActArrayParams, kActArraySettings)

constexpr Field kJointReading[] = {
    field<&JointReading::state>("state").one_of(kJointStates),
    field<&JointReading::position>("position", "m or rad"),
    field<&JointReading::speed>("speed", "m/s or rad/s"),
    field<&JointReading::acceleration>("acceleration", "m/s^2 or rad/s^2"),
    field<&JointReading::current_a>("current", "A"),
    field<&JointReading::speed_setting>("speed_setting", "m/s or rad/s"),
    field<&JointReading::acceleration_setting>("acceleration_setting", "m/s^2 or rad/s^2"),
};
SIM_FIELDS(JointReading, kJointReading)

constexpr Field kActArrayReading[] = {
    field<&ActArrayReading::joints>("joints", "",
                                    "from the base outwards; `state`: `\"idle\"`, `\"moving\"`, "
                                    "`\"braked\"` or `\"stalled\"`; m or rad, per s, per s^2, A"),
    field<&ActArrayReading::is_powered>("power", "", "whether the motors are on"),
};
SIM_FIELDS(ActArrayReading, kActArrayReading)

namespace {

/// The settings as clients see them: with the default joints and all limits.
std::map<std::string, double> properties_of(ActArrayParams params) {
  if (params.joints.empty()) params.joints = default_joints();
  std::map<std::string, double> properties;
  add_properties(fields_of<ActArrayParams>(), &params, properties);
  for (std::size_t i = 0; i < params.joints.size(); ++i) {
    const JointTravel travel = travel_of(params.joints[i]);
    const std::string number = std::to_string(i);
    properties["min_" + number] = travel.min;
    properties["centre_" + number] = travel.centre;
    properties["max_" + number] = travel.max;
    properties["home_" + number] = travel.home;
    properties["speed_" + number] = travel.speed;
    properties["speed_max_" + number] = travel.speed_max;
    properties["acceleration_" + number] = travel.acceleration;
    properties["acceleration_max_" + number] = travel.acceleration_max;
  }
  return properties;
}

}  // namespace

DeviceKind actarray_kind() {
  DeviceKind row =
      device_kind<ActArray, ActArrayParams, ActArrayReading>("actarray", {{"actarray"}});
  row.model_properties = [](const std::any& params, const RobotModel&) {
    return properties_of(params_in<ActArrayParams>(params));
  };
  return row;
}

}  // namespace sim
