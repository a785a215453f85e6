// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/canvas/layers.h"

namespace playerlike {

/// Ownership of a stack's layers and the permissions of sessions, for implementations of sessions.
/// The requests document the rules. This class only stores the owners; the simulation owns the
/// stack.
///
/// Layers are stacked by port, then by age. Unlike the order in which clients connect, this order
/// does not depend on the scheduling of their threads. Not thread-safe: the owner must serialise
/// calls.
class LayerRegistry {
 public:
  /// The cells of removed layers, whose memory may take a while to free.
  using Freed = std::vector<std::unique_ptr<sim::CellRaster>>;

  /// @param client  unique number of the session, >= 0; never reused.
  /// @param port    port of the session.
  /// @param cells   see sim::LayerStack::add().
  /// @param freed   gets the cells of layers that make room; null: they are freed at once.
  /// @throws SessionError for the same errors as CreateLayerRequest.
  sim::LayerId create(sim::LayerStack& stack, int client, int port, sim::LayerKind kind,
                      sim::LayerStyle style, std::unique_ptr<sim::CellRaster> cells = nullptr,
                      Freed* freed = nullptr);
  /// @param freed  gets the cells of the layer; null: they are freed at once.
  /// @throws SessionError for the same errors as RemoveLayerRequest.
  void remove(sim::LayerStack& stack, int client, sim::LayerId layer, Freed* freed = nullptr);
  /// @throws SessionError for the same errors as SetLayerStyleRequest.
  void set_style(sim::LayerStack& stack, int client, sim::LayerId layer, sim::LayerStyle style);
  /// @throws SessionError for the same errors as ResizeCanvasRequest.
  void require_size(const sim::LayerStack& stack, int width, int height) const;

  /// Returns the base layer and the client's layers, lowest first.
  [[nodiscard]] std::vector<sim::LayerInfo> list(const sim::LayerStack& stack, int client) const;
  /// Whether the layer is the base layer or one of the client's.
  [[nodiscard]] bool may_use(int client, sim::LayerId layer) const noexcept {
    return layer == sim::kBaseLayer || owns(client, layer);
  }
  /// Throws SessionError kBadArgument unless may_use().
  void require(int client, sim::LayerId layer) const;
  /// Notes that a session has ended. Its layers remain, without an owner.
  void leave(int client) noexcept;
  /// The same for all sessions.
  void leave_all() noexcept;

 private:
  static constexpr int kNobody = -1;
  struct Entry {
    sim::LayerId layer;
    int client;
    int port;
  };

  [[nodiscard]] bool owns(int client, sim::LayerId layer) const noexcept;
  void require_name(const sim::LayerStack& stack, int client, sim::LayerId layer,
                    const std::string& name) const;
  void make_room(sim::LayerStack& stack, int client, Freed* freed);
  static void remove_from(sim::LayerStack& stack, sim::LayerId layer, Freed* freed);

  std::vector<Entry> entries_;  // oldest first
};

/// Throws SessionError kBadArgument unless a rectangle has that many cells.
void require_cells(const sim::CellRect& rect, std::size_t count);

}  // namespace playerlike
