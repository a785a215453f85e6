// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Copies of a LayerStack that are made in pieces, and changes of its size, which need one.
#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "canvas/layer_stack.h"

namespace sim {

struct LayerCopy::Impl {
  struct Part {
    LayerId id;
    LayerKind kind;
    std::unique_ptr<CellRaster> cells;
  };

  std::optional<std::pair<int, int>> wanted;  // width and height; none: those of the stack
  std::optional<std::uint64_t> memory;        // of the stack when the copy began
  bool allocated = false;
  std::optional<std::uint64_t> number;  // of this copy in the stack
  CanvasDescription description;        // of the copy
  std::vector<Part> parts;              // in no particular order
  std::vector<std::uint8_t> picture;
  std::size_t part = 0;  // where the copying goes on
  std::size_t tile = 0;
  std::vector<LayerInfo> infos;  // of a complete copy: in drawing order
  LayerId next_id = kBaseLayer + 1;
};

LayerCopy::LayerCopy() : impl_(std::make_unique<Impl>()) {}
LayerCopy::LayerCopy(int width, int height) : LayerCopy() { impl_->wanted.emplace(width, height); }
LayerCopy::~LayerCopy() = default;
LayerCopy::LayerCopy(LayerCopy&&) noexcept = default;
LayerCopy& LayerCopy::operator=(LayerCopy&&) noexcept = default;

void LayerCopy::allocate() {
  const CanvasDescription& canvas = impl_->description;
  for (Impl::Part& part : impl_->parts) {
    part.cells = LayerStack::blank_cells(part.kind, canvas.width, canvas.height);
  }
  // Only a stack that is in use needs its picture soon.
  if (impl_->wanted) {
    impl_->picture.assign(
        4 * static_cast<std::size_t>(canvas.width) * static_cast<std::size_t>(canvas.height), 0);
  }
  impl_->allocated = true;
}

LayerStack::CopyState LayerStack::copy_some(LayerCopy& copy, std::size_t cells) {
  LayerCopy::Impl& c = *copy.impl_;
  // Another copy has used the marks of the tiles since.
  const bool overtaken = c.number && c.number != impl_->copies;
  if (c.memory != impl_->memory || overtaken) {
    c.memory = impl_->memory;
    c.allocated = false;
    c.number.reset();
    c.description = impl_->description;
    if (c.wanted) std::tie(c.description.width, c.description.height) = *c.wanted;
    c.parts.clear();
    for (const Layer& layer : impl_->layers) c.parts.push_back({layer.id, layer.kind, nullptr});
  }
  if (!c.allocated) return CopyState::kNeedsMemory;
  if (!c.number) {
    c.number = ++impl_->copies;
    for (Layer& layer : impl_->layers) layer.cells->begin_copy();
    c.part = c.tile = 0;
  }
  // The search begins anew at its end, for what was written meanwhile.
  std::size_t searched = 0;
  while (cells > 0 && searched <= c.parts.size()) {
    LayerCopy::Impl::Part& part = c.parts[c.part];
    cells -= std::min(cells, impl_->get(part.id).cells->copy_some(*part.cells, c.tile, cells));
    if (cells == 0) break;
    c.tile = 0;
    c.part = (c.part + 1) % c.parts.size();
    ++searched;
  }
  if (!std::all_of(impl_->layers.begin(), impl_->layers.end(),
                   [](const Layer& layer) { return layer.cells->copied(); })) {
    return CopyState::kUnfinished;
  }
  c.infos = layers();
  c.next_id = impl_->next_id;
  return CopyState::kComplete;
}

LayerStack LayerCopy::take() {
  CanvasDescription smallest = impl_->description;  // its cells are replaced
  smallest.width = smallest.height = 1;
  LayerStack stack(smallest);
  LayerStack::Impl& made = *stack.impl_;
  made.description = impl_->description;
  made.next_id = impl_->next_id;
  made.layers.clear();
  for (LayerInfo& info : impl_->infos) {
    const auto part = std::find_if(impl_->parts.begin(), impl_->parts.end(),
                                   [&](const Impl::Part& p) { return p.id == info.id; });
    const Ink ink(info.kind, info.style);
    Layer& layer = made.layers.emplace_back(
        Layer{info.id, info.kind, info.owner, std::move(info.style), ink, nullptr, nullptr});
    if (info.id == kBaseLayer) {
      layer.cells = &LayerStack::Impl::cells(made.base);
      *layer.cells = std::move(*part->cells);
    } else {
      layer.own = std::move(part->cells);
      layer.cells = layer.own.get();
    }
  }
  made.dirty.assign(LayerStack::Impl::cells(made.base).tiles().size(), 1);
  made.picture.clear();
  impl_ = std::make_unique<Impl>();
  return stack;
}

void LayerStack::resize(int width, int height) {
  SIM_ASSERT(width >= 1 && width <= kMaxCanvasSide && height >= 1 && height <= kMaxCanvasSide);
  if (width == this->width() && height == this->height()) return;
  LayerCopy copy(width, height);
  while (copy_some(copy, std::numeric_limits<std::size_t>::max()) != CopyState::kComplete) {
    copy.allocate();
  }
  resize(copy);
}

void LayerStack::resize(LayerCopy& copy) {
  LayerCopy::Impl& c = *copy.impl_;
  SIM_ASSERT(c.memory == impl_->memory && c.number && c.parts.size() == impl_->layers.size());
  for (LayerCopy::Impl::Part& part : c.parts) {
    CellRaster& cells = *impl_->get(part.id).cells;
    std::swap(cells, *part.cells);
    cells.mark_all();
  }
  impl_->description.width = c.description.width;
  impl_->description.height = c.description.height;
  impl_->dirty.assign(Impl::cells(impl_->base).tiles().size(), 1);
  impl_->picture.swap(c.picture);
  ++impl_->revision;
  ++impl_->memory;
}

}  // namespace sim
