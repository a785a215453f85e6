// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Sensors without commands: blobfinder, bumper, camera, fiducial, gps, imu, power and wifi.
#include <algorithm>
#include <cmath>
#include <memory>

#include "libplayerinterface/player_constants.h"
#include "session/player_values/blobfinder.h"
#include "session/player_values/bumper.h"
#include "session/player_values/fiducial.h"
#include "session/player_values/gps.h"
#include "session/player_values/imu.h"
#include "session/player_values/power.h"
#include "session/player_values/wifi.h"
#include "sim/core/math.h"
#include "sim/devices/camera.h"
#include "sim/devices/compass.h"
#include "sim/devices/space_sensors.h"
#include "wire/robot_device.h"

namespace playerlike::wire {
namespace {

using Blobfinder =
    PlainDevice<sim::BlobfinderReading, player::BlobfinderData, PLAYER_BLOBFINDER_DATA_BLOBS>;

class Bumper final
    : public PlainDevice<sim::BumperReading, player::BumperData, PLAYER_BUMPER_DATA_STATE> {
 public:
  using PlainDevice::PlainDevice;

 protected:
  std::optional<std::string> answer(std::uint8_t subtype, std::string_view /*payload*/) override {
    if (subtype != PLAYER_BUMPER_REQ_GET_GEOM) return std::nullopt;
    return player::encode(player::BumperGeom{bumper_segments<player::BumperDefine>(*settings())});
  }
};

class Camera final : public RobotDevice {
 public:
  using RobotDevice::RobotDevice;

  void on_reading(DeviceId /*device*/, const sim::Reading& reading, DataSink& sink) override {
    const auto* picture = reading_as<sim::CameraReading>(reading);
    if (picture == nullptr) return;
    picture_.width = static_cast<std::uint32_t>(picture->width);
    picture_.height = static_cast<std::uint32_t>(picture->height);
    picture_.bpp = 24;
    picture_.format = PLAYER_CAMERA_FORMAT_RGB888;
    picture_.fdiv = 1;
    picture_.compression = PLAYER_CAMERA_COMPRESS_RAW;
    picture_.image.assign(picture->pixels.begin(), picture->pixels.end());
    sink.data(PLAYER_CAMERA_DATA_STATE, encoded());
  }

 protected:
  std::optional<std::string> answer(std::uint8_t subtype, std::string_view /*payload*/) override {
    if (subtype != PLAYER_CAMERA_REQ_GET_IMAGE || picture_.image.empty()) return std::nullopt;
    return encoded();
  }

 private:
  [[nodiscard]] std::string encoded() const {
    constexpr std::size_t kOtherFields = 36;
    return encode_long(picture_, kOtherFields + picture_.image.size());
  }

  player::CameraData picture_;  // the newest one
};

class Fiducial final : public RobotDevice {
 public:
  using RobotDevice::RobotDevice;

  void on_reading(DeviceId /*device*/, const sim::Reading& reading, DataSink& sink) override {
    const auto* seen = reading_as<sim::FiducialReading>(reading);
    if (seen == nullptr) return;
    player::FiducialData data;
    for (const auto& mark : seen->marks) {
      data.fiducials.push_back(fiducial_item<player::FiducialItem>(mark, *settings()));
    }
    sink.data(PLAYER_FIDUCIAL_DATA_SCAN, player::encode(data));
  }

 protected:
  std::optional<std::string> answer(std::uint8_t subtype, std::string_view /*payload*/) override {
    switch (subtype) {
      case PLAYER_FIDUCIAL_REQ_GET_GEOM:
        return player::encode(player::FiducialGeom{pose_3d(mounting_of(*settings())), {}, {}});
      case PLAYER_FIDUCIAL_REQ_GET_FOV:
        return player::encode(player::FiducialFov{0.0F, static_cast<float>(setting("range_max")),
                                                  static_cast<float>(setting("field_of_view"))});
      default:
        return std::nullopt;
    }
  }
};

class Gps final : public RobotDevice {
 public:
  using RobotDevice::RobotDevice;

  void on_reading(DeviceId /*device*/, const sim::Reading& reading, DataSink& sink) override {
    const auto* fix = reading_as<sim::GpsReading>(reading);
    if (fix == nullptr) return;
    sink.data(PLAYER_GPS_DATA_STATE, player::encode(gps_data<player::GpsData>(*fix, *settings())));
  }
};

/// ImuProxy's counterpart: an inertial unit, or a compass, which measures the heading only.
class Imu final : public RobotDevice {
 public:
  using RobotDevice::RobotDevice;

  void on_reading(DeviceId /*device*/, const sim::Reading& reading, DataSink& sink) override {
    if (const auto* compass = reading_as<sim::CompassReading>(reading)) {
      send_data(compass->heading_rad, {}, false, sink);
    } else if (const auto* unit = reading_as<sim::ImuReading>(reading)) {
      send_data(unit->yaw_rad, to_players<player::ImuDataCalib>(*unit), true, sink);
    } else if (const auto* gyroscope = reading_as<sim::GyroscopeReading>(reading)) {
      send_data(gyroscope->yaw_rad, {}, false, sink);
    } else if (const auto* motion = reading_as<sim::AccelerometerReading>(reading)) {
      sim::ImuReading values;
      values.acceleration_mps2 = motion->acceleration_mps2;
      send_data(0.0, to_players<player::ImuDataCalib>(values), true, sink);
    }
  }

 protected:
  std::optional<std::string> answer(std::uint8_t subtype, std::string_view payload) override {
    switch (subtype) {
      case PLAYER_IMU_REQ_SET_DATATYPE: {
        const int wish = player::decode<player::ImuDatatypeConfig>(payload).value;
        if (wish < PLAYER_IMU_DATA_STATE || wish > PLAYER_IMU_DATA_FULLSTATE) return std::nullopt;
        data_type_ = wish;
        return empty_payload();
      }
      case PLAYER_IMU_REQ_RESET_ORIENTATION:
        static_cast<void>(player::decode<player::ImuResetOrientationConfig>(payload));
        set_yaw(0.0);
        return empty_payload();
      case PLAYER_IMU_REQ_RESET_EULER:
        set_yaw(player::decode<player::ImuResetEulerConfig>(payload).orientation.pyaw);
        return empty_payload();
      default:
        return std::nullopt;
    }
  }

 private:
  void set_yaw(double yaw_rad) const {
    require_number("the yaw angle", yaw_rad);
    send(sim::SetPoseCommand{{0.0, 0.0, sim::normalize_angle(yaw_rad)}});
  }

  // Until a client selects one kind of data, it gets pose and measured values.
  void send_data(double yaw_rad, const player::ImuDataCalib& values, bool has_values,
                 DataSink& sink) const {
    const player::Pose3d pose{0.0, 0.0, 0.0, 0.0, 0.0, yaw_rad};
    switch (data_type_) {
      case PLAYER_IMU_DATA_QUAT:
        return sink.data(PLAYER_IMU_DATA_QUAT,
                         player::encode(player::ImuDataQuat{
                             values, static_cast<float>(sim::math::cos(0.5 * yaw_rad)), 0.0F, 0.0F,
                             static_cast<float>(sim::math::sin(0.5 * yaw_rad))}));
      case PLAYER_IMU_DATA_EULER:
        return sink.data(PLAYER_IMU_DATA_EULER,
                         player::encode(player::ImuDataEuler{values, {0.0, 0.0, yaw_rad}}));
      case PLAYER_IMU_DATA_FULLSTATE: {
        const auto wide = [](float value) { return static_cast<double>(value); };
        return sink.data(
            PLAYER_IMU_DATA_FULLSTATE,
            player::encode(player::ImuDataFullstate{
                pose,
                {0.0, 0.0, 0.0, wide(values.gyro_x), wide(values.gyro_y), wide(values.gyro_z)},
                {wide(values.accel_x), wide(values.accel_y), wide(values.accel_z), 0.0, 0.0,
                 0.0}}));
      }
      default:
        break;
    }
    if (data_type_ != PLAYER_IMU_DATA_CALIB) {
      sink.data(PLAYER_IMU_DATA_STATE, player::encode(player::ImuDataState{pose}));
    }
    if (data_type_ == PLAYER_IMU_DATA_CALIB || (data_type_ == 0 && has_values)) {
      sink.data(PLAYER_IMU_DATA_CALIB, player::encode(values));
    }
  }

  int data_type_ = 0;  // PLAYER_IMU_DATA_...; 0: the client has not selected one
};

class Power final : public RobotDevice {
 public:
  using RobotDevice::RobotDevice;

  void on_reading(DeviceId /*device*/, const sim::Reading& reading, DataSink& sink) override {
    const auto* battery = reading_as<sim::BatteryReading>(reading);
    if (battery == nullptr) return;
    auto data = to_players<player::PowerData>(*battery);
    data.valid = kPowerFields;
    sink.data(PLAYER_POWER_DATA_STATE, player::encode(data));
  }
};

class Wifi final : public RobotDevice {
 public:
  using RobotDevice::RobotDevice;

  void on_reading(DeviceId /*device*/, const sim::Reading& reading, DataSink& sink) override {
    const auto* heard = reading_as<sim::WifiReading>(reading);
    if (heard == nullptr) return;
    player::WifiData data;
    for (const auto& station : heard->links) {
      data.links.push_back(wifi_link<player::WifiLink>(*heard, station));
    }
    data.mode = PLAYER_WIFI_MODE_ADHOC;
    data.qual_type = PLAYER_WIFI_QUAL_DBM;
    data.maxqual = 100;  // in percent, unlike the levels
    sink.data(PLAYER_WIFI_DATA_STATE, player::encode(data));
  }
};

}  // namespace

MadeDevice make_sensing_device(const DeviceContext& context) {
  switch (context.interface) {
    case PLAYER_BLOBFINDER_CODE:
      return std::make_unique<Blobfinder>(context);
    case PLAYER_BUMPER_CODE:
      return std::make_unique<Bumper>(context);
    case PLAYER_CAMERA_CODE:
      return std::make_unique<Camera>(context);
    case PLAYER_FIDUCIAL_CODE:
      return std::make_unique<Fiducial>(context);
    case PLAYER_GPS_CODE:
      return std::make_unique<Gps>(context);
    case PLAYER_IMU_CODE:
      return std::make_unique<Imu>(context);
    case PLAYER_POWER_CODE:
      return std::make_unique<Power>(context);
    case PLAYER_WIFI_CODE:
      return std::make_unique<Wifi>(context);
    default:
      return nullptr;
  }
}

}  // namespace playerlike::wire
