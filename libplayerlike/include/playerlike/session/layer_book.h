// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/canvas/layers.h"

namespace playerlike {

/// Who owns which layer of a stack, and what sessions may do with layers: the rules that requests
/// document, for those who implement it. Remembers only; the stack is the simulation's.
///
/// Layers are stacked by port, then by age: unlike the order in which clients connect, that does
/// not depend on how their threads were scheduled. Not thread-safe: its owner serialises.
class LayerBook {
 public:
  /// @param client  number that no other session has had, >= 0.
  /// @param port    of the session.
  /// @throws SessionError as CreateLayerRequest.
  sim::LayerId create(sim::LayerStack& stack, int client, int port, sim::LayerKind kind,
                      sim::LayerStyle style);
  /// @throws SessionError as RemoveLayerRequest.
  void remove(sim::LayerStack& stack, int client, sim::LayerId layer);
  /// @throws SessionError as SetLayerStyleRequest.
  void set_style(sim::LayerStack& stack, int client, sim::LayerId layer, sim::LayerStyle style);
  /// @throws SessionError as ResizeCanvasRequest.
  void require_size(const sim::LayerStack& stack, int width, int height) const;
  /// @param zeros  see sim::LayerStack::resize(). @return memory that is no longer used.
  /// @throws SessionError as ResizeCanvasRequest.
  std::vector<std::vector<std::uint8_t>> resize(sim::LayerStack& stack, int width, int height,
                                                std::vector<std::vector<std::uint8_t>> zeros = {});

  /// The base layer and the client's own, lowest first.
  [[nodiscard]] std::vector<sim::LayerInfo> list(const sim::LayerStack& stack, int client) const;
  /// Whether it is the base layer or one of the client's.
  [[nodiscard]] bool may_use(int client, sim::LayerId layer) const noexcept {
    return layer == sim::kBaseLayer || owns(client, layer);
  }
  /// Throws SessionError kBadArgument unless may_use().
  void require(int client, sim::LayerId layer) const;
  /// The session has ended: its layers stay, without an owner.
  void leave(int client) noexcept;

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
  void make_room(sim::LayerStack& stack, int client);

  std::vector<Entry> entries_;  // oldest first
};

/// Throws SessionError kBadArgument unless a rectangle has that many cells.
void require_cells(const sim::CellRect& rect, std::size_t count);

}  // namespace playerlike
