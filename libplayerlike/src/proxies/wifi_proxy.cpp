// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <ostream>

#include "libplayerc++/wifiproxy.h"
#include "proxies/link.h"
#include "session/player_values/wifi.h"

namespace PlayerCc {
namespace {

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

void WiFiProxy::HandleReading(const playerlike::NewReading& aNew) {
  const auto* reading = playerlike::reading_as<sim::WifiReading>(*aNew.reading);
  if (reading == nullptr) return;
  mLinks.clear();
  for (const auto& link : reading->links) {
    mLinks.push_back(playerlike::wifi_link<playerc_wifi_link_t>(*reading, link));
  }
  playerlike::set_text(reading->own_ip, mOwnIp);
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
