// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Sensors of distance and contact: ranger, sonar, infrared, bumper.
#include <vector>

#include "libplayerc++/bumperproxy.h"
#include "libplayerc++/irproxy.h"
#include "libplayerc++/rangerproxy.h"
#include "libplayerc++/sonarproxy.h"
#include "playerc/device.h"

namespace {

using playerlike::clib::copied;
using playerlike::clib::ProxyBacked;
using playerlike::clib::store_result;
using playerlike::clib::with_device;

class Ranger final : public ProxyBacked<playerc_ranger_t, PlayerCc::RangerProxy> {
 public:
  void refresh_geometry() {
    element_count = proxy_or_throw().GetElementCount();
    device_pose = proxy_or_throw().GetDevicePose();
    device_size = proxy_or_throw().GetDeviceSize();
    element_poses = copied(poses_, element_count,
                           [this](uint32_t i) { return proxy_or_throw().GetElementPose(i); });
    element_sizes = copied(sizes_, element_count,
                           [this](uint32_t i) { return proxy_or_throw().GetElementSize(i); });
  }
  void refresh_settings() {
    min_angle = proxy_or_throw().GetMinAngle();
    max_angle = proxy_or_throw().GetMaxAngle();
    angular_res = proxy_or_throw().GetAngularRes();
    min_range = proxy_or_throw().GetMinRange();
    max_range = proxy_or_throw().GetMaxRange();
    range_res = proxy_or_throw().GetRangeRes();
    frequency = proxy_or_throw().GetFrequency();
  }

 private:
  void refresh() override {
    ranges_count = proxy_or_throw().GetRangeCount();
    ranges =
        copied(ranges_, ranges_count, [this](uint32_t i) { return proxy_or_throw().GetRange(i); });
    intensities_count = proxy_or_throw().GetIntensityCount();
    intensities = copied(intensities_, intensities_count,
                         [this](uint32_t i) { return proxy_or_throw().GetIntensity(i); });
    // A laser measures many ranges with one element; other rangers measure one range per element.
    const bool sweeps = ranges_count > proxy_or_throw().GetElementCount();
    const double first_rad = proxy_or_throw().GetMinAngle();
    const double step_rad = proxy_or_throw().GetAngularRes();
    bearings_count = ranges_count;
    bearings = copied(bearings_, bearings_count, [&](uint32_t i) {
      return sweeps ? first_rad + i * step_rad : proxy_or_throw().GetElementPose(i).pyaw;
    });
    points_count = proxy_or_throw().GetPointCount();
    points =
        copied(points_, points_count, [this](uint32_t i) { return proxy_or_throw().GetPoint(i); });
  }

  std::vector<player_pose3d_t> poses_;
  std::vector<player_bbox3d_t> sizes_;
  std::vector<double> ranges_;
  std::vector<double> intensities_;
  std::vector<double> bearings_;
  std::vector<player_point_3d_t> points_;
};

// Player's C library counts the poses of sonars and bumpers in an int, those of other sensors in a
// uint32_t.
template <typename Used, typename Pose>
void refresh_poses(Used& used, std::vector<Pose>& kept, Pose*& poses, int& pose_count) {
  const uint32_t count = used.GetPoseCount();
  pose_count = static_cast<int>(count);
  poses = copied(kept, count, [&](uint32_t i) { return used.GetPose(i); });
}

class Sonar final : public ProxyBacked<playerc_sonar_t, PlayerCc::SonarProxy> {
 public:
  void refresh_geometry() { refresh_poses(proxy_or_throw(), poses_, poses, pose_count); }

 private:
  void refresh() override {
    const uint32_t count = proxy_or_throw().GetCount();
    scan_count = static_cast<int>(count);
    scan = copied(ranges_, count, [this](uint32_t i) { return proxy_or_throw().GetScan(i); });
  }

  std::vector<player_pose3d_t> poses_;
  std::vector<double> ranges_;
};

class Ir final : public ProxyBacked<playerc_ir_t, PlayerCc::IrProxy> {
 public:
  void refresh_geometry() {
    poses.poses_count = proxy_or_throw().GetPoseCount();
    poses.poses = copied(poses_, poses.poses_count,
                         [this](uint32_t i) { return proxy_or_throw().GetPose(i); });
  }

 private:
  void refresh() override {
    data.ranges_count = data.voltages_count = proxy_or_throw().GetCount();
    data.ranges = copied(ranges_, data.ranges_count, [this](uint32_t i) {
      return static_cast<float>(proxy_or_throw().GetRange(i));
    });
    data.voltages = copied(voltages_, data.voltages_count, [this](uint32_t i) {
      return static_cast<float>(proxy_or_throw().GetVoltage(i));
    });
  }

  std::vector<player_pose3d_t> poses_;
  std::vector<float> ranges_;
  std::vector<float> voltages_;
};

class Bumper final : public ProxyBacked<playerc_bumper_t, PlayerCc::BumperProxy> {
 public:
  void refresh_geometry() { refresh_poses(proxy_or_throw(), poses_, poses, pose_count); }

 private:
  void refresh() override {
    const uint32_t count = proxy_or_throw().GetCount();
    bumper_count = static_cast<int>(count);
    bumpers = copied(pressed_, count, [this](uint32_t i) {
      return static_cast<uint8_t>(proxy_or_throw().IsBumped(i));
    });
  }

  std::vector<player_bumper_define_t> poses_;
  std::vector<uint8_t> pressed_;
};

template <typename T>
int get_geometry(const char* fun, typename T::Struct* device) {
  return with_device<T>(fun, device, [](T& self) {
    if constexpr (std::is_same_v<T, Bumper>) {
      self.proxy_or_throw().RequestBumperConfig();
    } else {
      self.proxy_or_throw().RequestGeom();
    }
    self.refresh_geometry();
    self.info.freshgeom = 1;
  });
}

}  // namespace

PLAYERLIKE_CLIB_FRAME(ranger, Ranger, PLAYER_RANGER_CODE)
PLAYERLIKE_CLIB_FRAME(sonar, Sonar, PLAYER_SONAR_CODE)
PLAYERLIKE_CLIB_FRAME(ir, Ir, PLAYER_IR_CODE)
PLAYERLIKE_CLIB_FRAME(bumper, Bumper, PLAYER_BUMPER_CODE)

int playerc_ranger_get_geom(playerc_ranger_t* device) {
  return get_geometry<Ranger>(__func__, device);
}
int playerc_sonar_get_geom(playerc_sonar_t* device) {
  return get_geometry<Sonar>(__func__, device);
}
int playerc_ir_get_geom(playerc_ir_t* device) { return get_geometry<Ir>(__func__, device); }
int playerc_bumper_get_geom(playerc_bumper_t* device) {
  return get_geometry<Bumper>(__func__, device);
}

int playerc_ranger_power_config(playerc_ranger_t* device, uint8_t value) {
  return with_device<Ranger>(__func__, device,
                             [&](Ranger& self) { self.proxy_or_throw().SetPower(value != 0); });
}

int playerc_ranger_intns_config(playerc_ranger_t* device, uint8_t value) {
  return with_device<Ranger>(
      __func__, device, [&](Ranger& self) { self.proxy_or_throw().SetIntensityData(value != 0); });
}

int playerc_ranger_set_config(playerc_ranger_t* device, double min_angle, double max_angle,
                              double angular_res, double min_range, double max_range,
                              double range_res, double frequency) {
  return with_device<Ranger>(__func__, device, [&](Ranger& self) {
    self.proxy_or_throw().Configure(min_angle, max_angle, angular_res, min_range, max_range,
                                    range_res, frequency);
    self.refresh_settings();
  });
}

int playerc_ranger_get_config(playerc_ranger_t* device, double* min_angle, double* max_angle,
                              double* angular_res, double* min_range, double* max_range,
                              double* range_res, double* frequency) {
  return with_device<Ranger>(__func__, device, [&](Ranger& self) {
    self.proxy_or_throw().RequestConfigure();
    self.refresh_settings();
    store_result(min_angle, self.min_angle);
    store_result(max_angle, self.max_angle);
    store_result(angular_res, self.angular_res);
    store_result(min_range, self.min_range);
    store_result(max_range, self.max_range);
    store_result(range_res, self.range_res);
    store_result(frequency, self.frequency);
    self.info.freshconfig = 1;
  });
}
