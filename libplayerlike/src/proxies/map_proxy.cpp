// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

#include "core/errors.h"
#include "libplayerc++/mapproxy.h"
#include "proxies/link.h"
#include "session/player_values/map.h"
#include "sim/world/occupancy_map.h"

namespace PlayerCc {

MapProxy::MapProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  Attach(PLAYER_MAP_CODE, aIndex, "MapProxy::MapProxy", false);
}

MapProxy::~MapProxy() { ClientProxy::Unsubscribe(); }

void MapProxy::RequestMap() {
  const char* fun = "MapProxy::RequestMap";
  const scoped_lock_t lock(LockData(fun));
  playerlike::translated(fun, [&] {
    playerlike::Session& session = mLink->core->session();
    const sim::OccupancyMap map =
        session
            .request(playerlike::WorldMapRequest{
                session.request(playerlike::CanvasInfoRequest{}).cell_size_m})
            .map;
    mCells = playerlike::map_cells(map);
    mWidth = static_cast<uint32_t>(map.width);
    mHeight = static_cast<uint32_t>(map.height);
    mResolution = map.cell_size_m;
    mOriginX = map.origin.x();
    mOriginY = map.origin.y();
    mLink->refresh(sim::to_seconds(session.request(playerlike::TimeRequest{}).sim_time_ns));
    mFresh = true;
  });
}

int MapProxy::GetCellIndex(int x, int y) const {
  const scoped_lock_t lock(LockData("MapProxy::GetCellIndex"));
  return x + y * static_cast<int>(mWidth);
}

int8_t MapProxy::GetCell(int x, int y) const {
  const char* fun = "MapProxy::GetCell";
  const scoped_lock_t lock(LockData(fun));
  if (x < 0 || y < 0 || static_cast<uint32_t>(x) >= mWidth || static_cast<uint32_t>(y) >= mHeight) {
    mLink->warn_once(fun,
                     "there is no cell (" + std::to_string(x) + ", " + std::to_string(y) + "): " +
                         (mCells.empty() ? std::string("there is no map yet (call RequestMap())")
                                         : "the map has " + std::to_string(mWidth) + " x " +
                                               std::to_string(mHeight) + " cells, counted from 0") +
                         "; cells outside of the map read 0: unknown");
    return 0;
  }
  return mCells[static_cast<std::size_t>(y) * mWidth + static_cast<std::size_t>(x)];
}

double MapProxy::GetResolution() const { return GetVar(mResolution); }
uint32_t MapProxy::GetWidth() const { return GetVar(mWidth); }
uint32_t MapProxy::GetHeight() const { return GetVar(mHeight); }
double MapProxy::GetOriginX() const { return GetVar(mOriginX); }
double MapProxy::GetOriginY() const { return GetVar(mOriginY); }

int8_t MapProxy::GetDataRange() const {
  const scoped_lock_t lock(LockData("MapProxy::GetDataRange"));
  return playerlike::kMapDataRange;
}

void MapProxy::GetMap(int8_t* aMap) const {
  const char* fun = "MapProxy::GetMap";
  const scoped_lock_t lock(LockData(fun));
  if (aMap == nullptr && !mCells.empty()) {
    playerlike::refuse(
        fun, "needs room for " + std::to_string(mCells.size()) + " cells, but got a null pointer");
  }
  std::copy(mCells.begin(), mCells.end(), aMap);
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::MapProxy& c) {
  os << '#' << static_cast<const PlayerCc::ClientProxy&>(c)
     << "\n#columns\trows\tresolution [m]\torigin x [m]\torigin y [m]\n"
     << c.GetWidth() << '\t' << c.GetHeight() << '\t' << c.GetResolution() << '\t' << c.GetOriginX()
     << '\t' << c.GetOriginY() << '\n';
  const int width = static_cast<int>(c.GetWidth());
  std::vector<int8_t> cells(c.GetWidth() * static_cast<std::size_t>(c.GetHeight()));
  c.GetMap(cells.data());
  for (int y = static_cast<int>(c.GetHeight()) - 1; y >= 0; --y) {
    for (int x = 0; x < width; ++x) {
      const int8_t cell = cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(x)];
      os << (cell < 0 ? '.' : cell > 0 ? '#' : '?');
    }
    os << '\n';
  }
  return os;
}

}  // namespace std
