// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace playerlike {

/// Who thinks while a client does not wait: in lockstep a thinker waits as soon as one of its
/// clients does, since a thread can only wait for one thing at a time. In this process each thread
/// is one; a server makes one for each thread of each process that its clients tell it of. Never
/// given twice; 0 is nobody.
using ThinkerId = std::uint64_t;

/// A number that no thinker of this process has had. Thread-safe.
[[nodiscard]] ThinkerId new_thinker() noexcept;
/// The calling thread's own.
[[nodiscard]] ThinkerId this_thinker() noexcept;
/// Whether it has one: whether it has asked for it, or was given one.
[[nodiscard]] bool is_thinker() noexcept;
/// Gives the calling thread one that was made for it, before it uses its own.
void set_this_thinker(ThinkerId thinker) noexcept;

}  // namespace playerlike
