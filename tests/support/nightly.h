// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <string_view>

/// Tests of one merge and of a nightly run: the same code with other counts. A merge runs the cases
/// that would find a regression. Repetitions, further seeds and further worlds of the same kind run
/// in nightly runs. docs/decisions/nightly.md lists them.
namespace test_support {

/// Whether this is a nightly run: PLAYPEN_NIGHTLY in the environment is neither empty nor "0".
[[nodiscard]] inline bool nightly() {
  const char* text = std::getenv("PLAYPEN_NIGHTLY");
  const std::string_view value = text == nullptr ? "" : text;
  return !value.empty() && value != "0";
}

/// A count, a duration or a set of cases: one for a merge, one for a nightly run.
template <typename Cases>
[[nodiscard]] Cases cases(Cases merge, Cases nightly_run) {
  return nightly() ? nightly_run : merge;
}

/// Why a test is skipped: if (!nightly()) GTEST_SKIP() << kOnlyNightly;
inline constexpr const char* kOnlyNightly = "this test runs in nightly runs only (PLAYPEN_NIGHTLY)";

}  // namespace test_support
