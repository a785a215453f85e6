// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "remote/player_robots.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "messages/player_interfaces.h"
#include "protocol/player_xdr.h"
#include "sim/core/math.h"
#include "sim/devices/actarray.h"

namespace playerlike {
namespace {

using Properties = std::map<std::string, double>;

/// Maximum number of elements of a device that properties describe.
constexpr std::size_t kMaxElements = 4096;

struct TypeRow {
  unsigned interface;
  const char* type;
};
constexpr TypeRow kTypes[] = {
    {PLAYER_POSITION2D_CODE, "odometry"},
    {PLAYER_LOCALIZE_CODE, "amcl"},
    {PLAYER_LASER_CODE, "laser"},
    {PLAYER_RANGER_CODE, "laser"},  // "sonar" if it has several elements, see complete_ranger()
    {PLAYER_SONAR_CODE, "sonar"},
    {PLAYER_IR_CODE, "infrared"},
    {PLAYER_POWER_CODE, "battery"},
    {PLAYER_GPS_CODE, "gps"},
    {PLAYER_IMU_CODE, "imu"},
    {PLAYER_FIDUCIAL_CODE, "fiducial"},
    {PLAYER_BUMPER_CODE, "bumper"},
    {PLAYER_PTZ_CODE, "ptz"},
    {PLAYER_GRIPPER_CODE, "gripper"},
    {PLAYER_AIO_CODE, "aio"},
    {PLAYER_DIO_CODE, "dio"},
    {PLAYER_WIFI_CODE, "wifi"},
    {PLAYER_BLOBFINDER_CODE, "blobfinder"},
    {PLAYER_CAMERA_CODE, "camera"},
    {PLAYER_ACTARRAY_CODE, "actarray"},
    {PLAYER_OPAQUE_CODE, "opaque"},
    {PLAYER_SPEECH_CODE, "speech"},
    {PLAYER_BLINKENLIGHT_CODE, "blinkenlight"},
    {PLAYER_GRAPHICS2D_CODE, "pen"},
    {PLAYER_PLANNER_CODE, "planner"},
};

/// A finite number, else 0: servers may send anything, and drivers leave fields unset.
double finite(double value) { return std::isfinite(value) ? value : 0.0; }

void mount(const player::Pose3d& pose, Properties& properties) {
  properties["mount_x"] = finite(pose.px);
  properties["mount_y"] = finite(pose.py);
  properties["mount_yaw"] = finite(pose.pyaw);
  properties["height"] = finite(pose.pz);
}

void set_size(const player::Bbox3d& size, Properties& properties) {
  properties["size_x"] = finite(size.sl);
  properties["size_y"] = finite(size.sw);
  properties["size_height"] = finite(size.sh);
}

/// The poses of a device's elements. @param pose_of  of an element.
template <typename Element, typename PoseOf>
void mount_elements(const std::vector<Element>& elements, PoseOf pose_of, Properties& properties) {
  const std::size_t count = std::min(elements.size(), kMaxElements);
  properties["count"] = static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const player::Pose3d& pose = pose_of(elements[i]);
    const std::string number = std::to_string(i);
    properties["mount_x_" + number] = finite(pose.px);
    properties["mount_y_" + number] = finite(pose.py);
    properties["mount_yaw_" + number] = finite(pose.pyaw);
    if (i == 0) properties["height"] = finite(pose.pz);
  }
}

const player::Pose3d& itself(const player::Pose3d& pose) { return pose; }

void set_scanner(double min_rad, double max_rad, double resolution_rad, double range_max_m,
                 double frequency_hz, Properties& properties) {
  // Stage's resolution is the field of view divided by the number of beams, not of gaps, so that
  // rounding counts one beam too few at times. The first scan corrects it.
  const double beams = std::round((max_rad - min_rad) / resolution_rad) + 1.0;
  constexpr double kMostBeams = 1 << 20U;
  properties["beams"] = beams >= 1.0 && beams <= kMostBeams ? beams : 0.0;
  properties["angle_min"] = finite(min_rad);
  properties["resolution"] = finite(resolution_rad);
  properties["range_max"] = finite(range_max_m);
  properties["frequency"] = finite(frequency_hz);
}

/// Requests a device's answer and decodes it. @return nothing if it has none.
template <typename Payload>
std::optional<Payload> ask_for(const AskDevice& ask, std::uint8_t subtype) {
  const auto payload = ask(subtype);
  if (!payload) return std::nullopt;
  return player::decode<Payload>(*payload);
}

void complete_robot(const player::Position2dGeom& geometry, RobotInfo& robot) {
  robot.length_m = finite(geometry.size.sl);
  robot.width_m = finite(geometry.size.sw);
  robot.height_m = finite(geometry.size.sh);
  robot.center_m = {finite(geometry.pose.px), finite(geometry.pose.py)};
  // The farthest corner of the box from the robot's origin.
  robot.radius_m = sim::math::hypot(std::abs(robot.center_m.x()) + 0.5 * robot.length_m,
                                    std::abs(robot.center_m.y()) + 0.5 * robot.width_m);
}

sim::JointAxis axis_of(const player::Point3d& axis) {
  const double x = std::abs(finite(axis.px));
  const double y = std::abs(finite(axis.py));
  const double z = std::abs(finite(axis.pz));
  if (x > y && x > z) return axis.px > 0.0 ? sim::JointAxis::kX : sim::JointAxis::kMinusX;
  if (y > z) return axis.py > 0.0 ? sim::JointAxis::kY : sim::JointAxis::kMinusY;
  return axis.pz < 0.0 ? sim::JointAxis::kMinusZ : sim::JointAxis::kZ;
}

void complete_arm(const player::ActarrayGeom& geometry, Properties& properties) {
  constexpr std::size_t kMostJoints = sim::ActArrayParams::kMaxJoints;
  const std::size_t count = std::min(geometry.actuators.size(), kMostJoints);
  properties["count"] = static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const player::ActarrayActuatorgeom& joint = geometry.actuators[i];
    const auto set = [&](const char* name, double value) {
      properties[std::string(name) + '_' + std::to_string(i)] = finite(value);
    };
    const bool is_linear = joint.type == PLAYER_ACTARRAY_TYPE_LINEAR;
    set("type", static_cast<double>(is_linear ? sim::JointType::kLinear : sim::JointType::kRotary));
    set("length", joint.length);
    set("roll", joint.orientation.proll);
    set("pitch", joint.orientation.ppitch);
    set("yaw", joint.orientation.pyaw);
    set("axis", static_cast<double>(axis_of(joint.axis)));
    set("min", joint.min);
    set("centre", joint.centre);
    set("max", joint.max);
    set("home", joint.home);
    set("speed", joint.config_speed);
    set("brake", joint.hasbrakes != 0 ? 1.0 : 0.0);
  }
  properties["mount_x"] = finite(geometry.base_pos.px);
  properties["mount_y"] = finite(geometry.base_pos.py);
  properties["height"] = finite(geometry.base_pos.pz);
  properties["roll"] = finite(geometry.base_orientation.proll);
  properties["pitch"] = finite(geometry.base_orientation.ppitch);
  properties["mount_yaw"] = finite(geometry.base_orientation.pyaw);
}

void complete_gripper(const player::GripperGeom& geometry, Properties& properties) {
  mount(geometry.pose, properties);
  properties["length"] = finite(geometry.outer_size.sl);
  properties["opening"] = finite(geometry.inner_size.sw);
  properties["thickness"] = 0.5 * finite(geometry.outer_size.sw - geometry.inner_size.sw);
  properties["height"] = finite(geometry.outer_size.sh);
  properties["capacity"] = geometry.capacity;
}

void complete_bumpers(const player::BumperGeom& geometry, Properties& properties) {
  mount_elements(
      geometry.bumper_def,
      [](const player::BumperDefine& bumper) -> const player::Pose3d& { return bumper.pose; },
      properties);
  for (std::size_t i = 0; i < std::min(geometry.bumper_def.size(), kMaxElements); ++i) {
    const player::BumperDefine& bumper = geometry.bumper_def[i];
    properties["length_" + std::to_string(i)] = finite(double{bumper.length});
    properties["radius_" + std::to_string(i)] = finite(double{bumper.radius});
  }
}

void complete_laser(const AskDevice& ask, Properties& properties) {
  if (const auto geometry = ask_for<player::LaserGeom>(ask, PLAYER_LASER_REQ_GET_GEOM)) {
    mount(geometry->pose, properties);
    set_size(geometry->size, properties);
  }
  if (const auto config = ask_for<player::LaserConfig>(ask, PLAYER_LASER_REQ_GET_CONFIG)) {
    set_scanner(double{config->min_angle}, double{config->max_angle}, double{config->resolution},
                double{config->max_range}, double{config->scanning_frequency}, properties);
  }
}

/// The name of a device among those of its robot: that of the interface, with the index unless 0.
std::string device_name(const std::string& interface, unsigned index) {
  return index == 0 ? interface : interface + ':' + std::to_string(index);
}

/// Whether an interface belongs to the world instead of a device.
bool is_of_world(unsigned interface) {
  return interface == PLAYER_BLACKBOARD_CODE || interface == PLAYER_LOG_CODE ||
         interface == PLAYER_MAP_CODE || interface == PLAYER_SIMULATION_CODE;
}

}  // namespace

const char* device_type_of(unsigned interface) noexcept {
  for (const TypeRow& row : kTypes) {
    if (row.interface == interface) return row.type;
  }
  return nullptr;
}

RobotInfo describe_player_robot(const std::string& name, int port,
                                const std::vector<ListedDevice>& devices) {
  RobotInfo robot;
  robot.name = name;
  robot.model = "player";
  robot.port = port;
  robot.addresses.emplace();
  const auto add = [&](std::string device, const char* type) {
    DeviceInfo info;
    info.id = {0, static_cast<int>(robot.devices.size())};
    info.name = std::move(device);
    info.type = type;
    robot.devices.push_back(std::move(info));
    return robot.devices.back().id;
  };
  for (const ListedDevice& listed : devices) {
    const player::Devaddr& at = listed.address;
    const char* known = player_interface_name(at.interf);
    PlayerAddress address;
    address.interface = known != nullptr ? known : "interface " + std::to_string(at.interf);
    address.index = at.index;
    address.driver = listed.driver;
    const char* type = device_type_of(at.interf);
    // Other interfaces without a device are only listed: no proxy asks for them.
    if (type != nullptr && !is_of_world(at.interf)) {
      address.reading = add(device_name(address.interface, at.index), type);
      if (at.interf == PLAYER_POSITION2D_CODE) {
        address.motion = add(device_name("motion", at.index), "motion");
      }
    }
    robot.addresses->push_back(std::move(address));
  }
  return robot;
}

void complete_ranger(const player::RangerGeom* geometry, const player::RangerConfig* config,
                     DeviceInfo& device) {
  Properties& properties = device.properties;
  if (geometry != nullptr) {
    const bool is_laser = geometry->element_poses.size() <= 1;
    device.type = is_laser ? "laser" : "sonar";
    if (is_laser) {
      mount(geometry->pose, properties);
      set_size(geometry->size, properties);
    } else {
      mount_elements(geometry->element_poses, itself, properties);
    }
  }
  if (config != nullptr) {
    set_scanner(config->min_angle, config->max_angle, config->angular_res, config->max_range,
                config->frequency, properties);
    properties["field_of_view"] = finite(config->max_angle - config->min_angle);
    properties["range_min"] = finite(config->min_range);
  }
}

void complete_device(unsigned interface, const AskDevice& ask, RobotInfo& robot,
                     DeviceInfo& device) {
  Properties& properties = device.properties;
  switch (interface) {
    case PLAYER_POSITION2D_CODE:
      if (const auto geometry =
              ask_for<player::Position2dGeom>(ask, PLAYER_POSITION2D_REQ_GET_GEOM)) {
        complete_robot(*geometry, robot);
      }
      break;
    case PLAYER_LASER_CODE:
      complete_laser(ask, properties);
      break;
    case PLAYER_RANGER_CODE: {
      const auto geometry = ask_for<player::RangerGeom>(ask, PLAYER_RANGER_REQ_GET_GEOM);
      const auto config = ask_for<player::RangerConfig>(ask, PLAYER_RANGER_REQ_GET_CONFIG);
      complete_ranger(geometry ? &*geometry : nullptr, config ? &*config : nullptr, device);
      break;
    }
    case PLAYER_SONAR_CODE:
      if (const auto geometry = ask_for<player::SonarGeom>(ask, PLAYER_SONAR_REQ_GET_GEOM)) {
        mount_elements(geometry->poses, itself, properties);
      }
      break;
    case PLAYER_IR_CODE:
      if (const auto geometry = ask_for<player::IrPose>(ask, PLAYER_IR_REQ_POSE)) {
        mount_elements(geometry->poses, itself, properties);
      }
      break;
    case PLAYER_BUMPER_CODE:
      if (const auto geometry = ask_for<player::BumperGeom>(ask, PLAYER_BUMPER_REQ_GET_GEOM)) {
        complete_bumpers(*geometry, properties);
      }
      break;
    case PLAYER_FIDUCIAL_CODE:
      if (const auto geometry = ask_for<player::FiducialGeom>(ask, PLAYER_FIDUCIAL_REQ_GET_GEOM)) {
        mount(geometry->pose, properties);
      }
      break;
    case PLAYER_GRIPPER_CODE:
      if (const auto geometry = ask_for<player::GripperGeom>(ask, PLAYER_GRIPPER_REQ_GET_GEOM)) {
        complete_gripper(*geometry, properties);
      }
      break;
    case PLAYER_PTZ_CODE:
      if (const auto geometry = ask_for<player::PtzGeom>(ask, PLAYER_PTZ_REQ_GEOM)) {
        mount(geometry->pos, properties);
      }
      break;
    case PLAYER_ACTARRAY_CODE:
      if (const auto geometry = ask_for<player::ActarrayGeom>(ask, PLAYER_ACTARRAY_REQ_GET_GEOM)) {
        complete_arm(*geometry, properties);
      }
      break;
    default:
      break;
  }
}

}  // namespace playerlike
