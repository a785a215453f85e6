// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "sim/canvas/layers.h"
#include "sim/core/assert.h"

/// The inside of a LayerStack: its layers, and how they are composed.
namespace sim {

inline constexpr float kUnknown = 0.5F;

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

inline CellValue blank_of(LayerKind kind) {
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
inline bool lies_below(const Layer& a, const Layer& b) {
  const auto rank = [](const Layer& layer) {
    return std::tuple(layer.style.priority, layer.id != kBaseLayer, layer.owner, layer.id);
  };
  return rank(a) < rank(b);
}

inline bool any_bit(const std::vector<std::uint8_t>& bytes, std::uint8_t bits) {
  unsigned all = 0;
  for (const std::uint8_t byte : bytes) all |= byte;
  return (all & bits) != 0;
}

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

  /// Composes the dirty tiles of the rows of tiles from `begin` to before `end`.
  void compose(int begin, int end) {
    for (Layer& layer : layers) {
      if (!layer.style.visible) continue;
      const std::vector<std::uint8_t>& tiles = layer.cells->tiles();
      for (std::size_t i = 0; i < dirty.size(); ++i) {
        dirty[i] = static_cast<std::uint8_t>(dirty[i] | (tiles[i] & CellRaster::kChanged));
      }
      layer.cells->clear_changed();
    }
    if (picture.size() != base.data().size()) picture.assign(base.data().size(), 0);
    if (!any_bit(dirty, 1)) return;
    const int columns = cells(base).tile_columns();
    std::size_t tile = static_cast<std::size_t>(begin) * static_cast<std::size_t>(columns);
    for (int row = begin; row < end; ++row) {
      for (int column = 0; column < columns; ++column, ++tile) {
        if (dirty[tile] == 0) continue;
        compose_tile(column, row);
        dirty[tile] = 0;
      }
    }
    // Incremented only when all is done: a composition in parts is one change of the picture.
    if (!any_bit(dirty, 1)) ++version;
  }
  void compose_all() { compose(0, cells(base).tile_rows()); }

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
  std::vector<std::uint8_t> picture;  // RGBA; valid where no tile is dirty; made when it is needed
  std::uint64_t version = 0;          // number of compose() runs that found work
  std::uint64_t recomposed_cells = 0;
  std::uint64_t revision = 0;
  std::uint64_t memory = 0;  // counts the changes of layers' memory: their set, their size
  std::uint64_t copies = 0;  // number of copies begun
};

}  // namespace sim
