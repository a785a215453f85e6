// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace playerlike {

/// Removes the results of earlier runs from an output folder (report.json, scene.png, canvas.png,
/// trajectory.csv, the layers' files in layers/, the pictures in snapshots/, and pictures saved
/// from the live window), so that the results there belong to the next run. Other files are kept.
/// Does nothing if the folder does not exist.
/// @throws std::runtime_error naming a file that cannot be removed, and the reason.
void remove_results(const std::string& folder);

}  // namespace playerlike
