// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace playerlike {

/// Removes what runs write into their output folder (report.json, scene.png, canvas.png,
/// trajectory.csv, the layers' files in layers/, the pictures in snapshots/, those saved from the
/// live window), so that what lies there after the next run is of that run. Other files stay. No
/// folder, nothing to do.
/// @throws std::runtime_error naming the file that can't be removed and the reason.
void remove_results(const std::string& folder);

}  // namespace playerlike
