// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Sensors of position, motion and neighbourhood: gps, imu, localize, fiducial, wifi.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "libplayerc++/fiducialproxy.h"
#include "libplayerc++/gpsproxy.h"
#include "libplayerc++/imuproxy.h"
#include "libplayerc++/localizeproxy.h"
#include "libplayerc++/wifiproxy.h"
#include "playerc/device.h"
#include "sim/core/math.h"

namespace {

using playerlike::clib::copied;
using playerlike::clib::ProxyBacked;
using playerlike::clib::with_device;

class Fiducial final : public ProxyBacked<playerc_fiducial_t, PlayerCc::FiducialProxy> {
 public:
  Fiducial() {  // Player's values before playerc_fiducial_get_geom()
    fiducial_geom.size.sl = 0.1;
    fiducial_geom.size.sw = 0.01;
  }
  void refresh_geometry() {
    fiducial_geom.pose = proxy_or_throw().GetSensorPose();
    fiducial_geom.size = proxy_or_throw().GetSensorSize();
    fiducial_geom.fiducial_size = proxy_or_throw().GetFiducialSize();
  }

 private:
  void refresh() override {
    const uint32_t count = proxy_or_throw().GetCount();
    fiducials_count = static_cast<int>(count);
    fiducials =
        copied(items_, count, [this](uint32_t i) { return proxy_or_throw().GetFiducialItem(i); });
  }

  std::vector<player_fiducial_item_t> items_;
};

class Gps final : public ProxyBacked<playerc_gps_t, PlayerCc::GpsProxy> {
  void refresh() override {
    utc_time = proxy_or_throw().GetTime();
    lat = proxy_or_throw().GetLatitude();
    lon = proxy_or_throw().GetLongitude();
    alt = proxy_or_throw().GetAltitude();
    speed = proxy_or_throw().GetSpeed();
    course = proxy_or_throw().GetCourse();
    utm_e = proxy_or_throw().GetUtmEasting();
    utm_n = proxy_or_throw().GetUtmNorthing();
    hdop = proxy_or_throw().GetHdop();
    vdop = proxy_or_throw().GetVdop();
    err_horz = proxy_or_throw().GetErrHorizontal();
    err_vert = proxy_or_throw().GetErrVertical();
    quality = static_cast<int>(proxy_or_throw().GetQuality());
    sat_count = static_cast<int>(proxy_or_throw().GetSatellites());
  }
};

class Imu final : public ProxyBacked<playerc_imu_t, PlayerCc::ImuProxy> {
  void refresh() override {
    pose = proxy_or_throw().GetPose();
    calib_data = proxy_or_throw().GetRawValues();
    acc.px = proxy_or_throw().GetXAccel();
    acc.py = proxy_or_throw().GetYAccel();
    acc.pz = proxy_or_throw().GetZAccel();
    vel.proll = proxy_or_throw().GetXGyro();
    vel.ppitch = proxy_or_throw().GetYGyro();
    vel.pyaw = proxy_or_throw().GetZGyro();
    // Quaternion of rotations about z, then y, then x (Diebel, Representing Attitude, 2006, sec.
    // 8.10).
    const auto [sr, cr] = sim::math::sin_cos(0.5 * pose.proll);
    const auto [sp, cp] = sim::math::sin_cos(0.5 * pose.ppitch);
    const auto [sy, cy] = sim::math::sin_cos(0.5 * pose.pyaw);
    q0 = static_cast<float>(cr * cp * cy + sr * sp * sy);
    q1 = static_cast<float>(sr * cp * cy - cr * sp * sy);
    q2 = static_cast<float>(cr * sp * cy + sr * cp * sy);
    q3 = static_cast<float>(cr * cp * sy - sr * sp * cy);
  }
};

class Localize final : public ProxyBacked<playerc_localize_t, PlayerCc::LocalizeProxy> {
 public:
  void refresh_particles() {
    const player_localize_hypoth_t best = proxy_or_throw().GetHypoth(0);
    mean[0] = best.mean.px;
    mean[1] = best.mean.py;
    mean[2] = best.mean.pa;
    variance = 0.5 * (best.cov[0] + best.cov[1]);
    const uint32_t count = proxy_or_throw().GetNumParticles();
    num_particles = static_cast<int>(count);
    particles = copied(particles_, count, [&](uint32_t i) {
      const player_pose2d_t pose = proxy_or_throw().GetParticlePose(static_cast<int>(i));
      return playerc_localize_particle_t{{pose.px, pose.py, pose.pa},
                                         proxy_or_throw().GetParticleWeight(static_cast<int>(i))};
    });
  }

 private:
  void refresh() override {
    map_size_x = static_cast<int>(proxy_or_throw().GetMapSizeX());
    map_size_y = static_cast<int>(proxy_or_throw().GetMapSizeY());
    map_tile_x = static_cast<int>(proxy_or_throw().GetMapTileX());
    map_tile_y = static_cast<int>(proxy_or_throw().GetMapTileY());
    map_scale = proxy_or_throw().GetMapScale();
    pending_count = static_cast<int>(proxy_or_throw().GetPendingCount());
    pending_time = info.datatime;
    const uint32_t count = proxy_or_throw().GetHypothCount();
    hypoth_count = static_cast<int>(count);
    hypoths =
        copied(hypotheses_, count, [this](uint32_t i) { return proxy_or_throw().GetHypoth(i); });
  }

  std::vector<player_localize_hypoth_t> hypotheses_;
  std::vector<playerc_localize_particle_t> particles_;
};

class Wifi final : public ProxyBacked<playerc_wifi_t, PlayerCc::WiFiProxy> {
  void refresh() override {
    link_count = std::max(proxy_or_throw().GetLinkCount(), 0);
    links = copied(links_, static_cast<uint32_t>(link_count),
                   [this](uint32_t i) { return *proxy_or_throw().GetLink(static_cast<int>(i)); });
    std::fill(std::begin(ip), std::end(ip), '\0');
    if (const char* const own = proxy_or_throw().GetOwnIP()) std::strncpy(ip, own, sizeof ip - 1);
  }

  std::vector<playerc_wifi_link_t> links_;
};

}  // namespace

PLAYERLIKE_CLIB_FRAME(fiducial, Fiducial, PLAYER_FIDUCIAL_CODE)
PLAYERLIKE_CLIB_FRAME(gps, Gps, PLAYER_GPS_CODE)
PLAYERLIKE_CLIB_FRAME(imu, Imu, PLAYER_IMU_CODE)
PLAYERLIKE_CLIB_FRAME(localize, Localize, PLAYER_LOCALIZE_CODE)
PLAYERLIKE_CLIB_FRAME(wifi, Wifi, PLAYER_WIFI_CODE)

int playerc_fiducial_get_geom(playerc_fiducial_t* device) {
  return with_device<Fiducial>(__func__, device, [](Fiducial& self) {
    self.proxy_or_throw().RequestGeometry();
    self.refresh_geometry();
    self.info.freshgeom = 1;
  });
}

int playerc_imu_datatype(playerc_imu_t* device, int value) {
  return with_device<Imu>(__func__, device,
                          [&](Imu& self) { self.proxy_or_throw().SetDatatype(value); });
}

int playerc_imu_reset_orientation(playerc_imu_t* device, int value) {
  return with_device<Imu>(__func__, device,
                          [&](Imu& self) { self.proxy_or_throw().ResetOrientation(value); });
}

int playerc_imu_reset_euler(playerc_imu_t* device, float roll, float pitch, float yaw) {
  return with_device<Imu>(__func__, device,
                          [&](Imu& self) { self.proxy_or_throw().ResetEuler(roll, pitch, yaw); });
}

int playerc_localize_set_pose(playerc_localize_t* device, double pose[3], double cov[6]) {
  return with_device<Localize>(__func__, device,
                               [&](Localize& self) { self.proxy_or_throw().SetPose(pose, cov); });
}

int playerc_localize_get_particles(playerc_localize_t* device) {
  return with_device<Localize>(__func__, device, [](Localize& self) {
    if (self.proxy_or_throw().GetParticles() != 0)
      playerlike::clib::refuse("there is no reading yet");
    self.refresh_particles();
  });
}

playerc_wifi_link_t* playerc_wifi_get_link(playerc_wifi_t* device, int link) {
  return playerlike::clib::guarded(__func__, [&] {
    if (device == nullptr || link < 0 || link >= device->link_count) {
      playerlike::clib::refuse("there is no link with the number " + std::to_string(link));
    }
    return device->links + link;
  });
}
