// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "libCCMorse/PlayerClient.h"

namespace playerlike {
class ClientCore;
class GoalThread;
}  // namespace playerlike

namespace CCMorse {

/// Drives a robot to goals and avoids obstacles. It runs in its own thread with its own client.
/// SndDriver, VfhDriver and NdDriver are its methods.
///
/// The methods are local: they use current and recent laser scans, but no map. A goal behind a deep
/// dead end may end as BLOCKED; use a path planner for such goals (PlannerProxy,
/// docs/wavefront.md).
///
/// Frames: goals are in the frame of the position device. Index 0 is the arena's localisation,
/// whose frame is the world.
///
/// Time: in lockstep the driver's thread takes part, and simulated time advances only while the
/// program's own clients wait. Goals, cancellations and settings given at simulated time t take
/// effect at the driver's first reading after t. A run is therefore repeatable although it has
/// several threads.
///
/// Errors: members throw PlayerError kDisconnected once the client is gone, kRunIsOver in the same
/// cases as the client's proxies, and kBadArgument for invalid values.
///
/// Threads: all members may be called from any thread.
class LocalDriver {
 public:
  /// State of the newest goal.
  enum Status {
    IDLE,     ///< there is no goal, or it was cancelled
    MOVING,   ///< the robot is driving to the goal
    REACHED,  ///< the robot has stopped within the tolerances
    BLOCKED   ///< the driver has given up and stopped the robot; see the setting "patience"
  };

  LocalDriver(const LocalDriver&) = delete;
  LocalDriver& operator=(const LocalDriver&) = delete;
  /// Ends the thread and stops a moving robot. Simulated time does not advance.
  virtual ~LocalDriver();

  /// Drives to a position [m], with any final heading.
  void SetGoal(double aX, double aY);
  /// Drives to a position [m] and turns to a heading [rad].
  void SetGoal(double aX, double aY, double aYaw);
  /// Drops the goal and stops the robot.
  void Cancel();
  Status GetStatus() const;

  /// Reads the client, so that simulated time advances, until the goal is reached, blocked or
  /// cancelled.
  /// @param aTimeout  longest simulated time to wait [s]; negative: no limit.
  /// @return the final status; MOVING after a timeout.
  /// @throws PlayerError kRunIsOver if the run ends meanwhile.
  Status WaitForGoal(double aTimeout = -1.0);

  /// Changes a setting, also for the current goal.
  /// @param aName   key in world files, e.g. "max_speed"; docs/snd.md, docs/vfh.md and docs/nd.md
  ///                list them.
  /// @param aValue  in the units of world files: angles in degrees.
  /// @throws PlayerError kBadArgument for an unknown name or a value out of range.
  void Set(const std::string& aName, double aValue);
  /// Returns a setting in use, in the units of world files. A setting that follows another one
  /// until it is set has the value NaN.
  /// @throws PlayerError kBadArgument for an unknown name.
  double Get(const std::string& aName) const;

 protected:
  /// @cond
  struct Start;
  LocalDriver(const char* aName, PlayerClient* aClient, uint32_t aPosition, uint32_t aLaser,
              const Start& aStart);
  std::string Fun(const char* aMember) const;

  const char* mName;
  std::shared_ptr<playerlike::ClientCore> mCore;
  std::unique_ptr<playerlike::GoalThread> mThread;
  uint32_t mPosition;
  /// @endcond
};

/// Drives with VFH+ (I. Ulrich and J. Borenstein, ICRA 1998; docs/vfh.md).
class VfhDriver : public LocalDriver {
 public:
  /// As SndDriver::SndDriver(), with the default settings of docs/vfh.md.
  explicit VfhDriver(PlayerClient* aClient, uint32_t aPosition = 0, uint32_t aLaser = 0);
};

/// Drives with Nearness-Diagram navigation (J. Minguez and L. Montano, IEEE Transactions on
/// Robotics and Automation 20(1), 2004; docs/nd.md).
class NdDriver : public LocalDriver {
 public:
  /// As SndDriver::SndDriver(), with the default settings of docs/nd.md.
  explicit NdDriver(PlayerClient* aClient, uint32_t aPosition = 0, uint32_t aLaser = 0);
};

}  // namespace CCMorse

namespace PlayerCc {

/// The same classes in both namespaces; see CCMorse::LocalDriver.
using CCMorse::LocalDriver;
using CCMorse::NdDriver;
using CCMorse::VfhDriver;

}  // namespace PlayerCc
