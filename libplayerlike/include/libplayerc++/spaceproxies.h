// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Proxies of motion and drawing in space, and of maps and plans. Programs with them compile; no
/// device of Playpen carries their interfaces.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "libplayerc++/proxywithoutdevice.h"

namespace PlayerCc {

/// A robot that moves in space.
class Position3dProxy : public ProxyWithoutDevice {
 public:
  /// @throws PlayerError kNoSuchDevice, always; see ProxyWithoutDevice.
  Position3dProxy(PlayerClient* aPc, uint32_t aIndex = 0)
      : ProxyWithoutDevice(aPc, aIndex, PLAYER_POSITION3D_CODE,
                           "Position3dProxy::Position3dProxy") {}

  /// Moves at speeds along the axes [m/s] and round them [rad/s].
  void SetSpeed(double /*aXSpeed*/, double /*aYSpeed*/, double /*aZSpeed*/, double /*aRollSpeed*/,
                double /*aPitchSpeed*/, double /*aYawSpeed*/) {
    NoDevice();
  }
  /// Moves at speeds along the axes [m/s] and round the upright one [rad/s].
  void SetSpeed(double /*aXSpeed*/, double /*aYSpeed*/, double /*aZSpeed*/, double /*aYawSpeed*/) {
    NoDevice();
  }
  /// Moves at speeds in the plane [m/s] and round the upright axis [rad/s].
  void SetSpeed(double /*aXSpeed*/, double /*aYSpeed*/, double /*aYawSpeed*/) { NoDevice(); }
  /// Moves forward [m/s] and turns [rad/s].
  void SetSpeed(double /*aXSpeed*/, double /*aYawSpeed*/) { NoDevice(); }
  /// Moves at speeds [m/s, rad/s].
  void SetSpeed(player_pose3d_t /*vel*/) { NoDevice(); }
  /// Moves to a pose [m, rad] at speeds [m/s, rad/s].
  void GoTo(player_pose3d_t /*aPos*/, player_pose3d_t /*aVel*/) { NoDevice(); }
  /// Moves to a pose [m, rad].
  void GoTo(player_pose3d_t /*aPos*/) { NoDevice(); }
  /// Moves to a pose [m, rad].
  void GoTo(double /*aX*/, double /*aY*/, double /*aZ*/, double /*aRoll*/, double /*aPitch*/,
            double /*aYaw*/) {
    NoDevice();
  }
  /// Switches the motors on or off.
  void SetMotorEnable(bool /*aEnable*/) { NoDevice(); }
  /// Selects how speeds are kept; what the modes are is the device's matter.
  void SelectVelocityControl(int /*aMode*/) { NoDevice(); }
  /// Sets the odometry to 0.
  void ResetOdometry() { NoDevice(); }
  /// Sets the odometry to a pose [m, rad].
  void SetOdometry(double /*aX*/, double /*aY*/, double /*aZ*/, double /*aRoll*/, double /*aPitch*/,
                   double /*aYaw*/) {
    NoDevice();
  }
  /// Asks for the geometry.
  void RequestGeom() { NoDevice(); }
  /// x [m].
  double GetXPos() const { return NoDevice(); }
  /// y [m].
  double GetYPos() const { return NoDevice(); }
  /// z [m].
  double GetZPos() const { return NoDevice(); }
  /// Roll [rad].
  double GetRoll() const { return NoDevice(); }
  /// Pitch [rad].
  double GetPitch() const { return NoDevice(); }
  /// Yaw [rad].
  double GetYaw() const { return NoDevice(); }
  /// Speed along x [m/s].
  double GetXSpeed() const { return NoDevice(); }
  /// Speed along y [m/s].
  double GetYSpeed() const { return NoDevice(); }
  /// Speed along z [m/s].
  double GetZSpeed() const { return NoDevice(); }
  /// Speed of roll [rad/s].
  double GetRollSpeed() const { return NoDevice(); }
  /// Speed of pitch [rad/s].
  double GetPitchSpeed() const { return NoDevice(); }
  /// Speed of yaw [rad/s].
  double GetYawSpeed() const { return NoDevice(); }
  /// Whether the robot is stuck.
  bool GetStall() const { return NoDevice(); }
};

/// Drawing in space. (Graphics2dProxy works.)
class Graphics3dProxy : public ProxyWithoutDevice {
 public:
  /// @throws PlayerError kNoSuchDevice, always; see ProxyWithoutDevice.
  Graphics3dProxy(PlayerClient* aPc, uint32_t aIndex = 0)
      : ProxyWithoutDevice(aPc, aIndex, PLAYER_GRAPHICS3D_CODE,
                           "Graphics3dProxy::Graphics3dProxy") {}

  /// Sets the colour of what is drawn next.
  void Color(player_color_t /*col*/) { NoDevice(); }
  /// Sets the colour of what is drawn next.
  void Color(uint8_t /*red*/, uint8_t /*green*/, uint8_t /*blue*/, uint8_t /*alpha*/) {
    NoDevice();
  }
  /// Removes all that was drawn.
  void Clear() { NoDevice(); }
  /// Draws points, or lines and faces between them.
  void Draw(player_graphics3d_draw_mode_t /*mode*/, player_point_3d_t /*pts*/[], int /*count*/) {
    NoDevice();
  }
};

/// A planner that finds a way to a goal and drives it. (Position2dProxy::GoTo() drives to goals in
/// Playpen.)
class PlannerProxy : public ProxyWithoutDevice {
 public:
  /// @throws PlayerError kNoSuchDevice, always; see ProxyWithoutDevice.
  PlannerProxy(PlayerClient* aPc, uint32_t aIndex = 0)
      : ProxyWithoutDevice(aPc, aIndex, PLAYER_PLANNER_CODE, "PlannerProxy::PlannerProxy") {}

  /// Sets the goal [m, rad].
  void SetGoalPose(double /*aGx*/, double /*aGy*/, double /*aGa*/) { NoDevice(); }
  /// Sets where the way begins [m, rad].
  void SetStartPose(double /*aSx*/, double /*aSy*/, double /*aSa*/) { NoDevice(); }
  /// Asks for the points of the way.
  void RequestWaypoints() { NoDevice(); }
  /// Lets the robot drive, or stops it.
  void SetEnable(bool /*aEnable*/) { NoDevice(); }
  /// Whether there is a way.
  uint32_t GetPathValid() const { return NoDevice(); }
  /// Whether the goal is reached.
  uint32_t GetPathDone() const { return NoDevice(); }
  /// Length of the way [m].
  double GetPathLength() const { return NoDevice(); }
  /// x of the robot [m].
  double GetPx() const { return NoDevice(); }
  /// y of the robot [m].
  double GetPy() const { return NoDevice(); }
  /// Yaw of the robot [rad].
  double GetPa() const { return NoDevice(); }
  /// Pose of the robot [m, rad].
  player_pose2d_t GetPose() const { return NoDevice(); }
  /// x of the goal [m].
  double GetGx() const { return NoDevice(); }
  /// y of the goal [m].
  double GetGy() const { return NoDevice(); }
  /// Yaw at the goal [rad].
  double GetGa() const { return NoDevice(); }
  /// Pose of the goal [m, rad].
  player_pose2d_t GetGoal() const { return NoDevice(); }
  /// x of the point that the robot makes for [m].
  double GetWx() const { return NoDevice(); }
  /// y of the point that the robot makes for [m].
  double GetWy() const { return NoDevice(); }
  /// Yaw at the point that the robot makes for [rad].
  double GetWa() const { return NoDevice(); }
  /// The point that the robot makes for [m, rad].
  player_pose2d_t GetCurrentWaypoint() const { return NoDevice(); }
  /// x of a point of the way [m].
  double GetIx(int /*i*/) const { return NoDevice(); }
  /// y of a point of the way [m].
  double GetIy(int /*i*/) const { return NoDevice(); }
  /// Yaw at a point of the way [rad].
  double GetIa(int /*i*/) const { return NoDevice(); }
  /// A point of the way [m, rad].
  player_pose2d_t GetWaypoint(uint32_t /*aIndex*/) const { return NoDevice(); }
  /// Number of the point that the robot makes for; negative: none.
  int GetCurrentWaypointId() const { return NoDevice(); }
  /// How many points the way has.
  uint32_t GetWaypointCount() const { return NoDevice(); }
  /// The same as GetWaypoint().
  player_pose2d_t operator[](uint32_t /*aIndex*/) const { return NoDevice(); }
};

/// A map made of lines and shapes. (MapProxy works.)
class VectorMapProxy : public ProxyWithoutDevice {
 public:
  /// @throws PlayerError kNoSuchDevice, always; see ProxyWithoutDevice.
  VectorMapProxy(PlayerClient* aPc, uint32_t aIndex = 0)
      : ProxyWithoutDevice(aPc, aIndex, PLAYER_VECTORMAP_CODE, "VectorMapProxy::VectorMapProxy") {}

  /// Asks for the list of layers.
  void GetMapInfo() { NoDevice(); }
  /// Asks for a layer's features.
  void GetLayerData(unsigned /*layer_index*/) { NoDevice(); }
  /// How many layers there are.
  int GetLayerCount() const { return NoDevice(); }
  /// Names of the layers.
  std::vector<std::string> GetLayerNames() const { return NoDevice(); }
  /// How many features a layer has.
  int GetFeatureCount(unsigned /*layer_index*/) const { return NoDevice(); }
  /// A feature's shape as well-known binary.
  const uint8_t* GetFeatureData(unsigned /*layer_index*/, unsigned /*feature_index*/) const {
    return NoDevice();
  }
  /// Size of that [bytes].
  size_t GetFeatureDataCount(unsigned /*layer_index*/, unsigned /*feature_index*/) const {
    return NoDevice();
  }
};

}  // namespace PlayerCc
