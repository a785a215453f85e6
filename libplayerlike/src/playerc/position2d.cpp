// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "libplayerc++/position2dproxy.h"
#include "playerc/device.h"

namespace {

class Position2d final
    : public playerlike::clib::ProxyBacked<playerc_position2d_t, PlayerCc::Position2dProxy> {
  void refresh() override {
    px = proxy_or_throw().GetXPos();
    py = proxy_or_throw().GetYPos();
    pa = proxy_or_throw().GetYaw();
    vx = proxy_or_throw().GetXSpeed();
    vy = proxy_or_throw().GetYSpeed();
    va = proxy_or_throw().GetYawSpeed();
    stall = proxy_or_throw().GetStall() ? 1 : 0;
  }
};

template <typename Action>
int with_proxy(const char* fun, playerc_position2d_t* device, Action action) {
  return playerlike::clib::with_device<Position2d>(
      fun, device, [&](Position2d& self) { action(self.proxy_or_throw()); });
}

}  // namespace

PLAYERLIKE_CLIB_FRAME(position2d, Position2d, PLAYER_POSITION2D_CODE)

int playerc_position2d_enable(playerc_position2d_t* device, int enable) {
  return with_proxy(__func__, device,
                    [&](PlayerCc::Position2dProxy& proxy) { proxy.SetMotorEnable(enable != 0); });
}

int playerc_position2d_get_geom(playerc_position2d_t* device) {
  return with_proxy(__func__, device, [&](PlayerCc::Position2dProxy& proxy) {
    proxy.RequestGeom();
    const player_pose3d_t offset = proxy.GetOffset();
    const player_bbox3d_t size = proxy.GetSize();
    device->pose[0] = offset.px;
    device->pose[1] = offset.py;
    device->pose[2] = offset.pyaw;
    device->size[0] = size.sl;
    device->size[1] = size.sw;
    device->info.freshgeom = 1;
  });
}

int playerc_position2d_set_cmd_vel(playerc_position2d_t* device, double vx, double vy, double va,
                                   int /*state*/) {
  return with_proxy(__func__, device,
                    [&](PlayerCc::Position2dProxy& proxy) { proxy.SetSpeed(vx, vy, va); });
}

int playerc_position2d_set_cmd_pose_with_vel(playerc_position2d_t* device, player_pose2d_t pos,
                                             player_pose2d_t vel, int /*state*/) {
  return with_proxy(__func__, device,
                    [&](PlayerCc::Position2dProxy& proxy) { proxy.GoTo(pos, vel); });
}

int playerc_position2d_set_cmd_vel_head(playerc_position2d_t* device, double vx, double vy,
                                        double pa, int /*state*/) {
  return with_proxy(__func__, device,
                    [&](PlayerCc::Position2dProxy& proxy) { proxy.SetVelHead(vx, vy, pa); });
}

int playerc_position2d_set_cmd_pose(playerc_position2d_t* device, double gx, double gy, double ga,
                                    int /*state*/) {
  return with_proxy(__func__, device,
                    [&](PlayerCc::Position2dProxy& proxy) { proxy.GoTo(gx, gy, ga); });
}

int playerc_position2d_set_cmd_car(playerc_position2d_t* device, double vx, double a) {
  return with_proxy(__func__, device,
                    [&](PlayerCc::Position2dProxy& proxy) { proxy.SetCarlike(vx, a); });
}

int playerc_position2d_set_odom(playerc_position2d_t* device, double ox, double oy, double oa) {
  return with_proxy(__func__, device,
                    [&](PlayerCc::Position2dProxy& proxy) { proxy.SetOdometry(ox, oy, oa); });
}
