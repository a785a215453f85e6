// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/devices/device.h"

namespace sim {

/// A wireless access point in the world.
struct AccessPoint {
  std::string name;  ///< network name (SSID)
  Vec2 p_W = Vec2::Zero();

  friend bool operator==(const AccessPoint&, const AccessPoint&) = default;
};

/// Settings of a wireless network card.
struct WifiParams {
  double frequency_hz = 10.0;              ///< readings per simulated second
  double level_1m_dbm = -40.0;             ///< signal level at 1 m from a sender [dBm]
  double exponent = 3.0;                   ///< path loss exponent
  double noise_db = 0.0;                   ///< standard deviation of a level (shadowing) [dB]
  double floor_dbm = -95.0;                ///< channel noise [dBm]
  double least_dbm = -90.0;                ///< weaker links are not listed [dBm]
  double channel_mhz = 2437.0;             ///< carrier frequency, (0, 100 000] [MHz]
  std::vector<AccessPoint> access_points;  ///< at most 64
};

/// Links to robots and access points within range.
struct WifiReading final : Reading {
  /// A received station.
  struct Link {
    std::string name;  ///< robot or network
    std::string mac;   ///< "02:..:..", six pairs of hexadecimal digits
    std::string ip;    ///< "10.0.0.1"
    bool access_point = false;
    double level_dbm = 0.0;  ///< received power [dBm]
  };
  std::vector<Link> links;   ///< robots in the world's order, then access points
  std::string own_ip;        ///< this robot's own address
  double floor_dbm = 0.0;    ///< channel noise [dBm]
  double channel_mhz = 0.0;  ///< carrier frequency [MHz]
};

/// Signal level at a distance by the log-distance path loss model: level(1 m) - 10 n log10(d / 1
/// m), with d at least 0.1 m (Rappaport, Wireless Communications, 2nd ed., 2002, eq. 4.68). The
/// device's noise is the Gaussian shadowing in dB of eq. 4.69.
/// @return [dBm]
[[nodiscard]] double level_at_dbm(const WifiParams& params, double distance_m);

/// Link quality in percent: 0 at -100 dBm and below, 100 at -50 dBm and above, linear between.
[[nodiscard]] int link_quality(double level_dbm);

/// A locally administered hardware address derived from a name: "02" and five bytes of the name's
/// FNV-1a hash.
[[nodiscard]] std::string mac_of(std::string_view name);

/// Address of the n-th robot ("10.0.x.y") or access point ("10.1.x.y"), n from 0, 250 per network.
[[nodiscard]] std::string ip_of(bool access_point, std::size_t n);

/// A wireless card. It receives every other robot that has a card, and the access points of its
/// settings. Only the distance matters; walls do not weaken a signal.
class Wifi final : public SensorOf<WifiReading> {
 public:
  Wifi(std::string name, const WifiParams& params, RandomStream noise);

  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  WifiParams params_;
  RandomStream noise_;
  bool looked_ = false;
  std::vector<std::size_t> peers_;  ///< robots that have a card; found at the first reading
};

}  // namespace sim
