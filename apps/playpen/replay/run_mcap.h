// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "playerlike/host/rerun.h"

namespace playpen::replay {

/// Writes the rest of a run to an MCAP file, for Foxglove and PlotJuggler. Makes all steps until
/// the recording ends.
///
/// All times are simulated [ns]. A message's log time is that of the step after which it is
/// written, so that log times never decrease; its publish time is when a reading was measured or an
/// event happened. Topics, with JSON messages and their JSON Schemas:
///
/// - `/ROBOT/true_pose`: true pose, velocity in B, and whether the robot is stalled, each 0.05 s,
///   and at the end; `/ROBOT/true_pose/in_frame`: the pose as foxglove.PoseInFrame, in the frame
///   "world". Most robots have a device named "pose", so this is not `/ROBOT/pose`;
/// - `/ROBOT/DEVICE`: each reading, see playerlike::reading_json(); `/ROBOT/DEVICE/scan`: a laser's
///   scan as foxglove.LaserScan, in the frame "world", with ranges to 0.1 mm;
/// - `/ROBOT/commands`: each command and its device, at the time before the step that executed it;
/// - `/ROBOT/said`: texts that it said;
/// - `/arena/events`, `/arena/collisions`;
/// - `/program/log`: each line that the program printed, as foxglove.Log, to a tenth of a second.
///
/// If a world has such names that two topics are equal, the later ones get the ending "_". The file
/// replaces an earlier one when it is complete. Equal runs give equal bytes.
/// @throws std::runtime_error if the file cannot be written; no file is left then.
/// @throws playerlike::RecordingError as Rerun::step(); no file is left then, either.
void write_mcap(playerlike::Rerun& rerun, const std::string& file);

}  // namespace playpen::replay
