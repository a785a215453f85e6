// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "render/layout.h"
#include "render/painter.h"
#include "sim/simulation/scene_snapshot.h"

/// Painting of the moving parts of an arena.
namespace sim::render {

/// Draw laser fans, sonar cones, infrared rays and trails, which lie on the floor. `cells` are
/// those of the scene's canvas if it is drawn on the floor, otherwise empty. Fans are fainter if
/// more of the canvas is filled. A trail is fainter if more of it lies on coloured cells, which are
/// most likely the program's own drawing of the path.
void draw_fans(const SceneSnapshot& scene, const std::vector<std::uint8_t>& cells,
               const Layout& layout, Painter& painter);
void draw_trails(const SceneSnapshot& scene, const std::vector<std::uint8_t>& cells,
                 const Layout& layout, Painter& painter);

/// Draw what lies above blocks and borders: surfaces that lasers have met, lines to detected
/// fiducials, and robots with their bumpers.
void draw_seen_surfaces(const SceneSnapshot& scene, const Layout& layout, Painter& painter);
void draw_robots(const SceneSnapshot& scene, const Layout& layout, Painter& painter);

/// Which labels to draw next to robots.
struct LabelOptions {
  bool names = true;
  bool scores = true;            ///< once a robot has points
  Rectangle covered;             ///< e.g. a mini-map: robots inside have no label; empty: nothing
  std::vector<Rectangle> taken;  ///< other texts, which labels avoid
};
/// Draws names and scores next to the robots, and what the robots say in bubbles, on top of
/// everything else.
void draw_labels(const SceneSnapshot& scene, const Layout& layout, const LabelOptions& options,
                 Painter& painter);
void draw_speech(const SceneSnapshot& scene, const Layout& layout, const LabelOptions& options,
                 Painter& painter);

/// Draws the marks of collisions and goals above the robots.
void draw_collisions(const SceneSnapshot& scene, const Layout& layout, Painter& painter);
void draw_goals(const SceneSnapshot& scene, const Layout& layout, Painter& painter);

}  // namespace sim::render
