// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// The true occupancy grid of the world: floor that is free, and floor that borders, walls and
/// extended obstacles stand on. Robots are not in it.
///
/// It is one for all robots: index 0 on every port. Cells are those of the world's grid-map (0.02 m
/// in the SyRoTek arena), but the grid is as large as the floor, and its rows are counted from the
/// BOTTOM, as always in Player: cell (x, y) reaches from GetOriginX() + x * GetResolution() to the
/// right and from GetOriginY() + y * GetResolution() up. (On the canvas row 0 is the top one.)
///
/// There is no map, and all sizes are 0, until RequestMap() was called; nothing else makes the
/// proxy valid and fresh. As obstacles may be extended and retracted while the world runs, call it
/// again whenever that matters.
class MapProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice for an index that is not 0, or a port without robots.
  MapProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~MapProxy() override;

  /// Fetches the map as it is now. @throws PlayerError kDisconnected if the client is gone.
  void RequestMap();

  /// Place of cell (x, y) in a list of all cells: x + y * GetWidth(), whether there is such a cell
  /// or not.
  int GetCellIndex(int x, int y) const;
  /// What a cell holds: -1 free, 0 unknown, 1 occupied. The simulator's map knows all.
  /// A cell outside of the map reads 0; a warning on standard error says so, once for each proxy.
  int8_t GetCell(int x, int y) const;

  double GetResolution() const;  ///< side of a cell [m]
  uint32_t GetWidth() const;     ///< columns
  uint32_t GetHeight() const;    ///< rows
  double GetOriginX() const;     ///< left edge of column 0 in W [m]
  double GetOriginY() const;     ///< lower edge of row 0 in W [m]
  int8_t GetDataRange() const;   ///< what "occupied" is: 1; "free" is the same with a minus
  /// Copies all cells, in the order of GetCellIndex().
  /// @param aMap  room for GetWidth() * GetHeight() cells.
  /// @throws PlayerError kBadArgument for a null pointer, unless there are no cells.
  void GetMap(int8_t* aMap) const;

 private:
  // All of these are guarded by the client's mutex.
  std::vector<int8_t> mCells;
  uint32_t mWidth = 0;
  uint32_t mHeight = 0;
  double mResolution = 0.0;
  double mOriginX = 0.0;
  double mOriginY = 0.0;
};

}  // namespace PlayerCc

namespace std {
/// Prints size, resolution and origin, and the map: '.' free, '#' occupied, '?' unknown, the top
/// row first.
std::ostream& operator<<(std::ostream& os, const PlayerCc::MapProxy& c);
}  // namespace std
