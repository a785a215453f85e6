// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/canvas/cell_raster.h"

#include <algorithm>

#include "canvas/line.h"
#include "sim/core/assert.h"
#include "sim/core/state_archive.h"
#include "sim/world/description.h"

namespace sim {
namespace {

void fill_cells(std::uint8_t* to, std::size_t count, CellValue value) noexcept {
  for (std::size_t i = 0; i < count; ++i) std::memcpy(to + i * sizeof value, &value, sizeof value);
}

}  // namespace

CellRaster::CellRaster(int width, int height, CellValue blank)
    : width_(width), height_(height), blank_(blank) {
  SIM_ASSERT(width >= 1 && height >= 1);
  tile_stride_ = static_cast<std::size_t>(tile_columns());
  data_.resize(byte_offset(width_) * static_cast<std::size_t>(height_));
  fill_cells(data_.data(), data_.size() / sizeof blank_, blank_);
  tiles_.assign(tile_stride_ * static_cast<std::size_t>(tile_rows()), 0);
}

void CellRaster::put_line(int column0, int row0, int column1, int row1, CellValue value) noexcept {
  visit_line(width_, height_, column0, row0, column1, row1,
             [&](int column, int row) { write(column, row, value); });
}

void CellRaster::blend_line(int column0, int row0, int column1, int row1, Colour colour) noexcept {
  if (colour.a == 255) {
    put_line(column0, row0, column1, row1, CellValue::of(colour));
  } else if (colour.a != 0) {
    visit_line(width_, height_, column0, row0, column1, row1, [&](int column, int row) {
      write(column, row, CellValue::of(source_over(colour, at(column, row).colour())));
    });
  }
}

void CellRaster::fill_rows(int begin, int end, CellValue value) noexcept {
  SIM_ASSERT(begin >= 0 && begin <= end && end <= height_);
  if (begin == end) return;
  const auto offset = static_cast<std::size_t>(begin) * byte_offset(width_);
  const auto count = static_cast<std::size_t>(end - begin) * static_cast<std::size_t>(width_);
  fill_cells(data_.data() + offset, count, value);
  // A tile keeps its mark until all its rows have been filled, which may take several calls.
  const auto marks = [&](int row) {
    return tiles_.begin() +
           static_cast<std::ptrdiff_t>(row) * static_cast<std::ptrdiff_t>(tile_stride_);
  };
  const auto first = marks(begin >> kTileShift);
  const auto last = marks(tiles_across(end));
  if (value != blank_) {
    std::fill(first, last, kWritten);
    return;
  }
  for (int row = begin >> kTileShift; row < tiles_across(end); ++row) {
    const int bottom = std::min((row + 1) << kTileShift, height_);
    const bool whole = (row << kTileShift) >= begin && bottom <= end;
    for (auto tile = marks(row); tile != marks(row + 1); ++tile) {
      // Tiles that were blank before stay unmarked.
      if ((*tile & (kChanged | kUsed)) != 0) *tile = whole ? kChanged | kUnsaved : kWritten;
    }
  }
}

void CellRaster::set_cells(const CellRect& rect, std::span<const CellValue> values) noexcept {
  using std::int64_t;
  SIM_ASSERT(rect.width >= 0 && rect.height >= 0);
  SIM_ASSERT(values.size() ==
             static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(rect.height));
  const auto left = static_cast<int>(std::clamp<int64_t>(rect.column, 0, width_));
  const auto top = static_cast<int>(std::clamp<int64_t>(rect.row, 0, height_));
  const auto right =
      static_cast<int>(std::clamp<int64_t>(int64_t{rect.column} + rect.width, 0, width_));
  const auto bottom =
      static_cast<int>(std::clamp<int64_t>(int64_t{rect.row} + rect.height, 0, height_));
  if (left >= right) return;  // the rectangle is outside
  for (int row = top; row < bottom; ++row) {
    const CellValue* from =
        values.data() + (int64_t{row} - rect.row) * rect.width + (int64_t{left} - rect.column);
    std::uint8_t* const to = data_.data() + static_cast<std::size_t>(row) * byte_offset(width_);
    std::uint8_t* const tiles =
        tiles_.data() + static_cast<std::size_t>(row >> kTileShift) * tile_stride_;
    // For each tile: the part of the row that lies in it.
    for (int column = left; column < right;) {
      const int tile = column >> kTileShift;
      const int end = std::min(right, (tile + 1) << kTileShift);
      const std::size_t size = byte_offset(end - column);
      if (std::memcmp(to + byte_offset(column), from, size) != 0) {
        std::memcpy(to + byte_offset(column), from, size);
        tiles[tile] = kWritten;
      }
      from += end - column;
      column = end;
    }
  }
}

std::vector<std::uint8_t> CellRaster::resize(int width, int height,
                                             std::vector<std::uint8_t> zeros) {
  SIM_ASSERT(width >= 1 && height >= 1);
  const std::size_t size = byte_offset(width) * static_cast<std::size_t>(height);
  if (zeros.size() != size) zeros.assign(size, 0);
  if (blank_ != CellValue{}) fill_cells(zeros.data(), size / sizeof blank_, blank_);
  const int columns = std::min(width, width_);
  const int rows = std::min(height, height_);
  const bool used = std::any_of(tiles_.begin(), tiles_.end(),
                                [](std::uint8_t tile) { return (tile & kUsed) != 0; });
  const auto stride = static_cast<std::size_t>(tiles_across(width));
  std::vector<std::uint8_t> tiles(stride * static_cast<std::size_t>(tiles_across(height)),
                                  kChanged | kUnsaved);
  for (int i = 1; i <= rows && used; ++i) {
    const int row = height - i;
    std::uint8_t* const to = zeros.data() + static_cast<std::size_t>(row) * byte_offset(width);
    std::memcpy(to, row_bytes(height_ - i), byte_offset(columns));
    std::uint8_t* const marks = tiles.data() + static_cast<std::size_t>(row >> kTileShift) * stride;
    for (int column = 0; column < columns; ++column) {
      CellValue value;
      std::memcpy(&value, to + byte_offset(column), sizeof value);
      if (value != blank_) marks[column >> kTileShift] = kWritten;
    }
  }
  data_.swap(zeros);
  tiles_.swap(tiles);
  width_ = width;
  height_ = height;
  tile_stride_ = stride;
  return zeros;
}

void CellRaster::archive(StateArchive& archive) {
  int width = width_;
  int height = height_;
  archive.index(width, kMaxCanvasSide + 1, 1);
  archive.index(height, kMaxCanvasSide + 1, 1);
  const auto tiles = static_cast<std::size_t>(tiles_across(width)) *
                     static_cast<std::size_t>(tiles_across(height));
  archive.expect(tiles <= archive.left(), "a flag for each tile");
  if (archive.reading()) {
    *this = CellRaster(width, height, blank_);
    std::fill(tiles_.begin(), tiles_.end(), kChanged | kUnsaved);
  }
  for (std::size_t tile = 0; tile < tiles; ++tile) {
    const auto left = static_cast<int>(tile % tile_stride_) << kTileShift;
    const auto top = static_cast<int>(tile / tile_stride_) << kTileShift;
    const int bottom = std::min(top + kTileSide, height_);
    const int right = std::min(left + kTileSide, width_);
    bool used = (tiles_[tile] & kUsed) != 0;
    archive(used);
    if (!used) continue;
    if (archive.reading()) tiles_[tile] = kWritten;
    for (int row = top; row < bottom; ++row) {
      const auto offset = static_cast<std::size_t>(row) * byte_offset(width_) + byte_offset(left);
      archive.raw(data_.data() + offset, byte_offset(right - left));
    }
  }
}

void CellRaster::clear_changed() noexcept {
  for (std::uint8_t& tile : tiles_) tile &= static_cast<std::uint8_t>(~kChanged);
}

void CellRaster::clear_unsaved() noexcept {
  for (std::uint8_t& tile : tiles_) tile &= static_cast<std::uint8_t>(~kUnsaved);
}

}  // namespace sim
