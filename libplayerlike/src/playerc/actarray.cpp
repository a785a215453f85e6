// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Arms: arrays of actuators.
#include <string>
#include <vector>

#include "libplayerc++/actarrayproxy.h"
#include "playerc/device.h"

namespace {

using playerlike::clib::copied;
using playerlike::clib::ProxyBacked;
using playerlike::clib::refuse;
using playerlike::clib::with_device;

class ActArray final : public ProxyBacked<playerc_actarray_t, PlayerCc::ActArrayProxy> {
 public:
  void refresh_geometry() {
    // The geometry is known before the first reading, when GetCount() is 0.
    const auto count = static_cast<uint32_t>(joint_count());
    actuators_geom = copied(geometries_, count,
                            [this](uint32_t i) { return proxy_or_throw().GetActuatorGeom(i); });
    actuators_geom_count = count;
    base_pos = proxy_or_throw().GetBasePos();
    base_orientation = proxy_or_throw().GetBaseOrientation();
  }

 private:
  [[nodiscard]] int joint_count() const {
    char key[] = "count";
    int count = 0;
    double number = 0.0;
    if (proxy_or_throw().GetDblProp(key, &number) == 0) count = static_cast<int>(number);
    return count;
  }
  void refresh() override {
    actuators_count = proxy_or_throw().GetCount();
    actuators_data = copied(actuators_, actuators_count,
                            [this](uint32_t i) { return proxy_or_throw().GetActuatorData(i); });
    motor_state = proxy_or_throw().IsPowered() ? 1 : 0;
  }

  std::vector<player_actarray_actuator_t> actuators_;
  std::vector<player_actarray_actuatorgeom_t> geometries_;
};

// The array of a C program, e.g. of positions.
std::vector<float> list_of(const float* values, int count) {
  if (values == nullptr || count < 0) refuse("the list of values is a null pointer or too short");
  return {values, values + count};
}

// An element of a struct's array; all zero if it does not exist.
template <typename Element>
Element element_of(const char* fun, const Element* elements, uint32_t count, uint32_t index) {
  if (elements != nullptr && index < count) return elements[index];
  playerlike::clib::set_error(fun, "there is no joint " + std::to_string(index) + ": there are " +
                                       std::to_string(count) + ", counted from 0");
  return Element();
}

}  // namespace

PLAYERLIKE_CLIB_FRAME(actarray, ActArray, PLAYER_ACTARRAY_CODE)

player_actarray_actuator_t playerc_actarray_get_actuator_data(playerc_actarray_t* device,
                                                              uint32_t index) {
  if (device == nullptr) return {};
  return element_of(__func__, device->actuators_data, device->actuators_count, index);
}

player_actarray_actuatorgeom_t playerc_actarray_get_actuator_geom(playerc_actarray_t* device,
                                                                  uint32_t index) {
  if (device == nullptr) return {};
  return element_of(__func__, device->actuators_geom, device->actuators_geom_count, index);
}

int playerc_actarray_get_geom(playerc_actarray_t* device) {
  return with_device<ActArray>(__func__, device, [](ActArray& self) {
    self.proxy_or_throw().RequestGeometry();
    self.refresh_geometry();
    self.info.freshgeom = 1;
  });
}

// A joint of -1, all joints, is the largest index of a proxy.
int playerc_actarray_position_cmd(playerc_actarray_t* device, int joint, float position) {
  return with_device<ActArray>(__func__, device, [&](ActArray& self) {
    self.proxy_or_throw().MoveTo(static_cast<uint32_t>(joint), position);
  });
}

int playerc_actarray_multi_position_cmd(playerc_actarray_t* device, float* positions,
                                        int positions_count) {
  return with_device<ActArray>(__func__, device, [&](ActArray& self) {
    self.proxy_or_throw().MoveToMulti(list_of(positions, positions_count));
  });
}

int playerc_actarray_speed_cmd(playerc_actarray_t* device, int joint, float speed) {
  return with_device<ActArray>(__func__, device, [&](ActArray& self) {
    self.proxy_or_throw().MoveAtSpeed(static_cast<uint32_t>(joint), speed);
  });
}

int playerc_actarray_multi_speed_cmd(playerc_actarray_t* device, float* speeds, int speeds_count) {
  return with_device<ActArray>(__func__, device, [&](ActArray& self) {
    self.proxy_or_throw().MoveAtSpeedMulti(list_of(speeds, speeds_count));
  });
}

int playerc_actarray_home_cmd(playerc_actarray_t* device, int joint) {
  return with_device<ActArray>(__func__, device,
                               [&](ActArray& self) { self.proxy_or_throw().MoveHome(joint); });
}

int playerc_actarray_current_cmd(playerc_actarray_t* device, int joint, float current) {
  return with_device<ActArray>(__func__, device, [&](ActArray& self) {
    self.proxy_or_throw().SetActuatorCurrent(static_cast<uint32_t>(joint), current);
  });
}

int playerc_actarray_multi_current_cmd(playerc_actarray_t* device, float* currents,
                                       int currents_count) {
  return with_device<ActArray>(__func__, device, [&](ActArray& self) {
    self.proxy_or_throw().SetActuatorCurrentMulti(list_of(currents, currents_count));
  });
}

int playerc_actarray_power(playerc_actarray_t* device, uint8_t enable) {
  return with_device<ActArray>(
      __func__, device, [&](ActArray& self) { self.proxy_or_throw().SetPowerConfig(enable != 0); });
}

int playerc_actarray_brakes(playerc_actarray_t* device, uint8_t enable) {
  return with_device<ActArray>(__func__, device, [&](ActArray& self) {
    self.proxy_or_throw().SetBrakesConfig(enable != 0);
  });
}

int playerc_actarray_speed_config(playerc_actarray_t* device, int joint, float speed) {
  return with_device<ActArray>(__func__, device, [&](ActArray& self) {
    self.proxy_or_throw().SetSpeedConfig(static_cast<uint32_t>(joint), speed);
  });
}

int playerc_actarray_accel_config(playerc_actarray_t* device, int joint, float accel) {
  return with_device<ActArray>(__func__, device, [&](ActArray& self) {
    self.proxy_or_throw().SetAccelerationConfig(static_cast<uint32_t>(joint), accel);
  });
}
