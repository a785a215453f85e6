// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "session/player_values/speech.h"

#include <algorithm>
#include <cstddef>

#include "sim/core/utf8.h"
#include "sim/devices/device.h"

namespace playerlike {

std::string sayable(std::string_view text) {
  std::string said;
  while (!text.empty()) {
    const std::size_t length = sim::utf8_length(text);
    const auto first = static_cast<unsigned char>(text.front());
    const bool printable = length > 1 || (length == 1 && first >= 0x20 && first != 0x7f);
    const bool space = first == '\n' || first == '\t' || first == '\r';
    const std::string_view next = printable ? text.substr(0, length) : space ? " " : "?";
    if (said.size() + next.size() > sim::kMaxSpeech) break;
    said += next;
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return said;
}

}  // namespace playerlike
