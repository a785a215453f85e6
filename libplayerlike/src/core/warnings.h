// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace playerlike {

/// Prints a warning on standard error about a call without effect, where Player's library would be
/// silent. Callers must not repeat a warning. Threads: any.
void warn(const std::string& text);

}  // namespace playerlike
