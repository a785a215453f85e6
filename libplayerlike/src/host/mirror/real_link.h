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

#include "host/stepping/client.h"
#include "playerlike/session/session.h"

namespace playerlike {

/// The connection to a real robot: a session with its server and three threads. One thread waits
/// for readings, one sends commands, and one shows the server that this end is there, so neither
/// the network nor the robot delays the simulation. A lost connection is closed, so that the server
/// notices, too. Any thread may call the members.
class RealLink final : private ReadingSink {
 public:
  struct Arrival {
    DeviceId device{-1, -1};  ///< of the real robot
    sim::SharedReading reading;
    WallClock::time_point at;
  };

  /// Takes charge of the robot and starts the threads.
  /// @param session  subscribed to all devices that are needed. An answer is waited for twice as
  ///                 long as `charge.watchdog_s`.
  /// @param motors   device that stop() stops; none: no device.
  /// @throws SessionError if another client is in charge of the robot.
  RealLink(std::unique_ptr<Session> session, std::optional<DeviceId> motors,
           TakeChargeRequest charge);
  /// Stops the robot.
  ~RealLink() override;

  /// Queues a command. A command that replaces the last one in the queue takes its place. After the
  /// loss of the connection this does nothing.
  void send(DeviceId device, const sim::Command& command);
  /// Takes the readings that have arrived since the last call, oldest first.
  [[nodiscard]] std::vector<Arrival> take();
  /// Whether the server stops the robot if it hears nothing.
  [[nodiscard]] bool watched() const noexcept { return watched_; }
  /// Whether the server has stopped the robot for that reason since the last call.
  [[nodiscard]] bool take_stopped();
  /// Returns why the connection was lost; nullopt: it was not.
  [[nodiscard]] std::optional<std::string> lost() const;
  /// Stops the robot's motors, waits until that command is sent, but not longer than a second, and
  /// closes the connection.
  void stop() noexcept;

 private:
  void on_reading(DeviceId device, const sim::SharedReading& reading) override;
  void receive() noexcept;
  void transmit() noexcept;
  void keep_charge() noexcept;
  void note_loss(const std::string& reason) noexcept;

  const std::unique_ptr<Session> session_;
  const std::optional<DeviceId> motors_;
  TakeChargeRequest charge_;
  bool watched_ = false;
  mutable std::mutex mutex_;  // guards the members below
  std::condition_variable changed_;
  std::vector<Arrival> arrived_;
  std::vector<std::pair<DeviceId, sim::Command>> commands_;
  std::optional<std::string> lost_;
  bool stopping_ = false;
  bool all_sent_ = false;  // the sending thread has ended
  bool stopped_ = false;   // by the server, and not reported yet
  std::thread receiver_;
  std::thread sender_;
  std::thread keeper_;
};

}  // namespace playerlike
