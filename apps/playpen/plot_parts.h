// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "plot_data.h"
#include "sim/render/drawing.h"
#include "sim/render/render.h"
#include "sim/simulation/scene_snapshot.h"

namespace playpen {

/// Layout of the pages of `playpen plot` and `playpen diff`: charts over time on the left, scenes
/// on the right. All sizes are pixels.
namespace page {
inline constexpr int kPageWidth = 1200;
inline constexpr int kPageHeight = 780;
inline constexpr double kLeft = 62.0;    ///< left edge of the charts
inline constexpr double kRight = 640.0;  ///< right edge of the charts
inline constexpr double kTop = 104.0;
inline constexpr double kBottom = 734.0;
inline constexpr double kTitleGap = 30.0;  ///< space for the title above each chart
inline constexpr double kSceneLeft = 662.0;
inline constexpr double kScenesWidth = 530.0;  ///< for all scenes
inline constexpr double kText = 10.0;          ///< height of a capital letter
inline constexpr double kSmallText = 8.6;
inline constexpr std::size_t kMostEntries = 8;  ///< maximum number of entries in the legend
}  // namespace page

/// A curve in the charts: one robot of one run.
struct Series {
  const Track* track;
  const RunData* data;
  std::size_t run;
  int robot;  ///< index into the run's tracks
  sim::Colour colour;
  std::string name;
};

/// The curves of all robots. Robots keep the colours of their world if these colours are
/// distinguishable. If there are several runs, the names begin with the runs' folders.
[[nodiscard]] std::vector<Series> series_of(const std::vector<RunData>& runs);

/// Short names of runs: the last part of their folders, or more of it where these are equal.
[[nodiscard]] std::vector<std::string> short_names(const std::vector<RunData>& runs);

/// Draws the mark of a collision, as in pictures of scenes.
void add_cross(sim::render::Drawing& page, const sim::Vec2& place);

/// Draws the mark of a reached goal.
void add_diamond(sim::render::Drawing& page, const sim::Vec2& place);

/// The scene of a world with the trajectories of some runs.
/// @param group  indices of the runs; not empty. The arena is that of the first.
[[nodiscard]] sim::SceneSnapshot scene_of(const std::vector<RunData>& runs,
                                          const std::vector<std::size_t>& group,
                                          const std::vector<Series>& all);

/// Names the curves in at most two lines.
void draw_legend(sim::render::Drawing& page, const std::vector<Series>& all);

/// A scene on a page.
struct PlacedScene {
  sim::Vec2 corner;                    ///< top left corner of the picture [pixels]
  sim::Vec2 size;                      ///< of the picture [pixels]
  sim::render::RenderOptions options;  ///< with which it was drawn
};

/// Draws a scene with its title and a key to its marks.
/// @param corner  top left corner of its place [pixels].
/// @param side    longer side of its picture [pixels].
PlacedScene draw_scene(sim::render::Drawing& page, const sim::SceneSnapshot& scene,
                       const std::string& title, bool with_names, const sim::Vec2& corner,
                       double side);

/// Writes a page as SVG if the file's name ends in .svg, otherwise as PNG.
/// @param what  the page, for the message: "plot".
/// @throws std::runtime_error that names the file.
void write_page(const sim::render::Drawing& page, const std::string& file, const char* what);

}  // namespace playpen
