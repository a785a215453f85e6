// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>

namespace playerlike {

/// Flushes the standard output, unless another thread is printing at this moment: to wait for it
/// could block a run. Thread-safe.
inline void flush_printed() noexcept {
  if (ftrylockfile(stdout) != 0) return;
  fflush_unlocked(stdout);
  funlockfile(stdout);
}

}  // namespace playerlike
