// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>

#include "libCCMorse/PlayerClient.h"

namespace playerlike {
class ClientCore;
class SndThread;
}  // namespace playerlike

namespace CCMorse {

/// A setting of a SndDriver that was not given: the driver takes it from the robot's model.
constexpr double SND_FROM_ROBOT = -1.0;

/// Settings of a SndDriver. Each must be greater than 0, and at most what stands beside it. Those
/// that are SND_FROM_ROBOT follow from the model of the robot; what the driver makes of them is
/// told by SndDriver::GetSettings().
struct SndSettings {
  /// Of the disc round the axle's middle that holds the robot [m]; 10. From the robot: its
  /// footprint's radius, rounded up to whole centimetres (S1R: 0.1).
  double robot_radius = SND_FROM_ROBOT;
  /// What comes nearer to the disc deflects and slows [m]; 10. From the robot: one and a half times
  /// the radius (S1R: 0.15).
  double safety_distance = SND_FROM_ROBOT;
  /// [m/s]; 10. From the robot: 0.6 of its greatest speed (S1R: 0.3).
  double max_speed = SND_FROM_ROBOT;
  /// [rad/s]; 20 pi. From the robot: half of its greatest turn rate (S1R: 1.5).
  double max_turn_rate = SND_FROM_ROBOT;
  double goal_distance = 0.05;  ///< a goal's position is reached within this [m]; 10
  double goal_angle = 0.1;      ///< its heading is reached within this [rad]; pi
  double patience = 20.0;       ///< blocked after so long without coming nearer to the goal
                                ///< (simulated time) [s]; 1e6
};

/// Drives a robot to goals and round what stands in the way, by Smooth Nearness-Diagram navigation
/// (J. W. Durham and F. Bullo, IROS 2008; docs/snd.md), in a thread with a client of its own.
///
/// The method is local: it knows what the laser sees and has just seen, no map. A goal behind a
/// deep dead end may end as BLOCKED; planning a way round is another program's matter.
///
/// Frames: goals are in the frame of the position device: index 0 is the arena's localisation, so
/// the world.
///
/// Time: in lockstep the driver's thread takes part, and simulated time goes on only as the
/// program's own clients wait. Goals, cancellations and settings given at simulated time t count
/// from the driver's first reading after t, so a run is repeatable, threads and all.
///
/// Errors: members throw PlayerError kDisconnected once the client is gone, kRunIsOver as the
/// client's proxies do, kBadArgument for values that cannot be meant.
///
/// Threads: all members may be called from any thread.
class SndDriver {
 public:
  /// How far the newest goal has been pursued.
  enum Status {
    IDLE,     ///< there was none, or it was cancelled
    MOVING,   ///< on the way
    REACHED,  ///< arrived; the robot stands within the tolerances
    BLOCKED   ///< given up, see SndSettings::patience; the robot stands
  };

  /// Starts the driver's thread, which has joined the lockstep when this returns.
  /// @param aClient    a client on the robot's port; it must live as long as the driver is used.
  /// @param aPosition  index of the position2d that tells where the robot is and drives it.
  /// @param aLaser     index of the laser.
  /// @throws PlayerError kNoSuchDevice for an index that the port does not have, kNotAvailable if
  ///         the robot has no motors, kBadArgument for a null pointer or settings out of range.
  explicit SndDriver(PlayerClient* aClient, uint32_t aPosition = 0, uint32_t aLaser = 0,
                     const SndSettings& aSettings = SndSettings());
  SndDriver(const SndDriver&) = delete;
  SndDriver& operator=(const SndDriver&) = delete;
  /// Ends the thread; a robot on its way is stopped. No simulated time passes.
  ~SndDriver();

  /// Drives to a place [m], whatever the heading there.
  void SetGoal(double aX, double aY);
  /// Drives to a place [m] and turns to a heading [rad].
  void SetGoal(double aX, double aY, double aYaw);
  /// Drops the goal and stops the robot.
  void Cancel();
  Status GetStatus() const;

  /// Reads the client, so that time goes on, until the goal is reached, blocked or cancelled.
  /// @param aTimeout  longest simulated time to wait [s]; negative: no limit.
  /// @return the status then; MOVING after a timeout.
  /// @throws PlayerError kRunIsOver if the run ends meanwhile.
  Status WaitForGoal(double aTimeout = -1.0);

  /// Those in use; none is SND_FROM_ROBOT.
  SndSettings GetSettings() const;
  /// From now on, also for a goal that is being pursued.
  void SetSettings(const SndSettings& aSettings);
  void SetRobotRadius(double aRadius);                      ///< [m]
  void SetSafetyDistance(double aDistance);                 ///< [m]
  void SetSpeedLimits(double aSpeed, double aTurnRate);     ///< [m/s], [rad/s]
  void SetGoalTolerances(double aDistance, double aAngle);  ///< [m], [rad]
  void SetPatience(double aSeconds);                        ///< [s]

 private:
  void Apply(const SndSettings& aSettings);

  std::shared_ptr<playerlike::ClientCore> mCore;
  std::unique_ptr<playerlike::SndThread> mThread;
  uint32_t mPosition;
};

}  // namespace CCMorse

namespace PlayerCc {

/// The one classes under both names; see CCMorse::SndDriver.
using CCMorse::SndDriver;
using CCMorse::SndSettings;

}  // namespace PlayerCc
