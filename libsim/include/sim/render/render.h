// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/simulation/scene_snapshot.h"

namespace sim::render {

/// A picture: RGB bytes, row-major from the top left.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

/// What to draw of a scene.
struct RenderOptions {
  int size_px = 1000;  ///< the longer side of the picture, 64..8192
  bool canvas = true;  ///< the grid-map on the floor
  bool trails = true;
  bool scans = true;  ///< laser fans
  bool names = true;
  bool legend = true;  ///< scale bar, world name and simulated time
};

/// Draws a scene: floor, canvas, docks, obstacles, borders, trails, laser fans, robots.
/// Deterministic. Cost: a few milliseconds at 1000 px.
[[nodiscard]] Image draw_scene(const SceneSnapshot& scene, const RenderOptions& options = {});

/// Draws the canvas alone, each cell `scale` pixels a side, transparent cells as white.
[[nodiscard]] Image draw_canvas(const CanvasDescription& description,
                                const std::vector<std::uint8_t>& rgba, int scale);

/// Writes a PNG. @throws std::runtime_error naming the file and the reason.
void write_png(const Image& image, const std::string& path);

/// Writes a film, frame by frame (MP4 or AVI by the file's ending).
class FilmWriter {
 public:
  /// @throws std::runtime_error if the file cannot be opened or the ending is unknown.
  FilmWriter(const std::string& path, double frames_per_second);
  ~FilmWriter();
  FilmWriter(FilmWriter&&) noexcept;
  FilmWriter& operator=(FilmWriter&&) noexcept;

  /// All frames must have the size of the first (its sides are cut to even numbers).
  void add(const Image& frame);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sim::render
