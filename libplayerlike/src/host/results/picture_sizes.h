// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/render/render.h"

namespace playerlike {

inline constexpr int kSceneSize_px = 1200;       ///< longer side of a run's pictures of the scene
inline constexpr int kCanvasMostSize_px = 1200;  ///< pictures of cells; at least a pixel per cell

/// Returns the options for a run's pictures of the scene from the options of its film.
[[nodiscard]] inline sim::render::RenderOptions scene_options(sim::render::RenderOptions film) {
  film.size_px = kSceneSize_px;
  film.width_px = 0;
  film.height_px = 0;
  return film;
}

}  // namespace playerlike
