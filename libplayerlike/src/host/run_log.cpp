// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/run_log.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "host/outputs.h"
#include "protocol/codec.h"

namespace playerlike {
namespace {

namespace fs = std::filesystem;
using protocol::Encoding;
using protocol::json;

constexpr std::string_view kEnding = ".jsonl";
constexpr int kVersion = 1;
constexpr std::uintmax_t kMostRead = std::uintmax_t{1} << 28U;

[[noreturn]] void refuse(SessionError::Code code, const std::string& message) {
  throw SessionError(code, message);
}

}  // namespace

RunLog::RunLog(std::string folder, int port, const std::vector<RobotInfo>& robots,
               ClientFiles& files)
    : folder_(std::move(folder)), port_(port), robots_(&robots), files_(&files) {
  status_.file = "log_" + std::to_string(port) + std::string(kEnding);
}

std::string RunLog::path() const { return (fs::path(folder_) / status_.file).string(); }

LogStatus RunLog::control(const LogControl& changes, const sim::Simulation& simulation) {
  using Code = SessionError::Code;
  if (changes.file) {
    if (!is_plain_file_name(*changes.file)) {
      refuse(Code::kBadArgument,
             "a log is in the run's output folder, under a plain file name of 1 to " +
                 std::to_string(kMaxFileName) + " characters, without folders and no dot in front");
    }
    if (status_.running) refuse(Code::kBadArgument, "stop the log before it gets another file");
    status_.file = *changes.file;
    if (!status_.file.ends_with(kEnding)) status_.file += kEnding;
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
  if (changes.rewind) {
    if (!status_.replay) refuse(Code::kBadArgument, "only a log that is read can be rewound");
    next_ = 0;
    played_ns_ = 0;
  }
  if (changes.running && *changes.running != status_.running) {
    if (*changes.running) start(simulation);
    status_.running = *changes.running;
    if (out_.is_open()) out_.flush();
  }
  return status_;
}

void RunLog::start(const sim::Simulation& simulation) {
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
    if (entries_.empty()) load();
    if (next_ == entries_.size()) {  // once more from the beginning
      next_ = 0;
      played_ns_ = 0;
    }
    return;
  }
  if (out_.is_open()) return;  // goes on where it stopped
  files_->require_room(-port_);
  out_.clear();
  out_.open(path(), std::ios::trunc);
  const json head = {{"playpen_log", kVersion},
                     {"world", simulation.world().name},
                     {"port", port_},
                     {"t", simulation.now_ns()}};
  out_ << head.dump() << '\n';
  written_ = 0;
  if (!out_) {
    out_.close();
    refuse(Code::kNotAvailable, "cannot write " + path());
  }
}

// Reads the whole file: what is wrong with it is told before it begins.
void RunLog::load() {
  using Code = SessionError::Code;
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path(), error);
  if (error) refuse(Code::kNotAvailable, "cannot read " + path() + ": " + error.message());
  if (size > kMostRead) {
    refuse(Code::kNotAvailable, path() + " is too long: logs are read up to 256 MiB");
  }
  std::ifstream in(path());
  std::string line;
  entries_.clear();
  next_ = 0;
  played_ns_ = 0;
  for (int number = 1; std::getline(in, line); ++number) {
    try {
      read_line(line, number);
    } catch (const protocol::ProtocolError& e) {
      entries_.clear();
      refuse(Code::kBadArgument,
             path() + ":" + std::to_string(number) + " is no line of a log: " + e.what());
    }
  }
  if (entries_.empty()) {
    refuse(Code::kBadArgument,
           path() + " has no reading of a device that the robots of this port have");
  }
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const Entry& a, const Entry& b) { return a.offset_ns < b.offset_ns; });
}

void RunLog::read_line(const std::string& line, int number) {
  json message = protocol::decode(line, Encoding::kJson);
  if (number == 1) {
    static_cast<void>(protocol::require_integer(message, "playpen_log", kVersion, kVersion));
    begin_ns_ = protocol::require_integer(message, "t", 0, sim::from_seconds(1e9));
    return;
  }
  const std::string robot_name = protocol::require_text(message, "robot");
  const std::string device_name = protocol::require_text(message, "device");
  const std::string type = protocol::require_text(message, "type");
  for (const RobotInfo& robot : *robots_) {
    if (robot.name != robot_name || (port_ != kMorsePort && robot.port != port_)) continue;
    for (const DeviceInfo& device : robot.devices) {
      if (device.name != device_name || device.type != type) continue;
      message["device"] = protocol::encode_device_id(device.id);
      protocol::DecodedReading decoded = protocol::decode_reading(message, Encoding::kJson);
      const sim::SimTime offset_ns = decoded.reading->time_ns - begin_ns_;
      entries_.push_back({offset_ns, device.id, std::move(decoded.reading)});
    }
  }
}

std::optional<std::string> RunLog::observe(const sim::Simulation& simulation) {
  due_.clear();
  replaying_step_ = status_.running && status_.replay;
  if (!status_.running) return std::nullopt;
  if (status_.replay) {
    played_ns_ += simulation.world().simulation.step_ns;
    find_due(simulation.now_ns());
    return std::nullopt;
  }
  write(simulation);
  files_->note(-port_, path(), written_);
  if (out_ && files_->may_grow(written_)) return std::nullopt;
  const bool full = out_.good();
  status_.running = false;
  out_.close();
  return full ? "the log " + path() + " ends here: it has " + std::to_string(written_) +
                    " bytes, and clients may not fill more of the output folder with files"
              : "the log " + path() + " cannot be written any more";
}

void RunLog::write(const sim::Simulation& simulation) {
  for (const DeviceId id : simulation.updated()) {
    const RobotInfo& robot = (*robots_)[static_cast<std::size_t>(id.robot)];
    if (port_ != kMorsePort && robot.port != port_) continue;
    const DeviceInfo& device = robot.devices[static_cast<std::size_t>(id.device)];
    const auto& sensor = dynamic_cast<const sim::Sensor&>(simulation.device(id.robot, id.device));
    json line = protocol::encode_reading(id, device.type, sensor.reading(), Encoding::kJson);
    line["robot"] = robot.name;
    line["device"] = device.name;
    const std::string text = line.dump();
    out_ << text << '\n';
    written_ += text.size() + 1;
  }
}

void RunLog::find_due(sim::SimTime now_ns) {
  while (next_ < entries_.size() && entries_[next_].offset_ns <= played_ns_) {
    Entry& entry = entries_[next_++];
    entry.reading->time_ns = now_ns - (played_ns_ - entry.offset_ns);
    due_.push_back(&entry);
  }
  // From the next step on the devices are read again.
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
