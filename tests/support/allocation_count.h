// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace playpen::test {

/// How often the program has taken memory with `new`, from its start and in all threads. Needs
/// allocation_count.cpp in the program.
[[nodiscard]] std::size_t allocation_count() noexcept;

}  // namespace playpen::test
