// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// A robot that drives in a plane: reads its pose and twist, and commands its motion.
///
/// Frames: the pose is that of the body frame B (x forward, y left; its origin is the centre of the
/// wheel axle, for a car the rear axle). It is given in the reference frame of the localisation
/// device with this index. The robot's model and the world define the order of these devices
/// (docs/robot_models.md). For an S1R, index 0 is the arena's localisation, whose frame is the
/// world W, and index 1 the odometry. For Pioneers and the other models, index 0 is the odometry,
/// whose frame is B at the start, and index 1 the localisation. Yaw is counter-clockwise, in (-pi,
/// pi].
///
/// Commands: a command takes effect at the next step, without a Read(), and holds until the next
/// command. Values beyond the robot's limits are clamped. NaN and infinity throw PlayerError
/// kBadArgument. Only omnidirectional drives use speeds to the left; others ignore them. The
/// controller of SetVelHead() and GoTo() runs in the simulation, once per step;
/// docs/devices/motion.md gives its control law.
///
/// Drivers: the world's `drivers` table can assign an index to a driver (docs/snd.md). Such an
/// index reports the readings of the driver's position device. Its GoTo() passes the goal to the
/// driver, which avoids obstacles, runs in its own thread, and stops when it is blocked. Any other
/// command goes directly to the motors and cancels the goal.
class Position2dProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  Position2dProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  Position2dProxy(const Position2dProxy& aOther);  ///< see ClientProxy
  ~Position2dProxy() override;

  /// Sets the speeds.
  /// @param aXSpeed    speed forward [m/s].
  /// @param aYSpeed    speed to the left [m/s], for omnidirectional drives.
  /// @param aYawSpeed  turn rate, counter-clockwise [rad/s]. A car steers to achieve it, and cannot
  ///                   turn at standstill.
  void SetSpeed(double aXSpeed, double aYSpeed, double aYawSpeed);
  void SetSpeed(double aXSpeed, double aYawSpeed);  ///< without a speed to the left
  void SetSpeed(player_pose2d_t vel);               ///< SetSpeed() with the speeds px, py, pa

  /// Drives at these speeds [m/s], turns to the heading aYawHead [rad] and holds it. The heading is
  /// in the frame of GetYaw(). The turn rate is `turn_gain` times the heading error.
  void SetVelHead(double aXSpeed, double aYSpeed, double aYawHead);
  void SetVelHead(double aXSpeed, double aYawHead);  ///< without a speed to the left

  /// Drives to a pose in the frame of GetXPos(). The robot turns towards the position, drives there
  /// in a straight line (to within the motors' `tolerance`), turns to the heading (to within
  /// `heading_tolerance_deg`) and stops. An omnidirectional robot drives and turns at the same
  /// time. A car reaches the heading only if its arc allows it; otherwise it arrives with the
  /// heading at the end of its arc. The robot does not avoid obstacles and does not give up, unless
  /// the index belongs to a driver.
  /// @param pos  goal pose [m, rad].
  /// @param vel  maximum speeds, as in Player: px and py are the maximum speed as a vector [m/s],
  ///             pa is the maximum turn rate [rad/s]; 0 for the motors' own limits. Signs are
  ///             ignored.
  void GoTo(player_pose2d_t pos, player_pose2d_t vel);
  void GoTo(player_pose2d_t pos);                ///< GoTo() at the motors' own limits
  void GoTo(double aX, double aY, double aYaw);  ///< GoTo() at the motors' own limits [m, m, rad]

  /// Drives like a car. A robot that is not a car turns like a car whose wheelbase is the robot's
  /// length, with the turn rate aXSpeed * tan(aDriveAngle) / length [rad/s].
  /// @param aXSpeed      speed forward [m/s].
  /// @param aDriveAngle  steering angle, counter-clockwise [rad]; clamped to the limits of the
  ///                     car's steering, for other robots to +-80 degrees.
  void SetCarlike(double aXSpeed, double aDriveAngle);

  /// Requests the geometry. It is known from the start, so nothing changes.
  void RequestGeom();
  /// Pose of the centre of the body's bounding box in B [m].
  player_pose3d_t GetOffset();
  /// Same as GetOffset().
  /// @deprecated Player 2.0's name of GetOffset().
  player_pose3d_t GetPose();
  /// Size of the body's bounding box [m].
  player_bbox3d_t GetSize();

  /// Enables or disables the motors. Disabled motors stop the robot, end GoTo() and SetVelHead(),
  /// and ignore speed commands until they are enabled again.
  void SetMotorEnable(bool enable);

  /// From the next step on, reports the pose (0, 0, 0) for the robot's current position. The robot
  /// does not move.
  void ResetOdometry();
  /// From the next step on, reports this pose [m, rad] for the robot's current position. The robot
  /// does not move.
  void SetOdometry(double aX, double aY, double aYaw);

  // These use the newest reading; they are 0 before the first.
  double GetXPos() const { return Number(kXPos); }          ///< [m]
  double GetYPos() const { return Number(kYPos); }          ///< [m]
  double GetYaw() const { return Number(kYaw); }            ///< [rad], in (-pi, pi]
  double GetXSpeed() const { return Number(kXSpeed); }      ///< actual forward speed [m/s]
  double GetYSpeed() const { return Number(kYSpeed); }      ///< actual speed to the left [m/s]
  double GetYawSpeed() const { return Number(kYawSpeed); }  ///< actual turn rate [rad/s]
  /// Whether the commanded speed was not reached for 0.2 s.
  bool GetStall() const { return Number(kStall) > 0.0; }

 protected:
  void HandleReading(const playerlike::NewReading& aNew) override;

 private:
  struct Control;
  // Indices of the numbers of a reading. That of 0 is not used: Elements counts its accesses as
  // those of a beam.
  enum Numbers { kXPos = 1, kYPos, kYaw, kXSpeed, kYSpeed, kYawSpeed, kStall, kNumberCount };

  double Number(Numbers aNumber) const {
    double value = 0.0;
    return mElements.Find(aNumber, value) ? value : LockedNumber(aNumber);
  }
  // Locks the client's mutex.
  [[gnu::cold]] double LockedNumber(Numbers aNumber) const;
  void ShowNumbers();

  std::unique_ptr<Control> mControl;
  double mNumbers[detail::Elements::kViews][kNumberCount] = {};  // each read by one thread only
};

}  // namespace PlayerCc

namespace std {
/// Prints a heading and one line with position, speeds and stall flag.
std::ostream& operator<<(std::ostream& os, const PlayerCc::Position2dProxy& c);
}  // namespace std
