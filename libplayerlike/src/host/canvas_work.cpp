// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Work that may take long on a large canvas. It is done in pieces; the mutex is unlocked after each
// piece, so steps and other clients wait for one piece at most.
#include <algorithm>
#include <thread>
#include <utility>

#include "host/core.h"

namespace playerlike {
namespace {

// Cells that are copied or composed while the mutex is held, which takes a millisecond or two.
// Nearly all canvases are smaller, so their copies are consistent.
constexpr std::size_t kPiece = std::size_t{1} << 20U;

std::size_t cells_of(const sim::CanvasDescription& canvas) {
  return static_cast<std::size_t>(canvas.width) * static_cast<std::size_t>(canvas.height);
}

bool same_size(const sim::CanvasDescription& a, const sim::CanvasDescription& b) {
  return a.width == b.width && a.height == b.height;
}

}  // namespace

// A thread that locked the mutex again at once would starve the threads that sleep while they wait
// for it.
void Host::Core::yield_to_priority_waiters() const {
  std::this_thread::sleep_for(std::chrono::microseconds(50));
  while (priority_waiters_.load(std::memory_order_relaxed) > 0) std::this_thread::yield();
}

bool Host::Core::draw_some(Client& client, DrawWork& work, std::size_t cells) {
  {
    const Lock lock = lock_with_priority();
    client.require_open();
    if (!std::exchange(work.begun, true)) {
      inputs_.apply_drawings(client);
      inputs_.keep_own_drawings(client, work.operations);
      sim::drop_covered(work.operations);
    }
    work.written += simulation_.layers().draw_some(work.operations, work.progress, cells);
  }
  const bool done = work.progress.operation == work.operations.size();
  if (!done) yield_to_priority_waiters();
  return done;
}

/// Calls copy(layers, registry, row, rows) under the mutex for all rows of the canvas, from the
/// top, in pieces; starts again at row 0 if the canvas is resized meanwhile. Before, it calls
/// copy.make_room(canvas) without the mutex, once for each size.
template <typename Copy>
sim::CanvasDescription Host::Core::copy_in_pieces(Client& client, const Copy& copy) {
  sim::CanvasDescription canvas = with_layers(
      client,
      [](const sim::LayerStack& layers, const LayerRegistry&) { return layers.description(); });
  copy.make_room(canvas);
  for (int row = 0; row < canvas.height;) {
    const int most =
        static_cast<int>(std::max<std::size_t>(kPiece / static_cast<std::size_t>(canvas.width), 1));
    const int rows = std::min(most, canvas.height - row);
    const auto now =
        with_layers(client, [&](sim::LayerStack& layers, const LayerRegistry& registry) {
          if (same_size(layers.description(), canvas)) copy.rows(layers, registry, row, rows);
          return layers.description();
        });
    if (same_size(now, canvas)) {
      row += rows;
    } else {
      canvas = now;
      row = 0;
      copy.make_room(canvas);
    }
    if (row < canvas.height) yield_to_priority_waiters();
  }
  return canvas;
}

std::vector<sim::CellValue> Host::Core::cells(Client& client, sim::LayerId layer) {
  struct Copy {
    int client;
    sim::LayerId layer;
    std::vector<sim::CellValue>& cells;

    void make_room(const sim::CanvasDescription& canvas) const { cells.resize(cells_of(canvas)); }
    void rows(const sim::LayerStack& layers, const LayerRegistry& registry, int row,
              int count) const {
      registry.require(client, layer);
      const auto width = static_cast<std::size_t>(layers.width());
      layers.copy_rows(layer, row,
                       std::span(cells).subspan(static_cast<std::size_t>(row) * width,
                                                static_cast<std::size_t>(count) * width));
    }
  };
  std::vector<sim::CellValue> cells;
  copy_in_pieces(client, Copy{client.number, layer, cells});
  return cells;
}

std::vector<std::uint8_t> Host::Core::picture(Client& client, std::optional<sim::LayerId> layer,
                                              sim::CanvasDescription& canvas) {
  struct Copy {
    int client;
    std::optional<sim::LayerId> layer;
    std::vector<std::uint8_t>& rgba;

    void make_room(const sim::CanvasDescription& size) const { rgba.resize(4 * cells_of(size)); }
    void rows(sim::LayerStack& layers, const LayerRegistry& registry, int row, int count) const {
      if (layer) registry.require(client, *layer);
      const std::size_t line = 4 * static_cast<std::size_t>(layers.width());
      const auto to = std::span(rgba).subspan(static_cast<std::size_t>(row) * line,
                                              static_cast<std::size_t>(count) * line);
      if (layer) return layers.picture_rows(*layer, row, to);
      const std::vector<std::uint8_t>& all = layers.composed();
      std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(row) * line),
                  to.size(), to.begin());
    }
  };
  if (!layer) {
    // Other clients may draw meanwhile. What is left after one pass is composed by the copying.
    std::size_t composed = 0;
    bool more = true;
    while (more) {
      more = with_layers(client, [&](sim::LayerStack& layers, const LayerRegistry&) {
        composed += kPiece;
        return !layers.compose_some(kPiece) && composed < cells_of(layers.description()) + kPiece;
      });
      if (more) yield_to_priority_waiters();
    }
  }
  std::vector<std::uint8_t> rgba;
  canvas = copy_in_pieces(client, Copy{client.number, layer, rgba});
  return rgba;
}

void Host::Core::resize_canvas(Client& client, int width, int height) {
  // Memory is allocated and freed without the mutex.
  std::vector<std::vector<std::uint8_t>> memory;
  const auto size =
      with_layers(client, [&](const sim::LayerStack& layers, const LayerRegistry& registry) {
        registry.require_size(layers, width, height);
        const bool same = layers.width() == width && layers.height() == height;
        return same ? std::size_t{0} : layers.layers().size() + 1;
      });
  const auto cells = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (std::size_t i = 0; i < size; ++i) memory.emplace_back(4 * cells, std::uint8_t{0});
  const Lock lock = lock_with_priority();
  client.require_open();
  // Pending drawings of all clients refer to the old size.
  for (const auto& c : clients_) inputs_.apply_drawings(*c);
  memory = inputs_.registry.resize(simulation_.layers(), width, height, std::move(memory));
  canvas_generation_.fetch_add(1, std::memory_order_acq_rel);
}

}  // namespace playerlike
