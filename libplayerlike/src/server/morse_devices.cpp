// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Requests to MORSE's PTU, Armature, ArmaturePose, Proximity and Light, and to `communication`.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "server/morse_services.h"
#include "server/morse_state.h"
#include "sim/devices/actarray.h"
#include "sim/devices/blinkenlight.h"
#include "sim/devices/posture.h"
#include "sim/devices/ptz.h"
#include "sim/simulation/simulation.h"

namespace playerlike::server {
namespace {

using nlohmann::json;
using Right = MorseService::Right;

constexpr double kFarthest_m = 1e6;
constexpr double kMostTurn_rad = 1e6;

DeviceId id_of(const MorseCall& call) { return call.component->device.value(); }

template <typename Kind>
const Kind& device_in(const sim::Simulation& simulation, DeviceId id) {
  return dynamic_cast<const Kind&>(simulation.device(id.robot, id.device));
}

// --- ptz

bool head_rests(const sim::Device& device) {
  return !dynamic_cast<const sim::Ptz&>(device).moving();
}

// MORSE's tilt is positive downwards.
json point(MorseCall& call, double pan_rad, double tilt_rad) {
  call.state.answer_when(call.from, call.id, id_of(call),
                         sim::PointCommand{pan_rad, -tilt_rad, 0.0, 0.0, 0.0}, head_rests);
  return nullptr;
}

json set_pan_tilt(MorseCall& call) {
  return point(call, sim::normalize_angle(call.arguments.number(0, -kMostTurn_rad, kMostTurn_rad)),
               sim::normalize_angle(call.arguments.number(1, -kMostTurn_rad, kMostTurn_rad)));
}

json get_pan_tilt(MorseCall& call) {
  return call.state.with([&](const sim::Simulation& simulation) {
    const auto& head = device_in<sim::Ptz>(simulation, id_of(call));
    return json::array({head.pan_rad(), -head.tilt_rad()});
  });
}

// Points the head at a point of the world, as MORSE does: relative to the robot's heading and
// pitch.
json aim(MorseCall& call, const Eigen::Vector3d& p_W) {
  struct Angles {
    double pan;
    double tilt;
  };
  const Angles wanted = call.state.with([&](const sim::Simulation& simulation) {
    const sim::BodyState& body = simulation.body(call.component->robot);
    const auto& head = device_in<sim::Ptz>(simulation, id_of(call));
    const Eigen::Isometry3d X_WH =
        sim::in_space(body.X_WB, body.elevation) * head.mount().transform();
    const Eigen::Vector3d way = p_W - X_WH.translation();
    return Angles{sim::normalize_angle(std::atan2(way.y(), way.x()) - body.X_WB.yaw_rad),
                  -std::atan2(way.z(), std::hypot(way.x(), way.y())) + body.elevation.pitch_rad};
  });
  return point(call, wanted.pan, wanted.tilt);
}

json look_at_point(MorseCall& call) {
  return aim(call, {call.arguments.number(0, -kFarthest_m, kFarthest_m),
                    call.arguments.number(1, -kFarthest_m, kFarthest_m),
                    call.arguments.number(2, -kFarthest_m, kFarthest_m)});
}

json look_at_object(MorseCall& call) {
  require_truth(call);
  const std::string name = call.arguments.text(0);
  const auto place = call.state.with([&](const sim::Simulation& simulation) {
    std::optional<Eigen::Vector3d> found;
    for (const sim::SceneObject& object : simulation.scene_objects()) {
      if (object.name == name) found.emplace(object.pose.x_m, object.pose.y_m, 0.0);
    }
    return found;
  });
  if (!place) throw MorseRefusal("Object '" + name + "' not found in scene. Can not look at it");
  return aim(call, *place);
}

constexpr MorseService kHead[] = {
    {"set_pan_tilt", "pan, tilt", Right::kRobot, set_pan_tilt, nullptr, true},
    {"get_pan_tilt", "", Right::kConnect, get_pan_tilt},
    {"look_at_point", "x, y, z", Right::kRobot, look_at_point, nullptr, true},
    {"look_at_object", "object", Right::kRobot, look_at_object, nullptr, true},
};

// --- actarray

// Index of a joint of the arm, which is of the wanted type. @throws MorseRefusal.
int joint_of(MorseCall& call, const std::string& name, sim::JointType type) {
  return call.state.with([&](const sim::Simulation& simulation) {
    const auto& arm = device_in<sim::ActArray>(simulation, id_of(call));
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
  const double value = call.arguments.number(1, -kMostTurn_rad, kMostTurn_rad);
  call.state.command(id_of(call),
                     sim::JointCommand{sim::JointCommand::Mode::kPlace, joint, {value}});
  return nullptr;
}
json set_rotation(MorseCall& call) { return place_joint(call, sim::JointType::kRotary); }
json set_translation(MorseCall& call) { return place_joint(call, sim::JointType::kLinear); }

// Places the first joints, all of the given type.
json place_joints(MorseCall& call, sim::JointType type) {
  const std::vector<std::string> names = call.state.with([&](const sim::Simulation& simulation) {
    return device_in<sim::ActArray>(simulation, id_of(call)).joint_names();
  });
  std::vector<double> values;
  for (const json& value : call.arguments.list(0)) {
    if (values.size() == names.size()) break;  // as in MORSE, the rest is discarded
    if (!value.is_number()) call.arguments.refuse(0, "a list of numbers");
    static_cast<void>(joint_of(call, names[values.size()], type));
    values.push_back(value.get<double>());
  }
  if (values.empty()) return nullptr;
  call.state.command(id_of(call),
                     sim::JointCommand{sim::JointCommand::Mode::kPlace, 0, std::move(values)});
  return nullptr;
}
json set_rotations(MorseCall& call) { return place_joints(call, sim::JointType::kRotary); }
json set_translations(MorseCall& call) { return place_joints(call, sim::JointType::kLinear); }

bool arm_rests(const sim::Device& device) {
  return dynamic_cast<const sim::ActArray&>(device).at_rest();
}

json move_joint(MorseCall& call, sim::JointType type) {
  const int joint = joint_of(call, call.arguments.text(0), type);
  const double value = call.arguments.number(1, -kMostTurn_rad, kMostTurn_rad);
  if (call.arguments.has(2) && !call.arguments.any(2).is_null()) {
    call.state.command(id_of(call),
                       sim::JointSettingCommand{sim::JointSettingCommand::Setting::kSpeed, joint,
                                                call.arguments.number(2, 1e-6, kMostTurn_rad)});
  }
  call.state.answer_when(call.from, call.id, id_of(call),
                         sim::JointCommand{sim::JointCommand::Mode::kPosition, joint, {value}},
                         arm_rests);
  return nullptr;
}
json rotate_joint(MorseCall& call) { return move_joint(call, sim::JointType::kRotary); }
json translate_joint(MorseCall& call) { return move_joint(call, sim::JointType::kLinear); }

// Moves the joints of an object {name: value}. The others stay.
json move_joints(MorseCall& call, sim::JointType type) {
  const json& wanted = call.arguments.any(0);
  if (!wanted.is_object()) call.arguments.refuse(0, "an object {joint: value}");
  std::vector<double> values = call.state.with([&](const sim::Simulation& simulation) {
    return device_in<sim::ActArray>(simulation, id_of(call)).positions();
  });
  for (const auto& [name, value] : wanted.items()) {
    const int joint = joint_of(call, name, type);
    if (!value.is_number()) call.arguments.refuse(0, "an object {joint: number}");
    values[static_cast<std::size_t>(joint)] = value.get<double>();
  }
  call.state.answer_when(
      call.from, call.id, id_of(call),
      sim::JointCommand{sim::JointCommand::Mode::kPosition, 0, std::move(values)}, arm_rests);
  return nullptr;
}
json rotate_joints(MorseCall& call) { return move_joints(call, sim::JointType::kRotary); }
json translate_joints(MorseCall& call) { return move_joints(call, sim::JointType::kLinear); }

json joints_of_arm(MorseCall& call) {
  return call.state.with([&](const sim::Simulation& simulation) {
    return json(device_in<sim::ActArray>(simulation, id_of(call)).joint_names());
  });
}

json stop_arm(MorseCall& call) {
  call.state.command(id_of(call), sim::JointCommand{sim::JointCommand::Mode::kSpeed, -1, {0.0}});
  return nullptr;
}

constexpr MorseService kArm[] = {
    {"get_joints", "", Right::kConnect, joints_of_arm},
    {"set_rotation", "joint, rotation", Right::kRobot, set_rotation},
    {"set_rotations", "rotations", Right::kRobot, set_rotations},
    {"set_translation", "joint, translation", Right::kRobot, set_translation},
    {"set_translations", "translations", Right::kRobot, set_translations},
    {"rotate", "joint, rotation, speed=null", Right::kRobot, rotate_joint, nullptr, true},
    {"rotate_joints", "rotations", Right::kRobot, rotate_joints, nullptr, true},
    {"translate", "joint, translation, speed=null", Right::kRobot, translate_joint, nullptr, true},
    {"translate_joints", "translations", Right::kRobot, translate_joints, nullptr, true},
    {"stop", "", Right::kRobot, stop_arm},
};

// --- posture

json posture_joints(MorseCall& call) {
  return call.state.with([&](const sim::Simulation& simulation) {
    return json(device_in<sim::Posture>(simulation, id_of(call)).joints());
  });
}

// An object of the joints' values by their names.
json by_joint(const std::vector<std::string>& joints, const std::vector<double>& values) {
  json all = json::object();
  for (std::size_t i = 0; i < joints.size() && i < values.size(); ++i) {
    // MORSE's tilt is positive downwards.
    all[joints[i]] = joints[i] == "tilt" ? -values[i] : values[i];
  }
  return all;
}

json posture_state(MorseCall& call) {
  return call.state.with([&](const sim::Simulation& simulation) {
    const auto& posture = device_in<sim::Posture>(simulation, id_of(call));
    return by_joint(posture.joints(), posture.positions());
  });
}

json posture_joint(MorseCall& call) {
  const std::string name = call.arguments.text(0);
  const json state = posture_state(call);
  const auto joint = state.find(name);
  if (joint == state.end()) {
    throw MorseRefusal("Joint <" + name + "> does not exist in armature " + call.component->name);
  }
  return *joint;
}

json joints_length(MorseCall& call) {
  return call.state.with([&](const sim::Simulation& simulation) {
    const auto& posture = device_in<sim::Posture>(simulation, id_of(call));
    return by_joint(posture.joints(), posture.lengths_m());
  });
}

constexpr MorseService kPosture[] = {
    {"get_joints", "", Right::kConnect, posture_joints},
    {"get_state", "", Right::kConnect, posture_state},
    {"get_joint", "joint", Right::kConnect, posture_joint},
    {"get_joints_length", "", Right::kConnect, joints_length},
};

// --- proximity

json set_range(MorseCall& call) {
  call.state.command(id_of(call), sim::TrackCommand{call.arguments.number(0, 1e-3, 1000.0), {}});
  return nullptr;
}
json set_tracked_tag(MorseCall& call) {
  call.state.command(id_of(call), sim::TrackCommand{{}, call.arguments.text(0)});
  return nullptr;
}

constexpr MorseService kProximity[] = {
    {"set_range", "range", Right::kRobot, set_range},
    {"set_tracked_tag", "tag", Right::kRobot, set_tracked_tag},
};

// --- communication

json distance_and_view(MorseCall& call) {
  require_truth(call);
  const std::string names[] = {call.arguments.text(0), call.arguments.text(1)};
  return call.state.with([&](const sim::Simulation& simulation) {
    int robots[2] = {};
    for (std::size_t i = 0; i < 2; ++i) {
      const auto found = simulation.find_robot(names[i]);
      if (!found) throw MorseRefusal(names[i] + " does not exist in the simulation ");
      robots[i] = static_cast<int>(*found);
    }
    const sim::BodyState& a = simulation.body(robots[0]);
    const sim::BodyState& b = simulation.body(robots[1]);
    const Eigen::Vector3d way(b.X_WB.x_m - a.X_WB.x_m, b.X_WB.y_m - a.X_WB.y_m,
                              b.elevation.z_m - a.elevation.z_m);
    return json::array({way.norm(), simulation.sees(robots[0], robots[1])});
  });
}

constexpr MorseService kCommunication[] = {
    {"distance_and_view", "robot1, robot2", Right::kConnect, distance_and_view},
};

}  // namespace

std::span<const MorseService> communication_services() { return kCommunication; }

std::span<const MorseService> device_services(std::string_view type) {
  if (type == "ptz") return kHead;
  if (type == "actarray") return kArm;
  if (type == "posture") return kPosture;
  if (type == "proximity") return kProximity;
  return {};
}

}  // namespace playerlike::server
