// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <vector>

#include "libplayerc++/mapproxy.h"
#include "playerc/device.h"

namespace {

using playerlike::clib::with_device;

class Map final : public playerlike::clib::ProxyBacked<playerc_map_t, PlayerCc::MapProxy> {
 public:
  void request() {
    proxy_or_throw().RequestMap();
    resolution = proxy_or_throw().GetResolution();
    width = static_cast<int>(proxy_or_throw().GetWidth());
    height = static_cast<int>(proxy_or_throw().GetHeight());
    origin[0] = proxy_or_throw().GetOriginX();
    origin[1] = proxy_or_throw().GetOriginY();
    data_range = proxy_or_throw().GetDataRange();
    std::vector<int8_t> all(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    proxy_or_throw().GetMap(all.data());
    cells_.assign(all.begin(), all.end());
    cells = cells_.data();
    info.lasttime = info.datatime;
    info.datatime = proxy_or_throw().GetDataTime();
  }

 private:
  std::vector<char> cells_;
};

}  // namespace

PLAYERLIKE_CLIB_FRAME(map, Map, PLAYER_MAP_CODE)

int playerc_map_get_map(playerc_map_t* device) {
  return with_device<Map>(__func__, device, [](Map& self) { self.request(); });
}

int playerc_map_get_vector(playerc_map_t* device) {
  return with_device<Map>(__func__, device, [](Map& /*self*/) {
    playerlike::clib::refuse(
        "the map is a grid, not a list of segments: use playerc_map_get_map()");
  });
}
