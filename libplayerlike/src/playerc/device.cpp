// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerc/device.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <string>

#include "core/errors.h"
#include "proxies/link.h"

namespace playerlike::clib {

using PlayerCc::ClientProxy;

Device::~Device() {
  if (client_ != nullptr) client_->remove(*this);
  playerc_device_term(&common_);
}

void Device::begin(playerc_client_t* client, int code, int index) {
  if (index < 0 || index > std::numeric_limits<std::uint16_t>::max()) {
    refuse("there is no index " + std::to_string(index));
  }
  playerc_device_init(&common_, client, code, index, nullptr);
  common_.id = &common_;  // the struct begins with it
  if (client == nullptr) return;
  client_ = &Client::of(client);
  client_->add(*this);
}

void Device::subscribe(int access) {
  if (access == PLAYERC_CLOSE_MODE) return unsubscribe();
  if (common_.subscribed != 0) return;
  if (client_ == nullptr) refuse("the device has no client");
  PlayerCc::PlayerClient& player = client_->player();
  attach(player);
  ClientProxy* const made = proxy();
  if (made == nullptr) refuse("there is no way to use this device");
  std::fill(std::begin(common_.drivername), std::end(common_.drivername), '\0');
  made->GetDriverName().copy(common_.drivername, sizeof common_.drivername - 1);
  common_.addr.robot = player.GetPort();
  common_.subscribed = 1;
  client_->apply_replace_rules(*this);
  made->ConnectReadSignal([this] {
    if (has_news()) client_->note_arrival(*this);
  });
}

void Device::unsubscribe() noexcept {
  detach();
  common_.subscribed = 0;
  if (client_ != nullptr) client_->forget_arrival(*this);
}

void Device::client_is_gone() noexcept {
  unsubscribe();
  client_ = nullptr;
  common_.client = nullptr;
}

void* Device::deliver() {
  void* const id = common_.id;
  std::function<void()> report_events;
  if (ClientProxy* const made = proxy()) {
    common_.lasttime = common_.datatime;
    common_.datatime = made->GetDataTime();
    refresh();
    report_events = take_events();
    common_.fresh = 1;
    client_->lasttime = client_->datatime;
    client_->datatime = common_.datatime;
  }
  // A callback may remove callbacks or destroy the device, so the loop works on a copy.
  const playerc_device_t told = common_;
  if (report_events) report_events();
  for (int i = 0; i < told.callback_count; ++i) told.callback[i](told.callback_data[i]);
  return id;
}

std::string driver_at(PlayerCc::PlayerClient& player, int code, int index) {
  return translated("", [&] {
    const char* const name = PlayerCc::interface_name(code);
    if (name == nullptr) refuse("there is no interface with the code " + std::to_string(code));
    const ClientCore& core = *PlayerCc::detail::CoreAccess::get(player);
    return PlayerCc::driver_name(
        core, find_interface(core.robots(), static_cast<int>(player.GetPort()), name, index));
  });
}

namespace {

// The device of a common part; null for a null pointer and for a struct that a program made itself.
Device* behind(const playerc_device_t* device) {
  if (device == nullptr || device->client == nullptr) return nullptr;
  return Client::of(device->client).find(device);
}

Device& require(const playerc_device_t* device) {
  Device* const found = behind(device);
  if (found == nullptr) {
    refuse(device == nullptr ? "the device is a null pointer"
                             : "the device was not made by this library, for a client that exists");
  }
  return *found;
}

ClientProxy& require_proxy(const playerc_device_t* device) {
  ClientProxy* const proxy = require(device).proxy();
  if (proxy == nullptr) refuse("the device is not subscribed to");
  return *proxy;
}

// Throws with an explanation unless a proxy's property call returned 0.
void require_done(int result, const char* property) {
  if (result == 0) return;
  refuse("the device has no property \"" + std::string(property == nullptr ? "" : property) +
         "\" of that type that could be asked for or changed");
}

}  // namespace
}  // namespace playerlike::clib

using playerlike::clib::guarded;
using playerlike::clib::reported;
using playerlike::clib::require;
using playerlike::clib::require_done;
using playerlike::clib::require_proxy;

void playerc_device_init(playerc_device_t* device, playerc_client_t* client, int code, int index,
                         playerc_putmsg_fn_t putmsg) {
  if (device == nullptr) return;
  *device = playerc_device_t();
  device->id = device;
  device->client = client;
  device->addr.robot = client == nullptr ? 0U : static_cast<uint32_t>(client->port);
  device->addr.interf = static_cast<uint16_t>(code);
  device->addr.index = static_cast<uint16_t>(index);
  device->putmsg = putmsg;
  if (client != nullptr) playerc_client_adddevice(client, device);
}

void playerc_device_term(playerc_device_t* device) {
  if (device == nullptr || device->client == nullptr) return;
  playerc_client_deldevice(device->client, device);
  device->client = nullptr;
}

int playerc_device_subscribe(playerc_device_t* device, int access) {
  return reported(__func__, [&] { require(device).subscribe(access); });
}

int playerc_device_unsubscribe(playerc_device_t* device) {
  return guarded(__func__, [&] { require(device).unsubscribe(); });
}

int playerc_device_hascapability(playerc_device_t* device, uint32_t type, uint32_t subtype) {
  const int has =
      guarded(__func__, [&] { return require_proxy(device).HasCapability(type, subtype); });
  return has > 0 ? 1 : 0;
}

int playerc_device_get_boolprop(playerc_device_t* device, char* property, BOOL* value) {
  return guarded(__func__, [&] {
    bool found = false;
    require_done(require_proxy(device).GetBoolProp(property, &found), property);
    if (value != nullptr) *value = found ? 1 : 0;
  });
}

int playerc_device_set_boolprop(playerc_device_t* device, char* property, BOOL value) {
  return guarded(__func__, [&] {
    require_done(require_proxy(device).SetBoolProp(property, value != 0), property);
  });
}

int playerc_device_get_intprop(playerc_device_t* device, char* property, int32_t* value) {
  return guarded(
      __func__, [&] { require_done(require_proxy(device).GetIntProp(property, value), property); });
}

int playerc_device_set_intprop(playerc_device_t* device, char* property, int32_t value) {
  return guarded(
      __func__, [&] { require_done(require_proxy(device).SetIntProp(property, value), property); });
}

int playerc_device_get_dblprop(playerc_device_t* device, char* property, double* value) {
  return guarded(
      __func__, [&] { require_done(require_proxy(device).GetDblProp(property, value), property); });
}

int playerc_device_set_dblprop(playerc_device_t* device, char* property, double value) {
  return guarded(
      __func__, [&] { require_done(require_proxy(device).SetDblProp(property, value), property); });
}

int playerc_device_get_strprop(playerc_device_t* device, char* property, char** value) {
  return guarded(
      __func__, [&] { require_done(require_proxy(device).GetStrProp(property, value), property); });
}

int playerc_device_set_strprop(playerc_device_t* device, char* property, char* value) {
  return guarded(
      __func__, [&] { require_done(require_proxy(device).SetStrProp(property, value), property); });
}
