// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A program that includes Player's headers without their folders.
#include <clientproxy.h>
#include <libplayercore/playercore.h>
#include <playerc++.h>
#include <playerc.h>
#include <playerclient.h>
#include <playererror.h>

int main() {
  PlayerCc::PlayerClient robot("localhost");
  robot.RequestDeviceList();
  for (const playerc_device_info_t& device : robot.GetDeviceList()) {
    printf("%s:%d ", interf_to_str(device.addr.interf), device.addr.index);
  }
  printf("\n");
}
