// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "libplayerc++/gripperproxy.h"
#include "playerc/device.h"

namespace {

using playerlike::clib::ProxyBacked;
using playerlike::clib::with_device;

class Gripper final : public ProxyBacked<playerc_gripper_t, PlayerCc::GripperProxy> {
 public:
  void refresh_geometry() {
    pose = proxy_or_throw().GetPose();
    outer_size = proxy_or_throw().GetOuterSize();
    inner_size = proxy_or_throw().GetInnerSize();
    num_beams = static_cast<uint8_t>(proxy_or_throw().GetNumBeams());
    capacity = static_cast<uint8_t>(proxy_or_throw().GetCapacity());
  }

 private:
  void refresh() override {
    state = static_cast<uint8_t>(proxy_or_throw().GetState());
    beams = proxy_or_throw().GetBeams();
    stored = static_cast<uint8_t>(proxy_or_throw().GetStored());
  }
};

}  // namespace

PLAYERLIKE_CLIB_FRAME(gripper, Gripper, PLAYER_GRIPPER_CODE)

int playerc_gripper_open_cmd(playerc_gripper_t* device) {
  return with_device<Gripper>(__func__, device,
                              [](Gripper& self) { self.proxy_or_throw().Open(); });
}

int playerc_gripper_close_cmd(playerc_gripper_t* device) {
  return with_device<Gripper>(__func__, device,
                              [](Gripper& self) { self.proxy_or_throw().Close(); });
}

int playerc_gripper_stop_cmd(playerc_gripper_t* device) {
  return with_device<Gripper>(__func__, device,
                              [](Gripper& self) { self.proxy_or_throw().Stop(); });
}

int playerc_gripper_store_cmd(playerc_gripper_t* device) {
  return with_device<Gripper>(__func__, device,
                              [](Gripper& self) { self.proxy_or_throw().Store(); });
}

int playerc_gripper_retrieve_cmd(playerc_gripper_t* device) {
  return with_device<Gripper>(__func__, device,
                              [](Gripper& self) { self.proxy_or_throw().Retrieve(); });
}

void playerc_gripper_printout(playerc_gripper_t* device, const char* prefix) {
  if (device == nullptr) return;
  std::printf("%s gripper at %.3f s: state %d, beams 0x%02x, %d stored\n",
              prefix == nullptr ? "" : prefix, device->info.datatime, device->state, device->beams,
              device->stored);
}

int playerc_gripper_get_geom(playerc_gripper_t* device) {
  return with_device<Gripper>(__func__, device, [](Gripper& self) { self.refresh_geometry(); });
}
