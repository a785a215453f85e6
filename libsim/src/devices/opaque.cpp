// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/opaque.h"

#include <algorithm>
#include <utility>

#include "devices/device_kind.h"

namespace sim {

Opaque::Opaque(std::string name, const OpaqueParams& params)
    : SensorOf(std::move(name), "opaque", params.frequency_hz), params_(params) {}

std::optional<std::string> Opaque::connect(std::string_view robot, const DeviceDirectory& devices) {
  connections_.clear();
  if (params_.from.empty()) connections_.push_back({this, 0});
  for (const std::string& name : params_.from) {
    const std::size_t dot = name.find('.');
    const std::string device = dot == std::string::npos ? "opaque" : name.substr(dot + 1);
    const auto* sender = dynamic_cast<const Opaque*>(devices.find(name.substr(0, dot), device));
    if (sender == nullptr) {
      return "an opaque device at \"" + name + "\", whose messages are to arrive at robot " +
             std::string(robot);
    }
    connections_.push_back({sender, 0});
  }
  return std::nullopt;
}

std::optional<std::string> Opaque::apply(const Command& command) {
  const auto* message = std::get_if<OpaqueCommand>(&command);
  if (message == nullptr) return Sensor::apply(command);
  if (message->data.size() > kMaxOpaque) {
    return "device " + name() + " sends at most " + std::to_string(kMaxOpaque) +
           " bytes at a time, but the message has " + std::to_string(message->data.size());
  }
  if (message->data.empty()) return std::nullopt;
  sent_messages_.push_back(message->data);
  ++sent_;
  // No receiver's queue holds more.
  if (sent_messages_.size() > kMaxQueue) sent_messages_.pop_front();
  return std::nullopt;
}

void Opaque::receive(Connection& connection) {
  const std::uint64_t count = connection.sender->sent_;
  const auto& messages = connection.sender->sent_messages_;
  const std::uint64_t kept =
      std::min<std::uint64_t>(count - connection.received_count, messages.size());
  lost_ += count - connection.received_count - kept;
  arrived_.insert(arrived_.end(), messages.end() - static_cast<std::ptrdiff_t>(kept),
                  messages.end());
  connection.received_count = count;
  while (arrived_.size() > kMaxQueue) {
    arrived_.pop_front();
    ++lost_;
  }
}

void Opaque::integrate(const StepContext&) {
  for (Connection& connection : connections_) receive(connection);
  // All receivers have received the messages sent before the last step.
  const std::uint64_t since = sent_ - sent_before_step_;
  while (sent_messages_.size() > since) sent_messages_.pop_front();
  sent_before_step_ = sent_;
}

void Opaque::measure(const StepContext& context) {
  auto& reading = next(context);
  reading.data.clear();
  if (!arrived_.empty()) {
    reading.data = std::move(arrived_.front());
    arrived_.pop_front();
    ++reading.number;
  }
  reading.lost = lost_;
}

void Opaque::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  for (Connection& connection : connections_) archive(connection.received_count);
  archive(sent_messages_, sent_, sent_before_step_, arrived_, lost_);
}

namespace {

bool read_sender(const io::Reader& value, void* sender) {
  const std::optional<std::string> text = value.scalar_text();
  if (!value.is_string() || !text || text->empty()) return false;
  *static_cast<std::string*>(sender) = *text;
  return true;
}

std::string sender_text(const void* sender) {
  return '"' + *static_cast<const std::string*>(sender) + '"';
}

}  // namespace

constexpr ElementType kSender{read_sender, sender_text, R"({"type": "string"})"};

constexpr Field kOpaqueSettings[] = {
    frequency_field<&OpaqueParams::frequency_hz>(
        "readings per simulated second; each takes at most one message"),
    field<&OpaqueParams::from>("from", "",
                               "senders of the messages, at most 64: `\"ROBOT\"`, for its device "
                               "`opaque`, or `\"ROBOT.DEVICE\"`; none: its own, as an echo")
        .of(kSender)
        .counting(0, OpaqueParams::kMaxSenders)
        .with_issue("device/input", "\"ROBOT\" or \"ROBOT.DEVICE\""),
};
SIM_FIELDS(OpaqueParams, kOpaqueSettings)

constexpr Field kOpaqueReading[] = {
    field<&OpaqueReading::data>("data", "", "the message; empty: none has arrived"),
    field<&OpaqueReading::number>("number", "", "messages so far"),
    field<&OpaqueReading::lost>("lost", "", "lost messages so far"),
};
SIM_FIELDS(OpaqueReading, kOpaqueReading)

DeviceKind opaque_kind() {
  return device_kind<Opaque, OpaqueParams, OpaqueReading>("opaque", {{"opaque"}});
}

}  // namespace sim
