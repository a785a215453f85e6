// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "core/errors.h"
#include "libplayerc++/laserproxy.h"
#include "playerc/device.h"
#include "sim/core/math.h"

namespace {

using playerlike::clib::store_result;
using playerlike::clib::with_device;

class Laser final : public playerlike::clib::ProxyBacked<playerc_laser_t, PlayerCc::LaserProxy> {
 public:
  Laser() { size[0] = size[1] = 0.15; }  // Player's value before playerc_laser_get_geom()
  // Fields that are known without a scan, refreshed with each one.
  void refresh_settings() {
    intensity_on = proxy_or_throw().IntensityOn() ? 1 : 0;
    scan_start = proxy_or_throw().GetMinAngle();
    scan_res = proxy_or_throw().GetScanRes();
    range_res = proxy_or_throw().GetRangeRes();
    max_range = proxy_or_throw().GetMaxRange();
    scanning_frequency = proxy_or_throw().GetScanningFrequency();
  }

 private:
  void refresh() override {
    refresh_settings();
    const player_pose3d_t robot = proxy_or_throw().GetRobotPose();
    robot_pose[0] = robot.px;
    robot_pose[1] = robot.py;
    robot_pose[2] = robot.pyaw;
    const uint32_t count = proxy_or_throw().GetCount();
    scan_count = static_cast<int>(count);
    const std::size_t length = playerlike::clib::with_room(count);
    ranges_.resize(length);
    scan_.resize(length);
    points_.resize(length);
    intensities_.assign(length, 0);
    for (uint32_t i = 0; i < count; ++i) {
      const double range_m = proxy_or_throw().GetRange(i);
      const double bearing_rad = scan_start + i * scan_res;
      ranges_[i] = range_m;
      if (intensity_on != 0) intensities_[i] = proxy_or_throw().GetIntensity(i);
      scan_[i].pair[0] = range_m;
      scan_[i].pair[1] = bearing_rad;
      points_[i] = {range_m * sim::math::cos(bearing_rad), range_m * sim::math::sin(bearing_rad)};
    }
    ranges = ranges_.data();
    scan = &scan_[0].pair;
    point = points_.data();
    intensity = intensities_.data();
    min_right = proxy_or_throw().GetMinRight();
    min_left = proxy_or_throw().GetMinLeft();
    ++scan_id;
  }

  struct Beam {
    double pair[2];
  };
  static_assert(sizeof(Beam) == sizeof(double[2]));

  std::vector<double> ranges_;
  std::vector<Beam> scan_;
  std::vector<player_point_2d_t> points_;
  std::vector<int> intensities_;
};

// Units of LaserProxy::Configure().
constexpr double kHundredthsOfDegree = 100.0 * 180.0 / std::numbers::pi;
constexpr double kMillimetres = 1000.0;

uint32_t in_units(const char* name, double value, double units) {
  playerlike::require_finite("", {{name, value}});
  if (value < 0.0 || value > 1000.0) {
    playerlike::clib::refuse(std::string(name) + " must be between 0 and 1000");
  }
  return static_cast<uint32_t>(std::lround(value * units));
}

}  // namespace

PLAYERLIKE_CLIB_FRAME(laser, Laser, PLAYER_LASER_CODE)

int playerc_laser_set_config(playerc_laser_t* device, double min_angle, double max_angle,
                             double resolution, double range_res, unsigned char intensity,
                             double scanning_frequency) {
  return with_device<Laser>(__func__, device, [&](Laser& self) {
    self.proxy_or_throw().Configure(
        min_angle, max_angle, in_units("the angle between beams", resolution, kHundredthsOfDegree),
        in_units("the resolution of ranges", range_res, kMillimetres), intensity != 0,
        scanning_frequency);
    self.refresh_settings();
  });
}

int playerc_laser_get_config(playerc_laser_t* device, double* min_angle, double* max_angle,
                             double* resolution, double* range_res, unsigned char* intensity,
                             double* scanning_frequency) {
  return with_device<Laser>(__func__, device, [&](Laser& self) {
    self.proxy_or_throw().RequestConfigure();
    self.refresh_settings();
    store_result(min_angle, self.proxy_or_throw().GetMinAngle());
    store_result(max_angle, self.proxy_or_throw().GetMaxAngle());
    store_result(resolution, self.scan_res);
    store_result(range_res, self.range_res);
    store_result(intensity, self.intensity_on);
    store_result(scanning_frequency, self.scanning_frequency);
    self.info.freshconfig = 1;
  });
}

int playerc_laser_get_geom(playerc_laser_t* device) {
  return with_device<Laser>(__func__, device, [](Laser& self) {
    self.proxy_or_throw().RequestGeom();
    const player_pose3d_t pose = self.proxy_or_throw().GetPose();
    const player_bbox3d_t size = self.proxy_or_throw().GetSize();
    self.pose[0] = pose.px;
    self.pose[1] = pose.py;
    self.pose[2] = pose.pyaw;
    self.size[0] = size.sl;
    self.size[1] = size.sw;
    self.info.freshgeom = 1;
  });
}

int playerc_laser_get_id(playerc_laser_t* device) {
  return with_device<Laser>(__func__, device, [](Laser& self) {
    self.proxy_or_throw().RequestID();
    self.laser_id = self.proxy_or_throw().GetID();
  });
}

void playerc_laser_printout(playerc_laser_t* device, const char* prefix) {
  if (device == nullptr) return;
  const char* const begin = prefix == nullptr ? "" : prefix;
  std::printf("%s scan %d at %.3f s: %d beams from %.4f rad, %.4f rad apart\n", begin,
              device->scan_id, device->info.datatime, device->scan_count, device->scan_start,
              device->scan_res);
  for (int i = 0; i < device->scan_count; ++i) {
    std::printf("%s %.4f rad %.3f m\n", begin, device->scan[i][1], device->scan[i][0]);
  }
}
