// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "libCCMorse/MorseSensor.h"
#include "libplayerc++/playerstructs.h"

namespace CCMorse {

/// Drives its robot to a point of the world in a straight line, without avoiding obstacles
/// (docs/devices/waypoint.md).
///
/// Commands return immediately and take effect at the next step. The robot drives while Read()
/// advances time; Read() also updates the status. After a command, GetStatus() returns the
/// commanded status until the first reading that reflects the command. The last command to the
/// motors wins: SetSpeed(), or a command from another program, ends the transit with status "Stop".
class MorseWaypoint : public MorseSensor {
 public:
  /// @param aName  name of the device; "" for the robot's first device of type "waypoint".
  explicit MorseWaypoint(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseWaypoint() override;

  /// Starts driving to a point of the world.
  /// @param aX, aY      goal [m].
  /// @param aTolerance  distance to the goal within which the robot has arrived [m], > 0.
  /// @param aSpeed      maximum speed [m/s], > 0; the motors' limits apply too.
  /// @throws MorseError kBadArgument for NaN or infinity, and for a tolerance or speed that is not
  ///         positive.
  void Goto(double aX, double aY, double aTolerance, double aSpeed);
  /// Goto() with the device's own tolerance and speed; see GetTolerance() and GetSpeed().
  void Goto(double aX, double aY);
  /// Calls Goto(), unless the robot is already within the tolerance according to the newest
  /// reading.
  /// @return whether Goto() was called.
  bool SetDest(double aX, double aY, double aTolerance, double aSpeed);
  bool SetDest(double aX, double aY);
  /// Stops the robot and keeps the goal.
  void Stop();
  /// Continues to the last goal.
  void Resume();

  /// Returns MORSE's status: "Arrived" (also before the first goal), "Transit" or "Stop".
  std::string GetStatus() const;
  bool IsArrived() const;             ///< whether GetStatus() is "Arrived"
  player_point_2d_t GetGoal() const;  ///< goal [m]; before the first goal, the robot's start
  /// Distance from the robot to the goal [m]; 0 before the first reading.
  double GetDistance() const;
  /// Number of goals that the device has received from all programs, according to the newest
  /// reading.
  uint32_t GetGoalNumber() const;

  double GetTolerance() const;  ///< tolerance of Goto(x, y) [m]
  double GetSpeed() const;      ///< maximum speed of Goto(x, y) [m/s]

 protected:
  void HandleReading() override;

 private:
  void Ordered(const char* aStatus);

  std::string mStatus;
  double mOrderTime;  // readings up to this time [s] do not reflect the last command
  player_point_2d_t mGoal;
  player_point_2d_t mPosition;
  double mDistance;
  uint32_t mGoalNumber;
};

}  // namespace CCMorse
