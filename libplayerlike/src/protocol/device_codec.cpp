// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Readings and commands. A new sensor gets a pair of functions and a row in kReadingCodecs, a new
// command a row in kCommandCodecs.
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <variant>

#include "protocol/codec.h"
#include "sim/devices/aio.h"
#include "sim/devices/battery.h"
#include "sim/devices/blinkenlight.h"
#include "sim/devices/blobfinder.h"
#include "sim/devices/bumper.h"
#include "sim/devices/camera.h"
#include "sim/devices/contact_sensors.h"
#include "sim/devices/dio.h"
#include "sim/devices/fiducial.h"
#include "sim/devices/gps.h"
#include "sim/devices/gripper.h"
#include "sim/devices/imu.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"
#include "sim/devices/opaque.h"
#include "sim/devices/proximity.h"
#include "sim/devices/ptz.h"
#include "sim/devices/rangers.h"
#include "sim/devices/waypoint.h"
#include "sim/devices/wifi.h"

namespace playerlike::protocol {
namespace {

constexpr std::int64_t kMostInteger = std::numeric_limits<std::int64_t>::max();

// --- readings

/// The value among `all` whose name stands under a key.
template <typename Status>
Status require_status(const json& in, std::initializer_list<Status> all,
                      const char* key = "status") {
  const json& word = require(in, key);
  std::string names;
  for (const Status status : all) {
    if (word == sim::to_string(status)) return status;
    names += names.empty() ? "" : ", ";
    names += sim::to_string(status);
  }
  refuse_value(key, "one of " + names, word);
}

const json::array_t& require_list(const json& in, const char* key) {
  const json& value = require(in, key);
  const auto* list = value.get_ptr<const json::array_t*>();
  if (list == nullptr) refuse_value(key, "a list", value);
  return *list;
}

sim::Colour require_colour(const json& in, const char* key) {
  const std::optional<sim::Colour> colour = sim::parse_colour(require_text(in, key));
  if (!colour) refuse_value(key, "#rgb, #rrggbb or #rrggbbaa", in.at(key));
  return *colour;
}

constexpr std::int64_t kAllBits = 0xffffffff;

void write(const sim::AioReading& reading, json& out, Encoding encoding) {
  out["inputs"] = doubles(reading.inputs_v, encoding);
  out["outputs"] = doubles(reading.outputs_v, encoding);
}

void read(const json& in, Encoding encoding, sim::AioReading& reading) {
  reading.inputs_v = require_doubles(in, "inputs", encoding);
  reading.outputs_v = require_doubles(in, "outputs", encoding);
}

void write(const sim::BatteryReading& reading, json& out, Encoding) {
  out["charge"] = reading.charge_percent;
  out["status"] = sim::to_string(reading.status);
  out["voltage"] = reading.voltage_v;
  out["energy"] = reading.energy_wh;
  out["capacity"] = reading.capacity_wh;
  out["power"] = reading.power_w;
}

void read(const json& in, Encoding, sim::BatteryReading& reading) {
  using Status = sim::BatteryStatus;
  reading.charge_percent = require_number(in, "charge");
  reading.status = require_status(in, {Status::kCharged, Status::kCharging, Status::kDischarging});
  reading.voltage_v = require_number(in, "voltage");
  reading.energy_wh = require_number(in, "energy");
  reading.capacity_wh = require_number(in, "capacity");
  reading.power_w = require_number(in, "power");
}

void write(const sim::BumperReading& reading, json& out, Encoding encoding) {
  out["pressed"] =
      doubles(std::vector<double>(reading.pressed.begin(), reading.pressed.end()), encoding);
}

void read(const json& in, Encoding encoding, sim::BumperReading& reading) {
  for (const double number : require_doubles(in, "pressed", encoding)) {
    const bool fits = number >= 0.0 && number <= 255.0 && number == std::floor(number);
    if (!fits) refuse_value("pressed", "whole numbers from 0 to 255", json(number));
    reading.pressed.push_back(static_cast<std::uint8_t>(number));
  }
}

void write(const sim::BlinkenlightReading& reading, json& out, Encoding) {
  out["on"] = reading.enabled;
  out["colour"] = sim::to_string(reading.colour);
  out["period"] = reading.period_s;
  out["duty_cycle"] = reading.duty_cycle;
  out["lit"] = reading.lit;
}

void read(const json& in, Encoding, sim::BlinkenlightReading& reading) {
  reading.enabled = require_bool(in, "on");
  reading.colour = require_colour(in, "colour");
  reading.period_s = require_number(in, "period");
  reading.duty_cycle = require_number(in, "duty_cycle");
  reading.lit = require_bool(in, "lit");
}

/// A whole number of pixels, from 0 on.
int require_pixels(const json& in, const char* key, int most) {
  return static_cast<int>(require_integer(in, key, 0, most));
}

void write(const sim::BlobfinderReading& reading, json& out, Encoding) {
  json list = json::array();
  for (const auto& blob : reading.blobs) {
    list.push_back({{"colour", sim::to_string(blob.colour)},
                    {"area", blob.area},
                    {"x", blob.x},
                    {"y", blob.y},
                    {"left", blob.left},
                    {"right", blob.right},
                    {"top", blob.top},
                    {"bottom", blob.bottom},
                    {"range", blob.range_m}});
  }
  out["width"] = reading.width;
  out["height"] = reading.height;
  out["blobs"] = std::move(list);
}

void read(const json& in, Encoding, sim::BlobfinderReading& reading) {
  constexpr int kGreatest = std::numeric_limits<int>::max();
  reading.width = require_pixels(in, "width", kGreatest);
  reading.height = require_pixels(in, "height", kGreatest);
  for (const json& blob : require_list(in, "blobs")) {
    reading.blobs.push_back(
        {require_colour(blob, "colour"), require_pixels(blob, "area", kGreatest),
         require_pixels(blob, "x", kGreatest), require_pixels(blob, "y", kGreatest),
         require_pixels(blob, "left", kGreatest), require_pixels(blob, "right", kGreatest),
         require_pixels(blob, "top", kGreatest), require_pixels(blob, "bottom", kGreatest),
         require_number(blob, "range")});
  }
}

void write(const sim::CameraReading& reading, json& out, Encoding encoding) {
  out["width"] = reading.width;
  out["height"] = reading.height;
  out["pixels"] = bytes(reading.pixels, encoding);
}

void read(const json& in, Encoding encoding, sim::CameraReading& reading) {
  reading.width = require_pixels(in, "width", sim::ViewParams::kMaxWidth);
  reading.height = require_pixels(in, "height", sim::ViewParams::kMaxHeight);
  reading.pixels = require_bytes(in, "pixels", encoding);
  const std::int64_t size = std::int64_t{3} * reading.width * reading.height;
  if (static_cast<std::int64_t>(reading.pixels.size()) != size) {
    refuse_value("pixels", "three bytes for each pixel", in.at("pixels"));
  }
}

void write(const sim::CollisionReading& reading, json& out, Encoding) {
  out["collision"] = reading.collision;
  out["objects"] = reading.objects;
}

void read(const json& in, Encoding, sim::CollisionReading& reading) {
  reading.collision = require_bool(in, "collision");
  for (const json& name : require_list(in, "objects")) {
    if (!name.is_string()) refuse_value("objects", "a list of names", name);
    reading.objects.push_back(name.get<std::string>());
  }
}

void write(const sim::FiducialReading& reading, json& out, Encoding) {
  json list = json::array();
  for (const auto& mark : reading.marks) {
    json entry = encode_pose(mark.X_ST);
    entry["id"] = mark.id;
    list.push_back(std::move(entry));
  }
  out["marks"] = std::move(list);
}

void read(const json& in, Encoding, sim::FiducialReading& reading) {
  for (const json& mark : require_list(in, "marks")) {
    reading.marks.push_back(
        {static_cast<int>(require_integer(mark, "id", std::numeric_limits<int>::min(),
                                          std::numeric_limits<int>::max())),
         {require_number(mark, "x"), require_number(mark, "y"), require_number(mark, "yaw")}});
  }
}

void write(const sim::GpsReading& reading, json& out, Encoding) {
  out["latitude"] = reading.latitude_rad;
  out["longitude"] = reading.longitude_rad;
  out["altitude"] = reading.altitude_m;
  out["speed"] = reading.speed_mps;
  out["course"] = reading.course_rad;
  out["utm_easting"] = reading.utm_easting_m;
  out["utm_northing"] = reading.utm_northing_m;
  out["satellites"] = reading.satellites;
  out["quality"] = reading.quality;
}

void read(const json& in, Encoding, sim::GpsReading& reading) {
  constexpr int kLeast = std::numeric_limits<int>::min();
  constexpr int kGreatest = std::numeric_limits<int>::max();
  reading.latitude_rad = require_number(in, "latitude");
  reading.longitude_rad = require_number(in, "longitude");
  reading.altitude_m = require_number(in, "altitude");
  reading.speed_mps = require_number(in, "speed");
  reading.course_rad = require_number(in, "course");
  reading.utm_easting_m = require_number(in, "utm_easting");
  reading.utm_northing_m = require_number(in, "utm_northing");
  reading.satellites = static_cast<int>(require_integer(in, "satellites", kLeast, kGreatest));
  reading.quality = static_cast<int>(require_integer(in, "quality", kLeast, kGreatest));
}

json encode_vector(const std::array<double, 3>& v) {
  return {{"x", v[0]}, {"y", v[1]}, {"z", v[2]}};
}

std::array<double, 3> require_vector(const json& in, const char* key) {
  const json& vector = require(in, key);
  if (!vector.is_object()) refuse_value(key, "an object {\"x\", \"y\", \"z\"}", vector);
  return {require_number(vector, "x"), require_number(vector, "y"), require_number(vector, "z")};
}

void write(const sim::ImuReading& reading, json& out, Encoding) {
  out["acceleration"] = encode_vector(reading.acceleration_mps2);
  out["rate"] = encode_vector(reading.rate_radps);
  out["field"] = encode_vector(reading.field_ut);
  out["yaw"] = reading.yaw_rad;
}

void read(const json& in, Encoding, sim::ImuReading& reading) {
  reading.acceleration_mps2 = require_vector(in, "acceleration");
  reading.rate_radps = require_vector(in, "rate");
  reading.field_ut = require_vector(in, "field");
  reading.yaw_rad = require_number(in, "yaw");
}

void write(const sim::GripperReading& reading, json& out, Encoding) {
  out["state"] = sim::to_string(reading.state);
  out["outer_beam"] = reading.outer_beam;
  out["inner_beam"] = reading.inner_beam;
  out["holding"] = reading.holding;
  out["stored"] = reading.stored;
  out["gap"] = reading.gap_m;
}

void read(const json& in, Encoding, sim::GripperReading& reading) {
  using State = sim::GripperState;
  reading.state =
      require_status(in, {State::kOpen, State::kClosed, State::kMoving, State::kError}, "state");
  reading.outer_beam = require_bool(in, "outer_beam");
  reading.inner_beam = require_bool(in, "inner_beam");
  reading.holding = require_bool(in, "holding");
  reading.stored =
      static_cast<int>(require_integer(in, "stored", 0, sim::GripperParams::kMaxStored));
  reading.gap_m = require_number(in, "gap");
}

void write(const sim::DioReading& reading, json& out, Encoding) {
  out["count"] = reading.input_count;
  out["inputs"] = reading.inputs;
  out["output_count"] = reading.output_count;
  out["outputs"] = reading.outputs;
}

void read(const json& in, Encoding, sim::DioReading& reading) {
  constexpr int kLines = sim::DioParams::kMaxLines;
  reading.input_count = static_cast<int>(require_integer(in, "count", 0, kLines));
  reading.inputs = static_cast<std::uint32_t>(require_integer(in, "inputs", 0, kAllBits));
  reading.output_count = static_cast<int>(require_integer(in, "output_count", 0, kLines));
  reading.outputs = static_cast<std::uint32_t>(require_integer(in, "outputs", 0, kAllBits));
}

void write(const sim::LaserReading& reading, json& out, Encoding encoding) {
  out["ranges"] = doubles(reading.ranges_m, encoding);
  out["angle_min"] = reading.angle_min_rad;
  out["resolution"] = reading.resolution_rad;
  out["range_max"] = reading.range_max_m;
}

void read(const json& in, Encoding encoding, sim::LaserReading& reading) {
  reading.ranges_m = require_doubles(in, "ranges", encoding);
  reading.angle_min_rad = require_number(in, "angle_min");
  reading.resolution_rad = require_number(in, "resolution");
  reading.range_max_m = require_number(in, "range_max");
}

void write(const sim::OpaqueReading& reading, json& out, Encoding encoding) {
  out["data"] = bytes(reading.data, encoding);
  out["number"] = reading.number;
  out["lost"] = reading.lost;
}

void read(const json& in, Encoding encoding, sim::OpaqueReading& reading) {
  reading.data = require_bytes(in, "data", encoding);
  reading.number = static_cast<std::uint64_t>(require_integer(in, "number", 0, kMostInteger));
  reading.lost = static_cast<std::uint64_t>(require_integer(in, "lost", 0, kMostInteger));
}

void write(const sim::PoseReading& reading, json& out, Encoding) {
  out["x"] = reading.pose.x_m;
  out["y"] = reading.pose.y_m;
  out["yaw"] = reading.pose.yaw_rad;
  out["v"] = reading.twist.v_mps;
  out["omega"] = reading.twist.omega_radps;
  out["lateral"] = reading.twist.lateral_mps;
  out["stalled"] = reading.stalled;
  out["path_length"] = reading.path_length_m;
  out["increment"] = encode_pose(reading.increment);
}

void read(const json& in, Encoding, sim::PoseReading& reading) {
  reading.pose = {require_number(in, "x"), require_number(in, "y"), require_number(in, "yaw")};
  reading.twist = {require_number(in, "v"), require_number(in, "omega"),
                   require_number(in, "lateral")};
  reading.stalled = require_bool(in, "stalled");
  reading.path_length_m = require_number(in, "path_length");
  reading.increment = require_pose(in, "increment");
}

void write(const sim::ProximityReading& reading, json& out, Encoding) {
  json list = json::array();
  for (const auto& neighbour : reading.near_objects) {
    list.push_back({{"name", neighbour.name}, {"distance", neighbour.distance_m}});
  }
  out["near_objects"] = std::move(list);
}

void read(const json& in, Encoding, sim::ProximityReading& reading) {
  for (const json& neighbour : require_list(in, "near_objects")) {
    reading.near_objects.push_back(
        {require_text(neighbour, "name"), require_number(neighbour, "distance")});
  }
}

void write(const sim::PtzReading& reading, json& out, Encoding) {
  out["pan"] = reading.pan_rad;
  out["tilt"] = reading.tilt_rad;
  out["view"] = reading.view_rad;
  out["pan_speed"] = reading.pan_speed_radps;
  out["tilt_speed"] = reading.tilt_speed_radps;
  out["zoom_speed"] = reading.zoom_speed_radps;
  out["moving"] = reading.moving;
}

void read(const json& in, Encoding, sim::PtzReading& reading) {
  reading.pan_rad = require_number(in, "pan");
  reading.tilt_rad = require_number(in, "tilt");
  reading.view_rad = require_number(in, "view");
  reading.pan_speed_radps = require_number(in, "pan_speed");
  reading.tilt_speed_radps = require_number(in, "tilt_speed");
  reading.zoom_speed_radps = require_number(in, "zoom_speed");
  reading.moving = require_bool(in, "moving");
}

void write(const sim::RangerReading& reading, json& out, Encoding encoding) {
  json mountings = json::array();
  for (const sim::Pose& X_BS : reading.X_BS) mountings.push_back(encode_pose(X_BS));
  out["ranges"] = doubles(reading.ranges_m, encoding);
  out["mountings"] = std::move(mountings);
  out["range_max"] = reading.range_max_m;
  out["field_of_view"] = reading.field_of_view_rad;
}

void read(const json& in, Encoding encoding, sim::RangerReading& reading) {
  reading.ranges_m = require_doubles(in, "ranges", encoding);
  for (const json& X_BS : require_list(in, "mountings")) {
    reading.X_BS.push_back(
        {require_number(X_BS, "x"), require_number(X_BS, "y"), require_number(X_BS, "yaw")});
  }
  if (reading.X_BS.size() != reading.ranges_m.size()) {
    refuse_value("mountings", "as many as there are ranges", in.at("mountings"));
  }
  reading.range_max_m = require_number(in, "range_max");
  reading.field_of_view_rad = require_number(in, "field_of_view");
}

void write(const sim::WaypointReading& reading, json& out, Encoding) {
  out["status"] = sim::to_string(reading.status);
  out["goal_number"] = reading.goal_number;
  out["x"] = reading.goal_m.x();
  out["y"] = reading.goal_m.y();
  out["distance"] = reading.distance_m;
}

void read(const json& in, Encoding, sim::WaypointReading& reading) {
  using Status = sim::WaypointStatus;
  reading.status = require_status(in, {Status::kArrived, Status::kTransit, Status::kStop});
  reading.goal_number =
      static_cast<std::uint64_t>(require_integer(in, "goal_number", 0, kMostInteger));
  reading.goal_m = {require_number(in, "x"), require_number(in, "y")};
  reading.distance_m = require_number(in, "distance");
}

void write(const sim::WifiReading& reading, json& out, Encoding) {
  json list = json::array();
  for (const auto& link : reading.links) {
    list.push_back({{"name", link.name},
                    {"mac", link.mac},
                    {"ip", link.ip},
                    {"access_point", link.access_point},
                    {"level", link.level_dbm}});
  }
  out["links"] = std::move(list);
  out["own"] = {{"ip", reading.own_ip}};
  out["floor"] = reading.floor_dbm;
  out["channel"] = reading.channel_mhz;
}

void read(const json& in, Encoding, sim::WifiReading& reading) {
  for (const json& link : require_list(in, "links")) {
    reading.links.push_back({require_text(link, "name"), require_text(link, "mac"),
                             require_text(link, "ip"), require_bool(link, "access_point"),
                             require_number(link, "level")});
  }
  const json& own = require(in, "own");
  if (!own.is_object()) refuse_value("own", "an object {\"ip\"}", own);
  reading.own_ip = require_text(own, "ip");
  reading.floor_dbm = require_number(in, "floor");
  reading.channel_mhz = require_number(in, "channel");
}

/// How the readings of a type of device are told.
struct ReadingCodec {
  std::string_view type;
  void (*write)(const sim::Reading& reading, json& out, Encoding encoding);
  std::unique_ptr<sim::Reading> (*read)(const json& in, Encoding encoding);
};

template <typename ReadingType>
constexpr ReadingCodec reading_codec(std::string_view type) {
  return {type,
          [](const sim::Reading& reading, json& out, Encoding encoding) {
            protocol::write(dynamic_cast<const ReadingType&>(reading), out, encoding);
          },
          [](const json& in, Encoding encoding) -> std::unique_ptr<sim::Reading> {
            auto reading = std::make_unique<ReadingType>();
            protocol::read(in, encoding, *reading);
            return reading;
          }};
}

constexpr ReadingCodec kReadingCodecs[] = {
    reading_codec<sim::AioReading>("aio"),
    reading_codec<sim::BatteryReading>("battery"),
    reading_codec<sim::BlinkenlightReading>("blinkenlight"),
    reading_codec<sim::BlobfinderReading>("blobfinder"),
    reading_codec<sim::BumperReading>("bumper"),
    reading_codec<sim::CameraReading>("camera"),
    reading_codec<sim::CollisionReading>("collision"),
    reading_codec<sim::DioReading>("dio"),
    reading_codec<sim::FiducialReading>("fiducial"),
    reading_codec<sim::GpsReading>("gps"),
    reading_codec<sim::GripperReading>("gripper"),
    reading_codec<sim::ImuReading>("imu"),
    reading_codec<sim::RangerReading>("infrared"),
    reading_codec<sim::LaserReading>("laser"),
    reading_codec<sim::PoseReading>("odometry"),
    reading_codec<sim::OpaqueReading>("opaque"),
    reading_codec<sim::PoseReading>("pose"),
    reading_codec<sim::ProximityReading>("proximity"),
    reading_codec<sim::PtzReading>("ptz"),
    reading_codec<sim::RangerReading>("sonar"),
    reading_codec<sim::WaypointReading>("waypoint"),
    reading_codec<sim::WifiReading>("wifi"),
};

const ReadingCodec& codec_of(std::string_view type) {
  const auto* const codec = std::find_if(std::begin(kReadingCodecs), std::end(kReadingCodecs),
                                         [&](const ReadingCodec& row) { return row.type == type; });
  if (codec == std::end(kReadingCodecs)) {
    refuse_value("type", "a type of device that makes readings", std::string(type));
  }
  return *codec;
}

// --- commands

json to_json(const sim::TwistCommand& command) {
  return {{"kind", "twist"},
          {"v", command.twist.v_mps},
          {"omega", command.twist.omega_radps},
          {"lateral", command.twist.lateral_mps}};
}

json to_json(const sim::MotorEnableCommand& command) {
  return {{"kind", "motors"}, {"on", command.enabled}};
}

json pose_command(const char* kind, const sim::Pose& pose) {
  json out = encode_pose(pose);
  out["kind"] = kind;
  return out;
}

json to_json(const sim::SetPoseCommand& command) { return pose_command("set_pose", command.pose); }

json to_json(const sim::GotoCommand& command) {
  return {{"kind", "goto"},
          {"x", command.goal_m.x()},
          {"y", command.goal_m.y()},
          {"tolerance", command.tolerance_m},
          {"speed", command.speed_mps}};
}

json to_json(const sim::StopCommand&) { return {{"kind", "stop"}}; }

json to_json(const sim::ResumeCommand&) { return {{"kind", "resume"}}; }

json to_json(const sim::PlaceCommand& command) { return pose_command("place", command.pose); }

json to_json(const sim::TranslateCommand& command) {
  return {{"kind", "translate"}, {"x", command.offset_m.x()}, {"y", command.offset_m.y()}};
}

json to_json(const sim::RotateCommand& command) {
  return {{"kind", "rotate"}, {"yaw", command.yaw_rad}};
}

json to_json(const sim::HeadingCommand& command) {
  return {{"kind", "heading"},
          {"v", command.v_mps},
          {"lateral", command.lateral_mps},
          {"yaw", command.yaw_rad},
          {"frame", command.frame}};
}

json to_json(const sim::PositionCommand& command) {
  json out = pose_command("position", command.goal);
  out["max_speed"] = command.max_speed_mps;
  out["max_turn_rate"] = command.max_turn_rate_radps;
  out["frame"] = command.frame;
  return out;
}

json to_json(const sim::CarCommand& command) {
  return {{"kind", "car"}, {"v", command.v_mps}, {"steering", command.steering_rad}};
}

int read_frame(const json& in) {
  using Limits = std::numeric_limits<int>;
  return static_cast<int>(require_integer(in, "frame", Limits::min(), Limits::max()));
}

double read_lateral(const json& in) {
  return in.contains("lateral") ? require_number(in, "lateral") : 0.0;
}

json to_json(const sim::SayCommand& command) { return {{"kind", "say"}, {"text", command.text}}; }

json to_json(const sim::DigitalOutputCommand& command) {
  return {{"kind", "digital"}, {"count", command.count}, {"outputs", command.bits}};
}

json to_json(const sim::AnalogOutputCommand& command) {
  return {{"kind", "analog"}, {"output", command.channel}, {"voltage", command.voltage_v}};
}

json to_json(const sim::LightCommand& command) {
  json out = {{"kind", "light"}};
  if (command.enabled) out["on"] = *command.enabled;
  if (command.colour) out["colour"] = sim::to_string(*command.colour);
  if (command.period_s) out["period"] = *command.period_s;
  if (command.duty_cycle) out["duty_cycle"] = *command.duty_cycle;
  return out;
}

// In the order of GripCommand::Action.
constexpr std::array<std::string_view, 5> kGripActions = {"open", "close", "stop", "store",
                                                          "retrieve"};

json to_json(const sim::GripCommand& command) {
  return {{"kind", "grip"}, {"action", kGripActions[static_cast<std::size_t>(command.action)]}};
}

sim::GripCommand read_grip(const json& in) {
  const std::string action = require_text(in, "action");
  const auto* const found = std::find(kGripActions.begin(), kGripActions.end(), action);
  if (found == kGripActions.end()) {
    refuse_value("action", "open, close, stop, store or retrieve", in.at("action"));
  }
  return {static_cast<sim::GripCommand::Action>(found - kGripActions.begin())};
}

// A command has no encoding of its own to know: in CBOR, too, its bytes are a text in base64.
json to_json(const sim::PointCommand& command) {
  return {{"kind", "point"},
          {"pan", command.pan_rad},
          {"tilt", command.tilt_rad},
          {"view", command.view_rad},
          {"pan_speed", command.pan_speed_radps},
          {"tilt_speed", command.tilt_speed_radps}};
}

json to_json(const sim::PanCommand& command) {
  return {{"kind", "pan"},
          {"pan_speed", command.pan_speed_radps},
          {"tilt_speed", command.tilt_speed_radps},
          {"zoom_speed", command.zoom_speed_radps}};
}

json to_json(const sim::OpaqueCommand& command) {
  return {{"kind", "opaque"}, {"data", bytes(command.data, Encoding::kJson)}};
}

sim::Vec2 read_point(const json& in) { return {require_number(in, "x"), require_number(in, "y")}; }

sim::Pose read_pose(const json& in) {
  return {require_number(in, "x"), require_number(in, "y"), require_number(in, "yaw")};
}

/// How a kind of command is understood.
struct CommandCodec {
  std::string_view kind;
  std::initializer_list<std::string_view> keys;
  sim::Command (*decode)(const json& in);
};

const CommandCodec kCommandCodecs[] = {
    {"twist",
     {"kind", "v", "omega", "lateral"},
     [](const json& in) -> sim::Command {
       return sim::TwistCommand{
           {require_number(in, "v"), require_number(in, "omega"), read_lateral(in)}};
     }},
    {"motors",
     {"kind", "on"},
     [](const json& in) -> sim::Command {
       return sim::MotorEnableCommand{require_bool(in, "on")};
     }},
    {"set_pose",
     {"kind", "x", "y", "yaw"},
     [](const json& in) -> sim::Command { return sim::SetPoseCommand{read_pose(in)}; }},
    {"goto",
     {"kind", "x", "y", "tolerance", "speed"},
     [](const json& in) -> sim::Command {
       return sim::GotoCommand{read_point(in), require_number(in, "tolerance"),
                               require_number(in, "speed")};
     }},
    {"stop", {"kind"}, [](const json&) -> sim::Command { return sim::StopCommand{}; }},
    {"resume", {"kind"}, [](const json&) -> sim::Command { return sim::ResumeCommand{}; }},
    {"place",
     {"kind", "x", "y", "yaw"},
     [](const json& in) -> sim::Command { return sim::PlaceCommand{read_pose(in)}; }},
    {"translate",
     {"kind", "x", "y"},
     [](const json& in) -> sim::Command { return sim::TranslateCommand{read_point(in)}; }},
    {"rotate",
     {"kind", "yaw"},
     [](const json& in) -> sim::Command { return sim::RotateCommand{require_number(in, "yaw")}; }},
    {"heading",
     {"kind", "v", "lateral", "yaw", "frame"},
     [](const json& in) -> sim::Command {
       return sim::HeadingCommand{require_number(in, "v"), read_lateral(in),
                                  require_number(in, "yaw"), read_frame(in)};
     }},
    {"position",
     {"kind", "x", "y", "yaw", "max_speed", "max_turn_rate", "frame"},
     [](const json& in) -> sim::Command {
       return sim::PositionCommand{read_pose(in), require_number(in, "max_speed"),
                                   require_number(in, "max_turn_rate"), read_frame(in)};
     }},
    {"car",
     {"kind", "v", "steering"},
     [](const json& in) -> sim::Command {
       return sim::CarCommand{require_number(in, "v"), require_number(in, "steering")};
     }},
    {"say",
     {"kind", "text"},
     [](const json& in) -> sim::Command { return sim::SayCommand{require_text(in, "text")}; }},
    {"digital",
     {"kind", "count", "outputs"},
     [](const json& in) -> sim::Command {
       constexpr int kLines = sim::DioParams::kMaxLines;
       return sim::DigitalOutputCommand{
           static_cast<int>(require_integer(in, "count", 0, kLines)),
           static_cast<std::uint32_t>(require_integer(in, "outputs", 0, kAllBits))};
     }},
    {"analog",
     {"kind", "output", "voltage"},
     [](const json& in) -> sim::Command {
       constexpr int kLines = sim::AioParams::kMaxLines;
       return sim::AnalogOutputCommand{
           static_cast<int>(require_integer(in, "output", 0, kLines - 1)),
           require_number(in, "voltage")};
     }},
    {"light",
     {"kind", "on", "colour", "period", "duty_cycle"},
     [](const json& in) -> sim::Command {
       sim::LightCommand command;
       if (in.contains("on")) command.enabled = require_bool(in, "on");
       if (in.contains("colour")) command.colour = require_colour(in, "colour");
       if (in.contains("period")) command.period_s = require_number(in, "period");
       if (in.contains("duty_cycle")) command.duty_cycle = require_number(in, "duty_cycle");
       return command;
     }},
    {"grip", {"kind", "action"}, [](const json& in) -> sim::Command { return read_grip(in); }},
    {"opaque",
     {"kind", "data"},
     [](const json& in) -> sim::Command {
       return sim::OpaqueCommand{require_bytes(in, "data", Encoding::kJson)};
     }},
    {"point",
     {"kind", "pan", "tilt", "view", "pan_speed", "tilt_speed"},
     [](const json& in) -> sim::Command {
       return sim::PointCommand{require_number(in, "pan"), require_number(in, "tilt"),
                                require_number(in, "view"), require_number(in, "pan_speed"),
                                require_number(in, "tilt_speed")};
     }},
    {"pan",
     {"kind", "pan_speed", "tilt_speed", "zoom_speed"},
     [](const json& in) -> sim::Command {
       return sim::PanCommand{require_number(in, "pan_speed"), require_number(in, "tilt_speed"),
                              require_number(in, "zoom_speed")};
     }},
};

}  // namespace

json encode_reading(DeviceId device, std::string_view type, const sim::Reading& reading,
                    Encoding encoding) {
  json out = {{"device", encode_device_id(device)},
              {"seq", reading.sequence},
              {"t", reading.time_ns},
              {"type", type}};
  codec_of(type).write(reading, out, encoding);
  return out;
}

DecodedReading decode_reading(const json& reading, Encoding encoding) {
  DecodedReading decoded;
  decoded.device = require_device_id(reading, "device");
  const std::string type = require_text(reading, "type");
  decoded.reading = codec_of(type).read(reading, encoding);
  decoded.reading->sequence =
      static_cast<std::uint64_t>(require_integer(reading, "seq", 0, kMostInteger));
  decoded.reading->time_ns = require_integer(reading, "t", 0, kMostInteger);
  return decoded;
}

json encode_command(const sim::Command& command) {
  return std::visit([](const auto& what) { return to_json(what); }, command);
}

sim::Command decode_command(const json& command) {
  const std::string kind = require_text(command, "kind");
  std::string kinds;
  for (const CommandCodec& codec : kCommandCodecs) {
    if (codec.kind == kind) {
      refuse_unknown_keys(command, codec.keys, "a command " + kind);
      return codec.decode(command);
    }
    kinds += kinds.empty() ? "" : ", ";
    kinds += codec.kind;
  }
  refuse_value("kind", "one of " + kinds, command.at("kind"));
}

}  // namespace playerlike::protocol
