// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Drawing in metres on the arena's floor.
///
/// Points are positions in the world W [m], whatever robot the proxy belongs to (in Stage they move
/// with the robot). Each proxy draws on a layer of the grid-map of its own, called "graphics2d", or
/// "graphics2d_1", "graphics2d_2", ... if that name is taken; so Clear() leaves alone what others
/// have drawn. The layer has priority 100, above those of WindowProxy unless told otherwise. It
/// stays for the run's pictures when the proxy goes; the client's next proxy that gets its name
/// clears it.
///
/// What lies outside the grid-map is clipped. Points that are not finite, a null array with a
/// count, and a negative count are refused with PlayerError kBadArgument; a call whose client is
/// gone throws kDisconnected. Threads: all members may be called from any thread.
class Graphics2dProxy : public ClientProxy {
 public:
  /// @param aIndex  on a robot's own port the robot's pens, counted from 0; on port 4000 the robot.
  /// @throws PlayerError kNoSuchDevice if there is no such device; the text names those there are.
  Graphics2dProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~Graphics2dProxy() override;

  /// Colour of what is drawn from now on, alpha 255 opaque; at first opaque black. Alpha 0 is taken
  /// as opaque too: nothing could be seen of it, and programs written for Stage leave it at 0.
  void Color(player_color_t col);
  void Color(uint8_t red, uint8_t green, uint8_t blue, uint8_t alpha);

  /// Wipes the proxy's layer.
  void Clear();
  /// The cell of each point.
  void DrawPoints(player_point_2d_t pts[], int count);
  /// A closed polygon: its inside in fill_color, if filled (by the even-odd rule), then its outline
  /// in the proxy's colour.
  void DrawPolygon(player_point_2d_t pts[], int count, bool filled, player_color_t fill_color);
  /// Lines from each point to the next.
  void DrawPolyline(player_point_2d_t pts[], int count);
  /// A line for each pair of points: the first with the second, the third with the fourth, ... An
  /// odd one out at the end is left out.
  void DrawMultiline(player_point_2d_t pts[], int count);

 protected:
  void Subscribe(uint32_t aIndex) override;
  void Unsubscribe() override;

 private:
  class Sheet;  // the layer
  std::unique_ptr<Sheet> mSheet;
};

}  // namespace PlayerCc

namespace std {
/// Prints the interface, index and state of the proxy.
std::ostream& operator<<(std::ostream& os, const PlayerCc::Graphics2dProxy& c);
}  // namespace std
