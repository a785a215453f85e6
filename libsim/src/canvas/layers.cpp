// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/canvas/layers.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <tuple>
#include <unordered_set>
#include <utility>

#include "sim/core/assert.h"
#include "sim/core/state_archive.h"

namespace sim {
namespace {

constexpr float kUnknown = 0.5F;

/// Conversion of a layer's cells to colours: the layer's kind and the relevant parts of its style.
struct Ink {
  Ink(LayerKind of_kind, const LayerStyle& style)
      : kind(of_kind), colour(style.colour), transparent_colour(style.transparent_colour) {
    const double opaque = 1.0 - style.transparency;
    // NaN counts as opaque.
    opacity = opaque < 1.0
                  ? static_cast<std::uint8_t>(std::floor(255.0 * std::max(opaque, 0.0) + 0.5))
                  : std::uint8_t{255};
    if (kind != LayerKind::kBinary) colour = {};
    if (transparent_colour) transparent_colour->a = 255;
  }

  [[nodiscard]] Colour drawn(CellValue value) const noexcept {
    switch (kind) {
      case LayerKind::kColour:
        return drawn_as<LayerKind::kColour>(value);
      case LayerKind::kBinary:
        return drawn_as<LayerKind::kBinary>(value);
      case LayerKind::kGrey:
        break;
    }
    return drawn_as<LayerKind::kGrey>(value);
  }

  /// Like drawn(), for a kind known at compile time; for loops over many cells.
  template <LayerKind kKind>
  [[nodiscard]] Colour drawn_as(CellValue value) const noexcept {
    Colour c = shade<kKind>(value);
    if (transparent_colour && c.r == transparent_colour->r && c.g == transparent_colour->g &&
        c.b == transparent_colour->b) {
      return {0, 0, 0, 0};
    }
    if (opacity != 255) c.a = static_cast<std::uint8_t>((c.a * opacity + 127u) / 255u);
    return c.a == 0 ? Colour{0, 0, 0, 0} : c;
  }

  friend bool operator==(const Ink&, const Ink&) = default;

  LayerKind kind;
  Colour colour;
  std::optional<Colour> transparent_colour;
  std::uint8_t opacity = 255;

 private:
  template <LayerKind kKind>
  [[nodiscard]] Colour shade(CellValue value) const noexcept {
    if constexpr (kKind == LayerKind::kColour) {
      return value.colour();
    } else if constexpr (kKind == LayerKind::kBinary) {
      return value.set() ? colour : Colour{0, 0, 0, 0};
    } else {
      const float occupancy = value.occupancy();
      // Both comparisons fail for NaN.
      const float p = occupancy >= 0.0F  ? std::min(occupancy, 1.0F)
                      : occupancy < 0.0F ? 0.0F
                                         : kUnknown;
      // 255 (1 - p) rounded to nearest, halves up: computed from its double, rounded down.
      const auto doubled = static_cast<unsigned>(510.0 * (1.0 - static_cast<double>(p)));
      const auto grey = static_cast<std::uint8_t>((doubled + 1) / 2);
      return {grey, grey, grey, 255};
    }
  }
};

CellValue blank_of(LayerKind kind) {
  return kind == LayerKind::kGrey ? CellValue::of(kUnknown) : CellValue{};
}

struct Layer {
  LayerId id;
  LayerKind kind;
  int owner;
  LayerStyle style;
  Ink ink{LayerKind::kColour, {}};
  std::unique_ptr<CellRaster> own;  // null for the base layer, whose cells are the canvas's
  CellRaster* cells;

  /// Whether blank cells are visible.
  [[nodiscard]] bool blank_shows() const { return ink.drawn(cells->blank()).a != 0; }
};

/// Whether a is drawn before b.
bool lies_below(const Layer& a, const Layer& b) {
  const auto rank = [](const Layer& layer) {
    return std::tuple(layer.style.priority, layer.id != kBaseLayer, layer.owner, layer.id);
  };
  return rank(a) < rank(b);
}

bool any_bit(const std::vector<std::uint8_t>& bytes, std::uint8_t bits) {
  unsigned all = 0;
  for (const std::uint8_t byte : bytes) all |= byte;
  return (all & bits) != 0;
}

}  // namespace

struct LayerStack::Impl {
  explicit Impl(const CanvasDescription& place) : description(place), base(place) {
    LayerStyle style;
    style.name = "canvas";
    const Ink ink(LayerKind::kColour, style);
    layers.push_back(
        {kBaseLayer, LayerKind::kColour, 0, std::move(style), ink, nullptr, &cells(base)});
    dirty.assign(cells(base).tiles().size(), 0);
    picture.assign(base.data().size(), 0);
  }

  static CellRaster& cells(Canvas& canvas) { return canvas.cells_; }

  [[nodiscard]] Layer* find(LayerId id) {
    const auto it =
        std::find_if(layers.begin(), layers.end(), [id](const Layer& l) { return l.id == id; });
    return it == layers.end() ? nullptr : &*it;
  }
  [[nodiscard]] Layer& get(LayerId id) {
    Layer* layer = find(id);
    SIM_ASSERT(layer != nullptr);
    return *layer;
  }

  /// Marks as dirty everything that the layer shows, or has shown since it was last composed.
  void mark(const Layer& layer) {
    const std::vector<std::uint8_t>& tiles = layer.cells->tiles();
    const bool everywhere = layer.blank_shows();
    for (std::size_t i = 0; i < dirty.size(); ++i) {
      if (everywhere || (tiles[i] & (CellRaster::kChanged | CellRaster::kUsed)) != 0) dirty[i] = 1;
    }
  }

  [[nodiscard]] std::vector<LayerId> visible_order() const {
    std::vector<LayerId> order;
    for (const Layer& layer : layers) {
      if (layer.style.visible) order.push_back(layer.id);
    }
    return order;
  }

  void set_style(LayerId id, LayerStyle style) {
    ++revision;
    const std::vector<LayerId> order_before = visible_order();
    Layer& layer = get(id);
    Layer before{layer.id,  layer.kind, layer.owner, std::move(layer.style),
                 layer.ink, nullptr,    layer.cells};
    layer.ink = Ink(layer.kind, style);
    layer.style = std::move(style);
    const bool looks_else = layer.style.visible && before.style.visible && layer.ink != before.ink;
    // The sort determines its new position; `layer` may refer to another layer afterwards.
    std::sort(layers.begin(), layers.end(), lies_below);
    if (!looks_else && visible_order() == order_before) return;
    if (before.style.visible) mark(before);
    if (get(id).style.visible) mark(get(id));
  }

  /// Recomputes the tile's cells in `picture`.
  void compose_tile(int tile_column, int tile_row) {
    const int left = tile_column << CellRaster::kTileShift;
    const int right = std::min(left + CellRaster::kTileSide, base.width());
    const int top = tile_row << CellRaster::kTileShift;
    const int bottom = std::min(top + CellRaster::kTileSide, base.height());
    const std::size_t tile =
        static_cast<std::size_t>(tile_row) * static_cast<std::size_t>(cells(base).tile_columns()) +
        static_cast<std::size_t>(tile_column);
    const auto count = static_cast<std::size_t>(right - left);
    const std::size_t stride = static_cast<std::size_t>(base.width()) * sizeof(Colour);
    std::uint8_t* const first = picture.data() + static_cast<std::size_t>(top) * stride +
                                static_cast<std::size_t>(left) * sizeof(Colour);
    for (int row = top; row < bottom; ++row) {
      std::memset(first + static_cast<std::size_t>(row - top) * stride, 0, count * sizeof(Colour));
    }
    for (const Layer& layer : layers) {
      if (!layer.style.visible) continue;
      const bool used = (layer.cells->tiles()[tile] & CellRaster::kUsed) != 0;
      if (!used && !layer.blank_shows()) continue;
      for (int row = top; row < bottom; ++row) {
        draw_row(layer.ink,
                 layer.cells->row_bytes(row) + static_cast<std::size_t>(left) * sizeof(CellValue),
                 count, first + static_cast<std::size_t>(row - top) * stride);
      }
    }
    recomposed_cells += count * static_cast<std::size_t>(bottom - top);
  }

  static void draw_row(const Ink& ink, const std::uint8_t* from, std::size_t count,
                       std::uint8_t* to) {
    switch (ink.kind) {
      case LayerKind::kColour:
        return draw_row_as<LayerKind::kColour>(ink, from, count, to);
      case LayerKind::kBinary:
        return draw_row_as<LayerKind::kBinary>(ink, from, count, to);
      case LayerKind::kGrey:
        return draw_row_as<LayerKind::kGrey>(ink, from, count, to);
    }
  }

  template <LayerKind kKind>
  static void draw_row_as(const Ink& layer_ink, const std::uint8_t* from, std::size_t count,
                          std::uint8_t* to) {
    const Ink ink = layer_ink;  // a copy, so that the bytes written below cannot alias it
    for (std::size_t i = 0; i < count; ++i) {
      CellValue value;
      std::memcpy(&value, from + i * sizeof value, sizeof value);
      const Colour above = ink.drawn_as<kKind>(value);
      if (above.a == 0) continue;
      Colour cell;
      std::memcpy(&cell, to + i * sizeof cell, sizeof cell);
      cell = source_over(above, cell);
      std::memcpy(to + i * sizeof cell, &cell, sizeof cell);
    }
  }

  /// Composes dirty tiles until about `cells_at_most` cells are done.
  /// @return whether none is left.
  bool compose(std::size_t cells_at_most) {
    for (Layer& layer : layers) {
      if (!layer.style.visible) continue;
      const std::vector<std::uint8_t>& tiles = layer.cells->tiles();
      for (std::size_t i = 0; i < dirty.size(); ++i) {
        dirty[i] = static_cast<std::uint8_t>(dirty[i] | (tiles[i] & CellRaster::kChanged));
      }
      layer.cells->clear_changed();
    }
    if (!any_bit(dirty, 1)) return true;
    const std::uint64_t end =
        recomposed_cells + std::min<std::uint64_t>(cells_at_most, 1ULL << 62U);
    const int columns = cells(base).tile_columns();
    const int rows = cells(base).tile_rows();
    std::size_t tile = 0;
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column, ++tile) {
        if (dirty[tile] == 0) continue;
        if (recomposed_cells >= end) return false;
        compose_tile(column, row);
        dirty[tile] = 0;
      }
    }
    // Incremented only when all is done: a composition in parts is one change of the picture.
    ++version;
    return true;
  }

  /// Whether compose() has work to do.
  [[nodiscard]] bool is_dirty() const {
    return any_bit(dirty, 1) || std::any_of(layers.begin(), layers.end(), [](const Layer& layer) {
             return layer.style.visible && any_bit(layer.cells->tiles(), CellRaster::kChanged);
           });
  }

  CanvasDescription description;
  Canvas base;
  std::vector<Layer> layers;  // in drawing order
  LayerId next_id = kBaseLayer + 1;
  std::vector<std::uint8_t> dirty;    // by tile: must be recomposed, for any reason
  std::vector<std::uint8_t> picture;  // RGBA; valid where no tile is dirty
  std::uint64_t version = 0;          // number of compose() runs that found work
  std::uint64_t recomposed_cells = 0;
  std::uint64_t revision = 0;
};

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

LayerId LayerStack::add(LayerKind kind, LayerStyle style, int owner) {
  SIM_ASSERT(impl_->next_id < std::numeric_limits<LayerId>::max());
  const LayerId id = impl_->next_id++;
  ++impl_->revision;
  auto own = std::make_unique<CellRaster>(width(), height(), blank_of(kind));
  CellRaster* const cells = own.get();
  const Ink ink(kind, style);
  Layer layer{id, kind, owner, std::move(style), ink, std::move(own), cells};
  if (layer.style.visible) impl_->mark(layer);
  const auto place =
      std::upper_bound(impl_->layers.begin(), impl_->layers.end(), layer, lies_below);
  impl_->layers.insert(place, std::move(layer));
  return id;
}

bool LayerStack::remove(LayerId layer) {
  Layer* const found = impl_->find(layer);
  if (found == nullptr || layer == kBaseLayer) return false;
  ++impl_->revision;
  if (found->style.visible) impl_->mark(*found);
  impl_->layers.erase(impl_->layers.begin() + (found - impl_->layers.data()));
  return true;
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

void LayerStack::draw(std::span<const DrawOperation> operations) {
  const auto is_fill = [](const DrawOperation& o) { return o.kind == DrawOperation::Kind::kFill; };
  DrawProgress progress;
  const auto all = std::numeric_limits<std::size_t>::max();
  if (std::none_of(operations.begin(), operations.end(), is_fill)) {
    draw_some(operations, progress, all);
    return;
  }
  std::vector<DrawOperation> kept(operations.begin(), operations.end());
  drop_covered(kept);
  draw_some(kept, progress, all);
}

std::size_t LayerStack::draw_some(std::span<const DrawOperation> operations, DrawProgress& progress,
                                  std::size_t cells_at_most) {
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
      case DrawOperation::Kind::kPixel:
        ++written;
        if (blends) {
          cells.blend(operation.x0, operation.y0, value.colour());
        } else {
          cells.put(operation.x0, operation.y0, value);
        }
        break;
      case DrawOperation::Kind::kLine:
        written += cells_written(operation, width(), height());
        if (blends) {
          cells.blend_line(operation.x0, operation.y0, operation.x1, operation.y1, value.colour());
        } else {
          cells.put_line(operation.x0, operation.y0, operation.x1, operation.y1, value);
        }
        break;
      case DrawOperation::Kind::kFill: {
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

std::vector<std::vector<std::uint8_t>> LayerStack::resize(
    int width, int height, std::vector<std::vector<std::uint8_t>> zeros) {
  SIM_ASSERT(width >= 1 && width <= kMaxCanvasSide && height >= 1 && height <= kMaxCanvasSide);
  if (width == this->width() && height == this->height()) return zeros;
  ++impl_->revision;
  const auto take = [&]() -> std::vector<std::uint8_t> {
    if (zeros.empty()) return {};
    std::vector<std::uint8_t> bytes = std::move(zeros.back());
    zeros.pop_back();
    return bytes;
  };
  std::vector<std::vector<std::uint8_t>> old;
  old.reserve(impl_->layers.size() + 1 + zeros.size());
  for (Layer& layer : impl_->layers) old.push_back(layer.cells->resize(width, height, take()));
  impl_->description.width = width;
  impl_->description.height = height;
  const CellRaster& base = Impl::cells(impl_->base);
  impl_->dirty.assign(base.tiles().size(), 1);
  std::vector<std::uint8_t> picture = take();
  if (picture.size() != base.data().size()) picture.assign(base.data().size(), 0);
  impl_->picture.swap(picture);
  old.push_back(std::move(picture));
  std::move(zeros.begin(), zeros.end(), std::back_inserter(old));
  return old;
}

void LayerStack::archive_base(StateArchive& archive) {
  archive(impl_->base);
  if (!archive.reading()) return;
  impl_->description.width = width();
  impl_->description.height = height();
  impl_->dirty.assign(Impl::cells(impl_->base).tiles().size(), 1);
  impl_->picture.assign(impl_->base.data().size(), 0);
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

void LayerStack::take_base(LayerStack& from) {
  SIM_ASSERT(width() == from.width() && height() == from.height());
  CellRaster& base = Impl::cells(impl_->base);
  std::swap(base, Impl::cells(from.impl_->base));
  impl_->dirty.assign(base.tiles().size(), 1);
}

void LayerStack::take_over_from(const LayerStack& before) {
  impl_->next_id = std::max(impl_->next_id, before.impl_->next_id);
  impl_->version = before.impl_->version;
  impl_->recomposed_cells = before.impl_->recomposed_cells;
  impl_->revision = before.impl_->revision + 1;
}

const std::vector<std::uint8_t>& LayerStack::composed() {
  impl_->compose(std::numeric_limits<std::size_t>::max());
  return impl_->picture;
}

bool LayerStack::compose_some(std::size_t cells) { return impl_->compose(cells); }

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
