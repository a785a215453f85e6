// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// An arm: a row of actuators (joints), each of which turns or slides (docs/devices/actarray.md).
/// Positions are in rad for a rotary joint and in m for a linear joint; speeds and accelerations
/// are in the same units per s and s^2.
///
/// A joint whose index is not below its count reads 0, and a command to it has no effect; a warning
/// on standard error says so, once for each proxy. The index -1 means all joints.
class ActArrayProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  ActArrayProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~ActArrayProxy() override;

  /// Requests the geometry: GetActuatorGeom(), GetBasePos() and GetBaseOrientation(). It is known
  /// from the start, so nothing changes.
  void RequestGeometry();
  /// Switches the motors of all joints on or off, from the next step on. Without power a joint
  /// stops, stays where it is and ignores commands; a warning on standard error says so, once for
  /// each proxy.
  void SetPowerConfig(bool aVal);
  /// Applies or releases the brakes of all joints that have brakes, from the next step on. A braked
  /// joint stops and ignores commands.
  void SetBrakesConfig(bool aVal);
  /// Sets the speed of a joint for later calls of MoveTo() and MoveHome(). The sign is ignored; the
  /// joint's maximum speed applies.
  /// @throws PlayerError kBadArgument for a joint that does not exist, and for 0.
  void SetSpeedConfig(uint32_t aJoint, float aSpeed);
  /// Sets the acceleration of a joint for later movements. The sign is ignored; the joint's maximum
  /// acceleration applies.
  /// @throws PlayerError kBadArgument for a joint that does not exist, and for 0.
  void SetAccelerationConfig(uint32_t aJoint, float aAcc);

  /// Moves a joint to a position, from the next step on. A position beyond the joint's limits is
  /// replaced by the limit; a warning on standard error says so, once for each proxy.
  /// @throws PlayerError kBadArgument for values that are not finite, as all functions that move.
  void MoveTo(uint32_t aJoint, float aPos);
  /// Moves the first joints, as MoveTo().
  /// @param aPos  one position per joint. Positions without a joint have no effect.
  void MoveToMulti(std::vector<float> aPos);
  /// Moves a joint at a speed until another command or a limit; 0 stops it. At a limit its state
  /// becomes PLAYER_ACTARRAY_ACTSTATE_STALLED. The joint's maximum speed applies.
  void MoveAtSpeed(uint32_t aJoint, float aSpeed);
  /// Moves the first joints, as MoveAtSpeed().
  void MoveAtSpeedMulti(std::vector<float> aSpeed);
  /// Moves a joint to its home position; -1: all joints.
  void MoveHome(int aJoint);
  /// Sets the current of a joint's motor [A]: its torque is proportional to the current, so the
  /// speed approaches a value that is proportional to the current. The maximum current applies.
  void SetActuatorCurrent(uint32_t aJoint, float aCurrent);
  /// Sets the currents of the first joints, as SetActuatorCurrent().
  void SetActuatorCurrentMulti(std::vector<float> aCurrent);

  /// Number of joints; 0 before the first reading.
  uint32_t GetCount() const;
  /// Position, speed, acceleration, current [A] and state of a joint; the state is one of
  /// PLAYER_ACTARRAY_ACTSTATE_IDLE, _MOVING, _BRAKED, _STALLED. All zero before the first reading.
  player_actarray_actuator_t GetActuatorData(uint32_t aJoint) const;
  /// Type, length, orientation, axis, limits, home position and speed for MoveTo() of a joint, and
  /// whether it has a brake. The speed is the configured one of the newest reading.
  player_actarray_actuatorgeom_t GetActuatorGeom(uint32_t aJoint) const;
  /// Position of the arm's base in the robot's body frame [m].
  player_point_3d_t GetBasePos() const;
  /// Orientation of the arm's base in the robot's body frame [rad].
  player_orientation_3d_t GetBaseOrientation() const;
  /// Same as GetActuatorData().
  player_actarray_actuator_t operator[](uint32_t aJoint) { return GetActuatorData(aJoint); }

  /// Extension to Player: whether the motors are on; false before the first reading.
  bool IsPowered() const;

 private:
  /// aMode: a sim::JointCommand::Mode. The joint is the first one that moves.
  void Move(const char* aFun, int aMode, uint32_t aJoint, std::vector<double> aValues);
  /// aSetting: a sim::JointSettingCommand::Setting.
  void Set(const char* aFun, int aSetting, uint32_t aJoint, double aValue);
  /// Warns if a position of the joints from aFirst to before aEnd is beyond their limits.
  void WarnBeyondLimits(const char* aFun, std::size_t aFirst, std::size_t aEnd,
                        const std::vector<double>& aPositions) const;
  /// A property of a joint, such as "min".
  double OfJoint(const char* aName, std::size_t aJoint) const;

  // Guarded by the client's mutex.
  std::size_t mJoints = 0;
  bool mSwitchedOn = false;  // by this proxy; the newest reading may not show it yet
};

}  // namespace PlayerCc

namespace std {
/// Prints position, speed and state of each joint.
std::ostream& operator<<(std::ostream& os, const PlayerCc::ActArrayProxy& c);
}  // namespace std
