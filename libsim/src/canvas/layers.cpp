// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/canvas/layers.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <unordered_set>
#include <utility>

#include "canvas/layer_stack.h"
#include "sim/core/assert.h"
#include "sim/core/state_archive.h"

namespace sim {

void drop_covered(std::vector<DrawOperation>& operations) {
  std::unordered_set<LayerId> filled;  // layers that a later fill covers
  std::size_t kept = operations.size();
  for (std::size_t i = operations.size(); i-- > 0;) {
    const DrawOperation& operation = operations[i];
    if (filled.contains(operation.layer)) continue;
    if (operation.kind == DrawOperation::Kind::kFill) filled.insert(operation.layer);
    operations[--kept] = operation;
  }
  operations.erase(operations.begin(), operations.begin() + static_cast<std::ptrdiff_t>(kept));
}

std::size_t cells_written(const DrawOperation& operation, int width, int height) noexcept {
  using std::int64_t;
  switch (operation.kind) {
    case DrawOperation::Kind::kPixel:
      return 1;
    case DrawOperation::Kind::kLine: {
      // A line has as many cells as the longer side of its bounding box; cells outside are not
      // visited.
      const auto inside = [](int from, int to, int side) {
        const int64_t low = std::max<int64_t>(std::min(from, to), 0);
        const int64_t high = std::min<int64_t>(std::max(from, to), int64_t{side} - 1);
        return std::max<int64_t>(high - low + 1, 0);
      };
      const int64_t columns = inside(operation.x0, operation.x1, width);
      const int64_t rows = inside(operation.y0, operation.y1, height);
      if (columns == 0 || rows == 0) return 1;
      return static_cast<std::size_t>(std::max(columns, rows));
    }
    case DrawOperation::Kind::kFill:
      break;
  }
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

LayerStack::LayerStack(const CanvasDescription& description)
    : impl_(std::make_unique<Impl>(description)) {}
LayerStack::~LayerStack() = default;
LayerStack::LayerStack(LayerStack&&) noexcept = default;
LayerStack& LayerStack::operator=(LayerStack&&) noexcept = default;

int LayerStack::width() const noexcept { return impl_->base.width(); }
int LayerStack::height() const noexcept { return impl_->base.height(); }

CanvasDescription LayerStack::description() const { return impl_->description; }

Canvas& LayerStack::base() noexcept { return impl_->base; }
const Canvas& LayerStack::base() const noexcept { return impl_->base; }

std::unique_ptr<CellRaster> LayerStack::blank_cells(LayerKind kind, int width, int height) {
  return std::make_unique<CellRaster>(width, height, blank_of(kind));
}

LayerId LayerStack::add(LayerKind kind, LayerStyle style, int owner,
                        std::unique_ptr<CellRaster> own) {
  SIM_ASSERT(impl_->next_id < std::numeric_limits<LayerId>::max());
  const LayerId id = impl_->next_id++;
  ++impl_->revision;
  ++impl_->memory;
  if (own == nullptr || own->width() != width() || own->height() != height() ||
      own->blank() != blank_of(kind)) {
    own = blank_cells(kind, width(), height());
  }
  CellRaster* const cells = own.get();
  const Ink ink(kind, style);
  Layer layer{id, kind, owner, std::move(style), ink, std::move(own), cells};
  if (layer.style.visible) impl_->mark(layer);
  const auto place =
      std::upper_bound(impl_->layers.begin(), impl_->layers.end(), layer, lies_below);
  impl_->layers.insert(place, std::move(layer));
  return id;
}

std::unique_ptr<CellRaster> LayerStack::remove(LayerId layer) {
  Layer* const found = impl_->find(layer);
  if (found == nullptr || layer == kBaseLayer) return nullptr;
  ++impl_->revision;
  ++impl_->memory;
  if (found->style.visible) impl_->mark(*found);
  std::unique_ptr<CellRaster> cells = std::move(found->own);
  impl_->layers.erase(impl_->layers.begin() + (found - impl_->layers.data()));
  return cells;
}

bool LayerStack::contains(LayerId layer) const noexcept { return impl_->find(layer) != nullptr; }
LayerKind LayerStack::kind(LayerId layer) const { return impl_->get(layer).kind; }
const LayerStyle& LayerStack::style(LayerId layer) const { return impl_->get(layer).style; }

void LayerStack::set_style(LayerId layer, LayerStyle style) {
  impl_->set_style(layer, std::move(style));
}

std::vector<LayerInfo> LayerStack::layers() const {
  std::vector<LayerInfo> infos;
  infos.reserve(impl_->layers.size());
  for (const Layer& layer : impl_->layers) {
    infos.push_back({layer.id, layer.kind, layer.owner, layer.style});
  }
  return infos;
}

namespace {

// Executes the pixels at the beginning of a list, as long as they are on this layer.
// @return their number.
std::size_t draw_pixels(const Layer& layer, std::span<const DrawOperation> operations) {
  const CellRaster::Writer writer(*layer.cells);
  const LayerId id = layer.id;
  const auto draw_each = [&](auto draw_one) {
    std::size_t i = 0;
    for (; i < operations.size(); ++i) {
      const DrawOperation& operation = operations[i];
      if (operation.kind != DrawOperation::Kind::kPixel || operation.layer != id) break;
      draw_one(operation);
    }
    return i;
  };
  if (layer.kind == LayerKind::kColour) {
    return draw_each([&](const DrawOperation& pixel) {
      writer.blend(pixel.x0, pixel.y0, pixel.value.colour());
    });
  }
  return draw_each(
      [&](const DrawOperation& pixel) { writer.put(pixel.x0, pixel.y0, pixel.value); });
}

}  // namespace

void LayerStack::draw(std::span<const DrawOperation> operations) {
  constexpr auto kAll = std::numeric_limits<std::size_t>::max();
  DrawProgress progress;
  static_cast<void>(draw_some(operations, progress, kAll, /*stop_at_fill=*/true));
  const auto rest = operations.subspan(progress.operation);
  if (rest.empty()) return;
  std::vector<DrawOperation> kept(rest.begin(), rest.end());
  drop_covered(kept);
  progress = {};
  static_cast<void>(draw_some(kept, progress, kAll));
}

std::size_t LayerStack::draw_some(std::span<const DrawOperation> operations, DrawProgress& progress,
                                  std::size_t cells_at_most) {
  return draw_some(operations, progress, cells_at_most, /*stop_at_fill=*/false);
}

std::size_t LayerStack::draw_some(std::span<const DrawOperation> operations, DrawProgress& progress,
                                  std::size_t cells_at_most, bool stop_at_fill) {
  LayerId id = kBaseLayer;
  Layer* layer = impl_->find(id);
  std::size_t written = 0;
  for (; progress.operation < operations.size() && written < cells_at_most; ++progress.operation) {
    const DrawOperation& operation = operations[progress.operation];
    if (operation.layer != id) {
      id = operation.layer;
      layer = impl_->find(id);
    }
    if (layer == nullptr) {
      ++written;  // so that a list of such drawings also ends its turn
      continue;
    }
    CellRaster& cells = *layer->cells;
    const bool blends = layer->kind == LayerKind::kColour;
    const CellValue value = operation.value;
    switch (operation.kind) {
      case DrawOperation::Kind::kPixel: {
        const auto rest = operations.subspan(progress.operation);
        const std::size_t pixels =
            draw_pixels(*layer, rest.first(std::min(rest.size(), cells_at_most - written)));
        written += pixels;
        progress.operation += pixels - 1;
        break;
      }
      case DrawOperation::Kind::kLine:
        written += cells_written(operation, width(), height());
        if (blends) {
          cells.blend_line(operation.x0, operation.y0, operation.x1, operation.y1, value.colour());
        } else {
          cells.put_line(operation.x0, operation.y0, operation.x1, operation.y1, value);
        }
        break;
      case DrawOperation::Kind::kFill: {
        if (stop_at_fill) return written;
        const auto row_cells = static_cast<std::size_t>(width());
        // The canvas may have been resized between two calls.
        const int begin = std::min(progress.row, height());
        const auto left = static_cast<std::size_t>(height() - begin);
        constexpr std::size_t kTile = CellRaster::kTileSide;
        const std::size_t wanted = (cells_at_most - written) / row_cells;
        const std::size_t rows =  // whole tiles, so that none is marked twice
            std::min(left, std::max<std::size_t>(wanted / kTile, 1) * kTile);
        cells.fill_rows(begin, begin + static_cast<int>(rows), value);
        written += std::max<std::size_t>(rows * row_cells, 1);
        progress.row = begin + static_cast<int>(rows);
        if (progress.row < height()) return written;
        progress.row = 0;
        break;
      }
    }
  }
  return written;
}

void LayerStack::set_cells(LayerId layer, const CellRect& rect, std::span<const CellValue> values) {
  if (Layer* const found = impl_->find(layer)) found->cells->set_cells(rect, values);
}

std::optional<CellValue> LayerStack::cell(LayerId layer, int column, int row) const {
  const Layer* const found = impl_->find(layer);
  if (found == nullptr || !found->cells->contains(column, row)) return std::nullopt;
  return found->cells->at(column, row);
}

std::vector<CellValue> LayerStack::cells(LayerId layer) const {
  const std::vector<std::uint8_t>& bytes = impl_->get(layer).cells->data();
  std::vector<CellValue> values(bytes.size() / sizeof(CellValue));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

void LayerStack::archive_base(StateArchive& archive) {
  archive(impl_->base);
  if (!archive.reading()) return;
  impl_->description.width = width();
  impl_->description.height = height();
  impl_->dirty.assign(Impl::cells(impl_->base).tiles().size(), 1);
  impl_->picture.clear();
  ++impl_->memory;
}

void LayerStack::archive_others(StateArchive& archive) {
  archive(impl_->next_id);
  archive.expect(impl_->next_id > kBaseLayer, "a number for the next layer");
  std::vector<Layer> layers;
  if (!archive.reading()) layers.swap(impl_->layers);
  archive.list(layers, [&](Layer& layer) {
    archive.index(layer.id, static_cast<std::size_t>(impl_->next_id));
    archive.choice(layer.kind, LayerKind::kGrey);
    LayerStyle& style = layer.style;
    archive(layer.owner, style.name, style.colour, style.transparency, style.transparent_colour,
            style.priority, style.visible);
    if (layer.id == kBaseLayer) {
      archive.expect(layer.kind == LayerKind::kColour, "a base layer of colours");
      layer.cells = &Impl::cells(impl_->base);
    } else {
      if (archive.reading()) layer.own = std::make_unique<CellRaster>(1, 1, blank_of(layer.kind));
      archive(*layer.own);
      archive.expect(layer.own->width() == width() && layer.own->height() == height(),
                     "layers of one size");
      layer.cells = layer.own.get();
    }
    layer.ink = Ink(layer.kind, style);
  });
  std::vector<LayerId> ids;
  for (const Layer& layer : layers) ids.push_back(layer.id);
  std::sort(ids.begin(), ids.end());
  archive.expect(!ids.empty() && ids[0] == kBaseLayer &&
                     std::adjacent_find(ids.begin(), ids.end()) == ids.end() &&
                     std::is_sorted(layers.begin(), layers.end(), lies_below),
                 "each layer once, in order");
  layers.swap(impl_->layers);
}

std::size_t LayerStack::archived_bytes(bool others) const {
  std::size_t bytes = 0;
  for (const Layer& layer : impl_->layers) {
    if (others || layer.id == kBaseLayer) bytes += layer.cells->archived_bytes();
  }
  return bytes;
}

void LayerStack::take_base(LayerStack& from) {
  SIM_ASSERT(width() == from.width() && height() == from.height());
  CellRaster& base = Impl::cells(impl_->base);
  std::swap(base, Impl::cells(from.impl_->base));
  ++impl_->memory;
  impl_->dirty.assign(base.tiles().size(), 1);
}

void LayerStack::take_over_from(const LayerStack& before) {
  impl_->next_id = std::max(impl_->next_id, before.impl_->next_id);
  impl_->version = before.impl_->version;
  impl_->recomposed_cells = before.impl_->recomposed_cells;
  impl_->revision = before.impl_->revision + 1;
  impl_->memory = before.impl_->memory + 1;
}

const std::vector<std::uint8_t>& LayerStack::composed() {
  impl_->compose_all();
  return impl_->picture;
}

std::vector<std::uint8_t> LayerStack::take_composed() {
  impl_->compose_all();
  std::fill(impl_->dirty.begin(), impl_->dirty.end(), std::uint8_t{1});
  return std::exchange(impl_->picture, {});
}

void LayerStack::composed_rows(int row, std::span<std::uint8_t> to) {
  const std::size_t line = static_cast<std::size_t>(width()) * sizeof(Colour);
  const auto end = row + static_cast<int>(to.size() / line);
  SIM_ASSERT(row >= 0 && end <= height());
  if (to.empty()) return;
  impl_->compose(row >> CellRaster::kTileShift, CellRaster::tiles_across(end));
  std::memcpy(to.data(), impl_->picture.data() + static_cast<std::size_t>(row) * line, to.size());
}

std::vector<std::uint8_t> LayerStack::picture(LayerId layer) const {
  const Layer& found = impl_->get(layer);
  const std::vector<std::uint8_t>& from = found.cells->data();
  std::vector<std::uint8_t> bytes(from.size(), 0);
  Impl::draw_row(found.ink, from.data(), from.size() / sizeof(CellValue), bytes.data());
  return bytes;
}

void LayerStack::picture_rows(LayerId layer, int row, std::span<std::uint8_t> to) const {
  const Layer& found = impl_->get(layer);
  SIM_ASSERT(row >= 0 && row < height());
  const auto offset =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(width()) * sizeof(CellValue);
  SIM_ASSERT(offset + to.size() <= found.cells->data().size());
  std::fill(to.begin(), to.end(), std::uint8_t{0});
  Impl::draw_row(found.ink, found.cells->row_bytes(row), to.size() / sizeof(CellValue), to.data());
}

void LayerStack::copy_rows(LayerId layer, int row, std::span<CellValue> to) const {
  const Layer& found = impl_->get(layer);
  SIM_ASSERT(row >= 0 && row < height());
  const auto offset =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(width()) * sizeof(CellValue);
  SIM_ASSERT(offset + to.size_bytes() <= found.cells->data().size());
  std::memcpy(to.data(), found.cells->row_bytes(row), to.size_bytes());
}

std::uint64_t LayerStack::version() const noexcept {
  return impl_->version + (impl_->is_dirty() ? 1 : 0);
}

std::uint64_t LayerStack::revision() const noexcept { return impl_->revision; }

std::span<const std::uint8_t> LayerStack::bytes(LayerId layer) const {
  return impl_->get(layer).cells->data();
}

void LayerStack::take_written(const std::function<void(LayerId, const CellRect&)>& visit) {
  for (const Layer& layer : impl_->layers) {
    const std::vector<std::uint8_t>& tiles = layer.cells->tiles();
    if (!any_bit(tiles, CellRaster::kUnsaved)) continue;
    const int columns = layer.cells->tile_columns();
    const auto is_written = [&](int row, int column) {
      return (tiles[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                    static_cast<std::size_t>(column)] &
              CellRaster::kUnsaved) != 0;
    };
    for (int row = 0; row < layer.cells->tile_rows(); ++row) {
      for (int column = 0; column < columns; ++column) {
        if (!is_written(row, column)) continue;
        const int first = column;
        while (column < columns && is_written(row, column)) ++column;
        const int left = first << CellRaster::kTileShift;
        const int top = row << CellRaster::kTileShift;
        visit(layer.id, {left, top, std::min(column << CellRaster::kTileShift, width()) - left,
                         std::min(top + CellRaster::kTileSide, height()) - top});
      }
    }
    layer.cells->clear_unsaved();
  }
}

std::uint64_t LayerStack::recomposed_cells() const noexcept { return impl_->recomposed_cells; }

}  // namespace sim
