// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

namespace playpen {

/// The folder that this program lies in and those above it, as far up as the root of an installed
/// tree or of the source tree that a build folder lies in. What belongs to this program is looked
/// for from there: nothing is compiled in, so that an installed tree can be moved.
[[nodiscard]] std::vector<std::filesystem::path> own_folders();

}  // namespace playpen
