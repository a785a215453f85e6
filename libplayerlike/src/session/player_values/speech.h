// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

/// @file
/// Player's interface speech.
namespace playerlike {

/// A text without characters that cannot be said: white space becomes ' ', other control characters
/// and invalid UTF-8 become '?'.
/// @return at most sim::kMaxSpeech bytes.
[[nodiscard]] std::string sayable(std::string_view text);

}  // namespace playerlike
