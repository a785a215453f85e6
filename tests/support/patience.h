// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdlib>

namespace test_support {

/// How long a test waits for an expected event. It only ends tests that hang: on a loaded machine
/// every event occurs, only later. ctest's own limit is longer, so that the test can still print
/// what it waited for. PLAYPEN_TEST_PATIENCE_S in the environment sets another limit [s].
[[nodiscard]] inline std::chrono::seconds patience() {
  const char* text = std::getenv("PLAYPEN_TEST_PATIENCE_S");
  const long seconds = text == nullptr ? 0 : std::strtol(text, nullptr, 10);
  return std::chrono::seconds(seconds > 0 ? seconds : 900);
}

}  // namespace test_support
