// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace CCMorse {

/// How pictures, films and windows show the grid-map.
enum ViewMode {
  GROUND,       ///< it lies on the arena's floor; obstacles and robots stand on it
  MINI_MAP,     ///< in a corner of the picture of the arena
  FULL_SCREEN,  ///< instead of the arena, its cells crisp, the robots on it
};

}  // namespace CCMorse
