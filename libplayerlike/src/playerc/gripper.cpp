// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "libplayerc++/gripperproxy.h"
#include "playerc/device.h"

namespace {

using playerlike::clib::Backed;
using playerlike::clib::with_device;

class Gripper final : public Backed<playerc_gripper_t, PlayerCc::GripperProxy> {
 public:
  void refresh_geometry() {
    pose = used().GetPose();
    outer_size = used().GetOuterSize();
    inner_size = used().GetInnerSize();
    num_beams = static_cast<uint8_t>(used().GetNumBeams());
    capacity = static_cast<uint8_t>(used().GetCapacity());
  }

 private:
  void refresh() override {
    state = static_cast<uint8_t>(used().GetState());
    beams = used().GetBeams();
    stored = static_cast<uint8_t>(used().GetStored());
  }
};

}  // namespace

PLAYERLIKE_CLIB_FRAME(gripper, Gripper, PLAYER_GRIPPER_CODE)

int playerc_gripper_open_cmd(playerc_gripper_t* device) {
  return with_device<Gripper>(__func__, device, [](Gripper& self) { self.used().Open(); });
}

int playerc_gripper_close_cmd(playerc_gripper_t* device) {
  return with_device<Gripper>(__func__, device, [](Gripper& self) { self.used().Close(); });
}

int playerc_gripper_stop_cmd(playerc_gripper_t* device) {
  return with_device<Gripper>(__func__, device, [](Gripper& self) { self.used().Stop(); });
}

int playerc_gripper_store_cmd(playerc_gripper_t* device) {
  return with_device<Gripper>(__func__, device, [](Gripper& self) { self.used().Store(); });
}

int playerc_gripper_retrieve_cmd(playerc_gripper_t* device) {
  return with_device<Gripper>(__func__, device, [](Gripper& self) { self.used().Retrieve(); });
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
