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

namespace {

using playerlike::clib::Backed;
using playerlike::clib::copied;
using playerlike::clib::with_device;

class Fiducial final : public Backed<playerc_fiducial_t, PlayerCc::FiducialProxy> {
 public:
  void refresh_geometry() {
    fiducial_geom.pose = used().GetSensorPose();
    fiducial_geom.size = used().GetSensorSize();
    fiducial_geom.fiducial_size = used().GetFiducialSize();
  }

 private:
  void refresh() override {
    const uint32_t count = used().GetCount();
    fiducials_count = static_cast<int>(count);
    fiducials = copied(items_, count, [this](uint32_t i) { return used().GetFiducialItem(i); });
  }

  std::vector<player_fiducial_item_t> items_;
};

class Gps final : public Backed<playerc_gps_t, PlayerCc::GpsProxy> {
  void refresh() override {
    utc_time = used().GetTime();
    lat = used().GetLatitude();
    lon = used().GetLongitude();
    alt = used().GetAltitude();
    speed = used().GetSpeed();
    course = used().GetCourse();
    utm_e = used().GetUtmEasting();
    utm_n = used().GetUtmNorthing();
    hdop = used().GetHdop();
    vdop = used().GetVdop();
    err_horz = used().GetErrHorizontal();
    err_vert = used().GetErrVertical();
    quality = static_cast<int>(used().GetQuality());
    sat_count = static_cast<int>(used().GetSatellites());
  }
};

class Imu final : public Backed<playerc_imu_t, PlayerCc::ImuProxy> {
  void refresh() override {
    pose = used().GetPose();
    calib_data = used().GetRawValues();
    acc.px = used().GetXAccel();
    acc.py = used().GetYAccel();
    acc.pz = used().GetZAccel();
    vel.proll = used().GetXGyro();
    vel.ppitch = used().GetYGyro();
    vel.pyaw = used().GetZGyro();
    // Quaternion of rotations about z, then y, then x (Diebel, Representing Attitude, 2006, sec.
    // 8.10).
    const double cr = std::cos(0.5 * pose.proll);
    const double sr = std::sin(0.5 * pose.proll);
    const double cp = std::cos(0.5 * pose.ppitch);
    const double sp = std::sin(0.5 * pose.ppitch);
    const double cy = std::cos(0.5 * pose.pyaw);
    const double sy = std::sin(0.5 * pose.pyaw);
    q0 = static_cast<float>(cr * cp * cy + sr * sp * sy);
    q1 = static_cast<float>(sr * cp * cy - cr * sp * sy);
    q2 = static_cast<float>(cr * sp * cy + sr * cp * sy);
    q3 = static_cast<float>(cr * cp * sy - sr * sp * cy);
  }
};

class Localize final : public Backed<playerc_localize_t, PlayerCc::LocalizeProxy> {
 public:
  void refresh_particles() {
    const player_localize_hypoth_t best = used().GetHypoth(0);
    mean[0] = best.mean.px;
    mean[1] = best.mean.py;
    mean[2] = best.mean.pa;
    variance = 0.5 * (best.cov[0] + best.cov[1]);
    const uint32_t count = used().GetNumParticles();
    num_particles = static_cast<int>(count);
    particles = copied(particles_, count, [&](uint32_t i) {
      const player_pose2d_t pose = used().GetParticlePose(static_cast<int>(i));
      return playerc_localize_particle_t{{pose.px, pose.py, pose.pa}, 1.0 / count};
    });
  }

 private:
  void refresh() override {
    map_size_x = static_cast<int>(used().GetMapSizeX());
    map_size_y = static_cast<int>(used().GetMapSizeY());
    map_tile_x = static_cast<int>(used().GetMapTileX());
    map_tile_y = static_cast<int>(used().GetMapTileY());
    map_scale = used().GetMapScale();
    pending_count = static_cast<int>(used().GetPendingCount());
    pending_time = info.datatime;
    const uint32_t count = used().GetHypothCount();
    hypoth_count = static_cast<int>(count);
    hypoths = copied(hypotheses_, count, [this](uint32_t i) { return used().GetHypoth(i); });
  }

  std::vector<player_localize_hypoth_t> hypotheses_;
  std::vector<playerc_localize_particle_t> particles_;
};

class Wifi final : public Backed<playerc_wifi_t, PlayerCc::WiFiProxy> {
  void refresh() override {
    link_count = std::max(used().GetLinkCount(), 0);
    links = copied(links_, static_cast<uint32_t>(link_count),
                   [this](uint32_t i) { return *used().GetLink(static_cast<int>(i)); });
    std::fill(std::begin(ip), std::end(ip), '\0');
    if (const char* const own = used().GetOwnIP()) std::strncpy(ip, own, sizeof ip - 1);
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
    self.used().RequestGeometry();
    self.refresh_geometry();
    self.info.freshgeom = 1;
  });
}

int playerc_imu_datatype(playerc_imu_t* device, int value) {
  return with_device<Imu>(__func__, device, [&](Imu& self) { self.used().SetDatatype(value); });
}

int playerc_imu_reset_orientation(playerc_imu_t* device, int value) {
  return with_device<Imu>(__func__, device,
                          [&](Imu& self) { self.used().ResetOrientation(value); });
}

int playerc_imu_reset_euler(playerc_imu_t* device, float roll, float pitch, float yaw) {
  return with_device<Imu>(__func__, device,
                          [&](Imu& self) { self.used().ResetEuler(roll, pitch, yaw); });
}

int playerc_localize_set_pose(playerc_localize_t* device, double pose[3], double cov[6]) {
  return with_device<Localize>(__func__, device,
                               [&](Localize& self) { self.used().SetPose(pose, cov); });
}

int playerc_localize_get_particles(playerc_localize_t* device) {
  return with_device<Localize>(__func__, device, [](Localize& self) {
    if (self.used().GetParticles() != 0) playerlike::clib::refuse("there is no reading yet");
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
