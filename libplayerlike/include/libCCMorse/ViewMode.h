// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace CCMorse {

/// How pictures, films and windows show the grid-map.
enum ViewMode {
  GROUND,       ///< the grid-map is the arena's floor; obstacles and robots are drawn on it
  MINI_MAP,     ///< the grid-map is in a corner of the arena's picture
  FULL_SCREEN,  ///< the grid-map replaces the arena, with sharp cells; robots are drawn on it
};

}  // namespace CCMorse
