// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "sim/core/colour.h"

namespace sim {

class StateArchive;

/// Content of a grid-map cell in four bytes, for every kind of layer.
struct CellValue {
  std::uint32_t bits = 0;

  [[nodiscard]] static CellValue of(Colour colour) noexcept {
    return {std::bit_cast<std::uint32_t>(colour)};
  }
  [[nodiscard]] static CellValue of(bool set) noexcept { return {set ? 1U : 0U}; }
  [[nodiscard]] static CellValue of(float occupancy) noexcept {
    return {std::bit_cast<std::uint32_t>(occupancy)};
  }
  [[nodiscard]] Colour colour() const noexcept { return std::bit_cast<Colour>(bits); }
  [[nodiscard]] bool set() const noexcept { return bits != 0; }
  [[nodiscard]] float occupancy() const noexcept { return std::bit_cast<float>(bits); }

  friend bool operator==(const CellValue&, const CellValue&) = default;
};

/// A rectangle of cells; columns from the left, rows from the top.
struct CellRect {
  int column = 0;
  int row = 0;
  int width = 0;
  int height = 0;
};

/// Blends `above` over `below`, neither of them premultiplied: source-over of Porter and Duff
/// (Compositing Digital Images, SIGGRAPH 1984, table 1) in integers, so bit-identical on all
/// machines.
///
/// With weights wa = a_above * 255 and wb = a_below * (255 - a_above), alpha = (wa + wb) / 255 and
/// each channel is the weighted mean, both rounded to nearest. A colour with alpha 0 has no effect.
[[nodiscard]] inline Colour source_over(Colour above, Colour below) noexcept {
  if (above.a == 255 || (below.a == 0 && above.a != 0)) return above;
  if (above.a == 0) return below;
  const unsigned weight_above = above.a * 255u;
  const unsigned weight_below = below.a * (255u - above.a);
  const auto mix = [&](unsigned total) {
    const auto channel = [&](unsigned a, unsigned b) {
      return static_cast<std::uint8_t>((a * weight_above + b * weight_below + total / 2) / total);
    };
    return Colour{channel(above.r, below.r), channel(above.g, below.g), channel(above.b, below.b),
                  static_cast<std::uint8_t>((total + 127) / 255)};
  };
  // With an opaque `below` the sum of the weights is a constant, by which compilers divide quickly.
  if (below.a == 255) return mix(255u * 255u);
  return mix(weight_above + weight_below);
}

/// Cells of four bytes in rows, row 0 at the top: the storage of the canvas and of every layer.
///
/// Tracks changes per tile (kTileSide x kTileSide cells), at the cost of one byte stored with each
/// written cell. A tile without kUsed holds only blank cells. Drawings are clipped. Not
/// thread-safe; the owner must serialise access.
class CellRaster {
 public:
  static constexpr int kTileShift = 4;
  static constexpr int kTileSide = 1 << kTileShift;
  /// Flags of a tile.
  static constexpr std::uint8_t kChanged = 1;   ///< written since clear_changed()
  static constexpr std::uint8_t kUsed = 2;      ///< may hold cells that are not blank
  static constexpr std::uint8_t kUnsaved = 4;   ///< written since clear_unsaved()
  static constexpr std::uint8_t kUncopied = 8;  ///< to be copied by copy_some()

  /// @param blank  initial value of all cells, and of those that resize() adds.
  /// @pre sides >= 1.
  CellRaster(int width, int height, CellValue blank);

  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }
  [[nodiscard]] CellValue blank() const noexcept { return blank_; }
  [[nodiscard]] bool contains(int column, int row) const noexcept {
    return column >= 0 && row >= 0 && column < width_ && row < height_;
  }
  /// @pre contains(column, row)
  [[nodiscard]] CellValue at(int column, int row) const noexcept {
    CellValue value;
    std::memcpy(&value, row_bytes(row) + byte_offset(column), sizeof value);
    return value;
  }
  /// Cells as bytes, row-major from the top, four per cell.
  [[nodiscard]] const std::vector<std::uint8_t>& data() const noexcept { return data_; }
  /// The first byte of a row. @pre 0 <= row < height()
  [[nodiscard]] const std::uint8_t* row_bytes(int row) const noexcept {
    return data_.data() + static_cast<std::size_t>(row) * byte_offset(width_);
  }

  /// Writes single cells of a raster. Loops over many cells use one object, so that what each write
  /// needs is not loaded again. Valid as long as the raster keeps its size.
  class Writer {
   public:
    explicit Writer(CellRaster& raster) noexcept
        : width_(static_cast<unsigned>(raster.width_)),
          height_(static_cast<unsigned>(raster.height_)),
          tile_stride_(raster.tile_stride_),
          data_(raster.data_.data()),
          tiles_(raster.tiles_.data()) {}

    /// See CellRaster::put().
    void put(int column, int row, CellValue value) const noexcept {
      if (contains(column, row)) write(column, row, value);
    }
    /// See CellRaster::blend().
    void blend(int column, int row, Colour colour) const noexcept {
      if (!contains(column, row) || colour.a == 0) return;
      if (colour.a != 255) {
        CellValue below;
        std::memcpy(&below, cell(column, row), sizeof below);
        colour = source_over(colour, below.colour());
      }
      write(column, row, CellValue::of(colour));
    }

   private:
    [[nodiscard]] bool contains(int column, int row) const noexcept {
      return static_cast<unsigned>(column) < width_ && static_cast<unsigned>(row) < height_;
    }
    [[nodiscard]] std::uint8_t* cell(int column, int row) const noexcept {
      return data_ + (static_cast<std::size_t>(row) * width_ + static_cast<std::size_t>(column)) *
                         sizeof(CellValue);
    }
    void write(int column, int row, CellValue value) const noexcept {
      std::memcpy(cell(column, row), &value, sizeof value);
      tiles_[(static_cast<std::size_t>(row) >> kTileShift) * tile_stride_ +
             (static_cast<std::size_t>(column) >> kTileShift)] = kWritten;
    }

    unsigned width_;
    unsigned height_;
    std::size_t tile_stride_;
    std::uint8_t* data_;
    std::uint8_t* tiles_;
  };

  /// Sets a cell; does nothing outside the raster.
  void put(int column, int row, CellValue value) noexcept { Writer(*this).put(column, row, value); }
  /// Blends a colour over the cell's content (source_over); does nothing outside the raster.
  void blend(int column, int row, Colour colour) noexcept {
    Writer(*this).blend(column, row, colour);
  }
  /// put() along a line, see Canvas::draw_line.
  void put_line(int column0, int row0, int column1, int row1, CellValue value) noexcept;
  /// blend() along a line, see Canvas::draw_line.
  void blend_line(int column0, int row0, int column1, int row1, Colour colour) noexcept;
  /// Sets every cell to that value.
  void fill(CellValue value) noexcept { fill_rows(0, height_, value); }
  /// Sets every cell of the rows from `begin` to before `end` to that value.
  /// @pre 0 <= begin <= end <= height()
  void fill_rows(int begin, int end, CellValue value) noexcept;
  /// Sets the cells of a rectangle from a row-major list; the part outside the raster is ignored.
  /// Tiles in which no cell changes are not marked.
  /// @pre values.size() == rect.width * rect.height, sides >= 0.
  void set_cells(const CellRect& rect, std::span<const CellValue> values) noexcept;

  /// @name A copy that is made in pieces, while this raster is in use
  /// @{

  /// Begins a copy; an earlier one that is not complete is abandoned.
  void begin_copy() noexcept;
  /// Continues the copy with about `cells` cells: those that are not blank, and those that were
  /// written after they had been copied. The bottom left cells of both rasters correspond; cells
  /// that `to` has no room for are left out.
  /// @param to    blank when the copy began, of any size, with the same blank value.
  /// @param tile  where the search for cells to copy begins; advanced by this call.
  /// @return number of cells copied; less than `cells` if the end of the raster was reached.
  std::size_t copy_some(CellRaster& to, std::size_t& tile, std::size_t cells);
  /// Whether the copy is complete.
  [[nodiscard]] bool copied() const noexcept;
  /// Marks every tile as changed and unsaved.
  void mark_all() noexcept;
  /// @}

  [[nodiscard]] int tile_columns() const noexcept { return tiles_across(width_); }
  [[nodiscard]] int tile_rows() const noexcept { return tiles_across(height_); }
  /// The flags of each tile, row-major from the top; tile_columns() x
  /// tile_rows().
  [[nodiscard]] const std::vector<std::uint8_t>& tiles() const noexcept { return tiles_; }
  /// Clears kChanged of all tiles.
  void clear_changed() noexcept;
  /// Clears kUnsaved of all tiles.
  void clear_unsaved() noexcept;

  /// Writes or reads size and cells; a blank tile takes one byte. Cells that were read count as
  /// written.
  void archive(StateArchive& archive);
  /// About the number of bytes that archive() writes.
  [[nodiscard]] std::size_t archived_bytes() const noexcept;

  /// Number of tiles that cover this many cells.
  [[nodiscard]] static int tiles_across(int cells) noexcept {
    return (cells + kTileSide - 1) >> kTileShift;
  }

 private:
  static constexpr std::uint8_t kWritten = kChanged | kUsed | kUnsaved | kUncopied;

  [[nodiscard]] static std::size_t byte_offset(int cells) noexcept {
    return static_cast<std::size_t>(cells) * sizeof(CellValue);
  }
  void write(int column, int row, CellValue value) noexcept {
    const auto c = static_cast<std::size_t>(column);
    const auto r = static_cast<std::size_t>(row);
    std::memcpy(data_.data() + (r * static_cast<std::size_t>(width_) + c) * sizeof value, &value,
                sizeof value);
    tiles_[(r >> kTileShift) * tile_stride_ + (c >> kTileShift)] = kWritten;
  }

  void copy_tile(CellRaster& to, int column, int row) const;
  void clear_rows(int begin, int end) noexcept;

  int width_;
  int height_;
  CellValue blank_;
  std::size_t tile_stride_;
  std::vector<std::uint8_t> data_;
  std::vector<std::uint8_t> tiles_;
};

}  // namespace sim
