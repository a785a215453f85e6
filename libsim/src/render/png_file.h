// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sim::render {

/// Writes what encode_png() has returned.
/// @throws std::runtime_error naming the file and the reason.
void write_png_file(const std::vector<std::uint8_t>& png, const std::string& path);

}  // namespace sim::render
