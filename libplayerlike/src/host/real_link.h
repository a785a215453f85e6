// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "host/client.h"
#include "playerlike/session/session.h"

namespace playerlike {

/// The connection to a real robot: a session with its server and two threads. One thread waits for
/// readings, the other one sends commands, so neither the network nor the robot delays the
/// simulation. Any thread may call the members.
class RealLink final : private ReadingSink {
 public:
  struct Arrival {
    DeviceId device{-1, -1};  ///< of the real robot
    sim::SharedReading reading;
    WallClock::time_point at;
  };

  /// Starts the threads.
  /// @param session  subscribed to all devices that are needed.
  /// @param motors   device that stop() stops; none: no device.
  RealLink(std::unique_ptr<Session> session, std::optional<DeviceId> motors);
  /// Stops the robot.
  ~RealLink() override;

  /// Queues a command. A command that replaces the last one in the queue takes its place. After the
  /// loss of the connection this does nothing.
  void send(DeviceId device, const sim::Command& command);
  /// Takes the readings that have arrived since the last call, oldest first.
  [[nodiscard]] std::vector<Arrival> take();
  /// Returns why the connection was lost; nullopt: it was not.
  [[nodiscard]] std::optional<std::string> lost() const;
  /// Stops the robot's motors, waits until that command is sent, but not longer than a second, and
  /// closes the connection.
  void stop() noexcept;

 private:
  void on_reading(DeviceId device, const sim::SharedReading& reading) override;
  void receive() noexcept;
  void transmit() noexcept;
  void note_loss(const std::string& reason) noexcept;

  const std::unique_ptr<Session> session_;
  const std::optional<DeviceId> motors_;
  mutable std::mutex mutex_;  // guards the members below
  std::condition_variable changed_;
  std::vector<Arrival> arrived_;
  std::vector<std::pair<DeviceId, sim::Command>> commands_;
  std::optional<std::string> lost_;
  bool stopping_ = false;
  bool all_sent_ = false;  // the sending thread has ended
  std::thread receiver_;
  std::thread sender_;
};

}  // namespace playerlike
