// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "libCCMorse/MorseError.h"
#include "libCCMorse/MorseRobot.h"

namespace playerlike {
class ClientCore;
class Session;
}  // namespace playerlike

namespace CCMorse {

/// A connection to a simulation; gives access to its robots and their devices. This is the lowest
/// layer of the library.
///
/// Host names and time work as in PlayerCc::PlayerClient. Port 4000 gives access to all robots; a
/// robot's own port gives access to that robot only. Devices (MorseLaser, MorseMotionVW, ...) are
/// constructed with a MorseRobot. Read() updates the sensors.
///
/// A client may be destroyed before or after its devices. Devices without a client are not valid,
/// and their members throw MorseError.
///
/// Threads: all members may be called from any thread.
class MorseClient {
 public:
  /// Connects to a simulation.
  /// @throws MorseError for the same errors as PlayerClient's constructor.
  explicit MorseClient(const std::string& aHostname = "localhost", uint32_t aPort = 4000);
  /// Creates a client for a session that the program has opened itself. The session must not be
  /// null.
  explicit MorseClient(std::unique_ptr<playerlike::Session> aSession);
  MorseClient(const MorseClient&) = delete;
  MorseClient& operator=(const MorseClient&) = delete;
  /// Disconnects.
  ~MorseClient();

  bool Connected() const;

  /// Waits until at least one sensor has new data, then updates all sensors that have new data. In
  /// lockstep, simulated time advances meanwhile. If the client has no sensors, simulated time
  /// advances by 0.1 s.
  /// @throws MorseError kRunIsOver with the text "the simulated run is over" at the end of the run.
  void Read();
  /// Returns whether data is available; see PlayerClient::Peek().
  /// @param aTimeout  longest time to wait [ms].
  bool Peek(uint32_t aTimeout = 0);
  /// Calls Read() if Peek(0) returns true.
  void ReadIfWaiting();

  /// Returns the names of the robots on this port, in the world's order.
  std::vector<std::string> GetRobotNames() const;
  bool HasRobot(const std::string& aName) const;
  /// Returns the robot of this name; "" for the first robot.
  /// @throws MorseError kNoSuchDevice if there is no such robot; the text names the existing ones.
  MorseRobot GetRobot(const std::string& aName = "") const;

 private:
  friend class ArenaProxy;
  friend class MorseTime;
  std::shared_ptr<playerlike::ClientCore> mCore;
};

}  // namespace CCMorse

namespace std {
/// Prints the robots and their devices, one per line.
std::ostream& operator<<(std::ostream& os, const CCMorse::MorseClient& c);
}  // namespace std
