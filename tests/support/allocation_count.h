// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace playpen::test {

/// Number of calls of `new` since the program's start, in all threads. Requires
/// allocation_count.cpp in the program.
[[nodiscard]] std::size_t allocation_count() noexcept;

}  // namespace playpen::test
