// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

namespace playpen {

/// The folder of this program and its parents, up to the root of an installed tree or of the source
/// tree that contains the build folder. The program finds its files from there: no path is compiled
/// in, so an installed tree can be moved.
[[nodiscard]] std::vector<std::filesystem::path> own_folders();

}  // namespace playpen
