// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

#include "libplayerc++/wifiproxy.h"
#include "proxies/link.h"
#include "proxies/sensor_support.h"
#include "sim/devices/wifi.h"

namespace PlayerCc {
namespace {

// Copies a text into an array of bytes and terminates it with a zero.
template <std::size_t size>
void put(const std::string& text, uint8_t (&into)[size]) {
  const std::size_t length = std::min(text.size(), size - 1);
  std::copy_n(text.begin(), length, into);
  into[length] = 0;
}

template <std::size_t size>
char* text_of(uint8_t (&bytes)[size]) {
  return reinterpret_cast<char*>(bytes);
}

}  // namespace

WiFiProxy::WiFiProxy(PlayerClient* aPc, uint32_t aIndex)
    : ClientProxy(aPc, aIndex), mNoLink(), mOwnIp() {
  Attach(PLAYER_WIFI_CODE, aIndex, "WiFiProxy::WiFiProxy");
}

WiFiProxy::~WiFiProxy() { ClientProxy::Unsubscribe(); }

void WiFiProxy::HandleReading(const sim::SharedReading& aReading) {
  const auto* reading = playerlike::reading_as<sim::WifiReading>(*aReading);
  if (reading == nullptr) return;
  mLinks.clear();
  for (const auto& link : reading->links) {
    playerc_wifi_link_t shown = {};
    put(link.mac, shown.mac);
    put(link.ip, shown.ip);
    put(link.name, shown.essid);
    shown.mode = link.access_point ? PLAYER_WIFI_MODE_MASTER : PLAYER_WIFI_MODE_ADHOC;
    shown.freq = reading->channel_mhz;
    shown.qual = sim::link_quality(link.level_dbm);
    shown.level = static_cast<int>(std::lround(link.level_dbm));
    shown.noise = static_cast<int>(std::lround(reading->floor_dbm));
    mLinks.push_back(shown);
  }
  const std::size_t length = std::min(reading->own_ip.size(), sizeof mOwnIp - 1);
  std::copy_n(reading->own_ip.begin(), length, mOwnIp);
  mOwnIp[length] = '\0';
}

// The caller holds the client's mutex.
playerc_wifi_link_t& WiFiProxy::Link(int aIndex, const char* aFun) const {
  if (mLink->has_element(aFun, {"link", "links"}, aIndex, mLinks.size())) {
    return mLinks[static_cast<std::size_t>(aIndex)];
  }
  mNoLink = {};  // the program may have changed its texts
  return mNoLink;
}

const playerc_wifi_link_t* WiFiProxy::GetLink(int aLink) {
  const scoped_lock_t lock(LockData("WiFiProxy::GetLink"));
  const auto index = static_cast<std::size_t>(aLink);
  return aLink >= 0 && index < mLinks.size() ? &mLinks[index] : nullptr;
}

int WiFiProxy::GetLinkCount() const {
  const scoped_lock_t lock(LockData("WiFiProxy::GetLinkCount"));
  return static_cast<int>(mLinks.size());
}

char* WiFiProxy::GetOwnIP() const {
  const scoped_lock_t lock(LockData("WiFiProxy::GetOwnIP"));
  return mOwnIp;
}

char* WiFiProxy::GetLinkIP(int index) const {
  const char* fun = "WiFiProxy::GetLinkIP";
  const scoped_lock_t lock(LockData(fun));
  return text_of(Link(index, fun).ip);
}

char* WiFiProxy::GetLinkMAC(int index) const {
  const char* fun = "WiFiProxy::GetLinkMAC";
  const scoped_lock_t lock(LockData(fun));
  return text_of(Link(index, fun).mac);
}

char* WiFiProxy::GetLinkESSID(int index) const {
  const char* fun = "WiFiProxy::GetLinkESSID";
  const scoped_lock_t lock(LockData(fun));
  return text_of(Link(index, fun).essid);
}

double WiFiProxy::GetLinkFreq(int index) const {
  const char* fun = "WiFiProxy::GetLinkFreq";
  const scoped_lock_t lock(LockData(fun));
  return Link(index, fun).freq;
}

int WiFiProxy::GetLinkMode(int index) const {
  const char* fun = "WiFiProxy::GetLinkMode";
  const scoped_lock_t lock(LockData(fun));
  return Link(index, fun).mode;
}

int WiFiProxy::GetLinkEncrypt(int index) const {
  const char* fun = "WiFiProxy::GetLinkEncrypt";
  const scoped_lock_t lock(LockData(fun));
  return Link(index, fun).encrypt;
}

int WiFiProxy::GetLinkQuality(int index) const {
  const char* fun = "WiFiProxy::GetLinkQuality";
  const scoped_lock_t lock(LockData(fun));
  return Link(index, fun).qual;
}

int WiFiProxy::GetLinkLevel(int index) const {
  const char* fun = "WiFiProxy::GetLinkLevel";
  const scoped_lock_t lock(LockData(fun));
  return Link(index, fun).level;
}

int WiFiProxy::GetLinkNoise(int index) const {
  const char* fun = "WiFiProxy::GetLinkNoise";
  const scoped_lock_t lock(LockData(fun));
  return Link(index, fun).noise;
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::WiFiProxy& c) {
  os << '#' << static_cast<const PlayerCc::ClientProxy&>(c)
     << "\n#name\taddress\tlevel [dBm]\tquality [%]\n";
  for (int i = 0; i < c.GetLinkCount(); ++i) {
    os << c.GetLinkESSID(i) << '\t' << c.GetLinkIP(i) << '\t' << c.GetLinkLevel(i) << '\t'
       << c.GetLinkQuality(i) << '\n';
  }
  return os;
}

}  // namespace std
