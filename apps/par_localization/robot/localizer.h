// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_LOCALIZATION_LOCALIZER_H
#define PAR_LOCALIZATION_LOCALIZER_H

#include <memory>
#include <vector>

#include "libCCMorse/CCMorse.h"
#include "par_common/grid.h"

// What the localizer thinks: a pose, and how far it may be wrong.
struct Estimate {
  par::Pose pose;            // of the robot in W
  double positionError = 0;  // standard deviation of the position [m]
  double headingError = 0;   // standard deviation of the heading [rad]
};

// Finds out where the robot is. The part in which the solutions differ: each implements it in its
// own localizer.cc.
class Localizer {
 public:
  Localizer() = default;
  Localizer(const Localizer&) = delete;
  Localizer& operator=(const Localizer&) = delete;
  virtual ~Localizer() = default;

  // Takes the data of a round; call it after each Read().
  virtual void update() = 0;
  // Where the robot is now.
  virtual Estimate estimate() const = 0;
  // Poses that are thought possible, for drawing.
  virtual std::vector<par::Pose> particles() const = 0;
  // Begins again: the robot may be anywhere.
  virtual void forget() = 0;
};

// The localizer's name, for messages.
extern const char* const LOCALIZER_NAME;

// Makes the localizer of a solution. It may be anywhere on the map at first.
//
// walls:     the map, 1 where there is a wall.
// odometry:  the pose since the robot was switched on; it drifts.
// laser:     the newest scan.
// All of them outlive the localizer.
std::unique_ptr<Localizer> makeLocalizer(CCMorse::PlayerClient& client, const par::Mask& walls,
                                         const CCMorse::Position2dProxy& odometry,
                                         CCMorse::LaserProxy& laser);

#endif
