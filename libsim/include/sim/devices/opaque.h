// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "sim/devices/device.h"

namespace sim {

/// Settings of a device for messages of any bytes.
struct OpaqueParams {
  static constexpr std::size_t kMaxSenders = 64;

  double frequency_hz = 10.0;  ///< readings, and so messages at most, a simulated second, (0, 1000]
  /// Whose messages arrive here: "ROBOT", for its device "opaque", or "ROBOT.DEVICE"; at most
  /// kMaxSenders. None: its own, as an echo.
  std::vector<std::string> from;
};

/// A message, if one has arrived.
struct OpaqueReading final : Reading {
  std::vector<std::uint8_t> data;  ///< empty: none has arrived since the reading before
  std::uint64_t number = 0;        ///< messages that arrived so far, this one included
  std::uint64_t lost = 0;          ///< messages that found no room in the queue so far
};

/// Carries messages from robot to robot, or back to the sender, as a cable does: neither distance
/// nor walls matter. What an OpaqueCommand sends before a step arrives in that step, whatever the
/// order of the robots; messages of several senders arrive in the order in which `from` lists
/// these. Each reading takes one message, oldest first. Up to kMaxQueue wait; of more the oldest
/// are lost. Refused are messages of more than kMaxOpaque bytes; an empty one is none.
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
  struct Line {
    const Opaque* sender = nullptr;
    std::uint64_t heard = 0;  ///< messages of that sender so far
  };
  void hear(Line& line);

  OpaqueParams params_;
  std::vector<Line> lines_;
  /// Messages sent since the step before the last one, the newest having number sent_: all others
  /// have heard the older ones.
  std::deque<Message> sent_messages_;
  std::uint64_t sent_ = 0;
  std::uint64_t sent_before_step_ = 0;
  std::deque<Message> arrived_;
  std::uint64_t lost_ = 0;
};

}  // namespace sim
