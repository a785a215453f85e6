// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstring>
#include <limits>
#include <ostream>
#include <string>
#include <type_traits>
#include <utility>

#include "core/errors.h"
#include "core/warnings.h"
#include "libplayerc++/clientproxy.h"
#include "playerlike/session/device_properties.h"
#include "proxies/link.h"
#include "session/player_values.h"
#include "virtual_time/virtual_time.h"

namespace PlayerCc {

using playerlike::translated;

// --- Link

void ClientProxy::Link::on_reading(const sim::SharedReading& reading) {
  refresh(sim::to_seconds(reading->time_ns));
  proxy.HandleReading({reading});
  proxy.mFresh = true;
}

ClientProxy::scoped_lock_t ClientProxy::Link::lock_anyway(int looks) const {
  playerlike::virtual_time::count_data_reads(looks);
  scoped_lock_t lock(core->mutex());
  if (has_readings) core->count_data_reads(looks, newest.valid);
  return lock;
}

ClientProxy::scoped_lock_t ClientProxy::Link::lock(const char* fun, int looks) const {
  scoped_lock_t lock(lock_anyway(looks));
  translated(fun, [&] { core->require_usable(); });
  return lock;
}

ClientProxy::scoped_lock_t ClientProxy::Link::lock_for_command(const char* fun) const {
  playerlike::virtual_time::count_data_reads();  // counts commands, too
  scoped_lock_t lock(core->mutex());
  translated(fun, [&] { core->require_usable(); });
  return lock;
}

void ClientProxy::Link::refresh(double time_s) {
  // Before the first data there are none, so the elapsed time is zero.
  device.lasttime = newest.valid ? device.datatime : time_s;
  device.datatime = time_s;
  device.fresh = 1;
  newest.valid = true;
}

void ClientProxy::Link::on_round() { proxy.HandleRound(); }

bool ClientProxy::Link::on_poll() { return proxy.HandlePoll(); }

std::function<void()> ClientProxy::Link::notification() {
  if (proxy.mReadSignal.empty()) return {};
  return proxy.mReadSignal.call();
}

void ClientProxy::Link::on_close() {
  proxy.mPc = nullptr;
  newest.valid = false;
  device.subscribed = 0;
}

double ClientProxy::Link::property(const std::string& name, double otherwise) const {
  const auto& properties = info().properties;
  const auto it = properties.find(name);
  return it == properties.end() ? otherwise : it->second;
}

bool ClientProxy::Link::has_element(const char* fun, const ElementWords& words, std::int64_t index,
                                    std::size_t count) const {
  if (index >= 0 && static_cast<std::uint64_t>(index) < count) return true;
  if (count > 0) {
    warn_once(fun, std::string("there is no ") + words.one + ' ' + std::to_string(index) + ": " +
                       words.owner_has + ' ' + std::to_string(count) + ", counted from 0; " +
                       words.many + " beyond the last read " + words.value);
  }
  return false;
}

void ClientProxy::Link::warn_once(const char* fun, const std::string& text) const {
  if (std::exchange(*has_warned, true)) return;
  playerlike::warn(std::string(fun) + ": " + text);
}

// --- ClientProxy

ClientProxy::ClientProxy(PlayerClient* aPc, uint32_t aIndex)
    : mPc(aPc), mClient(nullptr), mInfo(nullptr), mFresh(false), mIndex(aIndex) {
  if (aPc == nullptr) {
    playerlike::refuse("ClientProxy::ClientProxy",
                       "a proxy needs a client, but it is a null pointer");
  }
  mLink = std::make_unique<Link>(*this, aPc->mCore);
  mInfo = &mLink->device;
  mInfo->id = this;
}

ClientProxy::ClientProxy(const ClientProxy& aOther)
    : mPc(aOther.GetPlayerClient()),
      mClient(nullptr),
      mInfo(nullptr),
      mFresh(false),
      mIndex(aOther.mIndex) {
  const Link& other = *aOther.mLink;
  mLink = std::make_unique<Link>(*this, other.core);
  mInfo = &mLink->device;
  translated("ClientProxy::ClientProxy", [&] {
    const scoped_lock_t lock(other.core->mutex());
    other.core->require_usable();
    mLink->binding = other.binding;
    mLink->attached = other.attached;
    mLink->has_readings = other.has_readings;
    mLink->show(other.newest.reading, other.whole_scan);
    mLink->newest.valid = other.newest.valid;
    mLink->device = other.device;
    mLink->has_warned = other.has_warned;
    mLink->device.id = this;
    mFresh = aOther.mFresh;
    if (other.core->listens(*aOther.mLink)) other.core->add(other.binding.reading, *mLink);
  });
}

ClientProxy::~ClientProxy() { ClientProxy::Unsubscribe(); }

void ClientProxy::Subscribe(uint32_t aIndex) { mIndex = aIndex; }

void ClientProxy::Unsubscribe() {
  mLink->core->remove(*mLink);
  mReadSignal.disconnect_all_slots();  // no slot may use a partly destroyed proxy
  const scoped_lock_t lock(mLink->core->mutex());
  mLink->attached = false;
  mLink->newest.valid = false;
  mLink->device.subscribed = 0;
}

void ClientProxy::Attach(uint32_t aInterface, uint32_t aIndex, const char* aFun,
                         bool aHasReadings) {
  playerlike::ClientCore& core = *mLink->core;
  const char* name = interface_name(static_cast<int>(aInterface));
  translated(aFun, [&] {
    constexpr auto kMax = static_cast<uint32_t>(std::numeric_limits<std::uint16_t>::max());
    mLink->binding = playerlike::find_interface(core.robots(), core.session().port(), name,
                                                static_cast<int>(std::min(aIndex, kMax)));
    const scoped_lock_t lock(core.mutex());
    playerc_device_t& info = mLink->device;
    info.addr.robot = static_cast<uint32_t>(core.session().port());
    info.addr.interf = static_cast<uint16_t>(aInterface);
    info.addr.index = static_cast<uint16_t>(aIndex);
    info.freshgeom = 1;
    info.freshconfig = 1;
    driver_name(core, mLink->binding).copy(info.drivername, sizeof info.drivername - 1);
    std::optional<bool> replace;
    const auto& rules = core.replace_rules();
    const auto rule = rules.find(static_cast<int>(aInterface));
    if (rule != rules.end()) replace = rule->second;
    if (aHasReadings) core.add(mLink->binding.reading, *mLink, replace);
    mLink->has_readings = aHasReadings;
    mLink->attached = true;
    info.subscribed = 1;
  });
}

ClientProxy::scoped_lock_t ClientProxy::LockData(const char* aFun) const {
  return mLink->lock(aFun);
}

void ClientProxy::HandleReading(const playerlike::NewReading& aNew) { mLink->show(aNew.reading); }

void ClientProxy::HandleRound() {}

void ClientProxy::Poll() { mLink->core->add_poller(*mLink); }

bool ClientProxy::HandlePoll() { return false; }

bool ClientProxy::IsValid() const {
  const scoped_lock_t lock(mLink->lock_anyway());
  return mLink->newest.valid;
}

bool ClientProxy::IsFresh() const {
  const scoped_lock_t lock(mLink->lock_anyway());
  return mFresh;
}

void ClientProxy::NotFresh() {
  const scoped_lock_t lock(mLink->core->mutex());
  mFresh = false;
  mInfo->fresh = 0;
}

std::string ClientProxy::GetDriverName() const {
  const scoped_lock_t lock(LockData("ClientProxy::GetDriverName"));
  return mInfo->drivername;
}

double ClientProxy::GetDataTime() const {
  const scoped_lock_t lock(LockData("ClientProxy::GetDataTime"));
  return mInfo->datatime;
}

double ClientProxy::GetElapsedTime() const {
  const scoped_lock_t lock(LockData("ClientProxy::GetElapsedTime"));
  return mInfo->datatime - mInfo->lasttime;
}

PlayerClient* ClientProxy::GetPlayerClient() const {
  const scoped_lock_t lock(mLink->core->mutex());
  return mPc;
}

uint32_t ClientProxy::GetIndex() const { return mIndex; }

uint32_t ClientProxy::GetInterface() const { return mLink->device.addr.interf; }

std::string ClientProxy::GetInterfaceStr() const {
  const char* name = interface_name(static_cast<int>(GetInterface()));
  return name == nullptr ? "unknown" : name;
}

void ClientProxy::SetReplaceRule(bool aReplace, int aType, int aSubtype) {
  static_cast<void>(aSubtype);
  const char* fun = "ClientProxy::SetReplaceRule";
  const scoped_lock_t lock(LockData(fun));
  if (!mLink->attached || (aType != -1 && aType != PLAYER_MSGTYPE_DATA)) return;
  translated(fun, [&] {
    mLink->core->session().request(playerlike::ReplaceRequest{mLink->binding.reading, aReplace});
  });
}

int ClientProxy::HasCapability(uint32_t aType, uint32_t aSubtype) {
  const scoped_lock_t lock(LockData("ClientProxy::HasCapability"));
  if (!mLink->attached) return 0;
  const bool is_property_query =
      aType == PLAYER_MSGTYPE_REQ &&
      (aSubtype == PLAYER_CAPABILITIES_REQ || aSubtype == PLAYER_GET_BOOLPROP_REQ ||
       aSubtype == PLAYER_GET_INTPROP_REQ || aSubtype == PLAYER_GET_DBLPROP_REQ ||
       aSubtype == PLAYER_GET_STRPROP_REQ);
  // A robot without motors still has position2d devices.
  const bool needs_motors =
      GetInterface() == PLAYER_POSITION2D_CODE &&
      (aType == PLAYER_MSGTYPE_CMD ||
       (aType == PLAYER_MSGTYPE_REQ && aSubtype == PLAYER_POSITION2D_REQ_MOTOR_POWER));
  const bool is_known = has_message(GetInterface(), aType, aSubtype) &&
                        (!needs_motors || mLink->binding.motion.has_value());
  return is_property_query || is_known ? 1 : 0;
}

// --- Properties

namespace {

using playerlike::DeviceProperties;

/// The numeric setting as a value of the type; nothing if it is not one.
template <typename T>
std::optional<T> as_property(double value) {
  if constexpr (std::is_same_v<T, bool>) {
    if (value != 0.0 && value != 1.0) return std::nullopt;
    return value != 0.0;
  } else if constexpr (std::is_same_v<T, std::int32_t>) {
    if (value != std::floor(value) || std::abs(value) > std::numeric_limits<T>::max()) {
      return std::nullopt;
    }
    return static_cast<T>(value);
  } else {
    return value;
  }
}

}  // namespace

template <typename T>
std::optional<T> ClientProxy::Link::named_property(const char* fun, const char* name) const {
  const scoped_lock_t data(lock(fun));
  if (!attached || name == nullptr) return std::nullopt;
  return translated(fun, [&]() -> std::optional<T> {
    if (auto* server = dynamic_cast<DeviceProperties*>(&core->session())) {
      const auto found = server->property(device.addr.interf, device.addr.index, name, T{});
      if (!found) return std::nullopt;
      return std::get<T>(*found);
    }
    if (binding.is_world()) return std::nullopt;
    if constexpr (std::is_same_v<T, std::string>) {
      return playerlike::text_property(robot(), info(), name);
    } else {
      const auto& properties = info().properties;
      const auto it = properties.find(name);
      return it == properties.end() ? std::nullopt : as_property<T>(it->second);
    }
  });
}

template <typename T>
int ClientProxy::Link::set_named_property(const char* fun, const char* name, const T& value) const {
  const scoped_lock_t data(lock(fun));
  auto* const server = dynamic_cast<DeviceProperties*>(&core->session());
  if (!attached || name == nullptr || server == nullptr) return -1;
  return translated(fun, [&] {
    return server->set_property(device.addr.interf, device.addr.index, name, value) ? 0 : -1;
  });
}

int ClientProxy::GetBoolProp(char* aProperty, bool* aValue) {
  const auto value = mLink->named_property<bool>("ClientProxy::GetBoolProp", aProperty);
  if (!value || aValue == nullptr) return -1;
  *aValue = *value;
  return 0;
}

int ClientProxy::GetIntProp(char* aProperty, int32_t* aValue) {
  const auto value = mLink->named_property<int32_t>("ClientProxy::GetIntProp", aProperty);
  if (!value || aValue == nullptr) return -1;
  *aValue = *value;
  return 0;
}

int ClientProxy::GetDblProp(char* aProperty, double* aValue) {
  const auto value = mLink->named_property<double>("ClientProxy::GetDblProp", aProperty);
  if (!value || aValue == nullptr) return -1;
  *aValue = *value;
  return 0;
}

int ClientProxy::GetStrProp(char* aProperty, char** aValue) {
  const auto value = mLink->named_property<std::string>("ClientProxy::GetStrProp", aProperty);
  if (!value || aValue == nullptr) return -1;
  char* const copy = strdup(value->c_str());  // as in Player, the caller frees it
  if (copy == nullptr) return -1;
  *aValue = copy;
  return 0;
}

int ClientProxy::SetBoolProp(char* aProperty, bool aValue) {
  return mLink->set_named_property("ClientProxy::SetBoolProp", aProperty, aValue);
}

int ClientProxy::SetIntProp(char* aProperty, int32_t aValue) {
  return mLink->set_named_property("ClientProxy::SetIntProp", aProperty, aValue);
}

int ClientProxy::SetDblProp(char* aProperty, double aValue) {
  return mLink->set_named_property("ClientProxy::SetDblProp", aProperty, aValue);
}

int ClientProxy::SetStrProp(char* aProperty, char* aValue) {
  if (aValue == nullptr) return -1;
  return mLink->set_named_property("ClientProxy::SetStrProp", aProperty, std::string(aValue));
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::ClientProxy& c) {
  return os << c.GetInterfaceStr() << ':' << c.GetIndex() << (c.IsValid() ? " valid" : " not valid")
            << (c.IsFresh() ? ", fresh" : ", not fresh");
}

}  // namespace std
