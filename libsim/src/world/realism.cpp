// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/realism.h"

namespace sim {

std::optional<Realism> parse_realism(std::string_view text) {
  for (const Realism level : kRealismLevels) {
    if (text == to_string(level)) return level;
  }
  return std::nullopt;
}

std::string_view to_string(Realism level) {
  switch (level) {
    case Realism::kIdeal:
      return "ideal";
    case Realism::kCourse:
      return "course";
    case Realism::kReal:
      break;
  }
  return "real";
}

}  // namespace sim
