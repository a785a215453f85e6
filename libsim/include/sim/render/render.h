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
  int size_px = 1000;  ///< the longer side of the picture, 64..8192; below 200 there is no text
  bool canvas = true;  ///< the grid-map on the floor
  bool trails = true;
  bool scans = true;  ///< laser fans
  bool names = true;
  bool legend = true;  ///< scale bar, world name and simulated time
};

/// Draws a scene: floor, canvas, docks, obstacles, borders, trails, laser fans, robots.
///
/// The W axes point right and up. The arena is as large as margins and footer let it; a very
/// narrow one gets wider margins, so that the footer has room. A robot too small to be seen is
/// marked by a disc of its colour, one that is stalled by a red ring. Laser fans and trails end at
/// the edge of the floor. Coordinates that are not finite or absurdly far away (1e9 pixels) are
/// left out.
/// Deterministic, on the calling thread. Cost: tens of milliseconds at 1000 px, growing with the
/// pixels under laser fans.
/// @throws std::invalid_argument if size_px is out of range, or the canvas has not as many bytes
///     as its description says.
[[nodiscard]] Image draw_scene(const SceneSnapshot& scene, const RenderOptions& options = {});

/// Draws the canvas alone, each cell `scale` pixels a side, transparent cells as white.
/// @throws std::invalid_argument if scale < 1, a side of the picture were over 32768 pixels, or
///     `rgba` has not 4 bytes a cell.
[[nodiscard]] Image draw_canvas(const CanvasDescription& description,
                                const std::vector<std::uint8_t>& rgba, int scale);

/// Writes a PNG; equal pictures give equal bytes. @throws std::runtime_error naming the file and
/// the reason.
void write_png(const Image& image, const std::string& path);

/// Writes a film, frame by frame: ".mp4" (MPEG-4) or ".avi" (Motion JPEG) by the file's ending.
/// It is complete when the writer is destroyed; without a frame no file remains.
class FilmWriter {
 public:
  /// @param frames_per_second  1..1000.
  /// @throws std::runtime_error naming the file and the reason: the file cannot be opened, its
  ///     ending is unknown, or the rate is out of range.
  FilmWriter(const std::string& path, double frames_per_second);
  ~FilmWriter();
  FilmWriter(FilmWriter&&) noexcept;
  FilmWriter& operator=(FilmWriter&&) noexcept;

  /// All frames must have the size of the first (the film's sides are cut to even numbers).
  /// @throws std::runtime_error naming the file and the reason: another size, or no encoder.
  void add(const Image& frame);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sim::render
