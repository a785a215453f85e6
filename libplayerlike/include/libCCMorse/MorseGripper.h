// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "libCCMorse/MorseSensor.h"

namespace CCMorse {

/// Two paddles before the robot that take obstacles, carry them and put them down
/// (docs/devices/gripper.md). Orders are executed from the next step on. All values are of the
/// newest reading; before the first the status is "", nothing is held, and no beam is broken.
class MorseGripper : public MorseSensor {
 public:
  /// @param aName  device; "": the robot's first of type "gripper".
  explicit MorseGripper(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseGripper() override;

  /// Opens the paddles and puts down what they hold. Where that has no room the status becomes
  /// "error", and it is held on.
  void Open();
  /// Closes the paddles, until they hold something or meet.
  void Close();
  /// Stops the paddles where they are.
  void Stop();
  /// Puts what is held into the store, if there is room, and opens the paddles.
  void Store();
  /// Takes what was stored last between the paddles.
  void Retrieve();

  /// "open" (also stopped on the way), "closed" (also round something), "moving" or "error".
  std::string GetStatus() const;
  bool IsHolding() const;          ///< something moves with the robot
  bool IsOuterBeamBroken() const;  ///< near the paddles' tips
  bool IsInnerBeamBroken() const;  ///< near the robot
  int GetStored() const;           ///< things in the store
  int GetCapacity() const;         ///< of the store
  double GetGap() const;           ///< between the paddles [m]
  double GetOpening() const;       ///< between the open paddles [m]
};

}  // namespace CCMorse
