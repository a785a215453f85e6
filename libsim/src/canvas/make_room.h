// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace sim {

/// Resizes a buffer for a C library, through which no exception may pass.
/// @return false if there is no memory.
[[nodiscard]] inline bool make_room(std::vector<std::uint8_t>& samples, std::size_t size) {
  try {
    samples.resize(size);
    return true;
  } catch (const std::bad_alloc&) {
    return false;
  }
}

}  // namespace sim
