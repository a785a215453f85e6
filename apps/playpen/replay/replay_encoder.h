// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "replay/replay_run.h"

namespace playpen::replay {

/// What is left out to make a replay smaller. Each stride keeps every n-th element.
struct Thinning {
  std::size_t beams = 1;    ///< of lasers
  std::size_t scans = 1;    ///< of range sensors; 0: none are kept
  std::size_t samples = 1;  ///< poses, and the readings of other sensors; the last pose is kept
  bool layers = true;

  /// What is left out, in a sentence; "" if nothing is.
  [[nodiscard]] std::string text() const;
};

/// The steps of thinning, from nothing to everything that can be left out.
[[nodiscard]] const std::vector<Thinning>& thinning_steps();

/// The runs as bytes: the length of a JSON text (4 bytes, little-endian), the JSON text, and the
/// bytes of Columns. viewer/columns.js and viewer/run.js read them. Times are in microseconds,
/// lengths in tenths of a millimetre, angles in hundredths of a degree, if an entry states no unit.
/// Invalid UTF-8 in texts is replaced.
/// @param note  a sentence that the page shows after Thinning::text().
[[nodiscard]] std::string encoded(const std::vector<ReplayRun>& runs, const Thinning& thinning,
                                  const std::string& note = "");

}  // namespace playpen::replay
