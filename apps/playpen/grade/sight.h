// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "grade/evaluation.h"
#include "grade/trajectory.h"
#include "playerlike/host/report.h"
#include "playerlike/host/task_rules.h"
#include "sim/world/description.h"

/// @file
/// Whether a robot could see what it hit.
namespace playpen::grade {

/// Whether something in the arena besides the robots may have moved or changed before a time.
///
/// True if the world has obstacles that move, or can be pushed or carried; if the report has an
/// event that changed an obstacle by then, or has lost events; or if there are dynamic blocks which
/// the program may have changed without an event.
/// @param until_s  simulated time [s].
[[nodiscard]] bool may_have_changed(const sim::WorldDescription& world,
                                    const playerlike::Report& report, double until_s);

/// Finds out since when a range sensor of a robot showed the place of a contact.
///
/// Rays are those of sim::Simulation, without noise: a copy of the world in which the robots are
/// put where they were at the time of each measurement, at most ten times a simulated second, from
/// the contact backwards. Poses between two rows of the trajectory are interpolated. The sensor
/// shows the place if it is within its field of view and range, if what was hit is as high as the
/// sensor, and if no ray beside the place ends more than 2 cm before it. A sonar's echo must also
/// come from what was hit, anywhere on its surface.
///
/// The robot's lasers count, otherwise its sonars with cones. Of several, the one that showed the
/// place for the longest time counts. The latency of a sensor is not considered.
///
/// @param world    as it was at the start of the run.
/// @param robot    the robot of the contact.
/// @param paths    the trajectories of all robots.
/// @param devices  names or types of the devices that the program may use; nullopt: all.
/// @return nullopt if it is not known: the robot has no such sensor; it hit a robot that has moved
///     before; a robot mirrors a real one; the place is not on the surface of what was hit, as the
///     world describes it; what was hit is a robot with superstructures; or a trajectory is missing
///     or does not reach until the contact.
/// @pre not may_have_changed() until the contact.
/// @note Some milliseconds: up to 600 scans per sensor.
[[nodiscard]] std::optional<Sight> sight_of(
    const sim::WorldDescription& world, std::string_view robot,
    const std::vector<Trajectory>& paths, const Contact& contact,
    const std::optional<std::vector<std::string>>& devices = std::nullopt);

/// A sight in words: "the laser had shown it for 1.2 s, at first 0.31 m ahead".
[[nodiscard]] std::string sight_text(const Sight& sight);

/// A first contact in words, and its sight if it is known: "first hit block_3 at (1.20, 2.05) after
/// 31.4 s; the laser had shown it for 1.2 s, at first 0.31 m ahead".
[[nodiscard]] std::string contact_text(const Contact& contact);

}  // namespace playpen::grade
