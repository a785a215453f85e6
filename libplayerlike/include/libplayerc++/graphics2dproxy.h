// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Drawing in metres on the arena's floor.
///
/// Points are positions in the world frame W [m], for the proxies of all robots. (In Stage they
/// move with the robot.)
///
/// Each proxy draws on its own layer of the grid-map, named "graphics2d", or "graphics2d_1",
/// "graphics2d_2", ... if that name is taken. Clear() therefore does not affect other drawings. The
/// layer has priority 100, which is above the default priority of WindowProxy's layers. It stays in
/// the run's pictures after the proxy is destroyed; the client's next proxy with this layer name
/// clears it.
///
/// Drawings are clipped to the grid-map.
///
/// With a Player server (`player://HOST`), the server's device draws, by its own rules: in Stage
/// the drawings move with the robot, alpha 0 is opaque and 255 invisible, and the window shows
/// them.
///
/// Errors: PlayerError kBadArgument for points that are not finite, for a null array with a count
/// above 0, and for a negative count; kDisconnected if the client is gone.
///
/// Threads: all members may be called from any thread.
class Graphics2dProxy : public ClientProxy {
 public:
  class Sheet;  ///< private to the library

  /// @param aIndex  on a robot's own port, index among its pens; on port 4000, the robot's number.
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  Graphics2dProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~Graphics2dProxy() override;

  /// Sets the colour of the following drawings; initially opaque black. Alpha 255 is opaque. Alpha
  /// 0 is opaque too, because programs written for Stage leave it at 0 and would draw nothing
  /// visible.
  void Color(player_color_t col);
  void Color(uint8_t red, uint8_t green, uint8_t blue, uint8_t alpha);

  /// Clears the proxy's layer.
  void Clear();
  /// Draws the cell of each point.
  void DrawPoints(player_point_2d_t pts[], int count);
  /// Draws a closed polygon: first its interior in fill_color, if filled is true (even-odd rule),
  /// then its outline in the proxy's colour.
  void DrawPolygon(player_point_2d_t pts[], int count, bool filled, player_color_t fill_color);
  /// Draws lines from each point to the next.
  void DrawPolyline(player_point_2d_t pts[], int count);
  /// Draws a line for each pair of points: the first and second, the third and fourth, ... The last
  /// point of an odd count is ignored.
  void DrawMultiline(player_point_2d_t pts[], int count);

 protected:
  void Subscribe(uint32_t aIndex) override;
  void Unsubscribe() override;

 private:
  std::unique_ptr<Sheet> mSheet;
};

}  // namespace PlayerCc

namespace std {
/// Prints the interface, index and state of the proxy.
std::ostream& operator<<(std::ostream& os, const PlayerCc::Graphics2dProxy& c);
}  // namespace std
