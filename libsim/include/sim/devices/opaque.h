// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "sim/devices/device.h"

namespace sim {

/// Settings of a device for messages of arbitrary bytes.
struct OpaqueParams {
  static constexpr std::size_t kMaxSenders = 64;

  double frequency_hz = 10.0;  ///< readings per simulated second, each with at most one message
  /// Senders of the messages: "ROBOT", for its device "opaque", or "ROBOT.DEVICE"; at most
  /// kMaxSenders. Empty: the device itself, which gives an echo.
  std::vector<std::string> from;
};

/// A message, if one has arrived.
struct OpaqueReading final : Reading {
  std::vector<std::uint8_t> data;  ///< empty if none has arrived since the previous reading
  std::uint64_t number = 0;        ///< messages received so far, including this one
  std::uint64_t lost = 0;          ///< messages dropped so far because the queue was full
};

/// Transmits messages from robot to robot, or back to the sender, regardless of distance and walls.
/// A message sent by an OpaqueCommand before a step arrives in that step, whatever the order of the
/// robots. Messages of several senders arrive in the order of `from`. Each reading takes one
/// message, oldest first. The queue holds kMaxQueue messages; when it is full, the oldest is
/// dropped. Messages over kMaxOpaque bytes are refused; an empty message counts as none.
class Opaque final : public SensorOf<OpaqueReading> {
 public:
  static constexpr std::size_t kMaxQueue = 256;

  Opaque(std::string name, const OpaqueParams& params);

  std::optional<std::string> connect(std::string_view robot,
                                     const DeviceDirectory& devices) override;
  std::optional<std::string> apply(const Command& command) override;
  void integrate(const StepContext& context) override;
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  using Message = std::vector<std::uint8_t>;
  struct Connection {
    const Opaque* sender = nullptr;
    std::uint64_t received_count = 0;  ///< number of messages received from that sender
  };
  void receive(Connection& connection);

  OpaqueParams params_;
  std::vector<Connection> connections_;
  /// Messages sent since the step before the last one; the newest has the number sent_. All
  /// receivers have already received the older ones.
  std::deque<Message> sent_messages_;
  std::uint64_t sent_ = 0;
  std::uint64_t sent_before_step_ = 0;
  std::deque<Message> arrived_;
  std::uint64_t lost_ = 0;
};

}  // namespace sim
