// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// A robot that drives in a plane: where it is, and how it is told to move.
///
/// Frames: positions are of the body B (the middle of the wheels' axle; x forward, y left) in the
/// frame that the localisation reports in: index 0 is the arena's localisation, so the world W;
/// index 1, if the robot has it, is the odometry, so the pose B had at the start. Yaw is
/// counter-clockwise in (-pi, pi].
///
/// Commands are carried out from the next step on and hold until the next one. Values beyond
/// the robot's limits are clamped to them; NaN and infinity are refused with PlayerError
/// kBadArgument. The robots have differential drives: sideways speeds are ignored. Of SetVelHead()
/// and GoTo() the control runs in this library, once for each new reading, so only while the client
/// reads.
///
/// An index that the world's `drivers` table gives a driver (docs/snd.md) reports what that
/// driver's own position device does. Its GoTo() hands the goal to the driver, which drives round
/// obstacles in a thread of its own, and stops when it is blocked; any other command goes straight
/// to the motors and drops the goal.
class Position2dProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if there is no such device; the text names those there are.
  Position2dProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~Position2dProxy() override;

  /// Drive. @param aXSpeed forward [m/s]; aYSpeed ignored; aYawSpeed counter-clockwise [rad/s].
  void SetSpeed(double aXSpeed, double aYSpeed, double aYawSpeed);
  void SetSpeed(double aXSpeed, double aYawSpeed);
  void SetSpeed(player_pose2d_t vel);

  /// Drive at aXSpeed [m/s], turning towards the heading aYawHead [rad], at a rate proportional
  /// to what is missing (see kGain_per_s in the source).
  void SetVelHead(double aXSpeed, double aYSpeed, double aYawHead);
  void SetVelHead(double aXSpeed, double aYawHead);

  /// Drive to a pose in the frame that GetXPos() is in: turn towards it, drive there straight (to
  /// within 1 cm), turn to the heading (to within 0.01 rad), stop. It goes straight, also into
  /// obstacles, unless the index is a driver's.
  /// @param pos  where to.
  /// @param vel  px: highest forward speed [m/s]; pa: highest turn rate [rad/s]; 0 for the robot's
  ///             own limits; signs do not matter, py is ignored.
  void GoTo(player_pose2d_t pos, player_pose2d_t vel);
  void GoTo(player_pose2d_t pos);
  void GoTo(double aX, double aY, double aYaw);

  /// Drive as a car with its wheelbase as long as the robot would: the turn rate is
  /// aXSpeed tan(aDriveAngle) / length [rad/s].
  /// @param aXSpeed      forward [m/s].
  /// @param aDriveAngle  steering angle, counter-clockwise, in (-pi/2, pi/2) [rad].
  void SetCarlike(double aXSpeed, double aDriveAngle);

  /// Asks for the geometry. It is known from the start, so nothing changes.
  void RequestGeom();
  /// Pose of the body's middle in B: zero.
  player_pose3d_t GetOffset();
  /// Size of the body.
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
  void Subscribe(uint32_t aIndex) override;
  void Unsubscribe() override;
  void HandleReading(const sim::Reading& aReading) override;
  void HandleRound() override;
  bool IsCapable(uint32_t aType, uint32_t aSubtype) const override;

 private:
  struct Control;
  void Drive(double aXSpeed, double aYawSpeed, const char* aFun);
  void Send(double aXSpeed, double aYawSpeed, const char* aFun);
  player_position2d_data_t mData;
  std::unique_ptr<Control> mControl;
};

}  // namespace PlayerCc

namespace std {
/// Prints a heading and one line with position, speeds and stall flag.
std::ostream& operator<<(std::ostream& os, const PlayerCc::Position2dProxy& c);
}  // namespace std
