// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "libCCMorse/LocalDriver.h"

namespace CCMorse {

/// Default value of a setting of a SndDriver: the driver derives the setting from the robot's
/// model.
constexpr double SND_FROM_ROBOT = -1.0;

/// Settings of a SndDriver. Each must be greater than 0 and at most the maximum in its description.
/// The driver derives settings that are SND_FROM_ROBOT from the robot's model.
/// SndDriver::GetSettings() returns the derived values.
struct SndSettings {
  /// Radius of the disc around the middle of the axle that contains the robot [m]; maximum 10.
  /// SND_FROM_ROBOT: radius of the footprint, rounded up to whole centimetres (S1R: 0.1).
  double robot_radius = SND_FROM_ROBOT;
  /// Distance from the disc below which obstacles deflect and slow the robot [m]; maximum 10.
  /// SND_FROM_ROBOT: 1.5 times the radius (S1R: 0.15).
  double safety_distance = SND_FROM_ROBOT;
  /// Maximum speed [m/s]; maximum 10. SND_FROM_ROBOT: 0.6 times the robot's maximum speed (S1R:
  /// 0.3).
  double max_speed = SND_FROM_ROBOT;
  /// Maximum turn rate [rad/s]; maximum 20 pi. SND_FROM_ROBOT: half of the robot's maximum turn
  /// rate (S1R: 1.5).
  double max_turn_rate = SND_FROM_ROBOT;
  double goal_distance = 0.05;  ///< tolerance of the goal's position [m]; maximum 10
  double goal_angle = 0.1;      ///< tolerance of the goal's heading [rad]; maximum pi
  double patience = 20.0;  ///< simulated time without progress towards the goal after which the
                           ///< status is BLOCKED [s]; maximum 1e6
};

/// Drives a robot to goals and avoids obstacles, with Smooth Nearness-Diagram navigation (J. W.
/// Durham and F. Bullo, IROS 2008; docs/snd.md). It runs in its own thread with its own client.
///
/// The method is local: it uses current and recent laser scans, but no map. A goal behind a deep
/// dead end may end as BLOCKED; use a path planner for such goals.
///
/// Frames: goals are in the frame of the position device. Index 0 is the arena's localisation,
/// whose frame is the world.
/// LocalDriver documents goals, time, errors and threads.
class SndDriver : public LocalDriver {
 public:
  /// Starts the driver's thread. When the constructor returns, the thread has joined the lockstep.
  /// @param aClient    a client on the robot's port; it must outlive all uses of the driver.
  /// @param aPosition  index of the position2d that measures the robot's pose and drives it.
  /// @param aLaser     index of the laser.
  /// @throws PlayerError kNoSuchDevice for an index that the port does not have, kNotAvailable if
  ///         the robot has no motors, kBadArgument for a null pointer or settings out of range.
  explicit SndDriver(PlayerClient* aClient, uint32_t aPosition = 0, uint32_t aLaser = 0,
                     const SndSettings& aSettings = SndSettings());

  /// Returns the settings in use; none of them is SND_FROM_ROBOT.
  SndSettings GetSettings() const;
  /// Changes the settings, also for the current goal.
  void SetSettings(const SndSettings& aSettings);
  void SetRobotRadius(double aRadius);                      ///< [m]
  void SetSafetyDistance(double aDistance);                 ///< [m]
  void SetSpeedLimits(double aSpeed, double aTurnRate);     ///< [m/s], [rad/s]
  void SetGoalTolerances(double aDistance, double aAngle);  ///< [m], [rad]
  void SetPatience(double aSeconds);                        ///< [s]

 private:
  void Apply(const SndSettings& aSettings);
};

}  // namespace CCMorse

namespace PlayerCc {

/// The same classes in both namespaces; see CCMorse::SndDriver.
using CCMorse::SndDriver;
using CCMorse::SndSettings;

}  // namespace PlayerCc
