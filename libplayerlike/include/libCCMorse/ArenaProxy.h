// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "libCCMorse/MorseClient.h"
#include "libCCMorse/PlayerClient.h"

namespace playerlike {
struct ArenaStatus;
}

namespace CCMorse {

/// Something that happened in the arena; docs/arena_controller.md lists the kinds. The meaning of
/// the other members depends on the kind.
struct ArenaEvent {
  uint64_t number;   ///< 1 for the first event of the run, then increasing by one
  double time;       ///< simulated time [s]
  std::string kind;  ///< e.g. "trap", "configuration", "extended", "message"
  std::string what;  ///< name of a timer, trap, configuration, block, obstacle or robot
  std::string who;   ///< name of a robot; "": none
  std::string text;  ///< a message or a reason; "": none
  double value;      ///< points, a duration [s], or 1 for a passed run
};

/// How an action of the arena's controller ended the run.
struct ArenaVerdict {
  bool passed;         ///< or failed
  std::string reason;  ///< for people; may be empty
  double time;         ///< simulated time [s]
};

/// The arena of a client's world: its configurations, the dynamic blocks, the timers and traps of
/// its controller, and events (docs/arena_controller.md).
///
/// Every world has an arena. In a world without a controller the lists of configurations, timers
/// and traps are empty, but there may be blocks.
///
/// A change takes effect before the call returns; a block with a rise speed then begins to move. No
/// member advances simulated time. Getters request the present state from the simulation.
///
/// The client may be destroyed before the proxy; the members then throw. After the end of the run
/// the getters still work.
///
/// Errors: members throw MorseError kBadArgument for an unknown name (the text suggests a similar
/// one and lists the known ones), kDisconnected if the client is gone, and kNotAvailable if the
/// world is private ("privacy") or the server's tokens do not allow the call. Changes also throw
/// kBadArgument if the simulation refuses them, e.g. because a robot stands on a block, and
/// kNotAvailable if the world locks its objects ("lock_objects").
///
/// Threads: all members may be called from any thread.
class ArenaProxy {
 public:
  /// @throws MorseError kBadArgument for a null pointer.
  explicit ArenaProxy(PlayerClient* aClient);
  explicit ArenaProxy(const MorseClient& aClient);  ///< for a client of robots' devices
  ArenaProxy(const ArenaProxy&) = delete;
  ArenaProxy& operator=(const ArenaProxy&) = delete;
  ~ArenaProxy();

  /// @name Configurations
  /// @{
  uint32_t GetConfigurationCount() const;  ///< number of configurations
  /// Returns the name of a configuration; the order is that of the world.
  /// @param aIndex  from 0 on.
  /// @throws MorseError kBadArgument for an index that is not below GetConfigurationCount().
  std::string GetConfigurationName(uint32_t aIndex) const;
  std::vector<std::string> GetConfigurationNames() const;  ///< all names, in the world's order
  /// Returns the last configuration that a client, timer or trap has set since the start or the
  /// last reset; "" if there is none. Blocks may have changed one by one since then.
  std::string GetConfiguration() const;
  /// Puts the arena into a configuration. If a block or an obstacle cannot be changed, the others
  /// are changed nevertheless.
  /// @throws MorseError kBadArgument that names what was not changed.
  void SetConfiguration(const std::string& aName);
  /// @}

  /// @name Dynamic blocks
  /// @{
  std::vector<std::string> GetBlockNames() const;  ///< names, in the world's order
  /// Extends a block, at once or with its rise speed. A block with "when_blocked": "wait" waits
  /// until no robot stands on it.
  void ExtendBlock(const std::string& aName);
  void RetractBlock(const std::string& aName);  ///< retracts a block, at once or with its speed
  /// Returns "extended", "retracted", "rising", "sinking", or "waiting": retracted until the robot
  /// that stands on it has left.
  std::string GetBlockState(const std::string& aName) const;
  double GetBlockHeight(const std::string& aName) const;  ///< present height [m]; 0 if retracted
  /// @}

  /// @name Timers and traps
  /// @{
  std::vector<std::string> GetTimerNames() const;  ///< names, in the world's order
  std::vector<std::string> GetTrapNames() const;   ///< names, in the world's order
  /// Switches a timer on, if it is off. It counts its times from now.
  void EnableTimer(const std::string& aName);
  void DisableTimer(const std::string& aName);          ///< switches a timer off
  bool IsTimerEnabled(const std::string& aName) const;  ///< whether a timer is on
  /// Returns the simulated time until a timer acts next [s]; negative if it does not, or if the
  /// simulation has not made its first step.
  double GetTimeLeft(const std::string& aTimer) const;
  /// Switches a trap on, if it is off. Robots inside it enter it now.
  void EnableTrap(const std::string& aName);
  void DisableTrap(const std::string& aName);          ///< switches a trap off
  bool IsTrapEnabled(const std::string& aName) const;  ///< whether a trap is on
  /// Returns how often a timer or trap has acted since the start or the last reset.
  uint64_t GetActCount(const std::string& aName) const;
  /// @}

  /// @name Events and results
  /// @{
  /// Returns the events since the last call of this proxy, oldest first. The first call returns the
  /// events since the start of the run. The simulation keeps the newest 1024 events.
  std::vector<ArenaEvent> GetEvents();
  /// Returns the number of events that GetEvents() has missed so far, because they were no longer
  /// kept.
  uint64_t GetLostEventCount() const;
  /// Returns the points of a robot from timers and traps.
  double GetScore(const std::string& aRobot) const;
  bool HasVerdict() const;  ///< whether an action has ended the run
  /// @throws MorseError kNotAvailable if no action has ended the run, see HasVerdict().
  ArenaVerdict GetVerdict() const;
  /// @}

 private:
  playerlike::ArenaStatus Status(const char* aFunction) const;
  template <typename Request>
  void Change(const char* aFunction, const Request& aRequest);

  const std::shared_ptr<playerlike::ClientCore> mCore;
  mutable std::mutex mMutex;
  uint64_t mNewest;  // number of the last event that was returned; guarded by mMutex
  uint64_t mLost;    // guarded by mMutex
};

}  // namespace CCMorse

namespace PlayerCc {

/// The same classes in both namespaces; see CCMorse::ArenaProxy.
using CCMorse::ArenaEvent;
using CCMorse::ArenaProxy;
using CCMorse::ArenaVerdict;

}  // namespace PlayerCc

namespace std {
/// Prints the event in one line: number, time, kind, what, who, text, value.
std::ostream& operator<<(std::ostream& os, const CCMorse::ArenaEvent& e);
/// Prints the configuration, the blocks with state and height, the timers and the traps.
std::ostream& operator<<(std::ostream& os, const CCMorse::ArenaProxy& a);
}  // namespace std
