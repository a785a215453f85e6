// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/canvas/canvas.h"
#include "sim/canvas/cell_raster.h"
#include "sim/core/colour.h"
#include "sim/world/description.h"

namespace sim {

/// What a cell of a layer holds.
enum class LayerKind : std::uint8_t {
  kColour,  ///< a colour with alpha; at first transparent black
  kBinary,  ///< set or not; drawn in the layer's colour where set; at first not
  kGrey,    ///< occupancy p in 0..1, drawn from white (free) over grey (0.5, unknown) to black
            ///< (occupied), as the grey round(255 (1 - p)); what lies outside 0..1 is taken as the
            ///< nearer end, NaN as 0.5; at first 0.5
};

/// How a layer is drawn over those below it.
struct LayerStyle {
  std::string name = {};
  Colour colour{0, 0, 0, 255};  ///< of a binary layer's cells; of any layer's entry in legends
  double transparency = 0.0;    ///< 0 opaque .. 1 invisible, clamped; a cell's alpha a becomes
                                ///< round(a round(255 (1 - transparency)) / 255)
  std::optional<Colour> transparent_colour = {};  ///< cells drawn in this RGB (whatever the alphas)
                                                  ///< are left out
  int priority = 0;                               ///< higher ones lie above lower ones
  bool visible = true;

  friend bool operator==(const LayerStyle&, const LayerStyle&) = default;
};

/// Names a layer of a stack; never used twice.
using LayerId = int;
/// The canvas that all pens of the simulation share: name "canvas", kind colour, priority 0.
inline constexpr LayerId kBaseLayer = 0;

/// A layer as clients and pictures are told of it.
struct LayerInfo {
  LayerId id = kBaseLayer;
  LayerKind kind = LayerKind::kColour;
  int owner = 0;  ///< number that the maker gave; equal priorities are stacked by owner, then by
                  ///< id; the base layer is below all others of its priority
  LayerStyle style;
};

/// One drawing on a layer, in cells (column, row from the top).
struct DrawOperation {
  enum class Kind : std::uint8_t {
    kPixel,  ///< cell (x0, y0)
    kLine,   ///< Bresenham line from (x0, y0) to (x1, y1)
    kFill,   ///< all cells take the value, without blending
  };
  Kind kind = Kind::kPixel;
  LayerId layer = kBaseLayer;
  int x0 = 0, y0 = 0;
  int x1 = 0, y1 = 0;  ///< line only
  CellValue value;
};

/// How far a list of drawings has been executed, see LayerStack::draw_some().
struct DrawProgress {
  std::size_t operation = 0;  ///< drawings that are done
  int row = 0;                ///< rows of the next one that are done, if it is a fill
};

/// Takes those drawings out of a list that a later fill of the same layer covers: the cells are the
/// same without them.
void drop_covered(std::vector<DrawOperation>& operations);

/// The most cells that a drawing writes on a canvas of that size, at least 1.
[[nodiscard]] std::size_t cells_written(const DrawOperation& operation, int width,
                                        int height) noexcept;

/// The grid-maps of a simulation: the base canvas and the layers that clients put over or under it,
/// all of one size and place.
///
/// Layers lie over one another by source_over (cell_raster.h). Composition is lazy: writing marks
/// tiles of cells as dirty, and composed() recomposes the dirty ones only. Colour cells with alpha
/// below 255 are blended over what the layer holds, as on the Canvas; other kinds are replaced.
/// What lies outside is clipped. Not thread-safe: its owner serialises. Deterministic.
class LayerStack {
 public:
  /// @pre as Canvas.
  explicit LayerStack(const CanvasDescription& description);
  ~LayerStack();
  LayerStack(LayerStack&&) noexcept;
  LayerStack& operator=(LayerStack&&) noexcept;

  [[nodiscard]] int width() const noexcept;
  [[nodiscard]] int height() const noexcept;
  /// Size and place now; only width and height ever change.
  [[nodiscard]] CanvasDescription description() const;

  /// The base layer. What is drawn on it directly is noticed as well. Do not assign to it: its
  /// size is that of all layers.
  [[nodiscard]] Canvas& base() noexcept;
  [[nodiscard]] const Canvas& base() const noexcept;

  /// Makes a layer above those there are of its priority and owner.
  LayerId add(LayerKind kind, LayerStyle style, int owner);
  /// Takes a layer out. @return whether there was one; the base layer cannot be taken out.
  bool remove(LayerId layer);
  [[nodiscard]] bool contains(LayerId layer) const noexcept;
  [[nodiscard]] LayerKind kind(LayerId layer) const;           ///< @pre contains(layer)
  [[nodiscard]] const LayerStyle& style(LayerId layer) const;  ///< @pre contains(layer)
  void set_style(LayerId layer, LayerStyle style);             ///< @pre contains(layer)
  /// All layers in the order in which they are drawn: lowest first.
  [[nodiscard]] std::vector<LayerInfo> layers() const;

  /// Carries drawings out, in order; those on layers that are gone do nothing, and those that a
  /// later fill of the same layer covers are left out.
  void draw(std::span<const DrawOperation> operations);
  /// Carries on with drawings, in order, until a number of cells has been written (cells_written();
  /// a line is not divided, a fill is divided between rows) or all are done.
  /// @param progress  where to go on; moved. Done when it is at the end of the list.
  /// @param cells     >= 1.
  /// @return cells written.
  std::size_t draw_some(std::span<const DrawOperation> operations, DrawProgress& progress,
                        std::size_t cells);
  /// Gives each cell of a rectangle its value from a row-major list, without blending; the part
  /// outside is left out. Nothing happens if the layer is gone.
  /// @pre values.size() == rect.width * rect.height, sides >= 0.
  void set_cells(LayerId layer, const CellRect& rect, std::span<const CellValue> values);
  /// Value of a cell; nullopt outside or if the layer is gone.
  [[nodiscard]] std::optional<CellValue> cell(LayerId layer, int column, int row) const;
  /// All cells of a layer, row-major from the top. @pre contains(layer)
  [[nodiscard]] std::vector<CellValue> cells(LayerId layer) const;
  /// Copies whole rows of a layer's cells: as many as there is room for.
  /// @pre contains(layer), 0 <= row, `to` has room for whole rows and for none beyond the last one.
  void copy_rows(LayerId layer, int row, std::span<CellValue> to) const;

  /// @name For snapshots of a simulation
  /// @{
  /// Writes or reads the base layer's cells; all layers get their size.
  void archive_base(StateArchive& archive);
  /// Writes or reads the other layers, and how all look. When reading, there are none yet, and the
  /// base layer has been read.
  void archive_others(StateArchive& archive);
  /// Takes the cells of another stack's base layer, whose are undefined then.
  /// @pre both have the same size.
  void take_base(LayerStack& from);
  /// Stands in for another stack from now on: its counts go on, and so do the layers' numbers.
  void succeed(const LayerStack& before);
  /// @}

  /// Changes the number of columns and rows of all layers. What is drawn stays where it is in the
  /// world: the bottom left corner stays, cells are added or cut off at the top and the right.
  /// @pre sides in 1..kMaxCanvasSide
  void resize(int width, int height) { static_cast<void>(resize(width, height, {})); }
  /// The same with memory that was prepared before: for each layer and the picture of all, as far
  /// as they reach, 4 * width * height bytes that are 0.
  /// @return memory that is no longer used; to free much of it takes a while.
  std::vector<std::vector<std::uint8_t>> resize(int width, int height,
                                                std::vector<std::vector<std::uint8_t>> zeros);

  /// All visible layers over one another, as RGBA bytes, row-major from the top; where nothing is
  /// drawn transparent black. Recomposes what has changed since the last call.
  [[nodiscard]] const std::vector<std::uint8_t>& composed();
  /// Does a part of what composed() would do, about so many cells of it.
  /// @return whether there is nothing left of it.
  bool compose_some(std::size_t cells);
  /// One layer alone as RGBA bytes, with its own transparency and transparent colour, also if it is
  /// hidden. @pre contains(layer)
  [[nodiscard]] std::vector<std::uint8_t> picture(LayerId layer) const;
  /// Whole rows of that: as many as there is room for. @pre as copy_rows(), four bytes a cell.
  void picture_rows(LayerId layer, int row, std::span<std::uint8_t> to) const;
  /// Count of the picture that composed() gives now: as long as it stays the same, so does the
  /// picture. Who asks for it before or after composed(), with nothing drawn in between, is told
  /// the same. Drawings on hidden layers and cells set to what they are leave it alone.
  [[nodiscard]] std::uint64_t version() const noexcept;
  /// Count of the changes to what layers there are, how they are drawn and how large they are.
  [[nodiscard]] std::uint64_t revision() const noexcept;
  /// A layer's cells as bytes, row-major from the top, four a cell, until the stack is changed.
  /// @pre contains(layer)
  [[nodiscard]] std::span<const std::uint8_t> bytes(LayerId layer) const;
  /// For who keeps a copy of all cells: calls visit(layer, rect) for rectangles that cover all
  /// cells written to since the last call, or since the layer was made.
  void take_written(const std::function<void(LayerId, const CellRect&)>& visit);
  /// Cells that composed() has worked out so far, all calls together: what composition has cost.
  [[nodiscard]] std::uint64_t recomposed_cells() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sim
