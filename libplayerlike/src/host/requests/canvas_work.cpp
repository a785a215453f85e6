// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Work that may take long on a large canvas. It is done in pieces; the mutex is unlocked after each
// piece, so steps and other clients wait for one piece at most.
#include <algorithm>
#include <limits>
#include <thread>
#include <utility>

#include "host/core.h"

namespace playerlike {
namespace {

// Cells that are copied while the mutex is held, which takes a millisecond or two. Nearly all
// canvases are smaller, so their copies are consistent.
constexpr std::size_t kPiece = std::size_t{1} << 20U;
// Composing a cell takes longer, for each layer.
constexpr std::size_t kComposedPiece = std::size_t{1} << 18U;
// A copy in pieces is completed in one piece if it was begun anew more often, or has copied the
// layers more often, because others change them all the time.
constexpr int kMostBeginnings = 8;
constexpr std::size_t kMostPasses = 4;

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

// In a few parts, since lines across a large canvas take much longer than fills with as many cells.
bool Host::Core::draw_some(Client& client, DrawWork& work, std::size_t cells) {
  constexpr std::size_t kParts = 4;
  const std::size_t part = std::max<std::size_t>(cells / kParts, 1);
  for (std::size_t i = 0; i < kParts; ++i) {
    {
      const Lock lock = lock_with_priority();
      client.require_open();
      if (!std::exchange(work.begun, true)) {
        inputs_.apply_drawings(client);
        inputs_.keep_own_drawings(client, work.operations);
        sim::drop_covered(work.operations);
      }
      work.written += simulation_.layers().draw_some(work.operations, work.progress, part);
    }
    if (work.progress.operation == work.operations.size()) return true;
    yield_to_priority_waiters();
  }
  return false;
}

void Host::Core::copy_layers(Lock& lock, sim::LayerCopy& copy, bool may_unlock) {
  using CopyState = sim::LayerStack::CopyState;
  std::unique_lock<std::mutex> one_at_a_time(copy_mutex_, std::defer_lock);
  if (may_unlock) {
    lock.unlock();
    one_at_a_time.lock();
    lock = lock_with_priority();
  }
  int beginnings = 0;
  std::size_t copied = 0;
  for (;;) {
    sim::LayerStack& layers = simulation_.layers();
    const bool all = !may_unlock || beginnings > kMostBeginnings ||
                     copied > kMostPasses * layers.layers().size() * cells_of(layers.description());
    const CopyState state =
        layers.copy_some(copy, all ? std::numeric_limits<std::size_t>::max() : kPiece);
    if (state == CopyState::kComplete) return;
    copied += kPiece;
    if (!all) lock.unlock();
    if (state == CopyState::kNeedsMemory) {
      ++beginnings;
      copied = 0;
      copy.allocate();
    }
    if (all) continue;
    yield_to_priority_waiters();
    lock = lock_with_priority();
  }
}

void Host::Core::require_not_writing() const {
  if (!writing_) return;
  throw SessionError(SessionError::Code::kFinished,
                     "the simulated run is over, and its results are being written");
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
    const int most = static_cast<int>(
        std::max<std::size_t>(copy.piece() / static_cast<std::size_t>(canvas.width), 1));
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

    static std::size_t piece() { return kPiece; }
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

    [[nodiscard]] std::size_t piece() const { return layer ? kPiece : kComposedPiece; }
    void make_room(const sim::CanvasDescription& size) const { rgba.resize(4 * cells_of(size)); }
    void rows(sim::LayerStack& layers, const LayerRegistry& registry, int row, int count) const {
      if (layer) registry.require(client, *layer);
      const std::size_t line = 4 * static_cast<std::size_t>(layers.width());
      const auto to = std::span(rgba).subspan(static_cast<std::size_t>(row) * line,
                                              static_cast<std::size_t>(count) * line);
      if (layer) return layers.picture_rows(*layer, row, to);
      layers.composed_rows(row, to);
    }
  };
  std::vector<std::uint8_t> rgba;
  canvas = copy_in_pieces(client, Copy{client.number, layer, rgba});
  return rgba;
}

sim::LayerId Host::Core::create_layer(Client& client, const CreateLayerRequest& what) {
  LayerRegistry::Freed freed;  // after the mutex was unlocked
  const sim::CanvasDescription canvas = with_layers(
      client,
      [](const sim::LayerStack& layers, const LayerRegistry&) { return layers.description(); });
  auto cells = sim::LayerStack::blank_cells(what.kind, canvas.width, canvas.height);
  return with_layers(client, [&](sim::LayerStack& layers, LayerRegistry& registry) {
    require_not_writing();
    return registry.create(layers, client.number, client.port, what.kind, what.style,
                           std::move(cells), &freed);
  });
}

void Host::Core::remove_layer(Client& client, sim::LayerId layer) {
  LayerRegistry::Freed freed;  // after the mutex was unlocked
  with_layers(client, [&](sim::LayerStack& layers, LayerRegistry& registry) {
    require_not_writing();
    registry.remove(layers, client.number, layer, &freed);
  });
}

void Host::Core::resize_canvas(Client& client, int width, int height) {
  sim::LayerCopy copy(width, height);  // frees the old memory after the mutex was unlocked
  Lock lock = lock_with_priority();
  const auto check = [&] {
    client.require_open();
    require_not_writing();
    inputs_.registry.require_size(simulation_.layers(), width, height);
    if (const auto refusal = simulation_.canvas_refusal(width, height)) {
      throw SessionError(SessionError::Code::kNotAvailable, *refusal);
    }
  };
  check();
  copy_layers(lock, copy);
  check();
  // Pending drawings of all clients refer to the old size.
  for (const auto& c : clients_) inputs_.apply_drawings(*c);
  sim::LayerStack& layers = simulation_.layers();
  const auto all = std::numeric_limits<std::size_t>::max();
  while (layers.copy_some(copy, all) != sim::LayerStack::CopyState::kComplete) copy.allocate();
  if (layers.width() != width || layers.height() != height) layers.resize(copy);
  canvas_generation_.fetch_add(1, std::memory_order_acq_rel);
  lock.unlock();
}

}  // namespace playerlike
