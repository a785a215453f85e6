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

/// A connection to a simulation, the lowest layer of this library: its robots and their devices.
///
/// Host names and time are as in PlayerCc::PlayerClient. The port is 4000, where all robots are
/// seen, or a robot's own, where only that one is. Devices (MorseLaser, MorseMotionVW, ...) are
/// made with a MorseRobot; Read() fills those that sense.
///
/// Clients may be destroyed before or after their devices; devices without client are not
/// valid and their calls throw MorseError. Threads: all members may be called from any thread.
class MorseClient {
 public:
  /// Connects.
  /// @throws MorseError as PlayerClient.
  explicit MorseClient(const std::string& aHostname = "localhost", uint32_t aPort = 4000);
  /// A client of a session that the program has opened itself; must not be null.
  explicit MorseClient(std::unique_ptr<playerlike::Session> aSession);
  MorseClient(const MorseClient&) = delete;
  MorseClient& operator=(const MorseClient&) = delete;
  /// Disconnects.
  ~MorseClient();

  bool Connected() const;

  /// Waits until a sensor has new data, then hands it to all sensors that have some. In lockstep
  /// this lets time pass. Without any sensor it lets a tenth of a simulated second pass.
  /// @throws MorseError kRunIsOver, text "the simulated run is over", at the end of the run.
  void Read();
  /// Whether data waits; see PlayerClient::Peek(). @param aTimeout  [ms].
  bool Peek(uint32_t aTimeout = 0);
  /// Read() if Peek(0), else nothing.
  void ReadIfWaiting();

  /// Names of the robots seen on this port, in the world's order.
  std::vector<std::string> GetRobotNames() const;
  bool HasRobot(const std::string& aName) const;
  /// A robot by its name; "": the first.
  /// @throws MorseError kNoSuchDevice if there is none; the text names those there are.
  MorseRobot GetRobot(const std::string& aName = "") const;

 private:
  friend class MorseTime;
  std::shared_ptr<playerlike::ClientCore> mCore;
};

}  // namespace CCMorse

namespace std {
/// Prints the robots and their devices, one a line.
std::ostream& operator<<(std::ostream& os, const CCMorse::MorseClient& c);
}  // namespace std
