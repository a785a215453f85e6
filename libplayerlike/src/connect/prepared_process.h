// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace playerlike {

/// If this process is a prepared one (playerlike/host/prepared_program.h), serves requests for
/// copies of it, and does not return. It returns in each copy, and in all other processes at once.
/// Called while the program is loaded, before main(), virtual time and any thread begin. Whoever
/// opens sessions refers to it, so that a statically linked program has it, too.
/// @return true.
bool serve_if_prepared() noexcept;

}  // namespace playerlike
