// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Two paddles before the robot with break beams between them; what they do with obstacles is told
/// in docs/devices/gripper.md.
class GripperProxy : public ClientProxy {
 public:
  /// @param aIndex  on a robot's own port the robot's devices of type "gripper", counted from 0; on
  /// port
  ///                4000 the robot.
  /// @throws PlayerError kNoSuchDevice if there is no such device; the text names those there are.
  GripperProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~GripperProxy() override;

  /// Asks for what GetPose(), GetOuterSize(), GetInnerSize(), GetNumBeams() and GetCapacity() tell;
  /// it is known from the start.
  void RequestGeometry();
  /// One of PLAYER_GRIPPER_STATE_OPEN, _CLOSED, _MOVING and _ERROR; 0 before the first reading.
  uint32_t GetState() const;
  /// Which beams are broken: 0x04 for the outer one, 0x08 for the inner one, as Player's drivers
  /// for Pioneers have it.
  uint32_t GetBeams() const;
  /// Where the paddles begin, half-way between them, on the robot [m, rad].
  player_pose3d_t GetPose() const;
  /// Size over open paddles [m]: sw across, sl along them.
  player_bbox3d_t GetOuterSize() const;
  /// Size between open paddles [m].
  player_bbox3d_t GetInnerSize() const;
  /// How many break beams there are: 2.
  uint32_t GetNumBeams() const;
  /// How many things the store holds at most.
  uint32_t GetCapacity() const;
  /// How many things are in the store.
  uint32_t GetStored() const;
  /// Opens the paddles, from the next step on, and puts down what they hold. Where that has no room
  /// the state becomes PLAYER_GRIPPER_STATE_ERROR, and it is held on.
  void Open();
  /// Closes the paddles, until they hold something or meet.
  void Close();
  /// Stops the paddles where they are.
  void Stop();
  /// Puts what the paddles hold into the store, if there is room, and opens them.
  void Store();
  /// Takes what was stored last between the paddles.
  void Retrieve();

  // Names of Player 2.0.

  /// @deprecated Of Player 2.0: 1 if the outer break beam is broken, else 0; see GetBeams().
  uint32_t GetOuterBreakBeam() const;
  /// @deprecated Of Player 2.0: 1 if the inner break beam is broken, else 0; see GetBeams().
  uint32_t GetInnerBreakBeam() const;
  /// @deprecated Of Player 2.0: 1 if the paddles are open, else 0; see GetState().
  uint32_t GetPaddlesOpen() const;
  /// @deprecated Of Player 2.0: 1 if the paddles are closed, else 0; see GetState().
  uint32_t GetPaddlesClosed() const;
  /// @deprecated Of Player 2.0: 1 if the paddles move, else 0; see GetState().
  uint32_t GetPaddlesMoving() const;
  /// @deprecated Of Player 2.0: 1 if the paddles have a fault, else 0; see GetState().
  uint32_t GetGripperError() const;
  /// @deprecated Of Player 2.0: there is no lift, so 0: what is carried stays down.
  uint32_t GetLiftUp() const { return 0; }
  /// @deprecated Of Player 2.0: there is no lift, so 1.
  uint32_t GetLiftDown() const { return 1; }
  /// @deprecated Of Player 2.0: there is no lift, so 0.
  uint32_t GetLiftMoving() const { return 0; }
  /// @deprecated Of Player 2.0: there is no lift, so 0.
  uint32_t GetLiftError() const { return 0; }
  /// @deprecated Of Player 2.0: a command as a Pioneer's gripper has it: 1 open, 2 close, 3 or 15
  /// stop, 7 store, 8 retrieve. The argument is not used.
  /// @throws PlayerError kNotAvailable for those of the lift (4, 5, 6, 17) and for pressure (16);
  ///         kBadArgument for others.
  void SetGrip(uint8_t aCmd, uint8_t aArg = 0);

 private:
  // aAction: of PLAYER_GRIPPER_CMD_OPEN, ...
  void Grip(const char* aFun, int aAction);

  // Guarded by the client's mutex.
  player_gripper_geom_t mGeom = {};
};

}  // namespace PlayerCc

namespace std {
/// Prints state, beams and store.
std::ostream& operator<<(std::ostream& os, const PlayerCc::GripperProxy& c);
}  // namespace std
