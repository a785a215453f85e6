// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/wifi.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "devices/device_kind.h"
#include "physics/physics_world.h"
#include "sim/core/math.h"
#include "sim/core/number_text.h"
#include "sim/world/description.h"

namespace sim {
namespace {

constexpr double kNearest_m = 0.1;

bool has_card(const RobotDescription& robot) {
  return std::any_of(robot.devices.begin(), robot.devices.end(),
                     [](const DeviceDescription& device) { return device.type == "wifi"; });
}

}  // namespace

double level_at_dbm(const WifiParams& params, double distance_m) {
  return params.level_1m_dbm -
         10.0 * params.exponent * math::log10(std::max(distance_m, kNearest_m));
}

int link_quality(double level_dbm) {
  return static_cast<int>(std::lround(std::clamp(2.0 * (level_dbm + 100.0), 0.0, 100.0)));
}

std::string mac_of(std::string_view name) {
  // FNV-1a, 64 bits: http://www.isthe.com/chongo/tech/comp/fnv/
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : name) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3U;
  }
  std::string mac = "02";
  for (int byte = 0; byte < 5; ++byte) {
    mac += ':';
    mac += hexadecimal_text(hash >> (8 * byte), 2);
  }
  return mac;
}

std::string ip_of(bool access_point, std::size_t n) {
  return std::string("10.") + (access_point ? "1." : "0.") + std::to_string(n / 250) + '.' +
         std::to_string(n % 250 + 1);
}

Wifi::Wifi(std::string name, const WifiParams& params, RandomStream noise)
    : SensorOf(std::move(name), "wifi", params.frequency_hz),
      params_(params),
      noise_(std::move(noise)) {
  auto& first = edit();
  first.floor_dbm = params.floor_dbm;
  first.channel_mhz = params.channel_mhz;
}

void Wifi::measure(const StepContext& context) {
  auto& reading = next(context);
  reading.own_ip = ip_of(false, static_cast<std::size_t>(context.robot));
  const std::vector<RobotDescription>& robots = context.world.robots;
  if (!looked_) {
    for (std::size_t i = 0; i < robots.size(); ++i) {
      if (static_cast<int>(i) != context.robot && has_card(robots[i])) peers_.push_back(i);
    }
    looked_ = true;
  }
  const Vec2 p_WB = context.body.X_WB.position();
  std::vector<WifiReading::Link>& links = reading.links;
  std::size_t count = 0;
  const auto hear = [&](const std::string& name, bool access_point, std::size_t number,
                        const Vec2& p_W) {
    const double level =
        level_at_dbm(params_, (p_W - p_WB).norm()) + noise_.gaussian(params_.noise_db);
    if (level < params_.least_dbm) return;
    if (count == links.size()) links.emplace_back();
    // Usually the same stations are received as last time; then only the level changes.
    WifiReading::Link& link = links[count++];
    if (link.name != name || link.access_point != access_point) {
      link = {name, mac_of(name), ip_of(access_point, number), access_point, level};
    }
    link.level_dbm = level;
  };
  for (const std::size_t i : peers_) {
    hear(robots[i].name, false, i, context.physics.body(static_cast<int>(i)).X_WB.position());
  }
  for (std::size_t i = 0; i < params_.access_points.size(); ++i) {
    hear(params_.access_points[i].name, true, i, params_.access_points[i].p_W);
  }
  links.resize(count);
}

void Wifi::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(noise_);
}

constexpr Field kAccessPoint[] = {
    field<&AccessPoint::name>("name", "", "name of its network")
        .as_name()
        .needed("the name of its network"),
    field<&AccessPoint::p_W>("", "m", "place in the world").within(-kFarthest_m, kFarthest_m),
};
SIM_FIELDS(AccessPoint, kAccessPoint)

constexpr Field kWifiSettings[] = {
    frequency_field<&WifiParams::frequency_hz>(),
    field<&WifiParams::level_1m_dbm>("level_1m", "dBm", "signal 1 m from a sender")
        .within(-200.0, 100.0),
    field<&WifiParams::exponent>("exponent", "",
                                 "path loss exponent: 2 in free space, about 3 in a building")
        .above(0.0, 10.0),
    field<&WifiParams::noise_db>("noise", "dB", "standard deviation of a level (shadowing)")
        .within(0.0, 100.0)
        .with_realism(0.0, 4.0),
    field<&WifiParams::floor_dbm>("floor", "dBm", "noise of the channel").within(-200.0, 100.0),
    field<&WifiParams::least_dbm>("least", "dBm", "weaker links are not listed")
        .within(-200.0, 100.0),
    field<&WifiParams::channel_mhz>("channel", "MHz", "carrier").above(0.0, 100'000.0),
    field<&WifiParams::access_points>("access_points", "m",
                                      "list of at most 64 `{\"name\", \"x\", \"y\"}` in the world")
        .counting(0, 64),
};
SIM_FIELDS(WifiParams, kWifiSettings)

constexpr Field kLink[] = {
    field<&WifiReading::Link::name>("name"),
    field<&WifiReading::Link::mac>("mac"),
    field<&WifiReading::Link::ip>("ip"),
    field<&WifiReading::Link::access_point>("access_point"),
    field<&WifiReading::Link::level_dbm>("level", "dBm"),
};
SIM_FIELDS(WifiReading::Link, kLink)

constexpr Field kWifiReading[] = {
    field<&WifiReading::links>("links", "", "`level` in dBm"),
    field<&WifiReading::own_ip>("own.ip", "", "this robot's own address"),
    field<&WifiReading::floor_dbm>("floor", "dBm", "noise of the channel"),
    field<&WifiReading::channel_mhz>("channel", "MHz", "carrier"),
};
SIM_FIELDS(WifiReading, kWifiReading)

DeviceKind wifi_kind() { return device_kind<Wifi, WifiParams, WifiReading>("wifi", {{"wifi"}}); }

}  // namespace sim
