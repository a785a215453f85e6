// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "libplayerc++/graphics2dproxy.h"
#include "playerc/device.h"

namespace {

class Graphics2d final
    : public playerlike::clib::ProxyBacked<playerc_graphics2d_t, PlayerCc::Graphics2dProxy> {};

template <typename Action>
int with_proxy(const char* fun, playerc_graphics2d_t* device, Action action) {
  return playerlike::clib::with_device<Graphics2d>(
      fun, device, [&](Graphics2d& self) { action(self.proxy_or_throw()); });
}

}  // namespace

PLAYERLIKE_CLIB_FRAME(graphics2d, Graphics2d, PLAYER_GRAPHICS2D_CODE)

int playerc_graphics2d_setcolor(playerc_graphics2d_t* device, player_color_t col) {
  return with_proxy(__func__, device, [&](PlayerCc::Graphics2dProxy& proxy) {
    proxy.Color(col);
    device->color = col;
  });
}

int playerc_graphics2d_draw_points(playerc_graphics2d_t* device, player_point_2d_t pts[],
                                   int count) {
  return with_proxy(__func__, device,
                    [&](PlayerCc::Graphics2dProxy& proxy) { proxy.DrawPoints(pts, count); });
}

int playerc_graphics2d_draw_polyline(playerc_graphics2d_t* device, player_point_2d_t pts[],
                                     int count) {
  return with_proxy(__func__, device,
                    [&](PlayerCc::Graphics2dProxy& proxy) { proxy.DrawPolyline(pts, count); });
}

int playerc_graphics2d_draw_multiline(playerc_graphics2d_t* device, player_point_2d_t pts[],
                                      int count) {
  return with_proxy(__func__, device,
                    [&](PlayerCc::Graphics2dProxy& proxy) { proxy.DrawMultiline(pts, count); });
}

int playerc_graphics2d_draw_polygon(playerc_graphics2d_t* device, player_point_2d_t pts[],
                                    int count, int filled, player_color_t fill_color) {
  return with_proxy(__func__, device, [&](PlayerCc::Graphics2dProxy& proxy) {
    proxy.DrawPolygon(pts, count, filled != 0, fill_color);
  });
}

int playerc_graphics2d_clear(playerc_graphics2d_t* device) {
  return with_proxy(__func__, device, [](PlayerCc::Graphics2dProxy& proxy) { proxy.Clear(); });
}
