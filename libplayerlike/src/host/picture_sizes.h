// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace playerlike {

inline constexpr int kFilmSize_px = 800;         ///< longer side of a film
inline constexpr int kSceneSize_px = 1200;       ///< longer side of a run's pictures of the scene
inline constexpr int kCanvasMostSize_px = 1200;  ///< pictures of cells; at least a pixel per cell

}  // namespace playerlike
