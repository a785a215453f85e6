// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace playerlike {

/// If this process is a prepared one (playerlike/host/prepared_program.h), serves requests for
/// copies of it, and does not return. It returns in each copy, and in all other processes at once.
/// To be called while the program is loaded, before main() and before any thread is started.
/// @return true.
bool serve_if_prepared() noexcept;

}  // namespace playerlike
