// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>

#include "libplayerinterface/player_constants.h"
#include "session/player_values/fields.h"
#include "sim/devices/wifi.h"

/// @file
/// Player's interface wifi.
namespace playerlike {

/// Copies a text and a zero byte to an array of 32 bytes, or to a list of that many at most. Longer
/// texts are cut.
template <typename Bytes>
void set_text(std::string_view text, Bytes& bytes) {
  constexpr std::size_t kTextRoom = 32;
  text = text.substr(0, kTextRoom - 1);
  if constexpr (requires { bytes.resize(kTextRoom); }) bytes.resize(text.size() + 1);
  *std::copy(text.begin(), text.end(), std::begin(bytes)) = 0;
}
/// The text up to the first zero byte.
template <typename Bytes>
[[nodiscard]] std::string text_in(const Bytes& bytes) {
  return {bytes.begin(), std::find(bytes.begin(), bytes.end(), 0)};
}

/// A received station. Levels are negative numbers, also in unsigned fields.
template <typename Link>
[[nodiscard]] Link wifi_link(const sim::WifiReading& heard, const sim::WifiReading::Link& station) {
  const auto level = [](double dbm) {
    return static_cast<decltype(Link::level)>(static_cast<std::int32_t>(std::lround(dbm)));
  };
  Link link = {};
  set_text(station.mac, link.mac);
  set_text(station.ip, link.ip);
  set_text(station.name, link.essid);
  link.mode = station.access_point ? PLAYER_WIFI_MODE_MASTER : PLAYER_WIFI_MODE_ADHOC;
  constexpr bool kIsWhole = std::is_integral_v<decltype(link.freq)>;
  link.freq = static_cast<decltype(link.freq)>(kIsWhole ? std::round(heard.channel_mhz)
                                                        : heard.channel_mhz);
  link.qual = number_as<decltype(link.qual)>(sim::link_quality(station.level_dbm));
  link.level = level(station.level_dbm);
  link.noise = level(heard.floor_dbm);
  return link;
}

template <typename Data>
[[nodiscard]] sim::WifiReading wifi_reading(const Data& data) {
  sim::WifiReading reading;
  for (const auto& link : data.links) {
    reading.links.push_back({text_in(link.essid), text_in(link.mac), text_in(link.ip),
                             link.mode == PLAYER_WIFI_MODE_MASTER,
                             static_cast<double>(static_cast<std::int32_t>(link.level))});
    if (reading.links.size() > 1) continue;
    reading.floor_dbm = static_cast<std::int32_t>(link.noise);
    reading.channel_mhz = link.freq;
  }
  return reading;
}

}  // namespace playerlike
