// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/core/colour.h"
#include "sim/core/pose.h"
#include "sim/navigation/particles.h"
#include "sim/world/description.h"

namespace sim {

/// A light on a robot.
struct LightSnapshot {
  Vec2 p_BL = Vec2::Zero();  ///< position in B [m]
  Colour colour;
  bool lit = false;
};

/// The last measurement of a sonar or infrared transducer.
struct ConeSnapshot {
  Pose X_WS;                       ///< pose of the transducer, which looks along its x axis
  double range_m = 0.0;            ///< [m]
  double field_of_view_rad = 0.0;  ///< full angle; 0: a ray
  bool met = false;                ///< whether anything was met; if not, the range is the maximum
};

/// A segment of a bumper.
struct BumperSnapshot {
  std::vector<Vec2> line;  ///< in B [m]
  bool pressed = false;    ///< at any time since the reading before the newest
};

/// Appearance of a robot at one moment.
struct RobotSnapshot {
  std::string name;
  Colour colour;
  Pose X_WB;
  Polygon footprint;                     ///< in B [m]
  std::vector<Polygon> parts;            ///< as RobotModel::parts, in B [m]
  std::vector<Polygon> superstructures;  ///< outlines of what is higher than its body, in B [m]
  std::vector<Vec2> trail;               ///< its path, oldest point first, in W [m]
  std::vector<Vec2> scan_points;         ///< hits of its newest laser scan in W [m], beam by beam
  Vec2 scan_origin = Vec2::Zero();       ///< position of that laser, in W [m]
  std::vector<ConeSnapshot> cones;       ///< of all its sonar and infrared transducers
  std::vector<BumperSnapshot> bumpers;   ///< all segments
  std::vector<std::pair<Vec2, Vec2>> sights;  ///< lines from its fiducial finders to the detected
                                              ///< marks, in W [m]
  std::string says;                           ///< UTF-8; empty: nothing
  std::vector<LightSnapshot> lights;
  std::vector<Polygon> paddles;         ///< of its grippers, in B [m]
  std::vector<std::vector<Vec2>> arms;  ///< of its arms, seen from above: the base, then the end of
                                        ///< each joint's link, in B [m]
  std::vector<Pose> particles;          ///< of its localisation (amcl), in W
  std::vector<PoseHypothesis> hypotheses;  ///< of its localisation (amcl), in W
  bool stalled = false;
  bool marked = false;  ///< highlighted, e.g. because the user selected it
};

}  // namespace sim
