// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/view_mode.h"

namespace sim {

std::optional<ViewMode> parse_view_mode(std::string_view text) {
  for (const ViewMode mode : kViewModes) {
    if (text == to_string(mode)) return mode;
  }
  return std::nullopt;
}

std::string_view to_string(ViewMode mode) {
  switch (mode) {
    case ViewMode::kGround:
      return "ground";
    case ViewMode::kMiniMap:
      return "mini-map";
    case ViewMode::kFullScreen:
      break;
  }
  return "full-screen";
}

}  // namespace sim
