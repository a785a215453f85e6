// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// A robot that drives in a plane: where it is, and how it is told to move.
///
/// Frames: positions are of the body B (x forward, y left; its origin is the middle of the wheels'
/// axle, of a car the rear one) in the frame that the index's localisation reports in. Which device
/// has index 0 is up to the robot's model and the world (docs/robot_models.md): of an S1R the
/// arena's localisation, so the world W, then, as index 1, the odometry; of Pioneers and the other
/// models the odometry, so the pose B had at the start, then the localisation. Yaw is
/// counter-clockwise in (-pi, pi].
///
/// Commands are executed from the next step on and hold until the next one, which ends them;
/// they need no Read(). Values beyond the robot's limits are clamped to them; NaN and infinity are
/// refused with PlayerError kBadArgument. Speeds to the left are for omnidirectional drives; others
/// ignore them. The control behind SetVelHead() and GoTo() runs in the simulation, once a step
/// (docs/devices/motion.md says by which law).
///
/// An index that the world's `drivers` table gives a driver (docs/snd.md) reports what that
/// driver's own position device does. Its GoTo() hands the goal to the driver, which drives round
/// obstacles in a thread of its own, and stops when it is blocked; any other command goes straight
/// to the motors and drops the goal.
class Position2dProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if there is no such device; the text names those there are.
  Position2dProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  Position2dProxy(const Position2dProxy& aOther);  ///< see ClientProxy
  ~Position2dProxy() override;

  /// Drive.
  /// @param aXSpeed    forward [m/s].
  /// @param aYSpeed    to the left [m/s], if the drive is omnidirectional.
  /// @param aYawSpeed  counter-clockwise [rad/s]; a car steers to get it, standing it cannot.
  void SetSpeed(double aXSpeed, double aYSpeed, double aYawSpeed);
  void SetSpeed(double aXSpeed, double aYawSpeed);  ///< the same without a speed to the left
  void SetSpeed(player_pose2d_t vel);               ///< the same: px, py, pa are the speeds

  /// Drive at these speeds [m/s], turning to the heading aYawHead [rad], in the frame that GetYaw()
  /// is in, and holding it: the turn rate is `turn_gain` times what is missing.
  void SetVelHead(double aXSpeed, double aYSpeed, double aYawHead);
  void SetVelHead(double aXSpeed, double aYawHead);  ///< the same without a speed to the left

  /// Drive to a pose in the frame that GetXPos() is in: turn towards it, drive there straight (to
  /// within the `tolerance` of the motors), turn to the heading (to within
  /// `heading_tolerance_deg`), stand. An omnidirectional robot does both at once; a car comes to
  /// the point with the heading where that lies on its way, else with whatever heading its arc
  /// ends. It goes on until it is there, also against obstacles, unless the index is a driver's.
  /// @param pos  where to.
  /// @param vel  speeds on the way, as in Player: px and py the highest speed as a vector [m/s], pa
  ///             the highest turn rate [rad/s]; 0 for the motors' own limits. Signs do not matter.
  void GoTo(player_pose2d_t pos, player_pose2d_t vel);
  void GoTo(player_pose2d_t pos);                ///< the same at the motors' own speeds
  void GoTo(double aX, double aY, double aYaw);  ///< the same, [m, m, rad]

  /// Drive as a car does. A robot that is none turns as one with a wheelbase of its own length
  /// would: at aXSpeed tan(aDriveAngle) / length [rad/s].
  /// @param aXSpeed      forward [m/s].
  /// @param aDriveAngle  steering angle, counter-clockwise [rad]; clamped to what the car's
  ///                     steering allows, of others to 80 degrees either way.
  void SetCarlike(double aXSpeed, double aDriveAngle);

  /// Asks for the geometry. It is known from the start, so nothing changes.
  void RequestGeom();
  /// Pose of the middle of the body's bounding box in B [m].
  player_pose3d_t GetOffset();
  /// Name of GetOffset() in Player 2.0. @deprecated Use GetOffset().
  player_pose3d_t GetPose();
  /// Size of the body's bounding box [m].
  player_bbox3d_t GetSize();

  /// Switches the motors on or off. Off stops the robot, ends GoTo() and SetVelHead(), and lets
  /// speeds be ignored until they are on again.
  void SetMotorEnable(bool enable);

  /// Makes the position read zero where the robot is now, from the next step on. In the
  /// simulation the robot does not move.
  void ResetOdometry();
  /// Makes the position read so where the robot is now [m, rad], from the next step on.
  void SetOdometry(double aX, double aY, double aYaw);

  double GetXPos() const;      ///< [m]; like all that follow, of the newest reading, 0 before
  double GetYPos() const;      ///< [m]
  double GetYaw() const;       ///< [rad], in (-pi, pi]
  double GetXSpeed() const;    ///< achieved forward speed [m/s]
  double GetYSpeed() const;    ///< achieved speed to the left, as when shoved [m/s]
  double GetYawSpeed() const;  ///< achieved turn rate, counter-clockwise [rad/s]
  bool GetStall() const;       ///< the commanded speed has not been achieved for 0.2 s

 protected:
  void HandleReading() override;

 private:
  struct Control;
  std::unique_ptr<Control> mControl;
};

}  // namespace PlayerCc

namespace std {
/// Prints a heading and one line with position, speeds and stall flag.
std::ostream& operator<<(std::ostream& os, const PlayerCc::Position2dProxy& c);
}  // namespace std
