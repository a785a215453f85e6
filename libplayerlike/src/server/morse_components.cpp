// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "server/morse_components.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "protocol/codec.h"
#include "sim/devices/battery.h"
#include "sim/devices/contact_sensors.h"
#include "sim/devices/gps.h"
#include "sim/devices/imu.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"
#include "sim/devices/proximity.h"
#include "sim/devices/rangers.h"
#include "sim/devices/waypoint.h"

namespace playerlike::server {
namespace {

using nlohmann::json;

struct Kind {
  std::string_view type;
  std::string_view class_name;
  StreamDirection stream;
};
constexpr std::string_view kProperties = "robot_properties";
constexpr std::array kKinds{
    Kind{"battery", "Battery", StreamDirection::kOut},
    Kind{"collision", "Collision", StreamDirection::kOut},
    Kind{"gps", "GPS", StreamDirection::kOut},
    Kind{"imu", "IMU", StreamDirection::kOut},
    Kind{"infrared", "Infrared", StreamDirection::kOut},
    Kind{"laser", "LaserScanner", StreamDirection::kOut},
    Kind{"motion", "MotionVW", StreamDirection::kIn},
    Kind{"odometry", "Odometry", StreamDirection::kOut},
    Kind{"pen", "Pen", StreamDirection::kNone},
    Kind{"pose", "Pose", StreamDirection::kOut},
    Kind{"proximity", "Proximity", StreamDirection::kOut},
    Kind{kProperties, "RobotProperties", StreamDirection::kOut},
    Kind{"sonar", "Sonar", StreamDirection::kOut},
    Kind{"teleport", "Teleport", StreamDirection::kIn},
    Kind{"waypoint", "Waypoint", StreamDirection::kIn},
};

MorseComponent component(const RobotInfo& robot, int index, const std::string& name,
                         std::string_view type, std::optional<DeviceId> device) {
  MorseComponent made;
  made.name = robot.name + '.' + name;
  made.type = type;
  made.robot = index;
  made.device = device;
  const auto* kind = std::find_if(kKinds.begin(), kKinds.end(), [&](const Kind& k) {
    return k.type == type && device.has_value() == (k.type != kProperties);
  });
  made.class_name = kind != kKinds.end() ? kind->class_name : "Device";
  if (kind != kKinds.end()) made.stream = kind->stream;
  return made;
}

// Writes a planar pose with MORSE's keys.
void put_pose(json& object, const sim::Pose& pose) {
  object["x"] = pose.x_m;
  object["y"] = pose.y_m;
  object["z"] = 0.0;
  object["yaw"] = pose.yaw_rad;
  object["pitch"] = 0.0;
  object["roll"] = 0.0;
}

void put_odometry(json& object, const sim::PoseReading& reading, sim::OdometryLevel level) {
  switch (level) {
    case sim::OdometryLevel::kIntegrated: {
      put_pose(object, reading.pose);
      // MORSE's velocities are in the world's axes, not in the robot's.
      const double c = std::cos(reading.pose.yaw_rad);
      const double s = std::sin(reading.pose.yaw_rad);
      object["vx"] = c * reading.twist.v_mps - s * reading.twist.lateral_mps;
      object["vy"] = s * reading.twist.v_mps + c * reading.twist.lateral_mps;
      object["vz"] = 0.0;
      object["wx"] = 0.0;
      object["wy"] = 0.0;
      object["wz"] = reading.twist.omega_radps;
      return;
    }
    case sim::OdometryLevel::kDifferential: {
      const sim::Vec2 shift = reading.shift_m();
      object["dx"] = shift.x();
      object["dy"] = shift.y();
      object["dz"] = 0.0;
      object["dyaw"] = reading.increment.yaw_rad;
      object["dpitch"] = 0.0;
      object["droll"] = 0.0;
      return;
    }
    case sim::OdometryLevel::kRaw:
      object["dS"] = reading.path_length_m;
      return;
  }
}

// Writes ranges and the points where the beams end, in the frame of end_of(); (0, 0, 0) for no hit.
void put_ranges(json& object, const std::vector<double>& ranges_m, double range_max_m,
                const std::function<sim::Vec2(std::size_t, double)>& end_of) {
  json points = json::array();
  for (std::size_t i = 0; i < ranges_m.size(); ++i) {
    const bool met = ranges_m[i] < range_max_m;
    const sim::Vec2 p = met ? end_of(i, ranges_m[i]) : sim::Vec2(0.0, 0.0);
    points.push_back(json::array({p.x(), p.y(), 0.0}));
  }
  object["range_list"] = ranges_m;
  object["point_list"] = std::move(points);
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ",") + word;
  return text;
}

std::string found(const json& value) { return std::string("found ") + value.type_name(); }

[[noreturn]] void refuse(const std::string& text) {
  throw protocol::ProtocolError("protocol/bad-value", text);
}

double number(const json& object, const char* key, std::optional<double> otherwise = {}) {
  const auto it = object.find(key);
  if (it == object.end()) {
    if (otherwise) return *otherwise;
    refuse(std::string("expected the key \"") + key + "\", found none");
  }
  const double value = it->is_number() ? it->get<double>() : std::nan("");
  if (!std::isfinite(value)) {
    refuse(std::string("expected a finite number for \"") + key + "\", " + found(*it));
  }
  return value;
}

}  // namespace

std::vector<MorseComponent> morse_components(const std::vector<RobotInfo>& robots) {
  std::vector<MorseComponent> all;
  for (std::size_t r = 0; r < robots.size(); ++r) {
    const RobotInfo& robot = robots[r];
    const int index = static_cast<int>(r);
    bool taken = false;
    for (const DeviceInfo& device : robot.devices) {
      all.push_back(component(robot, index, device.name, device.type, device.id));
      taken = taken || device.name == kProperties;
    }
    if (!taken) {
      all.push_back(component(robot, index, std::string(kProperties), kProperties, std::nullopt));
    }
  }
  return all;
}

json morse_record(const sim::Reading& reading, std::optional<sim::OdometryLevel> level) {
  json object{{"timestamp", sim::to_seconds(reading.time_ns)}};
  if (const auto* pose = dynamic_cast<const sim::PoseReading*>(&reading)) {
    if (level) {
      put_odometry(object, *pose, *level);
    } else {
      put_pose(object, pose->pose);
    }
  } else if (const auto* laser = dynamic_cast<const sim::LaserReading*>(&reading)) {
    put_ranges(object, laser->ranges_m, laser->range_max_m, [&](std::size_t beam, double range_m) {
      const double angle_rad =
          laser->angle_min_rad + static_cast<double>(beam) * laser->resolution_rad;
      return sim::Vec2(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad));
    });
  } else if (const auto* ranger = dynamic_cast<const sim::RangerReading*>(&reading)) {
    put_ranges(object, ranger->ranges_m, ranger->range_max_m, [&](std::size_t i, double range_m) {
      return ranger->X_BS[i] * sim::Vec2(range_m, 0.0);
    });
  } else if (const auto* collision = dynamic_cast<const sim::CollisionReading*>(&reading)) {
    object["collision"] = collision->collision;
    object["objects"] = joined(collision->objects);
  } else if (const auto* battery = dynamic_cast<const sim::BatteryReading*>(&reading)) {
    object["charge"] = battery->charge_percent;
    object["status"] = std::string(to_string(battery->status));
    object["voltage"] = battery->voltage_v;
  } else if (const auto* gps = dynamic_cast<const sim::GpsReading*>(&reading)) {
    constexpr double kDegrees = 180.0 / std::numbers::pi;
    object["latitude"] = gps->latitude_rad * kDegrees;
    object["longitude"] = gps->longitude_rad * kDegrees;
    object["altitude"] = gps->altitude_m;
    object["velocity"] = gps->speed_mps;
    object["heading"] = gps->course_rad * kDegrees;
  } else if (const auto* imu = dynamic_cast<const sim::ImuReading*>(&reading)) {
    object["angular_velocity"] = imu->rate_radps;
    object["linear_acceleration"] = imu->acceleration_mps2;
    object["magnetic_field"] = imu->field_ut;
  } else if (const auto* proximity = dynamic_cast<const sim::ProximityReading*>(&reading)) {
    json near = json::object();
    // If several objects have one name, emplace() keeps the nearest, which comes first.
    for (const auto& object_near : proximity->near_objects) {
      near.emplace(object_near.name, object_near.distance_m);
    }
    object["near_objects"] = near;
    object["near_robots"] = std::move(near);  // MORSE's older name of near_objects
  } else if (const auto* waypoint = dynamic_cast<const sim::WaypointReading*>(&reading)) {
    object["status"] = std::string(to_string(waypoint->status));
    object["x"] = waypoint->goal_m.x();
    object["y"] = waypoint->goal_m.y();
    object["distance"] = waypoint->distance_m;
  }
  return object;
}

json morse_properties_record(const RobotInfo& robot, sim::SimTime now_ns) {
  json pose;
  put_pose(pose, robot.initial_pose);
  json drivers = json::array();
  for (const sim::DriverDescription& driver : robot.drivers) {
    drivers.push_back({{"type", driver.type}, {"settings", driver.settings}});
  }
  json devices = json::object();
  for (const DeviceInfo& device : robot.devices) {
    devices[device.name] = {{"type", device.type}, {"properties", device.properties}};
  }
  return {{"timestamp", sim::to_seconds(now_ns)},
          {"name", robot.name},
          {"model", robot.model},
          {"colour", sim::to_string(robot.colour)},
          {"initial_pose", std::move(pose)},
          {"port", robot.port},
          {"size", {robot.length_m, robot.width_m, robot.height_m}},
          {"max_speed", robot.max_speed_mps},
          {"max_turn_rate", robot.max_turn_rate_radps},
          {"proxies", robot.proxies},
          {"drivers", std::move(drivers)},
          {"devices", std::move(devices)}};
}

std::optional<sim::OdometryLevel> odometry_level(const sim::Simulation& simulation,
                                                 DeviceId device) {
  const sim::DeviceDescription& description =
      simulation.world()
          .robots.at(static_cast<std::size_t>(device.robot))
          .devices.at(static_cast<std::size_t>(device.device));
  if (description.type != "odometry") return std::nullopt;
  // A device without settings in the world has no params; it has the default level.
  const auto* params = std::any_cast<sim::OdometryParams>(&description.params);
  return params != nullptr ? params->level : sim::OdometryParams{}.level;
}

sim::Command morse_command(const MorseComponent& component, const json& object,
                           const sim::Simulation& simulation) {
  if (!object.is_object()) refuse("expected an object, " + found(object));
  const DeviceId id = component.device.value();
  if (component.type == "motion") {
    return sim::TwistCommand{{number(object, "v"), number(object, "w"), 0.0}};
  }
  if (component.type == "waypoint") {
    const auto& device = dynamic_cast<const sim::Waypoint&>(simulation.device(id.robot, id.device));
    return sim::GotoCommand{{number(object, "x"), number(object, "y")},
                            number(object, "tolerance", device.params().tolerance_m),
                            number(object, "speed", device.params().speed_mps)};
  }
  return sim::PlaceCommand{
      {number(object, "x"), number(object, "y"), sim::normalize_angle(number(object, "yaw"))}};
}

json morse_scene_object(const sim::SceneObject& object) {
  const double half = 0.5 * object.pose.yaw_rad;
  return json::array({json::object(), json::array({object.pose.x_m, object.pose.y_m, 0.0}),
                      json::array({0.0, 0.0, std::sin(half), std::cos(half)})});
}

}  // namespace playerlike::server
