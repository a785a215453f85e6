// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "playerlike/replay/replay_run.h"

namespace playerlike::replay {

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

/// @name A run that goes on
/// In the same format, for viewers that watch it.
/// @param live  what is not a part of the run, as a JSON object; it becomes "live" of the text.
/// @{

/// A run up to now, see ReplayBuilder::whole().
[[nodiscard]] std::string encoded_whole(const ReplayRun& run, const std::string& live);
/// What is new, see ReplayBuilder::take(). Its text has "part": true, and its run only what grows:
/// motions of all robots; obstacles, devices and layers that have changed, each with its index "i"
/// and without what an earlier part has told of it; lists of what happened. The lists "goals" and
/// "texts" replace the elements from number "goals_from" and "texts_from" on.
[[nodiscard]] std::string encoded_part(const ReplayRun& part, const std::string& live);
/// @}

}  // namespace playerlike::replay
