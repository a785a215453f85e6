// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "server/morse_components.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "protocol/codec.h"
#include "server/morse_records.h"
#include "sim/core/math.h"
#include "sim/core/pose.h"
#include "sim/devices/actarray.h"
#include "sim/devices/battery.h"
#include "sim/devices/camera.h"
#include "sim/devices/contact_sensors.h"
#include "sim/devices/destination.h"
#include "sim/devices/gps.h"
#include "sim/devices/imu.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"
#include "sim/devices/orientation.h"
#include "sim/devices/proximity.h"
#include "sim/devices/rangers.h"
#include "sim/devices/teleport.h"
#include "sim/devices/waypoint.h"
#include "sim/world/robot_model.h"

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
    Kind{"accelerometer", "Accelerometer", StreamDirection::kOut},
    Kind{"actarray", "Armature", StreamDirection::kIn},
    Kind{"airspeed", "Airspeed", StreamDirection::kOut},
    Kind{"altimeter", "RadarAltimeter", StreamDirection::kOut},
    Kind{"attitude", "Attitude", StreamDirection::kOut},
    Kind{"barometer", "Barometer", StreamDirection::kOut},
    Kind{"battery", "Battery", StreamDirection::kOut},
    Kind{"blinkenlight", "Light", StreamDirection::kIn},
    Kind{"camera", "VideoCamera", StreamDirection::kOut},
    Kind{"clock", "Clock", StreamDirection::kOut},
    Kind{"collision", "Collision", StreamDirection::kOut},
    Kind{"depth_camera", "DepthCamera", StreamDirection::kOut},
    Kind{"destination", "Destination", StreamDirection::kIn},
    Kind{"gps", "GPS", StreamDirection::kOut},
    Kind{"gyroscope", "Gyroscope", StreamDirection::kOut},
    Kind{"hand", "Gripper", StreamDirection::kOut},
    Kind{"imu", "IMU", StreamDirection::kOut},
    Kind{"infrared", "Infrared", StreamDirection::kOut},
    Kind{"laser", "LaserScanner", StreamDirection::kOut},
    Kind{"motion", "MotionVW", StreamDirection::kIn},
    Kind{"odometry", "Odometry", StreamDirection::kOut},
    Kind{"orientation", "Orientation", StreamDirection::kIn},
    Kind{"pen", "Pen", StreamDirection::kNone},
    Kind{"pose", "Pose", StreamDirection::kOut},
    Kind{"posture", "Posture", StreamDirection::kOut},
    Kind{"proximity", "Proximity", StreamDirection::kOut},
    Kind{"ptz", "PTU", StreamDirection::kIn},
    Kind{kProperties, "RobotProperties", StreamDirection::kOut},
    Kind{"semantic_camera", "SemanticCamera", StreamDirection::kOut},
    Kind{"sonar", "Sonar", StreamDirection::kOut},
    Kind{"teleport", "Teleport", StreamDirection::kIn},
    Kind{"thermometer", "Thermometer", StreamDirection::kOut},
    Kind{"velocity", "Velocity", StreamDirection::kOut},
    Kind{"waypoint", "Waypoint", StreamDirection::kIn},
};

MorseComponent component(const RobotInfo& robot, int index, const std::string& name,
                         std::string_view type, std::optional<DeviceId> device,
                         std::string_view carrier = {}) {
  MorseComponent made;
  made.name = robot.name + '.' + (carrier.empty() ? "" : std::string(carrier) + '.') + name;
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

// Writes a pose with MORSE's keys, in the coordinates of the messages.
void put_pose(json& object, const sim::Pose& pose, const sim::Elevation& elevation,
              const sim::CoordinateParams& coordinates = {}) {
  const Eigen::Vector3d p = to_message(coordinates, {pose.x_m, pose.y_m, elevation.z_m});
  object["x"] = p.x();
  object["y"] = p.y();
  object["z"] = p.z();
  object["yaw"] = pose.yaw_rad;
  object["pitch"] = elevation.pitch_rad;
  object["roll"] = elevation.roll_rad;
  if (coordinates.ned) {
    object["yaw"] = elevation.roll_rad;
    object["pitch"] = -elevation.pitch_rad;
    object["roll"] = 0.5 * std::numbers::pi - pose.yaw_rad;
  }
}

void put_odometry(json& object, const sim::PoseReading& reading, sim::OdometryLevel level) {
  switch (level) {
    case sim::OdometryLevel::kIntegrated: {
      put_pose(object, reading.pose, reading.elevation);
      // MORSE's velocities are in the world's axes, not in the robot's.
      const auto [s, c] = sim::math::sin_cos(reading.pose.yaw_rad);
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

std::vector<MorseComponent> morse_components(const std::vector<RobotInfo>& robots,
                                             const sim::Simulation& simulation) {
  std::vector<MorseComponent> all;
  for (std::size_t r = 0; r < robots.size(); ++r) {
    const RobotInfo& robot = robots[r];
    const int index = static_cast<int>(r);
    bool taken = false;
    for (const DeviceInfo& device : robot.devices) {
      const sim::Device& made = simulation.device(device.id.robot, device.id.device);
      all.push_back(component(robot, index, device.name, device.type, device.id, made.carrier()));
      const sim::RobotModel* model = sim::find_robot_model(simulation.world(), robot.model);
      const bool is_holonomic =
          model != nullptr && model->drive.kind == sim::DriveKind::kOmnidirectional;
      if (device.type == "motion" && is_holonomic) {
        all.back().class_name = "MotionXYW";
      }
      taken = taken || device.name == kProperties;
    }
    if (!taken) {
      all.push_back(component(robot, index, std::string(kProperties), kProperties, std::nullopt));
    }
  }
  return all;
}

json morse_record(const sim::Reading& reading, const StreamFormat& format) {
  json object{{"timestamp", sim::to_seconds(reading.time_ns)}};
  if (put_picture_record(object, reading, format)) return object;
  if (put_space_record(object, reading, format)) return object;
  if (const auto* pose = dynamic_cast<const sim::PoseReading*>(&reading)) {
    if (format.odometry) {
      put_odometry(object, *pose, *format.odometry);
    } else {
      put_pose(object, pose->pose, pose->elevation, format.coordinates);
    }
  } else if (const auto* laser = dynamic_cast<const sim::LaserReading*>(&reading)) {
    const auto place = [&](std::size_t beam, double range_m) -> sim::Vec2 {
      const double angle_rad =
          laser->angle_min_rad + static_cast<double>(beam) * laser->resolution_rad;
      return range_m * sim::unit_vector(angle_rad);
    };
    put_ranges(object, laser->ranges_m, laser->range_max_m, place);
  } else if (const auto* ranger = dynamic_cast<const sim::RangerReading*>(&reading)) {
    put_ranges(object, ranger->ranges_m, ranger->range_max_m,
               [&](std::size_t i, double range_m) -> sim::Vec2 {
                 return ranger->X_BS[i] * sim::Vec2(range_m, 0.0);
               });
  } else if (const auto* collision = dynamic_cast<const sim::CollisionReading*>(&reading)) {
    object["collision"] = collision->collision;
    object["objects"] = joined(collision->objects);
  } else if (const auto* battery = dynamic_cast<const sim::BatteryReading*>(&reading)) {
    object["charge"] = battery->charge_percent;
    object["status"] = std::string(to_string(battery->status));
    object["voltage"] = battery->voltage_v;
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
  put_pose(pose, robot.initial_pose, {});
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

StreamFormat stream_format(const sim::Simulation& simulation, DeviceId device) {
  const sim::DeviceDescription& description =
      simulation.world()
          .robots.at(static_cast<std::size_t>(device.robot))
          .devices.at(static_cast<std::size_t>(device.device));
  StreamFormat format;
  // A device without settings in the world has no params; it has the defaults.
  if (description.type == "odometry") {
    const auto* params = std::any_cast<sim::OdometryParams>(&description.params);
    format.odometry = params != nullptr ? params->level : sim::OdometryParams{}.level;
  } else if (const auto* pose = std::any_cast<sim::PoseParams>(&description.params)) {
    format.coordinates = static_cast<const sim::CoordinateParams&>(*pose);
  } else if (const auto* gps = std::any_cast<sim::GpsParams>(&description.params)) {
    format.coordinates = static_cast<const sim::CoordinateParams&>(*gps);
    format.gps = gps->level;
  } else if (description.type == "camera") {
    const auto* camera = std::any_cast<sim::CameraParams>(&description.params);
    format.field_of_view_rad =
        (camera != nullptr ? *camera : sim::CameraParams{}).field_of_view_rad;
  } else if (const auto* teleport = std::any_cast<sim::TeleportParams>(&description.params)) {
    format.coordinates = *teleport;
  }
  return format;
}

namespace {

sim::Command place_command(const json& object, const StreamFormat& format) {
  const auto given = [&](const char* key) -> std::optional<double> {
    if (!object.contains(key)) return std::nullopt;
    return number(object, key);
  };
  std::optional<double> z_m = given("z");
  std::optional<double> roll = given("roll");
  std::optional<double> pitch = given("pitch");
  Eigen::Vector3d p(number(object, "x"), number(object, "y"), z_m.value_or(0.0));
  double yaw = number(object, "yaw", format.coordinates.ned ? 0.0 : std::optional<double>());
  if (format.coordinates.any()) {
    p = from_message(format.coordinates, p);
    if (z_m) z_m = p.z();
  }
  if (format.coordinates.ned) {
    yaw = std::exchange(roll, yaw).value_or(0.0);
    yaw = 0.5 * std::numbers::pi - yaw;
    if (pitch) pitch = -*pitch;
  }
  return sim::PlaceCommand{{p.x(), p.y(), sim::normalize_angle(yaw)}, z_m, roll, pitch};
}

sim::Command twist_command(const json& object) {
  // MORSE's MotionXYW has x, y and w, its MotionVW v and w.
  if (!object.contains("v") && object.contains("x")) {
    return sim::TwistCommand{{.v_mps = number(object, "x"),
                              .omega_radps = number(object, "w"),
                              .lateral_mps = number(object, "y", 0.0)}};
  }
  return sim::TwistCommand{{.v_mps = number(object, "v"), .omega_radps = number(object, "w")}};
}

// The values of joints by their names; the others keep their positions.
sim::Command joints_command(const json& object, const sim::ActArray& arm) {
  std::vector<double> positions = arm.positions();
  const std::vector<std::string> names = arm.joint_names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    positions[i] = number(object, names[i].c_str(), positions[i]);
  }
  return sim::JointCommand{sim::JointCommand::Mode::kPlace, 0, positions};
}

}  // namespace

sim::Command morse_command(const MorseComponent& component, const json& object,
                           const sim::Simulation& simulation) {
  if (!object.is_object()) refuse("expected an object, " + found(object));
  const DeviceId id = component.device.value();
  const sim::Device& device = simulation.device(id.robot, id.device);
  if (component.type == "motion") return twist_command(object);
  if (component.type == "waypoint") {
    const auto& waypoint = dynamic_cast<const sim::Waypoint&>(device);
    return sim::GotoCommand{{number(object, "x"), number(object, "y")},
                            number(object, "tolerance", waypoint.params().tolerance_m),
                            number(object, "speed", waypoint.params().speed_mps)};
  }
  if (component.type == "destination") {
    const auto& params = dynamic_cast<const sim::Destination&>(device).params();
    sim::GotoCommand goal{
        {number(object, "x"), number(object, "y")}, params.tolerance_m, params.speed_mps};
    if (object.contains("z")) goal.z_m = number(object, "z");
    return goal;
  }
  if (component.type == "orientation") {
    return sim::OrientCommand{number(object, "roll", 0.0), number(object, "pitch", 0.0),
                              number(object, "yaw")};
  }
  if (component.type == "ptz") {
    // MORSE's tilt is positive downwards.
    return sim::PointCommand{number(object, "pan"), -number(object, "tilt"), 0.0, 0.0, 0.0};
  }
  if (component.type == "actarray") {
    return joints_command(object, dynamic_cast<const sim::ActArray&>(device));
  }
  if (component.type == "blinkenlight") {
    const auto emit = object.find("emit");
    if (emit == object.end() || !emit->is_boolean()) refuse("expected true or false for \"emit\"");
    return sim::LightCommand{emit->get<bool>(), {}, {}, {}};
  }
  return place_command(object, stream_format(simulation, id));
}

json morse_scene_object(const sim::SceneObject& object) {
  const double half = 0.5 * object.pose.yaw_rad;
  return json::array({json::object(), json::array({object.pose.x_m, object.pose.y_m, 0.0}),
                      json::array({0.0, 0.0, sim::math::sin(half), sim::math::cos(half)})});
}

}  // namespace playerlike::server
