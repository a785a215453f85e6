// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "host/stepping/client.h"
#include "playerlike/messages/requests.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

/// Whether a device moves its whole robot: motors, and devices that drive or place it.
/// @param type  of the device.
[[nodiscard]] bool moves_robot(const std::string& type);

/// Who commands which robot. Says which robots must stop because those who commanded them are gone:
///
/// - A robot stops when the last client is gone that commands it or has opened its position2d, as
///   at a Player server.
/// - A robot that mirrors a real one stops when the client is gone that commanded it last, whoever
///   else has opened it. So does a robot that a client has taken charge of (TakeChargeRequest), and
///   also if nothing has arrived from that client for the time that it has named.
/// - Robots that a client in MORSE's protocol commanded drive on unless they mirror real ones, as
///   in MORSE.
///
/// Not thread-safe: guarded by the host's mutex.
class Commanders {
 public:
  /// Somebody who commands: a Client or a Commander. Compared, never used.
  using Who = const void*;
  using Commands = std::vector<std::pair<DeviceId, sim::Command>>;

  /// Both must outlive this object.
  Commanders(const sim::Simulation& simulation, const std::vector<RobotInfo>& robots);

  enum class Kind {
    kClient,
    kFollower,  ///< a driver, which acts for a client
    kMorse,     ///< simulated robots drive on without it
  };
  /// Notes a command that is about to be executed.
  /// @return why it must not be executed: somebody else has taken over the robot; nullopt: it may.
  [[nodiscard]] std::optional<std::string> note(Who who, DeviceId device, Kind kind);

  /// Notes that a client has closed a device. The subscription must have ended.
  /// @return the robots to stop.
  [[nodiscard]] std::vector<int> note_closed(const Client& client, DeviceId device);
  /// Notes that a client has opened a device.
  void note_opened(const Client& client, DeviceId device);
  /// Notes that somebody has gone. @return the robots to stop.
  [[nodiscard]] std::vector<int> note_gone(Who who);

  /// Executes a TakeChargeRequest. @return the robot is to be stopped, because it has a new
  /// commander. @throws SessionError kNotAvailable if another client is in charge.
  [[nodiscard]] bool take_charge(Who who, const TakeChargeRequest& what, WallClock::time_point now);
  /// Whether the watchdog has stopped a robot since the last call.
  [[nodiscard]] bool take_stopped(int robot);
  /// The robots to stop because the client in charge of them has sent nothing for too long.
  /// @param is_excused  asked then: whether that does not count, since a client is under a
  /// debugger.
  ///                    Its time begins anew. Empty: it counts.
  [[nodiscard]] std::vector<int> overdue(WallClock::time_point now,
                                         const std::function<bool()>& is_excused = {});
  /// Whether a watchdog has ever stopped a robot.
  [[nodiscard]] bool has_stopped() const noexcept { return has_stopped_; }

  /// The commands that stop a robot. After this nobody commands it.
  [[nodiscard]] Commands stop(int robot);

 private:
  struct Charge {
    Who who = nullptr;
    std::string name;
    WallClock::duration watchdog{};
    WallClock::time_point heard;
    bool stopped = false;  ///< by the watchdog, and not reported yet
  };
  enum class Role : char { kNone, kPlaces, kDrives };
  struct Robot {
    std::vector<Role> roles;  ///< by device: how it moves the robot
    std::set<int> poses;      ///< devices of position2d
    std::set<Who> holders;    ///< have commanded it or opened position2d
    std::set<Who> overruled;  ///< somebody has taken over from them
    Who last = nullptr;       ///< the last commander; null: none, or it has left
    Kind last_kind = Kind::kClient;
    std::set<int> commanded;  ///< devices that were commanded since the last stop
    std::optional<Charge> charge;
    bool mirrors = false;
  };

  [[nodiscard]] Robot& at(int robot) { return robots_[static_cast<std::size_t>(robot)]; }
  /// Somebody holds a robot no more. @return whether it is to be stopped.
  [[nodiscard]] static bool let_go(Robot& robot, Who who);
  /// Whether the client in charge has made the robot drive.
  [[nodiscard]] static bool drives_for_charge(const Robot& robot);

  const sim::Simulation& simulation_;
  std::vector<Robot> robots_;
  bool has_stopped_ = false;
};

}  // namespace playerlike
