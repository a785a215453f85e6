// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Proxies of things that a robot moves with: arrays of actuators, limbs, single axes. Programs
/// with them compile; no device of Playpen carries their interfaces.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "libplayerc++/proxywithoutdevice.h"

namespace PlayerCc {

/// A row of actuators, such as the joints of an arm.
class ActArrayProxy : public ProxyWithoutDevice {
 public:
  /// @throws PlayerError kNoSuchDevice, always; see ProxyWithoutDevice.
  ActArrayProxy(PlayerClient* aPc, uint32_t aIndex = 0)
      : ProxyWithoutDevice(aPc, aIndex, PLAYER_ACTARRAY_CODE, "ActArrayProxy::ActArrayProxy") {}

  /// Asks for what GetActuatorGeom(), GetBasePos() and GetBaseOrientation() tell.
  void RequestGeometry() { NoDevice(); }
  /// Switches all actuators on or off.
  void SetPowerConfig(bool /*aVal*/) { NoDevice(); }
  /// Puts all brakes on or off.
  void SetBrakesConfig(bool /*aVal*/) { NoDevice(); }
  /// Sets the speed of an actuator [m/s or rad/s] for MoveTo().
  void SetSpeedConfig(uint32_t /*aJoint*/, float /*aSpeed*/) { NoDevice(); }
  /// Sets the acceleration of an actuator [m/s^2 or rad/s^2].
  void SetAccelerationConfig(uint32_t /*aJoint*/, float /*aAcc*/) { NoDevice(); }
  /// Sends an actuator to a position [m or rad].
  void MoveTo(uint32_t /*aJoint*/, float /*aPos*/) { NoDevice(); }
  /// Sends the first actuators to positions [m or rad].
  void MoveToMulti(std::vector<float> /*aPos*/) { NoDevice(); }
  /// Moves an actuator at a speed [m/s or rad/s].
  void MoveAtSpeed(uint32_t /*aJoint*/, float /*aSpeed*/) { NoDevice(); }
  /// Moves the first actuators at speeds [m/s or rad/s].
  void MoveAtSpeedMulti(std::vector<float> /*aSpeed*/) { NoDevice(); }
  /// Sends an actuator home; -1: all of them.
  void MoveHome(int /*aJoint*/) { NoDevice(); }
  /// Sets the current of an actuator [A].
  void SetActuatorCurrent(uint32_t /*aJoint*/, float /*aCurrent*/) { NoDevice(); }
  /// Sets the currents of the first actuators [A].
  void SetActuatorCurrentMulti(std::vector<float> /*aCurrent*/) { NoDevice(); }
  /// How many actuators there are.
  uint32_t GetCount() const { return NoDevice(); }
  /// Position, speed, acceleration, current and state of an actuator.
  player_actarray_actuator_t GetActuatorData(uint32_t /*aJoint*/) const { return NoDevice(); }
  /// Kind, place and limits of an actuator.
  player_actarray_actuatorgeom_t GetActuatorGeom(uint32_t /*aJoint*/) const { return NoDevice(); }
  /// Place of the first actuator on the robot [m].
  player_point_3d_t GetBasePos() const { return NoDevice(); }
  /// Orientation of the first actuator [rad].
  player_orientation_3d_t GetBaseOrientation() const { return NoDevice(); }
  /// The same as GetActuatorData().
  player_actarray_actuator_t operator[](uint32_t /*aJoint*/) { return NoDevice(); }
};

/// An arm that is told where its end should be.
class LimbProxy : public ProxyWithoutDevice {
 public:
  /// @throws PlayerError kNoSuchDevice, always; see ProxyWithoutDevice.
  LimbProxy(PlayerClient* aPc, uint32_t aIndex = 0)
      : ProxyWithoutDevice(aPc, aIndex, PLAYER_LIMB_CODE, "LimbProxy::LimbProxy") {}

  /// Asks for what GetGeom() tells.
  void RequestGeometry() { NoDevice(); }
  /// Switches all joints on or off.
  void SetPowerConfig(bool /*aVal*/) { NoDevice(); }
  /// Puts all brakes on or off.
  void SetBrakesConfig(bool /*aVal*/) { NoDevice(); }
  /// Sets the speed of the end [m/s].
  void SetSpeedConfig(float /*aSpeed*/) { NoDevice(); }
  /// Moves the arm to where it rests.
  void MoveHome() { NoDevice(); }
  /// Stops the arm where it is.
  void Stop() { NoDevice(); }
  /// Moves the end to a position P [m], approached along vector A, oriented by vector O.
  void SetPose(float /*aPX*/, float /*aPY*/, float /*aPZ*/, float /*aAX*/, float /*aAY*/,
               float /*aAZ*/, float /*aOX*/, float /*aOY*/, float /*aOZ*/) {
    NoDevice();
  }
  /// Moves the end to a position [m], however oriented.
  void SetPosition(float /*aX*/, float /*aY*/, float /*aZ*/) { NoDevice(); }
  /// Moves the end along a direction by a length [m].
  void VectorMove(float /*aX*/, float /*aY*/, float /*aZ*/, float /*aLength*/) { NoDevice(); }
  /// Position, approach and orientation of the end, and its state.
  player_limb_data_t GetData() const { return NoDevice(); }
  /// Place of the arm on the robot [m].
  player_limb_geom_req_t GetGeom() const { return NoDevice(); }
};

/// A single axis: a slide or a joint.
class Position1dProxy : public ProxyWithoutDevice {
 public:
  /// @throws PlayerError kNoSuchDevice, always; see ProxyWithoutDevice.
  Position1dProxy(PlayerClient* aPc, uint32_t aIndex = 0)
      : ProxyWithoutDevice(aPc, aIndex, PLAYER_POSITION1D_CODE,
                           "Position1dProxy::Position1dProxy") {}

  /// Moves at a speed [m/s or rad/s].
  void SetSpeed(double /*aVel*/) { NoDevice(); }
  /// Moves to a position [m or rad] at a speed.
  void GoTo(double /*aPos*/, double /*aVel*/) { NoDevice(); }
  /// Asks for what GetPose() and GetSize() tell.
  void RequestGeom() { NoDevice(); }
  /// Pose on the robot [m, rad].
  player_pose3d_t GetPose() const { return NoDevice(); }
  /// Size [m].
  player_bbox3d_t GetSize() const { return NoDevice(); }
  /// Switches the motor on or off.
  void SetMotorEnable(bool /*enable*/) { NoDevice(); }
  /// Sets what GetPos() tells of the present position [m or rad].
  void SetOdometry(double /*aPos*/) { NoDevice(); }
  /// The same as SetOdometry(0).
  void ResetOdometry() { NoDevice(); }
  /// Position [m or rad].
  double GetPos() const { return NoDevice(); }
  /// Speed [m/s or rad/s].
  double GetVel() const { return NoDevice(); }
  /// Whether the axis is stuck.
  bool GetStall() const { return NoDevice(); }
  /// All states: bits PLAYER_POSITION1D_STATUS_...
  uint8_t GetStatus() const { return NoDevice(); }
  /// Whether the axis is at its lower limit switch.
  bool IsLimitMin() const { return NoDevice(); }
  /// Whether the axis is at its centre switch.
  bool IsLimitCen() const { return NoDevice(); }
  /// Whether the axis is at its upper limit switch.
  bool IsLimitMax() const { return NoDevice(); }
  /// Whether the motor draws too much current.
  bool IsOverCurrent() const { return NoDevice(); }
  /// Whether the last movement has ended.
  bool IsTrajComplete() const { return NoDevice(); }
  /// Whether the motor is on.
  bool IsEnabled() const { return NoDevice(); }
};

}  // namespace PlayerCc
