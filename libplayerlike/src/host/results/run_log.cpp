// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/results/run_log.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <system_error>
#include <utility>

#include "host/mirror/mirror.h"
#include "host/results/outputs.h"
#include "protocol/codec.h"
#include "sim/core/file.h"

namespace playerlike {
namespace {

namespace fs = std::filesystem;
using protocol::Encoding;
using protocol::json;

constexpr std::string_view kEnding = ".jsonl";
constexpr int kVersion = 1;
constexpr std::size_t kMostRead = std::size_t{1} << 28U;

std::string with_ending(std::string file) {
  if (!file.ends_with(kEnding)) file += kEnding;
  return file;
}

[[noreturn]] void refuse(SessionError::Code code, const std::string& message) {
  throw SessionError(code, message);
}

}  // namespace

RunLog::RunLog(std::string folder, int port, const std::vector<RobotInfo>& robots,
               ClientFiles& files)
    : folder_(std::move(folder)), port_(port), robots_(&robots), files_(&files) {
  status_.file = "log_" + std::to_string(port) + std::string(kEnding);
}

std::string RunLog::path_of(const std::string& file) const {
  return (fs::path(folder_) / file).string();
}

std::string RunLog::path() const { return path_of(status_.file); }

std::optional<std::string> RunLog::file_to_read(const LogRequest& changes) const {
  // A running log cannot change its file. control() reports other errors.
  if (status_.running || !changes.running.value_or(false) || folder_.empty()) return std::nullopt;
  if (!changes.replay.value_or(status_.replay)) return std::nullopt;
  if (changes.file && !is_plain_file_name(*changes.file)) return std::nullopt;
  const bool other = changes.file || changes.replay.value_or(status_.replay) != status_.replay;
  if (!other && !entries_.empty()) return std::nullopt;
  return path_of(changes.file ? with_ending(*changes.file) : status_.file);
}

LogStatus RunLog::control(const LogRequest& changes, const sim::Simulation& simulation,
                          Loaded* loaded) {
  using Code = SessionError::Code;
  if (changes.file) {
    if (!is_plain_file_name(*changes.file)) {
      refuse(Code::kBadArgument,
             "a log is in the run's output folder, under a plain file name of 1 to " +
                 std::to_string(kMaxFileName) + " characters, without folders and no dot in front");
    }
    if (status_.running) refuse(Code::kBadArgument, "stop the log before it gets another file");
    status_.file = with_ending(*changes.file);
    entries_.clear();
  }
  if (changes.replay && *changes.replay != status_.replay) {
    if (status_.running) {
      refuse(Code::kBadArgument, status_.replay ? "stop reading the log before it is written"
                                                : "stop writing the log before it is read");
    }
    static_cast<void>(close());
    status_.replay = *changes.replay;
    entries_.clear();
  }
  if (changes.rewind.value_or(false)) {
    if (!status_.replay) refuse(Code::kBadArgument, "only a log that is read can be rewound");
    next_ = 0;
    played_ns_ = 0;
  }
  if (changes.running && *changes.running != status_.running) {
    if (*changes.running) start(simulation, loaded);
    status_.running = *changes.running;
    if (out_.is_open()) out_.flush();
  }
  return status_;
}

void RunLog::start(const sim::Simulation& simulation, Loaded* loaded) {
  using Code = SessionError::Code;
  if (folder_.empty()) {
    refuse(Code::kNotAvailable,
           "there is no folder for logs: name one by `playpen run --out FOLDER` or PLAYPEN_OUT");
  }
  std::error_code ignored;
  if (fs::is_symlink(path(), ignored)) {
    refuse(Code::kNotAvailable, path() + " is a link, which may lead out of the output folder");
  }
  if (status_.replay) {
    if (entries_.empty()) {
      // The file is read here only if it was changed between the two calls.
      Loaded now;
      if (loaded == nullptr || loaded->path != path()) {
        now = read_file(path(), port_, *robots_);
        loaded = &now;
      }
      if (loaded->problem) throw *loaded->problem;
      entries_ = std::move(loaded->entries);
      begin_ns_ = loaded->begin_ns;
      next_ = 0;
      played_ns_ = 0;
    }
    if (next_ == entries_.size()) {  // start again from the beginning
      next_ = 0;
      played_ns_ = 0;
    }
    return;
  }
  if (out_.is_open()) return;  // resume where it stopped
  files_->require_room(-port_);
  out_.clear();
  out_.open(path(), std::ios::trunc);
  const json head = {{"playpen_log", kVersion},
                     {"world", simulation.world().name},
                     {"port", port_},
                     {"t", simulation.now_ns()}};
  out_ << head.dump(-1, ' ', false, json::error_handler_t::replace) << '\n';
  written_ = 0;
  if (!out_) {
    out_.close();
    refuse(Code::kNotAvailable, "cannot write " + path());
  }
}

namespace {

// Parses a line of a file; numbers begin at 1.
void read_line(const std::string& line, int number, int port, const std::vector<RobotInfo>& robots,
               RunLog::Loaded& loaded) {
  json message = protocol::decode(line, Encoding::kJson);
  if (number == 1) {
    static_cast<void>(protocol::require_integer(message, "playpen_log", kVersion, kVersion));
    loaded.begin_ns = protocol::require_integer(message, "t", 0, sim::from_seconds(1e9));
    return;
  }
  const std::string robot_name = protocol::require_text(message, "robot");
  const std::string device_name = protocol::require_text(message, "device");
  const std::string type = protocol::require_text(message, "type");
  for (const RobotInfo& robot : robots) {
    if (robot.name != robot_name || (port != kMorsePort && robot.port != port)) continue;
    for (const DeviceInfo& device : robot.devices) {
      if (device.name != device_name || device.type != type) continue;
      message["device"] = protocol::encode_device_id(device.id);
      protocol::DecodedReading decoded = protocol::decode_reading(message, Encoding::kJson);
      const sim::SimTime offset_ns = decoded.reading->time_ns - loaded.begin_ns;
      loaded.entries.push_back({offset_ns, device.id, std::move(decoded.reading), false});
    }
  }
}

// Reads the whole file, so that errors are reported before the replay begins.
void read_all(int port, const std::vector<RobotInfo>& robots, RunLog::Loaded& loaded) {
  using Code = SessionError::Code;
  const std::string& path = loaded.path;
  std::error_code error;
  if (fs::is_symlink(path, error)) return;  // start() reports this
  std::string text;
  if (const auto problem = sim::read_whole_file(path, {.most_bytes = kMostRead}, text)) {
    refuse(Code::kNotAvailable, problem->fault == sim::FileFault::kTooLarge
                                    ? path + " is too long: logs are read up to 256 MiB"
                                    : "cannot read " + path + ": " + problem->found);
  }
  std::istringstream in(std::move(text));
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    try {
      read_line(line, number, port, robots, loaded);
    } catch (const protocol::ProtocolError& e) {
      refuse(Code::kBadArgument,
             path + ":" + std::to_string(number) + " is no line of a log: " + e.what());
    }
  }
  if (loaded.entries.empty()) {
    refuse(Code::kBadArgument,
           path + " has no reading of a device that the robots of this port have");
  }
  std::stable_sort(
      loaded.entries.begin(), loaded.entries.end(),
      [](const RunLog::Entry& a, const RunLog::Entry& b) { return a.offset_ns < b.offset_ns; });
}

}  // namespace

RunLog::Loaded RunLog::read_file(const std::string& path, int port,
                                 const std::vector<RobotInfo>& robots) {
  Loaded loaded;
  loaded.path = path;
  try {
    read_all(port, robots, loaded);
  } catch (const SessionError& e) {
    loaded.problem = e;
    loaded.entries.clear();
  }
  return loaded;
}

std::optional<std::string> RunLog::observe(const sim::Simulation& simulation,
                                           const Mirror* mirror) {
  due_.clear();
  replaying_step_ = status_.running && status_.replay;
  if (!status_.running) return std::nullopt;
  if (status_.replay) {
    played_ns_ += simulation.world().simulation.step_ns;
    find_due(simulation.now_ns());
    return std::nullopt;
  }
  write(simulation, mirror);
  files_->note(-port_, path(), written_);
  if (out_ && files_->may_grow(written_)) return std::nullopt;
  const bool full = out_.good();
  status_.running = false;
  out_.close();
  return full ? "the log " + path() + " ends here: it has " + std::to_string(written_) +
                    " bytes, and clients may not fill more of the output folder with files"
              : "the log " + path() + " cannot be written any more";
}

void RunLog::write(const sim::Simulation& simulation, const Mirror* mirror) {
  for (const DeviceId id : simulation.updated()) {
    if (mirror != nullptr && mirror->replaces(id)) continue;
    const sim::Reading& reading = simulation.device(id.robot, id.device).sensor()->reading();
    write(id, reading, reading.time_ns);
  }
  if (mirror == nullptr) return;
  for (const auto& [id, reading] : mirror->readings()) write(id, *reading, simulation.now_ns());
}

void RunLog::write(DeviceId id, const sim::Reading& reading, sim::SimTime time_ns) {
  const RobotInfo& robot = (*robots_)[static_cast<std::size_t>(id.robot)];
  if (port_ != kMorsePort && robot.port != port_) return;
  const DeviceInfo& device = robot.devices[static_cast<std::size_t>(id.device)];
  json line = protocol::encode_reading(id, device.type, reading, Encoding::kJson);
  line["t"] = time_ns;
  line["robot"] = robot.name;
  line["device"] = device.name;
  const std::string text = line.dump(-1, ' ', false, json::error_handler_t::replace);
  out_ << text << '\n';
  written_ += text.size() + 1;
}

void RunLog::find_due(sim::SimTime now_ns) {
  while (next_ < entries_.size() && entries_[next_].offset_ns <= played_ns_) {
    Entry& entry = entries_[next_++];
    if (std::exchange(entry.given, true)) {
      // A copy, because clients still share the earlier reading with its own time stamp.
      const RobotInfo& robot = (*robots_)[static_cast<std::size_t>(entry.device.robot)];
      const DeviceInfo& device = robot.devices[static_cast<std::size_t>(entry.device.device)];
      const json again =
          protocol::encode_reading(entry.device, device.type, *entry.reading, Encoding::kJson);
      entry.reading = protocol::decode_reading(again, Encoding::kJson).reading;
    }
    entry.reading->time_ns = now_ns - (played_ns_ - entry.offset_ns);
    due_.push_back(&entry);
  }
  // Readings come from the devices again from the next step on.
  if (next_ == entries_.size()) status_.running = false;
}

std::optional<std::string> RunLog::close() {
  if (!out_.is_open()) return std::nullopt;
  if (!status_.replay) status_.running = false;
  out_.close();
  if (out_) return std::nullopt;
  return "the log " + path() + " is not complete";
}

}  // namespace playerlike
