// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace playerlike {

/// Does nothing. Whoever calls it takes debug_types.cpp into a statically linked program.
void keep_debug_types() noexcept;

}  // namespace playerlike
