// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "libCCMorse/MorseSensor.h"

namespace CCMorse {

/// Two paddles at the front of the robot that grip obstacles, carry them and put them down
/// (docs/devices/gripper.md). Commands take effect at the next step. All values come from the
/// newest reading. Before the first reading the status is "", nothing is held, and no beam is
/// broken.
class MorseGripper : public MorseSensor {
 public:
  /// @param aName  name of the device; "" for the robot's first device of type "gripper".
  explicit MorseGripper(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseGripper() override;

  /// Opens the paddles and puts down the held object. If there is no room for the object, the
  /// gripper keeps it and the status becomes "error".
  void Open();
  /// Closes the paddles until they hold an object or touch each other.
  void Close();
  /// Stops the paddles where they are.
  void Stop();
  /// Moves the held object to the store, if there is room, and opens the paddles.
  void Store();
  /// Moves the last stored object from the store to the paddles.
  void Retrieve();

  /// Returns "open" (also if stopped halfway), "closed" (also around an object), "moving" or
  /// "error".
  std::string GetStatus() const;
  bool IsHolding() const;          ///< whether an object is held
  bool IsOuterBeamBroken() const;  ///< whether the beam near the paddles' tips is broken
  bool IsInnerBeamBroken() const;  ///< whether the beam near the robot is broken
  int GetStored() const;           ///< number of objects in the store
  int GetCapacity() const;         ///< capacity of the store [objects]
  double GetGap() const;           ///< current distance between the paddles [m]
  double GetOpening() const;       ///< distance between the fully open paddles [m]
};

}  // namespace CCMorse
