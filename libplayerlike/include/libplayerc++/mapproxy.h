// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// The true occupancy grid of the world: free floor, and floor that is occupied by borders, walls
/// and extended obstacles. It does not contain robots.
///
/// All robots share one map, with index 0 on every port. It has the cell size of the world's
/// grid-map (0.02 m in the SyRoTek arena) and covers the whole floor. Rows are counted from the
/// BOTTOM, as in Player: the lower left corner of cell (x, y) is (GetOriginX() + x *
/// GetResolution(), GetOriginY() + y * GetResolution()). (On the canvas, row 0 is at the top.)
///
/// Before the first RequestMap() there is no map, and all sizes are 0. Only RequestMap() makes the
/// proxy valid and fresh. Obstacles may be extended and retracted during a run; call RequestMap()
/// again to see such changes.
class MapProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice for an index other than 0, or on a port without robots.
  MapProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~MapProxy() override;

  /// Fetches the current map.
  /// @throws PlayerError kDisconnected if the client is gone.
  void RequestMap();

  /// Index of cell (x, y) in the array of all cells: x + y * GetWidth(). The arguments are not
  /// checked.
  int GetCellIndex(int x, int y) const;
  /// What a cell holds: -1 free, 0 unknown, 1 occupied. The simulator's map knows all.
  /// A cell outside of the map reads 0; a warning on standard error says so, once for each proxy.
  int8_t GetCell(int x, int y) const;

  double GetResolution() const;  ///< side length of a cell [m]
  uint32_t GetWidth() const;     ///< number of columns
  uint32_t GetHeight() const;    ///< number of rows
  double GetOriginX() const;     ///< left edge of column 0 in W [m]
  double GetOriginY() const;     ///< lower edge of row 0 in W [m]
  int8_t GetDataRange() const;   ///< value of "occupied": 1; "free" is its negative
  /// Copies all cells, in the order of GetCellIndex().
  /// @param aMap  buffer for GetWidth() * GetHeight() cells.
  /// @throws PlayerError kBadArgument for a null pointer, unless there are no cells.
  void GetMap(int8_t* aMap) const;

 private:
  // The following members are guarded by the client's mutex.
  std::vector<int8_t> mCells;
  uint32_t mWidth = 0;
  uint32_t mHeight = 0;
  double mResolution = 0.0;
  double mOriginX = 0.0;
  double mOriginY = 0.0;
};

}  // namespace PlayerCc

namespace std {
/// Prints size, resolution, origin and the cells, top row first: '.' free, '#' occupied, '?'
/// unknown.
std::ostream& operator<<(std::ostream& os, const PlayerCc::MapProxy& c);
}  // namespace std
