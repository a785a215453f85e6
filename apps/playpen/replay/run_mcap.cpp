// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "replay/run_mcap.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "playerlike/host/reading_json.h"
#include "playerlike/replay/happenings.h"
#include "replay/mcap_writer.h"
#include "replay/printed_lines.h"
#include "sim/core/math.h"
#include "sim/core/replace_file.h"
#include "sim/core/time.h"
#include "sim/core/utf8.h"
#include "sim/devices/builtin.h"
#include "sim/devices/laser.h"

namespace playpen::replay {

using playerlike::replay::HappeningsWatch;
namespace {

using nlohmann::json;

constexpr sim::SimTime kPosePeriod_ns = sim::kNanosecondsPerSecond / 20;
constexpr double kUnitsPerMetre = 1e4;  // resolution of ranges in pictures
constexpr const char* kWorldFrame = "world";

std::string dumped(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

/// A member of an object and its type in JSON Schema.
struct Member {
  const char* name;
  const char* type;
  const char* description = "";
};

json object_schema(std::initializer_list<Member> members) {
  json out = {{"type", "object"}, {"properties", json::object()}};
  for (const Member& member : members) {
    json& own = out["properties"][member.name];
    own["type"] = member.type;
    if (*member.description != '\0') own["description"] = member.description;
  }
  return out;
}

json with_members(json schema, const json& more) {
  schema["properties"].update(more);
  return schema;
}

// The schemas that Foxglove shows, see https://docs.foxglove.dev/docs/sdk/schemas.
json time_schema() { return object_schema({{"sec", "integer"}, {"nsec", "integer"}}); }

json pose_in_space_schema() {
  const json vector = object_schema({{"x", "number"}, {"y", "number"}, {"z", "number"}});
  const json quaternion =
      object_schema({{"x", "number"}, {"y", "number"}, {"z", "number"}, {"w", "number"}});
  return with_members(object_schema({}), {{"position", vector}, {"orientation", quaternion}});
}

json pose_in_frame_schema() {
  return with_members(object_schema({{"frame_id", "string"}}),
                      {{"timestamp", time_schema()}, {"pose", pose_in_space_schema()}});
}

json laser_scan_schema() {
  const json numbers = {{"type", "array"}, {"items", {{"type", "number"}}}};
  json schema =
      with_members(pose_in_frame_schema(), {{"ranges", numbers}, {"intensities", numbers}});
  for (const char* name : {"start_angle", "end_angle"}) {
    schema["properties"][name] = {{"type", "number"}};
  }
  return schema;
}

json log_schema() {
  return with_members(object_schema({{"level", "integer"},
                                     {"message", "string"},
                                     {"name", "string"},
                                     {"file", "string"},
                                     {"line", "integer"}}),
                      {{"timestamp", time_schema()}});
}

json time_json(sim::SimTime time_ns) {
  return {{"sec", time_ns / sim::kNanosecondsPerSecond},
          {"nsec", time_ns % sim::kNanosecondsPerSecond}};
}

json pose_in_space(const sim::Pose& pose, double z_m) {
  return {{"position", {{"x", pose.x_m}, {"y", pose.y_m}, {"z", z_m}}},
          {"orientation",
           {{"x", 0.0},
            {"y", 0.0},
            {"z", sim::math::sin(0.5 * pose.yaw_rad)},
            {"w", sim::math::cos(0.5 * pose.yaw_rad)}}}};
}

/// Writes what a run does to its channels.
class RunChannels {
 public:
  RunChannels(const playerlike::Rerun& rerun, std::ostream& out)
      : writer_(out), printed_(rerun.program_log()) {
    const sim::Simulation& run = rerun.simulation();
    for (int robot = 0; robot < run.robot_count(); ++robot) add_robot(run, robot);
    add_arena();
    if (rerun.program_log().empty()) return;
    log_ = channel("/program/log", "foxglove.Log", log_schema());
  }

  /// Writes the present state, what has happened since the last call, and the new readings.
  void observe(const playerlike::Rerun& rerun) {
    const sim::Simulation& run = rerun.simulation();
    for (const playerlike::RecordedCommand& command : rerun.commands()) add_command(run, command);
    now_ns_ = run.now_ns();
    if (!poses_ns_ || now_ns_ / kPosePeriod_ns > *poses_ns_ / kPosePeriod_ns) add_poses(run);
    for (const sim::Simulation::DeviceId id : run.updated()) add_reading(run, id);
    add_happenings(run);
    add_printed(printed_.until(rerun.printed_bytes()));
  }

  void close(const playerlike::Rerun& rerun) {
    if (poses_ns_ != now_ns_) add_poses(rerun.simulation());
    add_printed(printed_.rest(rerun.printed_bytes()));
    writer_.close();
  }

 private:
  struct DeviceChannels {
    std::string name;
    std::string type;
    std::uint16_t readings = 0;  ///< 0: it makes none
    std::uint16_t scans = 0;     ///< 0: it is no laser
  };
  struct RobotChannels {
    std::uint16_t pose = 0;
    std::uint16_t pose_in_frame = 0;
    std::uint16_t commands = 0;
    std::uint16_t said = 0;
    std::vector<DeviceChannels> devices;
  };

  std::uint16_t channel(std::string topic, const std::string& schema_name, const json& schema) {
    while (!topics_.insert(topic).second) topic += '_';
    return writer_.add_channel(topic, schema_name, dumped(schema));
  }

  void add_robot(const sim::Simulation& run, int robot) {
    const std::string topic = '/' + run.world().robots[static_cast<std::size_t>(robot)].name + '/';
    RobotChannels& own = robots_.emplace_back();
    own.pose = channel(topic + "true_pose", "playpen.TruePose",
                       object_schema({{"x", "number", "true position in the world [m]"},
                                      {"y", "number", "true position in the world [m]"},
                                      {"yaw", "number", "true heading [rad]"},
                                      {"v", "number", "velocity forward [m/s]"},
                                      {"lateral", "number", "velocity to the left [m/s]"},
                                      {"omega", "number", "turn rate [rad/s]"},
                                      {"stalled", "boolean", "blocked by an obstacle"}}));
    own.pose_in_frame =
        channel(topic + "true_pose/in_frame", "foxglove.PoseInFrame", pose_in_frame_schema());
    own.commands = channel(topic + "commands", "playpen.Command",
                           with_members(object_schema({{"device", "string"}}),
                                        {{"command", object_schema({{"kind", "string"}})}}));
    own.said = channel(topic + "said", "playpen.SpokenText", object_schema({{"text", "string"}}));
    for (int i = 0; i < run.device_count(robot); ++i) {
      const sim::Device& device = run.device(robot, i);
      DeviceChannels& channels = own.devices.emplace_back();
      channels.name = device.name();
      channels.type = device.type();
      const sim::DeviceKind* const kind = sim::find_device_kind(device.type());
      if (device.sensor() == nullptr || kind == nullptr || kind->reading.fields == nullptr)
        continue;
      channels.readings = channel(topic + device.name(), "playpen." + channels.type,
                                  json::parse(playerlike::reading_schema(channels.type)));
      if (dynamic_cast<const sim::Laser*>(&device) == nullptr) continue;
      channels.scans =
          channel(topic + device.name() + "/scan", "foxglove.LaserScan", laser_scan_schema());
    }
  }

  void add_arena() {
    events_ = channel("/arena/events", "playpen.ArenaEvent",
                      object_schema({{"number", "integer"},
                                     {"kind", "string"},
                                     {"what", "string", "timer, trap, obstacle or configuration"},
                                     {"who", "string", "robot, if there is one"},
                                     {"text", "string"},
                                     {"value", "number"},
                                     {"description", "string", "the event in words"}}));
    collisions_ = channel("/arena/collisions", "playpen.Collision",
                          object_schema({{"robot", "string"},
                                         {"partner", "string", "obstacle or robot"},
                                         {"x", "number", "contact point in the world [m]"},
                                         {"y", "number", "contact point in the world [m]"}}));
  }

  void write(std::uint16_t to, sim::SimTime publish_ns, const json& message) {
    writer_.write(to, now_ns_, publish_ns, dumped(message));
  }

  void add_poses(const sim::Simulation& run) {
    poses_ns_ = now_ns_;
    for (int robot = 0; robot < run.robot_count(); ++robot) {
      const RobotChannels& own = robots_[static_cast<std::size_t>(robot)];
      const sim::BodyState& body = run.body(robot);
      write(own.pose, now_ns_,
            {{"x", body.X_WB.x_m},
             {"y", body.X_WB.y_m},
             {"yaw", body.X_WB.yaw_rad},
             {"v", body.twist.v_mps},
             {"lateral", body.twist.lateral_mps},
             {"omega", body.twist.omega_radps},
             {"stalled", body.stalled}});
      write(own.pose_in_frame, now_ns_,
            {{"timestamp", time_json(now_ns_)},
             {"frame_id", kWorldFrame},
             {"pose", pose_in_space(body.X_WB, 0.0)}});
    }
  }

  // A command was executed between the step before and the present one: now_ns_ is still its time.
  void add_command(const sim::Simulation& run, const playerlike::RecordedCommand& command) {
    const auto [robot, device] = command.device;
    // Built from texts, because the command is a JSON text already.
    const std::string text = "{\"device\":" + dumped(run.device(robot, device).name()) +
                             ",\"command\":" + playerlike::command_json(command.command) + '}';
    writer_.write(robots_[static_cast<std::size_t>(robot)].commands, now_ns_, now_ns_, text);
  }

  void add_reading(const sim::Simulation& run, sim::Simulation::DeviceId id) {
    const DeviceChannels& own =
        robots_[static_cast<std::size_t>(id.robot)].devices[static_cast<std::size_t>(id.device)];
    if (own.readings == 0) return;
    const sim::Device& device = run.device(id.robot, id.device);
    const sim::Reading& reading = device.sensor()->reading();
    writer_.write(own.readings, now_ns_, reading.time_ns,
                  playerlike::reading_json(own.type, reading));
    if (own.scans == 0) return;
    const auto& laser = static_cast<const sim::Laser&>(device);
    const sim::LaserReading& scan = laser.reading();
    // For pictures, so a third of the digits does. The exact ranges are in the reading.
    json ranges_m = json::array();
    for (const double range_m : scan.ranges_m) {
      ranges_m.push_back(std::round(range_m * kUnitsPerMetre) / kUnitsPerMetre);
    }
    const auto last = static_cast<double>(scan.ranges_m.empty() ? 0 : scan.ranges_m.size() - 1);
    write(own.scans, scan.time_ns,
          {{"timestamp", time_json(scan.time_ns)},
           {"frame_id", kWorldFrame},
           {"pose", pose_in_space(scan.X_WB * laser.params().X_BL, laser.params().height_m)},
           {"start_angle", scan.angle_min_rad},
           {"end_angle", scan.angle_min_rad + last * scan.resolution_rad},
           {"ranges", std::move(ranges_m)},
           {"intensities", scan.intensities}});
  }

  void add_happenings(const sim::Simulation& run) {
    const HappeningsWatch::Happenings fresh = happenings_.look(run);
    for (const sim::ArenaEvent& event : fresh.events) {
      write(events_, event.time_ns,
            {{"number", event.number},
             {"kind", sim::to_string(event.kind)},
             {"what", event.what},
             {"who", event.who},
             {"text", event.text},
             {"value", event.value},
             {"description", sim::description(event)}});
    }
    for (const sim::Collision& collision : fresh.collisions) {
      write(collisions_, collision.time_ns,
            {{"robot", run.world().robots[static_cast<std::size_t>(collision.robot)].name},
             {"partner", collision.partner},
             {"x", collision.place.x()},
             {"y", collision.place.y()}});
    }
    for (const sim::SpokenText& spoken : fresh.spoken) {
      write(robots_[static_cast<std::size_t>(spoken.robot)].said, spoken.time_ns,
            {{"text", spoken.text}});
    }
  }

  void add_printed(std::string_view lines) {
    for (std::size_t end = 0; !lines.empty();
         lines.remove_prefix(std::min(end + 1, lines.size()))) {
      end = std::min(lines.find('\n'), lines.size());
      add_line(lines.substr(0, end));
    }
  }

  void add_line(std::string_view line) {
    constexpr int kInfo = 2;
    write(log_, now_ns_,
          {{"timestamp", time_json(now_ns_)},
           {"level", kInfo},
           {"message", sim::escape_invalid_utf8(line)},
           {"name", "program"},
           {"file", ""},
           {"line", 0}});
  }

  McapWriter writer_;
  std::set<std::string> topics_;
  std::vector<RobotChannels> robots_;
  std::uint16_t events_ = 0;
  std::uint16_t collisions_ = 0;
  std::uint16_t log_ = 0;
  HappeningsWatch happenings_;
  PrintedLines printed_;
  sim::SimTime now_ns_ = 0;
  std::optional<sim::SimTime> poses_ns_;  ///< when they were written last
};

/// A file that is removed unless it is kept.
class PartFile {
 public:
  explicit PartFile(const std::string& file) : file_(file), part_(sim::part_file_name(file)) {
    out_.open(part_, std::ios::binary | std::ios::trunc);
    check();
  }
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;
  ~PartFile() {
    std::error_code ignored;
    if (!kept_) std::filesystem::remove(part_, ignored);
  }
  [[nodiscard]] std::ostream& out() noexcept { return out_; }
  /// Gives the file its name.
  void keep() {
    out_.close();
    check();
    std::error_code error;
    std::filesystem::rename(part_, file_, error);
    if (error) throw std::runtime_error(file_ + ": cannot write the MCAP file: " + error.message());
    kept_ = true;
  }
  void check() const {
    if (out_) return;
    const std::string reason = errno != 0 ? std::strerror(errno) : "unknown error";
    throw std::runtime_error(file_ + ": cannot write the MCAP file: " + reason);
  }

 private:
  std::string file_;
  std::string part_;
  std::ofstream out_;
  bool kept_ = false;
};

}  // namespace

void write_mcap(playerlike::Rerun& rerun, const std::string& file) {
  PartFile part(file);
  RunChannels channels(rerun, part.out());
  channels.observe(rerun);
  while (rerun.step()) {
    channels.observe(rerun);
    part.check();
  }
  channels.close(rerun);
  part.keep();
}

}  // namespace playpen::replay
