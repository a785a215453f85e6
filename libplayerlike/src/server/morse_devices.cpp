// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Requests to MORSE's PTU, ArmaturePose, Proximity, Gripper, Light and cameras, and to
// `communication`.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "server/morse_services.h"
#include "server/morse_state.h"
#include "sim/core/math.h"
#include "sim/devices/blinkenlight.h"
#include "sim/devices/hand.h"
#include "sim/devices/posture.h"
#include "sim/devices/ptz.h"
#include "sim/simulation/simulation.h"

namespace playerlike::server {
namespace {

using nlohmann::json;
using Right = MorseService::Right;

constexpr double kFarthest_m = 1e6;
constexpr double kMostTurn_rad = 1e6;

// --- ptz

bool head_rests(const sim::Device& device) {
  return !dynamic_cast<const sim::Ptz&>(device).moving();
}

// MORSE's tilt is positive downwards.
json point(MorseCall& call, double pan_rad, double tilt_rad) {
  answer_when(call, sim::PointCommand{pan_rad, -tilt_rad, 0.0, 0.0, 0.0}, head_rests);
  return nullptr;
}

json set_pan_tilt(MorseCall& call) {
  return point(call, sim::normalize_angle(call.arguments.number(0, -kMostTurn_rad, kMostTurn_rad)),
               sim::normalize_angle(call.arguments.number(1, -kMostTurn_rad, kMostTurn_rad)));
}

json get_pan_tilt(MorseCall& call) {
  return ask<sim::Ptz>(call, [](const sim::Ptz& head) {
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
  const Angles wanted = ask<sim::Ptz>(call, [&](const sim::Ptz& head, const sim::Simulation& all) {
    const sim::BodyState& body = all.body(call.component->robot);
    const Eigen::Isometry3d X_WH =
        sim::in_space(body.X_WB, body.elevation) * head.mount().transform();
    const Eigen::Vector3d way = p_W - X_WH.translation();
    return Angles{
        sim::normalize_angle(sim::math::atan2(way.y(), way.x()) - body.X_WB.yaw_rad),
        -sim::math::atan2(way.z(), sim::math::hypot(way.x(), way.y())) + body.elevation.pitch_rad};
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
  std::optional<Eigen::Vector3d> place;
  for (const sim::SceneObject& object : scene_of(call)) {
    if (object.name == name) place.emplace(object.pose.x_m, object.pose.y_m, 0.0);
  }
  if (!place) throw MorseRefusal("Object '" + name + "' not found in scene. Can not look at it");
  return aim(call, *place);
}

constexpr MorseService kHead[] = {
    {"set_pan_tilt", "pan, tilt", Right::kRobot, set_pan_tilt, nullptr, true},
    {"get_pan_tilt", "", Right::kConnect, get_pan_tilt},
    {"look_at_point", "x, y, z", Right::kRobot, look_at_point, nullptr, true},
    {"look_at_object", "object", Right::kRobot, look_at_object, nullptr, true},
};

// --- posture

json posture_joints(MorseCall& call) { return ask<sim::Posture>(call, &sim::Posture::joints); }

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
  return ask<sim::Posture>(call, [](const sim::Posture& posture) {
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
  return ask<sim::Posture>(call, [](const sim::Posture& posture) {
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
  command(call, sim::TrackCommand{call.arguments.number(0, 1e-3, 1000.0), {}});
  return nullptr;
}
json set_tracked_tag(MorseCall& call) {
  command(call, sim::TrackCommand{{}, call.arguments.text(0)});
  return nullptr;
}

constexpr MorseService kProximity[] = {
    {"set_range", "range", Right::kRobot, set_range},
    {"set_tracked_tag", "tag", Right::kRobot, set_tracked_tag},
};

// --- hand

// The name of the object that the hand holds; empty: none.
std::string held_by(MorseCall& call) {
  return ask<sim::Hand>(call, [&](const sim::Hand& hand, const sim::Simulation& all) {
    return hand.held(all.world(), call.component->robot);
  });
}

json grab(MorseCall& call) {
  const bool reaches = ask<sim::Hand>(call, [&](const sim::Hand& hand, const sim::Simulation& all) {
    return hand.nearest(all.world(), all.body(call.component->robot)) >= 0;
  });
  if (!reaches && held_by(call).empty()) return nullptr;
  command(call, sim::GripCommand{sim::GripCommand::Action::kClose});
  return held_by(call);
}

json release(MorseCall& call) {
  if (held_by(call).empty()) return nullptr;
  command(call, sim::GripCommand{sim::GripCommand::Action::kOpen});
  return true;
}

constexpr MorseService kHand[] = {
    {"grab", "", Right::kRobot, grab},
    {"release", "", Right::kRobot, release},
};

// --- blinkenlight

json toggle(MorseCall& call) {
  // As in MORSE, anything but true switches the light to the other state.
  const bool on = call.arguments.has(0) && call.arguments.any(0) == json(true);
  const bool is_on = ask<sim::Blinkenlight>(call, &sim::Blinkenlight::enabled);
  command(call, sim::LightCommand{on || !is_on, {}, {}, {}});
  return true;
}

constexpr MorseService kLight[] = {
    {"toggle", "emit=null", Right::kRobot, toggle},
};

// --- camera, depth_camera

json capture(MorseCall& call) {
  constexpr int kMostPictures = 1000000;
  const int wanted = call.arguments.integer(0, 1, kMostPictures);
  const auto pictures = [&host = call.state.host(), camera = id_of(call)] {
    return host.count_of_readings(camera);
  };
  const std::uint64_t last = pictures() + static_cast<std::uint64_t>(wanted);
  call.state.answer_when(call.from, call.id, id_of(call),
                         [=](const sim::Device&) { return pictures() >= last; });
  return nullptr;
}

constexpr MorseService kCamera[] = {
    {"capture", "n", Right::kConnect, capture, nullptr, true},
};

// --- communication

json distance_and_view(MorseCall& call) {
  require_truth(call);
  const std::string names[] = {call.arguments.text(0), call.arguments.text(1)};
  return call.state.host().with_simulation([&](const sim::Simulation& simulation) {
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
  if (type == "actarray") return arm_services();
  if (type == "blinkenlight") return kLight;
  if (type == "camera" || type == "depth_camera") return kCamera;
  if (type == "hand") return kHand;
  if (type == "posture") return kPosture;
  if (type == "proximity") return kProximity;
  return {};
}

}  // namespace playerlike::server
