// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/session/layer_registry.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "playerlike/session/session.h"
#include "session/checks.h"
#include "sim/core/number_text.h"

namespace playerlike {
namespace {

constexpr sim::LayerId kNoLayer = -1;

[[noreturn]] void reject(SessionError::Code code, const std::string& text) {
  throw SessionError(code, text);
}

std::size_t cells_of(int width, int height) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

void require_transparency(const sim::LayerStyle& style) {
  if (style.transparency >= 0.0 && style.transparency <= 1.0) return;
  reject(SessionError::Code::kBadArgument, "a layer's transparency is a number in 0..1, but is " +
                                               sim::rounded_text(style.transparency, 6));
}

}  // namespace

bool LayerRegistry::owns(int client, sim::LayerId layer) const noexcept {
  return std::any_of(entries_.begin(), entries_.end(),
                     [&](const Entry& e) { return e.layer == layer && e.client == client; });
}

void LayerRegistry::require(int client, sim::LayerId layer) const {
  if (may_use(client, layer)) return;
  reject(SessionError::Code::kBadArgument,
         "this client has no layer with the number " + std::to_string(layer));
}

void LayerRegistry::require_name(const sim::LayerStack& stack, int client, sim::LayerId layer,
                                 const std::string& name) const {
  if (name.empty() || name.size() > kMaxLayerName || !is_printable(name)) {
    reject(SessionError::Code::kBadArgument,
           "a layer's name has 1 to " + std::to_string(kMaxLayerName) +
               " printable characters, but this one " +
               (name.empty()                  ? "is empty"
                : name.size() > kMaxLayerName ? "has " + std::to_string(name.size())
                                              : "holds a control character"));
  }
  for (const sim::LayerInfo& other : list(stack, client)) {
    if (other.id == layer || other.style.name != name) continue;
    reject(SessionError::Code::kBadArgument, "there is a layer \"" + name + "\" already");
  }
}

// Evicts layers without an owner, oldest first, until one more fits.
void LayerRegistry::make_room(sim::LayerStack& stack, int client, Freed* freed) {
  const auto own = static_cast<std::size_t>(std::count_if(
      entries_.begin(), entries_.end(), [&](const Entry& e) { return e.client == client; }));
  if (own >= kMaxLayers) {
    reject(SessionError::Code::kNotAvailable,
           "this client has " + std::to_string(own) + " layers, which is the most it may have");
  }
  const std::size_t most = kMaxLayerCells / cells_of(stack.width(), stack.height());
  while (entries_.size() + 2 > most) {
    const auto orphan = std::find_if(entries_.begin(), entries_.end(),
                                     [](const Entry& e) { return e.client == kNobody; });
    if (orphan == entries_.end()) {
      reject(SessionError::Code::kNotAvailable,
             "there is no room for another layer: " + std::to_string(entries_.size() + 1) +
                 " layers of " + std::to_string(stack.width()) + " x " +
                 std::to_string(stack.height()) + " cells are there");
    }
    remove_from(stack, orphan->layer, freed);
    entries_.erase(orphan);
  }
}

sim::LayerId LayerRegistry::create(sim::LayerStack& stack, int client, int port,
                                   sim::LayerKind kind, sim::LayerStyle style,
                                   std::unique_ptr<sim::CellRaster> cells, Freed* freed) {
  require_name(stack, client, kNoLayer, style.name);
  require_transparency(style);
  const auto left_behind = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) {
    return e.client == kNobody && e.port == port && stack.style(e.layer).name == style.name;
  });
  if (left_behind != entries_.end()) {
    remove_from(stack, left_behind->layer, freed);
    entries_.erase(left_behind);
  }
  make_room(stack, client, freed);
  entries_.reserve(entries_.size() + 1);
  const sim::LayerId layer = stack.add(kind, std::move(style), port, std::move(cells));
  entries_.push_back({layer, client, port});
  return layer;
}

void LayerRegistry::remove_from(sim::LayerStack& stack, sim::LayerId layer, Freed* freed) {
  auto cells = stack.remove(layer);
  if (freed != nullptr) freed->push_back(std::move(cells));
}

void LayerRegistry::remove(sim::LayerStack& stack, int client, sim::LayerId layer, Freed* freed) {
  require(client, layer);
  if (layer == sim::kBaseLayer) {
    reject(SessionError::Code::kNotAvailable,
           "the layer \"canvas\" is shared by all clients and cannot be removed");
  }
  remove_from(stack, layer, freed);
  std::erase_if(entries_, [&](const Entry& e) { return e.layer == layer; });
}

void LayerRegistry::set_style(sim::LayerStack& stack, int client, sim::LayerId layer,
                              sim::LayerStyle style) {
  require(client, layer);
  require_transparency(style);
  if (style.name != stack.style(layer).name) {
    if (layer == sim::kBaseLayer) {
      reject(SessionError::Code::kNotAvailable,
             "the layer \"canvas\" is shared by all clients and cannot be renamed");
    }
    require_name(stack, client, layer, style.name);
  }
  stack.set_style(layer, std::move(style));
}

void LayerRegistry::require_size(const sim::LayerStack& stack, int width, int height) const {
  if (width < 1 || height < 1 || width > sim::kMaxCanvasSide || height > sim::kMaxCanvasSide) {
    reject(SessionError::Code::kBadArgument,
           "the grid-map's sides are 1 to " + std::to_string(sim::kMaxCanvasSide) + " cells, but " +
               std::to_string(width) + " x " + std::to_string(height) + " were asked for");
  }
  if (width == stack.width() && height == stack.height()) return;
  if (cells_of(width, height) > kMaxLayerCells / (entries_.size() + 1)) {
    reject(SessionError::Code::kNotAvailable,
           std::to_string(width) + " x " + std::to_string(height) + " cells are too many for " +
               std::to_string(entries_.size() + 1) + " layers: they may have " +
               std::to_string(kMaxLayerCells) + " cells together");
  }
}

std::vector<sim::LayerInfo> LayerRegistry::list(const sim::LayerStack& stack, int client) const {
  std::vector<sim::LayerInfo> layers = stack.layers();
  std::erase_if(layers, [&](const sim::LayerInfo& layer) {
    return layer.id != sim::kBaseLayer && !owns(client, layer.id);
  });
  return layers;
}

void LayerRegistry::leave(int client) noexcept {
  for (Entry& entry : entries_) {
    if (entry.client == client) entry.client = kNobody;
  }
}

void LayerRegistry::leave_all() noexcept {
  for (Entry& entry : entries_) entry.client = kNobody;
}

void require_cells(const sim::CellRect& rect, std::size_t count) {
  if (rect.width >= 0 && rect.height >= 0 && cells_of(rect.width, rect.height) == count) return;
  reject(SessionError::Code::kBadArgument, "a rectangle of " + std::to_string(rect.width) + " x " +
                                               std::to_string(rect.height) + " cells was given " +
                                               std::to_string(count) + " values");
}

}  // namespace playerlike
