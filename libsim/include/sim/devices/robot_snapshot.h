// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/core/colour.h"
#include "sim/core/pose.h"
#include "sim/world/description.h"

namespace sim {

/// A light on a robot.
struct LightSnapshot {
  Vec2 p_BL = Vec2::Zero();  ///< where it is, in B [m]
  Colour colour;
  bool lit = false;
};

/// What a sonar or infrared transducer measured last.
struct ConeSnapshot {
  Pose X_WS;                       ///< where it was; it looks along its x axis
  double range_m = 0.0;            ///< [m]
  double field_of_view_rad = 0.0;  ///< full angle; 0: a ray
  bool met = false;                ///< something; else the range is the greatest there is
};

/// A segment of a bumper.
struct BumperSnapshot {
  std::vector<Vec2> line;  ///< in B [m]
  bool pressed = false;    ///< since the reading before the newest
};

/// How a robot looks at one moment.
struct RobotSnapshot {
  std::string name;
  Colour colour;
  Pose X_WB;
  Polygon footprint;                    ///< in B [m]
  std::vector<Vec2> trail;              ///< where it has been, oldest first, in W [m]
  std::vector<Vec2> scan_points;        ///< hits of its newest laser scan in W [m], beam by beam
  Vec2 scan_origin = Vec2::Zero();      ///< where that laser stood, in W [m]
  std::vector<ConeSnapshot> cones;      ///< of all its sonars and infrared rangers
  std::vector<BumperSnapshot> bumpers;  ///< all segments
  std::vector<std::pair<Vec2, Vec2>> sights;  ///< lines from its fiducial finders to what they see,
                                              ///< in W [m]
  std::string says;                           ///< UTF-8; empty: nothing
  std::vector<LightSnapshot> lights;
  std::vector<Polygon> paddles;  ///< of its grippers, in B [m]
  bool stalled = false;
  bool marked = false;  ///< to be told apart from the others, as the one that a user chose
};

}  // namespace sim
