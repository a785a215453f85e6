// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "playerlike/host/rerun.h"

namespace playpen::diff {

/// A command or a reading that two runs have in different forms.
struct RecordedPair {
  double time_s = 0.0;  ///< of the step before a command, or after which a reading was made
  std::string device;   ///< "r1.laser"
  std::string value;    ///< of a reading: "ranges[341]"; "": whether there is one
  std::string first;    ///< in the first run; "none"
  std::string second;   ///< in the second run
};

/// Where two runs first differ according to their recordings.
struct RecordedDifference {
  std::optional<RecordedPair> command;  ///< first command that differs
  std::optional<RecordedPair> reading;  ///< first reading that differs
};

/// Makes two runs again side by side, until a command and a reading differ or one of them ends.
/// Robots and devices are matched by their names.
/// @param first, second  at their starts.
/// @throws playerlike::RecordingError as Rerun::step().
[[nodiscard]] RecordedDifference recorded_difference(playerlike::Rerun& first,
                                                     playerlike::Rerun& second);

/// The differences as lines of text, each with its line end; "" if there are none.
[[nodiscard]] std::string text_of(const RecordedDifference& difference);

}  // namespace playpen::diff
