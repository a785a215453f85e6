// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Requests to MORSE's Armature.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "server/morse_services.h"
#include "server/morse_state.h"
#include "sim/core/elevation.h"
#include "sim/devices/actarray.h"
#include "sim/devices/arm_kinematics.h"
#include "sim/simulation/simulation.h"

namespace playerlike::server {
namespace {

using nlohmann::json;
using Right = MorseService::Right;

constexpr double kMost = 1e6;  // of any number in a request

std::vector<std::string> joint_names(const MorseCall& call) {
  return ask<sim::ActArray>(call, &sim::ActArray::joint_names);
}

// Index of a joint of the arm, which is of the wanted type, if any. @throws MorseRefusal.
int joint_of(MorseCall& call, const std::string& name, std::optional<sim::JointType> type) {
  return ask<sim::ActArray>(call, [&](const sim::ActArray& arm) {
    const std::vector<std::string> names = arm.joint_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      throw MorseRefusal("Joint <" + name + "> does not exist in armature " + call.component->name);
    }
    const auto index = found - names.begin();
    const bool is_linear =
        arm.params().joints[static_cast<std::size_t>(index)].type == sim::JointType::kLinear;
    if (is_linear && type == sim::JointType::kRotary) {
      throw MorseRefusal("Joint " + name + " is not a revolute joint! Can not set the rotation");
    }
    if (!is_linear && type == sim::JointType::kLinear) {
      throw MorseRefusal("Joint " + name +
                         " is not a prismatic joint! Can not set the translation");
    }
    return static_cast<int>(index);
  });
}

json place_joint(MorseCall& call, sim::JointType type) {
  const int joint = joint_of(call, call.arguments.text(0), type);
  const double value = call.arguments.number(1, -kMost, kMost);
  command(call, sim::JointCommand{sim::JointCommand::Mode::kPlace, joint, {value}});
  return nullptr;
}
json set_rotation(MorseCall& call) { return place_joint(call, sim::JointType::kRotary); }
json set_translation(MorseCall& call) { return place_joint(call, sim::JointType::kLinear); }

// Places the first joints, all of the given type.
json place_joints(MorseCall& call, sim::JointType type) {
  const std::vector<std::string> names = joint_names(call);
  std::vector<double> values;
  for (const json& value : call.arguments.list(0)) {
    if (values.size() == names.size()) break;  // as in MORSE, the rest is discarded
    if (!value.is_number()) call.arguments.refuse(0, "a list of numbers");
    static_cast<void>(joint_of(call, names[values.size()], type));
    values.push_back(value.get<double>());
  }
  if (values.empty()) return nullptr;
  command(call, sim::JointCommand{sim::JointCommand::Mode::kPlace, 0, std::move(values)});
  return nullptr;
}
json set_rotations(MorseCall& call) { return place_joints(call, sim::JointType::kRotary); }
json set_translations(MorseCall& call) { return place_joints(call, sim::JointType::kLinear); }

bool arm_rests(const sim::Device& device) {
  return dynamic_cast<const sim::ActArray&>(device).at_rest();
}

// A joint's speed if a request names none.
double usual_speed_of(MorseCall& call, int joint) {
  return ask<sim::ActArray>(call, [&](const sim::ActArray& arm) {
    return sim::travel_of(arm.params().joints.at(static_cast<std::size_t>(joint))).speed;
  });
}

void set_speed_of(MorseCall& call, int joint, double speed) {
  command(call, sim::JointSettingCommand{sim::JointSettingCommand::Setting::kSpeed, joint, speed});
}

json move_joint(MorseCall& call, sim::JointType type) {
  const int joint = joint_of(call, call.arguments.text(0), type);
  const double value = call.arguments.number(1, -kMost, kMost);
  set_speed_of(call, joint, call.arguments.number(2, 1e-6, kMost, usual_speed_of(call, joint)));
  answer_when(call, sim::JointCommand{sim::JointCommand::Mode::kPosition, joint, {value}},
              arm_rests);
  return nullptr;
}
json rotate_joint(MorseCall& call) { return move_joint(call, sim::JointType::kRotary); }
json translate_joint(MorseCall& call) { return move_joint(call, sim::JointType::kLinear); }

// Moves the joints of an object {name: value}. The others stay.
json move_joints(MorseCall& call, sim::JointType type) {
  const json& wanted = call.arguments.any(0);
  if (!wanted.is_object()) call.arguments.refuse(0, "an object {joint: value}");
  std::vector<double> values = ask<sim::ActArray>(call, &sim::ActArray::positions);
  for (const auto& [name, value] : wanted.items()) {
    const int joint = joint_of(call, name, type);
    if (!value.is_number()) call.arguments.refuse(0, "an object {joint: number}");
    set_speed_of(call, joint, call.arguments.number(1, 1e-6, kMost, usual_speed_of(call, joint)));
    values[static_cast<std::size_t>(joint)] = value.get<double>();
  }
  answer_when(call, sim::JointCommand{sim::JointCommand::Mode::kPosition, 0, std::move(values)},
              arm_rests);
  return nullptr;
}
json rotate_joints(MorseCall& call) { return move_joints(call, sim::JointType::kRotary); }
json translate_joints(MorseCall& call) { return move_joints(call, sim::JointType::kLinear); }

json joints_of_arm(MorseCall& call) { return joint_names(call); }

json stop_arm(MorseCall& call) {
  command(call, sim::JointCommand{sim::JointCommand::Mode::kSpeed, -1, {0.0}});
  return nullptr;
}

// --- limits

json degrees_of_freedom(MorseCall& call) {
  return ask<sim::ActArray>(call, [](const sim::ActArray& arm) {
    const std::vector<std::string> names = arm.joint_names();
    json all = json::object();
    for (std::size_t i = 0; i < names.size(); ++i) {
      const int axis = static_cast<int>(arm.params().joints[i].axis) % 3;
      all[names[i]] = {axis == 0, axis == 1, axis == 2};
    }
    return all;
  });
}

json limits_of_joint(MorseCall& call) {
  const int joint = joint_of(call, call.arguments.text(0), {});
  return ask<sim::ActArray>(call, [&](const sim::ActArray& arm) {
    const sim::JointTravel travel =
        sim::travel_of(arm.params().joints[static_cast<std::size_t>(joint)]);
    return json::array({travel.min, travel.max});
  });
}

// --- trajectories

bool has_come_to_its_end(const sim::Device& device) {
  return !dynamic_cast<const sim::ActArray&>(device).on_trajectory();
}

// A number of a trajectory. @throws MorseRefusal with MORSE's text for a missing key.
double number_in(MorseCall& call, const json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) {
    throw MorseRefusal(std::string("Error: invalid trajectory: key '") + key + "' was expected.");
  }
  if (!found->is_number()) call.arguments.refuse(0, std::string("a number for ") + key);
  return found->get<double>();
}

json trajectory(MorseCall& call) {
  const json& wanted = call.arguments.any(0);
  if (!wanted.is_object()) call.arguments.refuse(0, "an object with points");
  sim::TrajectoryCommand command;
  if (wanted.contains("starttime")) command.start_s = number_in(call, wanted, "starttime");
  const auto points = wanted.find("points");
  if (points == wanted.end()) {
    throw MorseRefusal("Error: invalid trajectory: key 'points' was expected.");
  }
  if (!points->is_array()) call.arguments.refuse(0, "a list of points");
  const std::size_t joints = joint_names(call).size();
  for (const json& point : *points) {
    if (!point.is_object()) call.arguments.refuse(0, "points that are objects");
    command.times_s.push_back(number_in(call, point, "time_from_start"));
    const auto positions = point.find("positions");
    if (positions == point.end()) {
      throw MorseRefusal("Error: invalid trajectory: key 'positions' was expected.");
    }
    // As in MORSE, positions of more joints than there are do not matter.
    const bool is_whole = positions->is_array() && positions->size() >= joints;
    if (!is_whole) {
      call.arguments.refuse(0, "positions of all " + std::to_string(joints) + " joints");
    }
    for (std::size_t i = 0; i < joints; ++i) {
      const json& position = (*positions)[i];
      if (!position.is_number()) call.arguments.refuse(0, "positions that are numbers");
      command.positions.push_back(position.get<double>());
    }
  }
  answer_when(call, command, has_come_to_its_end);
  return nullptr;
}

// --- inverse kinematics

// Weight of the orientation when an arm cannot reach its target [m/rad].
constexpr double kOrientationWeight = 1.5;

// Iterations of a search.
constexpr int kToTheEnd = 500;
constexpr int kOnTheWay = 10;

// From the axes of a target, which are those of Blender's bones (y along the link), to those of the
// frame at the end of a link (x along it).
Eigen::Matrix3d axes_of_bone() {
  Eigen::Matrix3d R;
  R << 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0;
  return R;
}

// MORSE's name of the only target, at the end of the last link.
std::string target_name(MorseCall& call) {
  return "ik_target." + call.component->name + '.' + joint_names(call).back();
}

json list_ik_targets(MorseCall& call) { return json::array({target_name(call)}); }

Eigen::Vector3d vector_in(MorseCall& call, std::size_t argument) {
  const json& list = call.arguments.list(argument);
  if (list.size() != 3) call.arguments.refuse(argument, "a list of three numbers");
  Eigen::Vector3d vector;
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = list[i].is_number() ? list[i].get<double>() : std::nan("");
    if (!(std::abs(value) <= kMost)) call.arguments.refuse(argument, "a list of three numbers");
    vector[static_cast<Eigen::Index>(i)] = value;
  }
  return vector;
}

// An arm and its target.
struct Reach {
  sim::ActArrayParams arm;
  std::vector<double> positions;
  Eigen::Isometry3d X_WB;
  Eigen::Isometry3d from_W;  // the target before the request
  Eigen::Isometry3d to_W;    // the target that is wanted

  [[nodiscard]] std::vector<double> solve(const Eigen::Isometry3d& X_WT,
                                          const std::vector<double>& start, int steps) const {
    Eigen::Isometry3d X_BE = X_WB.inverse() * X_WT;
    X_BE.linear() *= axes_of_bone().transpose();
    return sim::solve_arm(arm, start, X_BE, kOrientationWeight, steps);
  }
};

// Reads the first four arguments of a request to a target.
Reach reach_of(MorseCall& call) {
  const std::string name = call.arguments.text(0);
  if (name != target_name(call)) {
    throw MorseRefusal("IK target <" + name + "> does not exist for armature " +
                       call.component->name);
  }
  Reach reach = ask<sim::ActArray>(call, [&](const sim::ActArray& arm, const sim::Simulation& all) {
    const sim::BodyState& body = all.body(call.component->robot);
    Reach made;
    made.arm = arm.params();
    made.positions = arm.positions();
    made.X_WB = sim::in_space(body.X_WB, body.elevation);
    return made;
  });
  Eigen::Isometry3d X_BT;
  if (const auto kept = call.state.target_of(call.component->name)) {
    X_BT = *kept;
  } else {
    std::vector<double> home;
    for (const sim::JointParams& joint : reach.arm.joints) {
      home.push_back(sim::travel_of(joint).home);
    }
    X_BT = sim::arm_frames(reach.arm, home).back();
    X_BT.linear() *= axes_of_bone();
  }
  reach.from_W = reach.to_W = reach.X_WB * X_BT;
  const bool relative = !call.arguments.has(3) || call.arguments.boolean(3);
  const Eigen::Vector3d shift = vector_in(call, 1);
  reach.to_W.translation() = relative ? reach.from_W.translation() + shift : shift;
  if (call.arguments.has(2) && !call.arguments.any(2).is_null()) {
    const Eigen::Vector3d turn = vector_in(call, 2);
    const Eigen::Matrix3d R = sim::rotation_of(turn.x(), turn.y(), turn.z());
    reach.to_W.linear() = relative ? R * reach.from_W.linear() : R;
  }
  return reach;
}

void keep_target(MorseCall& call, const Reach& reach) {
  call.state.keep_target(call.component->name, reach.X_WB.inverse() * reach.to_W);
}

json place_ik_target(MorseCall& call) {
  const Reach reach = reach_of(call);
  command(call, sim::JointCommand{sim::JointCommand::Mode::kPlace, 0,
                                  reach.solve(reach.to_W, reach.positions, kToTheEnd)});
  keep_target(call, reach);
  return nullptr;
}

// The target moves along a straight line, the arm follows it.
json move_ik_target(MorseCall& call) {
  constexpr double kUsualSpeed = 0.5;  // m/s and rad/s, MORSE's defaults
  const double linear = call.arguments.number(4, 1e-3, kMost, kUsualSpeed);
  const double radial = call.arguments.number(5, 1e-3, kMost, kUsualSpeed);
  const Reach reach = reach_of(call);
  const Eigen::Vector3d way = reach.to_W.translation() - reach.from_W.translation();
  const Eigen::Vector3d turn =
      sim::rotation_vector_of(reach.from_W.linear().transpose() * reach.to_W.linear());
  const double way_s = way.norm() / linear;
  const double turn_s = turn.norm() / radial;
  const double time_s = std::max(way_s, turn_s);
  constexpr double kPointsPerSecond = 20.0;
  constexpr double kMostPoints = 100.0;
  const int points =
      static_cast<int>(std::clamp(std::ceil(time_s * kPointsPerSecond), 1.0, kMostPoints));
  sim::TrajectoryCommand command;
  std::vector<double> positions = reach.positions;
  for (int i = 1; i <= points; ++i) {
    const double t_s = time_s * i / points;
    const auto share = [t_s](double whole_s) { return t_s < whole_s ? t_s / whole_s : 1.0; };
    Eigen::Isometry3d target = Eigen::Isometry3d::Identity();
    target.linear() =
        reach.from_W.linear() * sim::rotation_about(turn.normalized(), share(turn_s) * turn.norm());
    target.translation() = reach.from_W.translation() + share(way_s) * way;
    // The next point continues where a search on the way ends early.
    positions = reach.solve(target, positions, i < points ? kOnTheWay : kToTheEnd);
    command.times_s.push_back(t_s);
    command.positions.insert(command.positions.end(), positions.begin(), positions.end());
  }
  answer_when(call, command, has_come_to_its_end);
  keep_target(call, reach);
  return nullptr;
}

constexpr std::string_view kPlaceTarget = "name, translation, euler_rotation=null, relative=true";
constexpr std::string_view kMoveTarget =
    "name, translation, euler_rotation=null, relative=true, linear_speed=null, radial_speed=null";
constexpr MorseService kArm[] = {
    {"get_joints", "", Right::kConnect, joints_of_arm},
    {"set_rotation", "joint, rotation", Right::kRobot, set_rotation},
    {"set_rotations", "rotations", Right::kRobot, set_rotations},
    {"set_translation", "joint, translation", Right::kRobot, set_translation},
    {"set_translations", "translations", Right::kRobot, set_translations},
    {"rotate", "joint, rotation, speed=null", Right::kRobot, rotate_joint, nullptr, true},
    {"rotate_joints", "rotations, speed=null", Right::kRobot, rotate_joints, nullptr, true},
    {"translate", "joint, translation, speed=null", Right::kRobot, translate_joint, nullptr, true},
    {"translate_joints", "translations, speed=null", Right::kRobot, translate_joints, nullptr,
     true},
    {"trajectory", "trajectory", Right::kRobot, trajectory, nullptr, true},
    {"list_IK_targets", "", Right::kConnect, list_ik_targets},
    {"place_IK_target", kPlaceTarget, Right::kRobot, place_ik_target},
    {"move_IK_target", kMoveTarget, Right::kRobot, move_ik_target, nullptr, true},
    {"get_dofs", "", Right::kConnect, degrees_of_freedom},
    {"get_IK_limits", "joint", Right::kConnect, limits_of_joint},
    {"stop", "", Right::kRobot, stop_arm},
};

}  // namespace

std::span<const MorseService> arm_services() { return kArm; }

}  // namespace playerlike::server
