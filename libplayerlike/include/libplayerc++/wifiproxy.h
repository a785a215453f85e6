// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// A wireless network card with links to the robots and access points in range. Before the first
/// reading there are 0 links, and the own address is "".
///
/// Returned pointers to texts and links belong to the proxy and are valid until the next Read().
///
/// A link whose index is not below GetLinkCount() reads 0 and "", and a warning on standard error
/// says so, once for each proxy; GetLink() gives a null pointer there.
class WiFiProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  WiFiProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~WiFiProxy() override;

  const playerc_wifi_link_t* GetLink(int aLink);  ///< all data of a link
  int GetLinkCount() const;                       ///< number of robots and access points in range
  char* GetOwnIP() const;                         ///< this robot's address
  char* GetLinkIP(int index) const;               ///< address of the other end
  char* GetLinkMAC(int index) const;              ///< hardware address of the other end
  char* GetLinkESSID(int index) const;            ///< name of the other end, at most 31 bytes
  double GetLinkFreq(int index) const;            ///< carrier frequency [MHz]
  int GetLinkMode(int index) const;               ///< PLAYER_WIFI_MODE_ADHOC; _MASTER: access point
  int GetLinkEncrypt(int index) const;            ///< always 0: links are not encrypted
  int GetLinkQuality(int index) const;            ///< [%]
  int GetLinkLevel(int index) const;              ///< [dBm], rounded
  int GetLinkNoise(int index) const;              ///< [dBm], rounded

 protected:
  void HandleReading(const playerlike::NewReading& aNew) override;

 private:
  playerc_wifi_link_t& Link(int aIndex, const char* aFun) const;

  mutable std::vector<playerc_wifi_link_t> mLinks;  // mutable: Player hands out their texts
  mutable playerc_wifi_link_t mNoLink;              // value of links past the end
  mutable char mOwnIp[32];
};

}  // namespace PlayerCc

namespace std {
/// Prints the links, one per line: name, address, level, quality.
std::ostream& operator<<(std::ostream& os, const PlayerCc::WiFiProxy& c);
}  // namespace std
