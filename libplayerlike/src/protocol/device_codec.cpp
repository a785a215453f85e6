// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Readings and commands. A new sensor gets a pair of functions and a row in kReadingCodecs, a new
// command a row in kCommandCodecs.
#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <variant>

#include "protocol/codec.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"

namespace playerlike::protocol {
namespace {

// --- readings

void write(const sim::PoseReading& reading, json& out, Encoding) {
  out["x"] = reading.pose.x_m;
  out["y"] = reading.pose.y_m;
  out["yaw"] = reading.pose.yaw_rad;
  out["v"] = reading.twist.v_mps;
  out["omega"] = reading.twist.omega_radps;
  out["lateral"] = reading.twist.lateral_mps;
  out["stalled"] = reading.stalled;
}

void read(const json& in, Encoding, sim::PoseReading& reading) {
  reading.pose = {require_number(in, "x"), require_number(in, "y"), require_number(in, "yaw")};
  reading.twist = {require_number(in, "v"), require_number(in, "omega"),
                   require_number(in, "lateral")};
  reading.stalled = require_bool(in, "stalled");
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
    reading_codec<sim::LaserReading>("laser"),
    reading_codec<sim::PoseReading>("odometry"),
    reading_codec<sim::PoseReading>("pose"),
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
       const double lateral_mps = in.contains("lateral") ? require_number(in, "lateral") : 0.0;
       return sim::TwistCommand{
           {require_number(in, "v"), require_number(in, "omega"), lateral_mps}};
     }},
    {"motors",
     {"kind", "on"},
     [](const json& in) -> sim::Command {
       return sim::MotorEnableCommand{require_bool(in, "on")};
     }},
    {"set_pose",
     {"kind", "x", "y", "yaw"},
     [](const json& in) -> sim::Command { return sim::SetPoseCommand{read_pose(in)}; }},
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
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  DecodedReading decoded;
  decoded.device = require_device_id(reading, "device");
  const std::string type = require_text(reading, "type");
  decoded.reading = codec_of(type).read(reading, encoding);
  decoded.reading->sequence = static_cast<std::uint64_t>(require_integer(reading, "seq", 0, kMost));
  decoded.reading->time_ns = require_integer(reading, "t", 0, kMost);
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
