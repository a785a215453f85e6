// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace sim {

/// The temporary name of a file while it is written: "scene.png" becomes "scene.part.png", so that
/// the extension still shows the type.
[[nodiscard]] std::string part_file_name(const std::string& path);

/// Replaces a file atomically: readers see either the old content or the complete new content.
/// Writes to part_file_name() in the same folder, then renames. On failure the old file stays and
/// the temporary file is removed. A path that exists and is not a regular file (a pipe, a device, a
/// link) is written directly.
/// @return 0, or the errno of the failed call.
[[nodiscard]] int replace_file(const std::string& path, std::string_view bytes) noexcept;

/// Renames a file that was written as part_file_name(path) to its final name.
/// @return 0, or the errno of the failed call.
[[nodiscard]] int rename_part_file(const std::string& path) noexcept;

}  // namespace sim
