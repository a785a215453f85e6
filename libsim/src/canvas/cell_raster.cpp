// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/canvas/cell_raster.h"

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

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

/// Whether one of the cells has another value.
bool any_other(const std::uint8_t* cells, int count, CellValue value) noexcept {
  unsigned other = 0;
  for (int i = 0; i < count; ++i) {
    CellValue cell;
    std::memcpy(&cell, cells + static_cast<std::size_t>(i) * sizeof cell, sizeof cell);
    other |= cell.bits ^ value.bits;
  }
  return other != 0;
}

/// Sets bytes to 0. Linux takes back the whole pages of a large range and gives pages of zeros when
/// they are used again, in a small part of the time of writing them.
void clear_bytes(std::uint8_t* begin, std::size_t size) noexcept {
#ifdef __linux__
  constexpr std::size_t kLarge = std::size_t{4} << 20U;
  static const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::size_t head = (page - reinterpret_cast<std::uintptr_t>(begin) % page) % page;
  if (size >= kLarge && size > head + page) {
    const std::size_t pages = (size - head) / page * page;
    if (madvise(begin + head, pages, MADV_DONTNEED) == 0) {
      std::memset(begin, 0, head);
      std::memset(begin + head + pages, 0, size - head - pages);
      return;
    }
  }
#endif
  std::memset(begin, 0, size);
}

}  // namespace

CellRaster::CellRaster(int width, int height, CellValue blank)
    : width_(width), height_(height), blank_(blank) {
  SIM_ASSERT(width >= 1 && height >= 1);
  tile_stride_ = static_cast<std::size_t>(tile_columns());
  data_.resize(byte_offset(width_) * static_cast<std::size_t>(height_));
  if (blank_ != CellValue{}) fill_cells(data_.data(), data_.size() / sizeof blank_, blank_);
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
  if (value == CellValue{} && blank_ == value) {
    clear_rows(begin, end);
  } else {
    const auto offset = static_cast<std::size_t>(begin) * byte_offset(width_);
    const auto count = static_cast<std::size_t>(end - begin) * static_cast<std::size_t>(width_);
    fill_cells(data_.data() + offset, count, value);
  }
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
      if ((*tile & (kChanged | kUsed)) != 0) {
        *tile = whole ? kChanged | kUnsaved | kUncopied : kWritten;
      }
    }
  }
}

// Rows of blank tiles hold zeros already.
void CellRaster::clear_rows(int begin, int end) noexcept {
  const auto is_blank = [this](int row) {
    const auto first = tiles_.begin() +
                       static_cast<std::ptrdiff_t>(row) * static_cast<std::ptrdiff_t>(tile_stride_);
    return std::none_of(first, first + static_cast<std::ptrdiff_t>(tile_stride_),
                        [](std::uint8_t tile) { return (tile & kUsed) != 0; });
  };
  for (int row = begin; row < end;) {
    const int first = row;
    while (row < end && !is_blank(row >> kTileShift)) {
      row = std::min(end, ((row >> kTileShift) + 1) << kTileShift);
    }
    clear_bytes(data_.data() + static_cast<std::size_t>(first) * byte_offset(width_),
                static_cast<std::size_t>(row - first) * byte_offset(width_));
    if (row < end) row = std::min(end, ((row >> kTileShift) + 1) << kTileShift);
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

void CellRaster::begin_copy() noexcept {
  for (std::uint8_t& tile : tiles_) {
    tile = static_cast<std::uint8_t>((tile & kUsed) != 0 ? tile | kUncopied : tile & ~kUncopied);
  }
}

std::size_t CellRaster::copy_some(CellRaster& to, std::size_t& tile, std::size_t cells) {
  std::size_t copied = 0;
  for (; tile < tiles_.size() && copied < cells; ++tile) {
    if ((tiles_[tile] & kUncopied) == 0) continue;
    copy_tile(to, static_cast<int>(tile % tile_stride_), static_cast<int>(tile / tile_stride_));
    tiles_[tile] &= static_cast<std::uint8_t>(~kUncopied);
    copied += std::size_t{kTileSide} * kTileSide;
  }
  return copied;
}

bool CellRaster::copied() const noexcept {
  unsigned all = 0;
  for (const std::uint8_t tile : tiles_) all |= tile;
  return (all & kUncopied) == 0;
}

// The tiles of rasters of two sizes need not coincide, since rows are counted from the top.
void CellRaster::copy_tile(CellRaster& to, int column, int row) const {
  const int left = column << kTileShift;
  const int right = std::min({left + kTileSide, width_, to.width_});
  const int shift = to.height_ - height_;
  const int top = std::max(row << kTileShift, -shift);
  const int bottom = std::min((row + 1) << kTileShift, height_);
  if (left >= right) return;
  const bool same_size = width_ == to.width_ && shift == 0;
  const std::size_t own =
      static_cast<std::size_t>(row) * tile_stride_ + static_cast<std::size_t>(column);
  if (same_size) to.tiles_[own] = tiles_[own] & kUsed;
  for (int y = top; y < bottom; ++y) {
    const std::uint8_t* const from = row_bytes(y) + byte_offset(left);
    std::memcpy(to.data_.data() + static_cast<std::size_t>(y + shift) * byte_offset(to.width_) +
                    byte_offset(left),
                from, byte_offset(right - left));
    if (same_size || !any_other(from, right - left, blank_)) continue;
    to.tiles_[static_cast<std::size_t>((y + shift) >> kTileShift) * to.tile_stride_ +
              static_cast<std::size_t>(column)] |= kUsed;
  }
}

void CellRaster::mark_all() noexcept {
  for (std::uint8_t& tile : tiles_) tile |= kChanged | kUnsaved;
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

std::size_t CellRaster::archived_bytes() const noexcept {
  const auto used = static_cast<std::size_t>(std::count_if(
      tiles_.begin(), tiles_.end(), [](std::uint8_t tile) { return (tile & kUsed) != 0; }));
  return 64 + tiles_.size() + used * byte_offset(kTileSide * kTileSide);
}

void CellRaster::clear_changed() noexcept {
  for (std::uint8_t& tile : tiles_) tile &= static_cast<std::uint8_t>(~kChanged);
}

void CellRaster::clear_unsaved() noexcept {
  for (std::uint8_t& tile : tiles_) tile &= static_cast<std::uint8_t>(~kUnsaved);
}

}  // namespace sim
