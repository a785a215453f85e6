// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace sim {

/// The name under which a file is written before it takes its own: "scene.png" becomes
/// "scene.part.png", so that the ending still tells the kind.
[[nodiscard]] std::string part_name(const std::string& path);

/// Writes a file so that whoever looks finds the former one or the whole new one, and nothing in
/// between: beside it, under part_name(), and then renamed. On failure the former file stays, and
/// nothing else does. What is there and no regular file (a pipe, a device, a link) is written
/// directly.
/// @return 0, or the errno of what failed.
[[nodiscard]] int replace_file(const std::string& path, std::string_view bytes) noexcept;

/// Lets a file written under part_name(path) take its name.
/// @return 0, or the errno of what failed.
[[nodiscard]] int adopt_part(const std::string& path) noexcept;

}  // namespace sim
