// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace playerlike {

/// Tells the user on standard error what a program asks for in vain, where Player's library would
/// say nothing at all. Callers see to it that nothing is told over and over. Threads: any.
void warn(const std::string& text);

}  // namespace playerlike
