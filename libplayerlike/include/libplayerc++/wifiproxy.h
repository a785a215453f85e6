// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// A wireless network card: links to robots and access points in reach. Before the first reading
/// there are 0 links, and the own address is "".
///
/// Texts and links that are returned by pointer belong to the proxy and hold until the next Read().
///
/// A link whose index is not below GetLinkCount() reads 0 and "", and a warning on standard error
/// says so, once for each proxy; GetLink() gives a null pointer there.
class WiFiProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if there is no such device; the text names those there are.
  WiFiProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~WiFiProxy() override;

  const playerc_wifi_link_t* GetLink(int aLink);  ///< all of a link
  int GetLinkCount() const;                       ///< robots and access points in reach
  char* GetOwnIP() const;                         ///< this robot's address
  char* GetLinkIP(int index) const;               ///< address of the other end
  char* GetLinkMAC(int index) const;              ///< its hardware address
  char* GetLinkESSID(int index) const;            ///< its name, cut after 31 letters
  double GetLinkFreq(int index) const;            ///< carrier [MHz]
  int GetLinkMode(int index) const;               ///< PLAYER_WIFI_MODE_ADHOC; _MASTER: access point
  int GetLinkEncrypt(int index) const;            ///< 0: none is encrypted
  int GetLinkQuality(int index) const;            ///< percent
  int GetLinkLevel(int index) const;              ///< [dBm], rounded
  int GetLinkNoise(int index) const;              ///< [dBm], rounded

 protected:
  void HandleReading() override;

 private:
  playerc_wifi_link_t& Link(int aIndex, const char* aFun) const;

  mutable std::vector<playerc_wifi_link_t> mLinks;  // mutable: Player hands out their texts
  mutable playerc_wifi_link_t mNoLink;              // what links past the end read
  mutable char mOwnIp[32];
};

}  // namespace PlayerCc

namespace std {
/// Prints the links, one a line: name, address, level, quality.
std::ostream& operator<<(std::ostream& os, const PlayerCc::WiFiProxy& c);
}  // namespace std
