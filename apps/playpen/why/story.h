// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "grade/surface.h"
#include "playerlike/host/rerun.h"
#include "sim/core/pose.h"
#include "sim/simulation/arena_event.h"
#include "sim/simulation/simulation.h"
#include "sim/world/robot_model.h"

/// Why a run went as it did: what is observed of a run, and reasons found in it.
namespace playpen::why {

/// A robot after a step.
struct Sample {
  double time_s = 0.0;
  sim::Pose X_WB;
  sim::Twist twist;      ///< achieved in B
  sim::Twist commanded;  ///< target of the motors, within their limits
  bool stalled = false;
};

/// A velocity that the program commanded, before any limit.
struct Told {
  double time_s = 0.0;  ///< of the step before
  sim::Twist twist;
};

/// A read of a client.
struct Read {
  double time_s = 0.0;  ///< of the step before
  double age_s = 0.0;   ///< of the oldest reading that it took
};

/// A scan of a laser, or the ranges of transducers.
struct Scan {
  double time_s = 0.0;  ///< when it was measured
  sim::Pose X_WL;       ///< pose of the laser, or of the robot with the transducers
  double angle_min_rad = 0.0;
  double resolution_rad = 0.0;
  double range_max_m = 0.0;
  std::vector<float> ranges_m;  ///< of each beam or transducer
};

/// Sonars or infrared rangers of a robot.
struct Transducers {
  std::string type;  ///< "sonar" or "infrared"
  std::vector<sim::Pose> X_BS;
  std::vector<double> ranges_max_m;  ///< of each
  double view_rad = 0.0;             ///< full angle of each cone; 0: rays
};

/// What happened to one robot in a run, in the order of time.
struct Story {
  std::string robot;
  sim::RobotModel model;
  /// Name of the sensor of `scans`: its first laser with several beams, otherwise its first sonars,
  /// otherwise its first infrared rangers; "": it has none of these.
  std::string sensor;
  std::optional<Transducers>
      transducers;  ///< of `sensor`; nullopt: it is a laser, or there is none
  std::vector<Sample> samples;
  std::vector<Told> told;
  std::vector<Read> reads;  ///< of all clients
  std::vector<Scan> scans;  ///< of `sensor`
  std::vector<sim::Collision> collisions;
  /// Surface of the partner in the first of them; empty if its place is not on what the world
  /// describes.
  std::vector<grade::SolidSide> surface;
  std::vector<sim::ArenaEvent> events;  ///< that name the robot
  int other_commands = 0;               ///< to its devices, that command no velocity
  bool motors_switched_off = false;     ///< by its last such command
  bool complete = false;                ///< see Rerun::complete()
};

/// Makes a run again and notes what happened to a robot.
/// @param rerun  at its start.
/// @param robot  index in the world; it must exist.
/// @throws playerlike::RecordingError as Rerun::step().
[[nodiscard]] Story story_of(playerlike::Rerun& rerun, int robot);

/// The scene of a run at a time, with trails and collisions, as a picture needs it.
/// @param rerun  at its start; afterwards at that time, or at the end.
/// @throws playerlike::RecordingError as Rerun::step().
[[nodiscard]] sim::SceneSnapshot scene_at(playerlike::Rerun& rerun, double time_s);

/// The newest sample at or before a time; the first if there is none. @pre there are samples.
[[nodiscard]] const Sample& sample_at(const Story& story, double time_s);

}  // namespace playpen::why
