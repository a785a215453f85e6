// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/painter.h"
#include "sim/render/render.h"

namespace sim::render {

/// The number of bytes of a canvas's cells; 0 if it has none.
[[nodiscard]] std::size_t canvas_bytes(const CanvasDescription& description);

/// A cached picture of the grid-map over a background. Only pixels of cells that have changed are
/// drawn again.
///
/// Each pixel shows the area-weighted mean of the cells under it. Cells larger than pixels keep
/// crisp edges and equal widths, and lines of cells smaller than pixels do not vanish.
class CanvasView {
 public:
  /// Position of the cells in the picture.
  struct Place {
    int columns = 0;
    int rows = 0;
    double left_px = 0.0;  ///< of the top left cell
    double top_px = 0.0;
    double cell_px = 1.0;
    PixelRect part;  ///< nothing is drawn outside of it or of the picture

    friend bool operator==(const Place&, const Place&) = default;
  };

  /// Must be called if `below` or `above` have changed since the last update.
  void forget() { valid_ = false; }

  /// Updates the picture.
  /// @param cells  RGBA, like SceneSnapshot::canvas; empty: nothing is drawn.
  /// @param below  the background of the cells.
  /// @param above  drawn over both, or null.
  const Image& update(const Place& place, const std::vector<std::uint8_t>& cells,
                      const Image& below, const Overlay* above);

  /// Makes one picture, the same as update()'s, without the copies that would help the next one.
  Image draw_once(const Place& place, const std::vector<std::uint8_t>& cells, Image below,
                  const Overlay* above);

 private:
  // The weights of the cells in each pixel along one axis.
  struct Span {
    int first = 0;
    std::vector<float> weights;  // of the cells first, first + 1, ...; empty: outside the canvas
  };
  // Range of changed columns in one row of cells.
  struct Dirty {
    int begin = 0;
    int end = 0;
  };
  static Span span(double begin, double end, int cells);
  void start(const Place& place);
  [[nodiscard]] bool find_changes(const std::vector<std::uint8_t>& cells);
  void draw_changes(const Image* below, const Overlay* above);
  void mix_line(const Span& row, int x_begin, int x_end);

  bool valid_ = false;
  Place place_;
  Image picture_;
  std::vector<std::uint8_t> cells_;  // as drawn
  std::vector<Span> columns_;        // of the pixels from place_.part.left on
  std::vector<Span> rows_;           // of the pixels from place_.part.top on
  std::vector<int> first_pixel_;     // by column of cells: the first pixel at or after it
  std::vector<int> end_pixel_;       // and one past the last pixel at or before it
  std::vector<Dirty> dirty_;         // by row of cells
  std::vector<std::array<float, 4>> sums_;
  std::vector<Blend> line_;  // of the pixels from place_.part.left on
};

}  // namespace sim::render
