// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Two paddles at the front of the robot, with break beams between them. docs/devices/gripper.md
/// describes how they handle obstacles.
class GripperProxy : public ClientProxy {
 public:
  /// @param aIndex  on a robot's own port, index among its devices of type "gripper";
  ///                on port 4000, the robot's number.
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  GripperProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~GripperProxy() override;

  /// Requests the geometry: GetPose(), GetOuterSize(), GetInnerSize(), GetNumBeams() and
  /// GetCapacity(). It is known from the start, so nothing changes.
  void RequestGeometry();
  /// Returns PLAYER_GRIPPER_STATE_OPEN, _CLOSED, _MOVING or _ERROR; 0 before the first reading.
  uint32_t GetState() const;
  /// Bit mask of the broken beams: 0x04 for the outer beam, 0x08 for the inner beam, as in Player's
  /// Pioneer drivers.
  uint32_t GetBeams() const;
  /// Pose in the robot's body frame of the midpoint between the roots of the paddles [m, rad].
  player_pose3d_t GetPose() const;
  /// Outer size of the open paddles [m]: sw across, sl along them.
  player_bbox3d_t GetOuterSize() const;
  /// Size of the gap between the open paddles [m].
  player_bbox3d_t GetInnerSize() const;
  /// Number of break beams: 2.
  uint32_t GetNumBeams() const;
  /// Capacity of the store [objects].
  uint32_t GetCapacity() const;
  /// Number of objects in the store.
  uint32_t GetStored() const;
  /// Opens the paddles, from the next step on, and puts down the held object. If there is no room
  /// for the object, the gripper keeps it and the state becomes PLAYER_GRIPPER_STATE_ERROR.
  void Open();
  /// Closes the paddles until they hold an object or touch each other.
  void Close();
  /// Stops the paddles where they are.
  void Stop();
  /// Moves the held object to the store, if there is room, and opens the paddles.
  void Store();
  /// Moves the last stored object from the store to the paddles.
  void Retrieve();

  // Functions of Player 2.0.

  /// @deprecated Player 2.0: 1 if the outer break beam is broken, otherwise 0; see GetBeams().
  uint32_t GetOuterBreakBeam() const;
  /// @deprecated Player 2.0: 1 if the inner break beam is broken, otherwise 0; see GetBeams().
  uint32_t GetInnerBreakBeam() const;
  /// @deprecated Player 2.0: 1 if the paddles are open, otherwise 0; see GetState().
  uint32_t GetPaddlesOpen() const;
  /// @deprecated Player 2.0: 1 if the paddles are closed, otherwise 0; see GetState().
  uint32_t GetPaddlesClosed() const;
  /// @deprecated Player 2.0: 1 if the paddles are moving, otherwise 0; see GetState().
  uint32_t GetPaddlesMoving() const;
  /// @deprecated Player 2.0: 1 if the gripper is in the error state, otherwise 0; see GetState().
  uint32_t GetGripperError() const;
  /// @deprecated Player 2.0: always 0, because there is no lift.
  uint32_t GetLiftUp() const { return 0; }
  /// @deprecated Player 2.0: always 1, because there is no lift.
  uint32_t GetLiftDown() const { return 1; }
  /// @deprecated Player 2.0: always 0, because there is no lift.
  uint32_t GetLiftMoving() const { return 0; }
  /// @deprecated Player 2.0: always 0, because there is no lift.
  uint32_t GetLiftError() const { return 0; }
  /// @deprecated Player 2.0: sends a command code of the Pioneer's gripper: 1 open, 2 close, 3 or
  /// 15 stop, 7 store, 8 retrieve. The argument is ignored.
  /// @throws PlayerError kNotAvailable for the codes of the lift (4, 5, 6, 17) and of pressure
  ///         (16); kBadArgument for unknown codes.
  void SetGrip(uint8_t aCmd, uint8_t aArg = 0);

 private:
  // aAction: PLAYER_GRIPPER_CMD_OPEN, ...
  void Grip(const char* aFun, int aAction);

  // Guarded by the client's mutex.
  player_gripper_geom_t mGeom = {};
};

}  // namespace PlayerCc

namespace std {
/// Prints state, beams and store.
std::ostream& operator<<(std::ostream& os, const PlayerCc::GripperProxy& c);
}  // namespace std
