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

/// Content of a layer's cells.
enum class LayerKind : std::uint8_t {
  kColour,  ///< a colour with alpha; initially transparent black
  kBinary,  ///< set or not, drawn in the layer's colour where set; initially not set
  kGrey,    ///< occupancy p in 0..1, drawn as the grey round(255 (1 - p)): white (free), grey (0.5,
            ///< unknown), black (occupied); values outside 0..1 are clamped, NaN is drawn as 0.5;
            ///< initially 0.5
};

/// How a layer is drawn over those below it.
struct LayerStyle {
  std::string name = {};
  Colour colour{0, 0, 0, 255};  ///< of a binary layer's set cells; of a layer's legend entry
  double transparency = 0.0;    ///< 0 (opaque) to 1 (invisible), clamped; a cell's alpha a becomes
                                ///< round(a round(255 (1 - transparency)) / 255)
  std::optional<Colour> transparent_colour = {};  ///< cells with this RGB (whatever the alpha) are
                                                  ///< not drawn
  int priority = 0;                               ///< higher priorities lie above lower ones
  bool visible = true;

  friend bool operator==(const LayerStyle&, const LayerStyle&) = default;
};

/// Identifies a layer of a stack; never reused.
using LayerId = int;
/// The canvas that all pens of the simulation share: name "canvas", kind colour, priority 0.
inline constexpr LayerId kBaseLayer = 0;

/// A layer as clients and pictures see it.
struct LayerInfo {
  LayerId id = kBaseLayer;
  LayerKind kind = LayerKind::kColour;
  int owner = 0;  ///< number that its creator passed; layers of equal priority are ordered by
                  ///< owner, then by id; the base layer is below all others of its priority
  LayerStyle style;
};

/// One drawing on a layer, in cells (column, row from the top).
struct DrawOperation {
  enum class Kind : std::uint8_t {
    kPixel,  ///< cell (x0, y0)
    kLine,   ///< Bresenham line from (x0, y0) to (x1, y1)
    kFill,   ///< all cells take the value without blending
  };
  Kind kind = Kind::kPixel;
  LayerId layer = kBaseLayer;
  int x0 = 0, y0 = 0;
  int x1 = 0, y1 = 0;  ///< line only
  CellValue value;
};

/// Progress in a list of drawings, see LayerStack::draw_some().
struct DrawProgress {
  std::size_t operation = 0;  ///< number of finished drawings
  int row = 0;                ///< finished rows of the next drawing if it is a fill
};

/// Removes drawings that a later fill of the same layer covers, since they do not affect the
/// result.
void drop_covered(std::vector<DrawOperation>& operations);

/// Maximum number of cells that a drawing writes on a canvas of that size, at least 1.
[[nodiscard]] std::size_t cells_written(const DrawOperation& operation, int width,
                                        int height) noexcept;

class LayerStack;

/// A copy of all layers of a LayerStack that is made in pieces, between which the stack may change;
/// see LayerStack::copy_some(). Memory is allocated and freed by calls that need no access to the
/// stack.
class LayerCopy {
 public:
  /// A copy of the stack as it is.
  LayerCopy();
  /// A copy of another size, for LayerStack::resize(). @pre sides in 1..kMaxCanvasSide
  LayerCopy(int width, int height);
  ~LayerCopy();
  LayerCopy(LayerCopy&&) noexcept;
  LayerCopy& operator=(LayerCopy&&) noexcept;

  /// Allocates the memory that copy_some() has asked for.
  void allocate();
  /// The copied layers as a stack of their own. @pre the copy is complete.
  [[nodiscard]] LayerStack take();

 private:
  friend class LayerStack;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The grid-maps of a simulation: the base canvas and the layers that clients put above or below
/// it, all with the same size and position.
///
/// Layers are composed by source_over (cell_raster.h). Composition is lazy: writing marks tiles of
/// cells as dirty, and composed() recomposes only dirty tiles. Colour cells with alpha below 255
/// are blended over the old content, as on the Canvas; cells of other kinds are replaced. Drawings
/// are clipped. Not thread-safe; the owner must serialise access. Deterministic.
class LayerStack {
 public:
  /// @pre as for Canvas.
  explicit LayerStack(const CanvasDescription& description);
  ~LayerStack();
  LayerStack(LayerStack&&) noexcept;
  LayerStack& operator=(LayerStack&&) noexcept;

  [[nodiscard]] int width() const noexcept;
  [[nodiscard]] int height() const noexcept;
  /// Number of cells of a layer.
  [[nodiscard]] std::size_t cell_count() const noexcept {
    return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  }
  /// Current size and position; only width and height ever change.
  [[nodiscard]] CanvasDescription description() const;

  /// The base layer. Direct drawings on it are noticed as well. Do not assign to it, because all
  /// layers must have the same size.
  [[nodiscard]] Canvas& base() noexcept;
  [[nodiscard]] const Canvas& base() const noexcept;

  /// Creates a layer above the existing ones of the same priority and owner.
  /// @param cells  its cells if they are of the right size, so that no memory is allocated; see
  ///     blank_cells().
  LayerId add(LayerKind kind, LayerStyle style, int owner,
              std::unique_ptr<CellRaster> cells = nullptr);
  /// Blank cells for a new layer. @pre sides >= 1
  [[nodiscard]] static std::unique_ptr<CellRaster> blank_cells(LayerKind kind, int width,
                                                               int height);
  /// Removes a layer. The base layer cannot be removed.
  /// @return its cells, whose memory may take a while to free; null if there was no such layer.
  std::unique_ptr<CellRaster> remove(LayerId layer);
  [[nodiscard]] bool contains(LayerId layer) const noexcept;
  [[nodiscard]] LayerKind kind(LayerId layer) const;           ///< @pre contains(layer)
  [[nodiscard]] const LayerStyle& style(LayerId layer) const;  ///< @pre contains(layer)
  void set_style(LayerId layer, LayerStyle style);             ///< @pre contains(layer)
  /// All layers in drawing order, lowest first.
  [[nodiscard]] std::vector<LayerInfo> layers() const;

  /// Executes drawings in order. Drawings on removed layers have no effect. From the first fill on,
  /// those that a later fill of the same layer covers are skipped.
  void draw(std::span<const DrawOperation> operations);
  /// Continues drawings in order, until this many cells have been written (cells_written()) or all
  /// drawings are finished. Lines are not divided; fills are divided between rows.
  /// @param progress  where to continue; advanced by this call. All is done when it is at the end
  ///     of the list.
  /// @param cells     >= 1.
  /// @return number of cells written.
  std::size_t draw_some(std::span<const DrawOperation> operations, DrawProgress& progress,
                        std::size_t cells);
  /// Sets the cells of a rectangle from a row-major list, without blending. The part outside is
  /// ignored. Does nothing if the layer does not exist.
  /// @pre values.size() == rect.width * rect.height, sides >= 0.
  void set_cells(LayerId layer, const CellRect& rect, std::span<const CellValue> values);
  /// Value of a cell; nullopt outside, or if the layer does not exist.
  [[nodiscard]] std::optional<CellValue> cell(LayerId layer, int column, int row) const;
  /// All cells of a layer, row-major from the top. @pre contains(layer)
  [[nodiscard]] std::vector<CellValue> cells(LayerId layer) const;
  /// Copies whole rows of a layer's cells, as many as fit into `to`.
  /// @pre contains(layer), 0 <= row, `to` has room for whole rows and for none beyond the last one.
  void copy_rows(LayerId layer, int row, std::span<CellValue> to) const;

  /// @name For snapshots of a simulation
  /// @{
  /// Writes or reads the base layer's cells. Reading gives all layers its size.
  void archive_base(StateArchive& archive);
  /// Writes or reads the other layers and the styles of all layers. When reading, no other layers
  /// may exist, and the base layer must have been read before.
  void archive_others(StateArchive& archive);
  /// About the number of bytes that archive_base() writes, or both functions together.
  [[nodiscard]] std::size_t archived_bytes(bool others) const;
  /// Moves the cells of another stack's base layer into this one. The cells of the other are
  /// undefined afterwards.
  /// @pre both have the same size.
  void take_base(LayerStack& from);
  /// Continues the counters (version, revision) and the layer ids of a stack that this one
  /// replaces.
  void take_over_from(const LayerStack& before);
  /// @}

  /// State of a copy.
  enum class CopyState {
    kNeedsMemory,  ///< call LayerCopy::allocate() next
    kUnfinished,
    kComplete,  ///< the copy equals the stack at this moment
  };
  /// Continues a copy by about `cells` cells. Cells that change after they were copied are copied
  /// again. A change of the set of layers or of their size begins the copy anew, and so does
  /// another copy of this stack that was begun since.
  /// @param cells  >= 1.
  CopyState copy_some(LayerCopy& copy, std::size_t cells);

  /// Changes the number of columns and rows of all layers. Drawings keep their position in the
  /// world: the bottom left corner stays, cells are added or cut off at the top and the right.
  /// @pre sides in 1..kMaxCanvasSide
  void resize(int width, int height);
  /// Gives the layers the size and the memory of a copy. The copy then has the memory that is no
  /// longer used, so that it can be freed later.
  /// @pre the copy is complete, and this stack has not changed since.
  void resize(LayerCopy& copy);

  /// All visible layers composed, as RGBA bytes, row-major from the top; transparent black where
  /// nothing is drawn. Recomposes what has changed since the last call.
  [[nodiscard]] const std::vector<std::uint8_t>& composed();
  /// Like composed(), but the caller gets the memory, and the next picture is composed as a whole.
  [[nodiscard]] std::vector<std::uint8_t> take_composed();
  /// Whole rows of the picture of composed(), as many as fit; composes only the tiles in these
  /// rows.
  /// @pre 0 <= row, `to` has room for whole rows, and for none beyond the last one.
  void composed_rows(int row, std::span<std::uint8_t> to);
  /// One layer alone as RGBA bytes, with its own transparency and transparent colour, even if it is
  /// hidden. @pre contains(layer)
  [[nodiscard]] std::vector<std::uint8_t> picture(LayerId layer) const;
  /// Whole rows of picture(), as many as fit. @pre as for copy_rows(), four bytes per cell.
  void picture_rows(LayerId layer, int row, std::span<std::uint8_t> to) const;
  /// Version number of the picture that composed() returns: the picture does not change while the
  /// number stays the same. Calls before and after composed() return the same number if nothing was
  /// drawn in between. Drawings on hidden layers, and writes that do not change a cell's value, do
  /// not change it.
  [[nodiscard]] std::uint64_t version() const noexcept;
  /// Counts the changes to the set of layers, their styles and their size.
  [[nodiscard]] std::uint64_t revision() const noexcept;
  /// A layer's cells as bytes, row-major from the top, four per cell; valid until the stack
  /// changes.
  /// @pre contains(layer)
  [[nodiscard]] std::span<const std::uint8_t> bytes(LayerId layer) const;
  /// For callers that keep a copy of all cells: calls visit(layer, rect) for rectangles that cover
  /// all cells written since the last call, or since the layer was created.
  void take_written(const std::function<void(LayerId, const CellRect&)>& visit);
  /// Total number of cells that composed() has computed so far: the cost of composition.
  [[nodiscard]] std::uint64_t recomposed_cells() const noexcept;

 private:
  friend class LayerCopy;
  struct Impl;
  /// @param stop_at_fill  end before the first fill.
  std::size_t draw_some(std::span<const DrawOperation> operations, DrawProgress& progress,
                        std::size_t cells, bool stop_at_fill);

  std::unique_ptr<Impl> impl_;
};

}  // namespace sim
