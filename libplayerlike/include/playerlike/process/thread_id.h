// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace playerlike {

/// Identifies a thread that drives clients. In lockstep a thread counts as waiting as soon as one
/// of its clients waits, since a thread can wait for one thing only. Each thread of this process
/// has an id; a server makes one for each thread of each remote process. An id is never used twice;
/// 0 means no thread.
using ThreadId = std::uint64_t;

/// Returns an id that has not been used in this process. Thread-safe.
[[nodiscard]] ThreadId new_thread_id() noexcept;
/// Returns the calling thread's id; makes one on the first call.
[[nodiscard]] ThreadId this_thread_id() noexcept;
/// Whether the calling thread has an id, by this_thread_id() or set_this_thread_id().
[[nodiscard]] bool has_thread_id() noexcept;
/// Sets the calling thread's id. Call it before the first this_thread_id().
void set_this_thread_id(ThreadId thread_id) noexcept;

}  // namespace playerlike
