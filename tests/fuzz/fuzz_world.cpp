// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// World files: whatever they hold, they are read or refused with words.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "sim/core/error.h"
#include "sim/simulation/simulation.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    static_cast<void>(sim::load_world_text(text, "<memory>"));
  } catch (const sim::ConfigError& e) {
    if (e.issues().empty() || e.issues().front().id.empty()) std::abort();
  }
  return 0;
}
