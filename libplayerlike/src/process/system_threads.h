// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>

namespace playerlike {

/// Number of the calling thread for the system.
[[nodiscard]] pid_t this_thread() noexcept;
/// How often a thread of this process has gone to sleep by itself; nullopt unless it sleeps now.
[[nodiscard]] std::optional<std::uint64_t> sleeps_since(pid_t thread);

}  // namespace playerlike
