// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "libplayerc++/simulationproxy.h"
#include "playerc/device.h"
#include "proxies/simulation_proxy.h"

namespace {

using playerlike::clib::refuse;
using playerlike::clib::store_result;

class Simulation final
    : public playerlike::clib::ProxyBacked<playerc_simulation_t, PlayerCc::SimulationProxy> {};

template <typename Action>
int with_proxy(const char* fun, playerc_simulation_t* device, Action action) {
  return playerlike::clib::with_device<Simulation>(fun, device, [&](Simulation& self) {
    const playerlike::StrictSimulation strict;
    action(self.proxy_or_throw());
  });
}

}  // namespace

PLAYERLIKE_CLIB_FRAME(simulation, Simulation, PLAYER_SIMULATION_CODE)

int playerc_simulation_set_pose2d(playerc_simulation_t* device, char* name, double gx, double gy,
                                  double ga) {
  return with_proxy(__func__, device,
                    [&](PlayerCc::SimulationProxy& proxy) { proxy.SetPose2d(name, gx, gy, ga); });
}

int playerc_simulation_get_pose2d(playerc_simulation_t* device, char* identifier, double* x,
                                  double* y, double* a) {
  return with_proxy(__func__, device, [&](PlayerCc::SimulationProxy& proxy) {
    player_pose2d_t pose = {0.0, 0.0, 0.0};
    proxy.GetPose2d(identifier, pose.px, pose.py, pose.pa);
    store_result(x, pose.px);
    store_result(y, pose.py);
    store_result(a, pose.pa);
  });
}

int playerc_simulation_set_pose3d(playerc_simulation_t* device, char* name, double gx, double gy,
                                  double gz, double groll, double gpitch, double gyaw) {
  return with_proxy(__func__, device, [&](PlayerCc::SimulationProxy& proxy) {
    proxy.SetPose3d(name, gx, gy, gz, groll, gpitch, gyaw);
  });
}

int playerc_simulation_get_pose3d(playerc_simulation_t* device, char* identifier, double* x,
                                  double* y, double* z, double* roll, double* pitch, double* yaw,
                                  double* time) {
  return with_proxy(__func__, device, [&](PlayerCc::SimulationProxy& proxy) {
    player_pose3d_t pose = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    double now_s = 0.0;
    proxy.GetPose3d(identifier, pose.px, pose.py, pose.pz, pose.proll, pose.ppitch, pose.pyaw,
                    now_s);
    store_result(x, pose.px);
    store_result(y, pose.py);
    store_result(z, pose.pz);
    store_result(roll, pose.proll);
    store_result(pitch, pose.ppitch);
    store_result(yaw, pose.pyaw);
    store_result(time, now_s);
  });
}

int playerc_simulation_set_property(playerc_simulation_t* device, char* name, char* property,
                                    void* value, size_t value_len) {
  return with_proxy(__func__, device, [&](PlayerCc::SimulationProxy& proxy) {
    proxy.SetProperty(name, property, value, value_len);
  });
}

int playerc_simulation_get_property(playerc_simulation_t* device, char* name, char* property,
                                    void* value, size_t value_len) {
  return with_proxy(__func__, device, [&](PlayerCc::SimulationProxy& proxy) {
    proxy.GetProperty(name, property, value, value_len);
  });
}

int playerc_simulation_pause(playerc_simulation_t* device) {
  return with_proxy(__func__, device, [](PlayerCc::SimulationProxy& /*proxy*/) {
    refuse("clients cannot stop time: it advances only while they read");
  });
}

int playerc_simulation_reset(playerc_simulation_t* device) {
  return with_proxy(__func__, device, [](PlayerCc::SimulationProxy& /*proxy*/) {
    refuse("a run cannot be restarted: place robots with playerc_simulation_set_pose2d()");
  });
}

int playerc_simulation_save(playerc_simulation_t* device) {
  return with_proxy(__func__, device, [](PlayerCc::SimulationProxy& /*proxy*/) {
    refuse("a world cannot be written while it runs");
  });
}
