// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sim/core/colour.h"
#include "sim/core/pose.h"

namespace playerlike {

/// A drawing for a device that draws by itself, as those of Player's interface graphics2d do. The
/// points are in the device's frame [m]; in Stage it moves with the robot. What alpha means is the
/// device's matter; in Stage 0 is opaque and 255 invisible.
struct DeviceDrawing {
  enum class Kind {
    kClear,  ///< removes this session's drawings
    kPoints,
    kPolyline,   ///< lines from each point to the next
    kMultiline,  ///< a line for each pair of points
    kPolygon,    ///< a closed outline, filled with `fill` if `filled`
  };
  Kind kind = Kind::kClear;
  std::vector<sim::Vec2> points{};
  sim::Colour colour{};
  bool filled = false;
  sim::Colour fill{};
};

/// Draws by devices of a server. Sessions with servers whose devices draw, and that have no canvas,
/// derive from it: those with Player servers.
class DeviceGraphics {
 public:
  /// Sends a drawing to the device with this index of the interface graphics2d.
  /// @throws SessionError kNoSuchDevice, kNotAvailable (the device does not open), kDisconnected.
  virtual void draw(unsigned index, const DeviceDrawing& drawing) = 0;

 protected:
  ~DeviceGraphics() = default;
};

}  // namespace playerlike
