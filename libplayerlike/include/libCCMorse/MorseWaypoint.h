// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "libCCMorse/MorseSensor.h"
#include "libplayerc++/playerstructs.h"

namespace CCMorse {

/// Drives its robot to a point of the world, straight on, round nothing (docs/devices/waypoint.md).
///
/// Orders are executed from the next step on, and return at once; Read() lets the robot drive
/// and brings how it goes. What was ordered is told as done until a reading shows what came of it.
/// Whoever spoke last steers: SetSpeed() of the motors, or another program, ends the transit with
/// "Stop".
class MorseWaypoint : public MorseSensor {
 public:
  /// @param aName  device; "": the robot's first of type "waypoint".
  explicit MorseWaypoint(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseWaypoint() override;

  /// Drive to a point of the world.
  /// @param aX, aY      goal [m].
  /// @param aTolerance  so near to it the robot has arrived [m], > 0.
  /// @param aSpeed      at most [m/s], > 0; the motors' limits hold too.
  /// @throws MorseError kBadArgument for NaN, infinity, or what is not positive.
  void Goto(double aX, double aY, double aTolerance, double aSpeed);
  /// The same with the device's own tolerance and speed, see GetTolerance() and GetSpeed().
  void Goto(double aX, double aY);
  /// As Goto(), unless the robot is there already by the newest reading: then nothing is ordered.
  /// @return whether it was ordered.
  bool SetDest(double aX, double aY, double aTolerance, double aSpeed);
  bool SetDest(double aX, double aY);
  /// Stop; the goal is kept.
  void Stop();
  /// Go on to the goal that was given last.
  void Resume();

  /// MORSE's words: "Arrived" (also before the first goal), "Transit" or "Stop".
  std::string GetStatus() const;
  bool IsArrived() const;             ///< GetStatus() is "Arrived"
  player_point_2d_t GetGoal() const;  ///< [m]; before the first: where the robot started
  /// From the robot to the goal [m]; 0 before the first reading.
  double GetDistance() const;
  /// How many goals, of all programs together, the device had by the newest reading.
  uint32_t GetGoalNumber() const;

  double GetTolerance() const;  ///< what Goto(x, y) takes [m]
  double GetSpeed() const;      ///< the same [m/s]

 protected:
  void HandleReading() override;

 private:
  void Ordered(const char* aStatus);

  std::string mStatus;
  double mOrderTime;  // readings up to then do not know of the last order
  player_point_2d_t mGoal;
  player_point_2d_t mPosition;
  double mDistance;
  uint32_t mGoalNumber;
};

}  // namespace CCMorse
