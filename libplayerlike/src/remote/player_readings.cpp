// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "remote/player_readings.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "protocol/player_xdr.h"
#include "session/player_values/actarray.h"
#include "session/player_values/aio.h"
#include "session/player_values/blinkenlight.h"
#include "session/player_values/blobfinder.h"
#include "session/player_values/bumper.h"
#include "session/player_values/dio.h"
#include "session/player_values/fiducial.h"
#include "session/player_values/gps.h"
#include "session/player_values/gripper.h"
#include "session/player_values/imu.h"
#include "session/player_values/planner.h"
#include "session/player_values/position2d.h"
#include "session/player_values/power.h"
#include "session/player_values/ptz.h"
#include "session/player_values/wifi.h"
#include "session/range_settings.h"
#include "sim/core/math.h"
#include "sim/devices/amcl.h"
#include "sim/devices/camera.h"
#include "sim/devices/laser.h"
#include "sim/devices/opaque.h"
#include "sim/devices/rangers.h"

namespace playerlike {
namespace {

using Made = std::shared_ptr<sim::Reading>;
using player::decode;

template <typename R>
std::shared_ptr<R> made(R reading) {
  return std::make_shared<R>(std::move(reading));
}

/// The reading of a message; null if the message is of another kind.
template <typename R, typename Data>
Made reading_if(bool is_data, std::string_view payload) {
  return is_data ? made(from_players<R>(decode<Data>(payload))) : nullptr;
}

/// A copy of the last reading for a message with a part of its values; a new one before the first.
template <typename R>
R next_of(const sim::SharedReading& last) {
  const auto* before = dynamic_cast<const R*>(last.get());
  return before == nullptr ? R() : *before;
}

std::vector<double> doubles(const std::vector<float>& values) {
  return {values.begin(), values.end()};
}

// --- Positions

/// The most likely hypothesis first.
Made localization(std::uint8_t subtype, std::string_view payload) {
  if (subtype != PLAYER_LOCALIZE_DATA_HYPOTHS) return nullptr;
  const auto data = decode<player::LocalizeData>(payload);
  if (data.hypoths.empty()) return nullptr;
  const auto reading = std::make_shared<sim::AmclReading>();
  reading->pending = data.pending_count;
  for (const player::LocalizeHypoth& hypoth : data.hypoths) {
    const auto& cov = hypoth.cov;
    reading->hypotheses.push_back({from_players<sim::Pose>(hypoth.mean),
                                   {{cov[0], cov[1], cov[2]}, {cov[3], cov[4], cov[5]}},
                                   hypoth.alpha});
  }
  std::stable_sort(reading->hypotheses.begin(), reading->hypotheses.end(),
                   [](const sim::PoseHypothesis& a, const sim::PoseHypothesis& b) {
                     return a.weight > b.weight;
                   });
  return reading;
}

Made planner(std::uint8_t subtype, std::string_view payload) {
  if (subtype != PLAYER_PLANNER_DATA_STATE) return nullptr;
  const auto data = decode<player::PlannerData>(payload);
  const auto reading = std::make_shared<PlannerReading>();
  reading->state = from_players<PlannerState>(data);
  reading->state.reported_waypoints = data.waypoints_count;
  return reading;
}

// --- Ranges

Made scan_of(const player::LaserData& data) {
  const auto reading = std::make_shared<sim::LaserReading>();
  reading->ranges_m = doubles(data.ranges);
  reading->angle_min_rad = double{data.min_angle};
  reading->resolution_rad = double{data.resolution};
  reading->range_max_m = double{data.max_range};
  // Some drivers send an intensity for each range, some none, and some send zeros.
  const bool has_any = std::any_of(data.intensity.begin(), data.intensity.end(),
                                   [](std::uint8_t intensity) { return intensity != 0; });
  if (has_any && data.intensity.size() == data.ranges.size()) {
    reading->intensities = {data.intensity.begin(), data.intensity.end()};
  }
  return reading;
}

Made scan(std::uint8_t subtype, std::string_view payload) {
  if (subtype == PLAYER_LASER_DATA_SCAN) return scan_of(decode<player::LaserData>(payload));
  if (subtype == PLAYER_LASER_DATA_SCANPOSE) {
    return scan_of(decode<player::LaserDataScanpose>(payload).scan);
  }
  return nullptr;  // beams at any angles
}

std::shared_ptr<sim::RangerReading> ring(std::vector<double> ranges_m, const DeviceInfo& device) {
  auto reading = std::make_shared<sim::RangerReading>();
  reading->ranges_m = std::move(ranges_m);
  reading->range_max_m = setting_of(device.properties, "range_max");
  reading->field_of_view_rad = setting_of(device.properties, "field_of_view");
  for (const Mounting& mounting : element_mountings(device.properties)) {
    reading->X_BS.push_back({mounting.x_m, mounting.y_m, mounting.yaw_rad});
  }
  return reading;
}

Made infrared(const player::IrData& data, const DeviceInfo& device) {
  const auto reading = ring(doubles(data.ranges), device);
  if (data.voltages.size() == data.ranges.size()) reading->voltages_v = doubles(data.voltages);
  return reading;
}

Made ranger_scan(std::vector<double> ranges_m, const DeviceInfo& device) {
  if (device.type != "laser") return ring(std::move(ranges_m), device);
  const ScannerSettings scanner = scanner_settings(device.properties);
  const auto reading = std::make_shared<sim::LaserReading>();
  reading->ranges_m = std::move(ranges_m);
  reading->angle_min_rad = scanner.least_rad;
  reading->resolution_rad = scanner.native_rad;
  reading->range_max_m = scanner.range_max_m;
  return reading;
}

/// Drivers send intensities after the ranges to which they belong.
Made with_intensities(const std::vector<double>& intensities, const sim::SharedReading& last) {
  const auto complete = [&](const auto& reading) -> Made {
    if (reading.ranges_m.size() != intensities.size()) return nullptr;
    auto whole = std::make_shared<std::decay_t<decltype(reading)>>(reading);
    whole->intensities = intensities;
    return whole;
  };
  if (const auto* scan = dynamic_cast<const sim::LaserReading*>(last.get())) return complete(*scan);
  if (const auto* round = dynamic_cast<const sim::RangerReading*>(last.get())) {
    return complete(*round);
  }
  return nullptr;
}

Made ranger(std::uint8_t subtype, std::string_view payload, const DeviceInfo& device,
            const sim::SharedReading& last) {
  if (subtype == PLAYER_RANGER_DATA_RANGE) {
    return ranger_scan(decode<player::RangerDataRange>(payload).ranges, device);
  }
  if (subtype == PLAYER_RANGER_DATA_RANGESTAMPED) {
    return ranger_scan(decode<player::RangerDataRangestamped>(payload).data.ranges, device);
  }
  if (subtype == PLAYER_RANGER_DATA_INTNS) {
    return with_intensities(decode<player::RangerDataIntns>(payload).intensities, last);
  }
  if (subtype == PLAYER_RANGER_DATA_INTNSSTAMPED) {
    return with_intensities(decode<player::RangerDataIntnsstamped>(payload).data.intensities, last);
  }
  return nullptr;
}

// --- The robot's state

Made gps(std::uint8_t subtype, std::string_view payload) {
  if (subtype != PLAYER_GPS_DATA_STATE) return nullptr;
  return made(gps_reading(decode<player::GpsData>(payload)));
}

Made imu(std::uint8_t subtype, std::string_view payload, const sim::SharedReading& last) {
  const auto reading = made(next_of<sim::ImuReading>(last));
  const auto set_values = [&](const player::ImuDataCalib& values) {
    *reading = from_players(values, *reading);
  };
  switch (subtype) {
    case PLAYER_IMU_DATA_STATE:
      reading->yaw_rad = decode<player::ImuDataState>(payload).pose.pyaw;
      return reading;
    case PLAYER_IMU_DATA_CALIB:
      set_values(decode<player::ImuDataCalib>(payload));
      return reading;
    case PLAYER_IMU_DATA_QUAT: {
      const auto data = decode<player::ImuDataQuat>(payload);
      set_values(data.calib_data);
      const double w = double{data.q0};
      const double x = double{data.q1};
      const double y = double{data.q2};
      const double z = double{data.q3};
      reading->yaw_rad = sim::math::atan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z);
      return reading;
    }
    case PLAYER_IMU_DATA_EULER: {
      const auto data = decode<player::ImuDataEuler>(payload);
      set_values(data.calib_data);
      reading->yaw_rad = data.orientation.pyaw;
      return reading;
    }
    case PLAYER_IMU_DATA_FULLSTATE:
      reading->yaw_rad = decode<player::ImuDataFullstate>(payload).pose.pyaw;
      return reading;
    default:
      return nullptr;
  }
}

Made bumpers(std::uint8_t subtype, std::string_view payload) {
  if (subtype != PLAYER_BUMPER_DATA_STATE) return nullptr;
  auto felt = from_players<sim::BumperReading>(decode<player::BumperData>(payload));
  for (std::uint8_t& pressed : felt.pressed) pressed = pressed != 0 ? 1 : 0;
  return made(std::move(felt));
}

Made gripper(std::uint8_t subtype, std::string_view payload) {
  if (subtype != PLAYER_GRIPPER_DATA_STATE) return nullptr;
  return made(gripper_reading(decode<player::GripperData>(payload)));
}

Made arm(std::uint8_t subtype, std::string_view payload, const DeviceInfo& device) {
  if (subtype != PLAYER_ACTARRAY_DATA_STATE) return nullptr;
  auto reading = from_players<sim::ActArrayReading>(decode<player::ActarrayData>(payload));
  for (std::size_t i = 0; i < reading.joints.size(); ++i) {
    reading.joints[i].speed_setting = joint_setting(device.properties, "speed", i);
  }
  return made(std::move(reading));
}

// --- What is seen

Made fiducials(std::uint8_t subtype, std::string_view payload) {
  if (subtype != PLAYER_FIDUCIAL_DATA_SCAN) return nullptr;
  const auto reading = std::make_shared<sim::FiducialReading>();
  for (const player::FiducialItem& item : decode<player::FiducialData>(payload).fiducials) {
    reading->marks.push_back(mark_of(item));
  }
  return reading;
}

[[noreturn]] void refuse_image(const player::CameraData& data) {
  throw protocol::ProtocolError("player/payload", "an image of " + std::to_string(data.width) +
                                                      " x " + std::to_string(data.height) +
                                                      " pixels has " +
                                                      std::to_string(data.image.size()) + " bytes");
}

/// Images become RGB with 8 bits per channel. Compressed ones are skipped.
Made image(std::uint8_t subtype, std::string_view payload) {
  if (subtype != PLAYER_CAMERA_DATA_STATE) return nullptr;
  auto data = decode<player::CameraData>(payload);
  if (data.compression != PLAYER_CAMERA_COMPRESS_RAW) return nullptr;
  const bool is_wide =
      data.format == PLAYER_CAMERA_FORMAT_MONO16 || data.format == PLAYER_CAMERA_FORMAT_RGB565;
  const std::uint64_t bytes_per_pixel = data.format == PLAYER_CAMERA_FORMAT_RGB888 ? 3
                                        : is_wide                                  ? 2
                                                                                   : 1;
  constexpr std::uint32_t kMostSide = 1U << 16U;
  if (data.width > kMostSide || data.height > kMostSide ||
      std::uint64_t{data.width} * data.height * bytes_per_pixel != data.image.size()) {
    refuse_image(data);
  }
  const auto reading = std::make_shared<sim::CameraReading>();
  reading->width = as_int(data.width);
  reading->height = as_int(data.height);
  if (data.format == PLAYER_CAMERA_FORMAT_RGB888) {
    reading->pixels = std::move(data.image);
    return reading;
  }
  reading->pixels.reserve(data.image.size() / bytes_per_pixel * 3);
  for (std::size_t i = 0; i < data.image.size(); i += bytes_per_pixel) {
    if (data.format == PLAYER_CAMERA_FORMAT_RGB565) {
      // As Player's drivers write it: little-endian, red in the highest bits.
      const auto bits = static_cast<unsigned>(data.image[i] | data.image[i + 1] << 8U);
      reading->pixels.push_back(static_cast<std::uint8_t>((bits >> 11U & 31U) * 255U / 31U));
      reading->pixels.push_back(static_cast<std::uint8_t>((bits >> 5U & 63U) * 255U / 63U));
      reading->pixels.push_back(static_cast<std::uint8_t>((bits & 31U) * 255U / 31U));
    } else {
      const std::uint8_t light = data.image[i + (is_wide ? 1 : 0)];  // the higher byte
      reading->pixels.insert(reading->pixels.end(), 3, light);
    }
  }
  return reading;
}

// --- Signals

Made voltages(std::uint8_t subtype, std::string_view payload, const sim::SharedReading& last) {
  if (subtype != PLAYER_AIO_DATA_STATE) return nullptr;
  return made(from_players(decode<player::AioData>(payload), next_of<sim::AioReading>(last)));
}

Made digital_inputs(std::uint8_t subtype, std::string_view payload) {
  if (subtype != PLAYER_DIO_DATA_VALUES) return nullptr;
  auto data = decode<player::DioData>(payload);
  data.count = std::min<std::uint32_t>(data.count, sim::DioParams::kMaxLines);
  return made(from_players<sim::DioReading>(data));
}

Made links(std::uint8_t subtype, std::string_view payload) {
  if (subtype != PLAYER_WIFI_DATA_STATE) return nullptr;
  return made(wifi_reading(decode<player::WifiData>(payload)));
}

Made opaque(std::uint8_t subtype, std::string_view payload, const sim::SharedReading& last) {
  if (subtype != PLAYER_OPAQUE_DATA_STATE) return nullptr;
  const auto reading = made(next_of<sim::OpaqueReading>(last));
  reading->data = decode<player::OpaqueData>(payload).data;
  ++reading->number;
  return reading;
}

Made light(std::uint8_t subtype, std::string_view payload) {
  if (subtype != PLAYER_BLINKENLIGHT_DATA_STATE) return nullptr;
  auto shown = from_players<sim::BlinkenlightReading>(decode<player::BlinkenlightData>(payload));
  shown.colour.a = 255;
  shown.lit = shown.enabled;
  return made(shown);
}

Made made_of(unsigned interface, std::uint8_t subtype, std::string_view payload,
             const DeviceInfo& device, const sim::SharedReading& last) {
  switch (interface) {
    case PLAYER_POSITION2D_CODE:
      return reading_if<sim::PoseReading, player::Position2dData>(
          subtype == PLAYER_POSITION2D_DATA_STATE, payload);
    case PLAYER_LOCALIZE_CODE:
      return localization(subtype, payload);
    case PLAYER_PLANNER_CODE:
      return planner(subtype, payload);
    case PLAYER_LASER_CODE:
      return scan(subtype, payload);
    case PLAYER_RANGER_CODE:
      return ranger(subtype, payload, device, last);
    case PLAYER_SONAR_CODE:
      if (subtype != PLAYER_SONAR_DATA_RANGES) return nullptr;
      return ring(doubles(decode<player::SonarData>(payload).ranges), device);
    case PLAYER_IR_CODE:
      if (subtype != PLAYER_IR_DATA_RANGES) return nullptr;
      return infrared(decode<player::IrData>(payload), device);
    case PLAYER_POWER_CODE:
      return reading_if<sim::BatteryReading, player::PowerData>(subtype == PLAYER_POWER_DATA_STATE,
                                                                payload);
    case PLAYER_GPS_CODE:
      return gps(subtype, payload);
    case PLAYER_IMU_CODE:
      return imu(subtype, payload, last);
    case PLAYER_FIDUCIAL_CODE:
      return fiducials(subtype, payload);
    case PLAYER_BUMPER_CODE:
      return bumpers(subtype, payload);
    case PLAYER_PTZ_CODE:
      return reading_if<sim::PtzReading, player::PtzData>(subtype == PLAYER_PTZ_DATA_STATE,
                                                          payload);
    case PLAYER_GRIPPER_CODE:
      return gripper(subtype, payload);
    case PLAYER_AIO_CODE:
      return voltages(subtype, payload, last);
    case PLAYER_DIO_CODE:
      return digital_inputs(subtype, payload);
    case PLAYER_WIFI_CODE:
      return links(subtype, payload);
    case PLAYER_BLOBFINDER_CODE:
      return reading_if<sim::BlobfinderReading, player::BlobfinderData>(
          subtype == PLAYER_BLOBFINDER_DATA_BLOBS, payload);
    case PLAYER_CAMERA_CODE:
      return image(subtype, payload);
    case PLAYER_ACTARRAY_CODE:
      return arm(subtype, payload, device);
    case PLAYER_OPAQUE_CODE:
      return opaque(subtype, payload, last);
    case PLAYER_BLINKENLIGHT_CODE:
      return light(subtype, payload);
    default:
      return nullptr;
  }
}

}  // namespace

sim::SharedReading PlayerReadings::convert(std::uint8_t subtype, double time_s,
                                           std::string_view payload, const DeviceInfo& device) {
  const Made made = made_of(interface_, subtype, payload, device, last_);
  if (made == nullptr) return nullptr;
  constexpr double kLatest_s = 9e9;  // nanoseconds fit 64 bits until the year 2255
  if (time_s >= 0.0 && time_s <= kLatest_s) time_ns_ = sim::from_seconds(time_s);
  made->time_ns = time_ns_;
  const bool completes_last =
      interface_ == PLAYER_RANGER_CODE &&
      (subtype == PLAYER_RANGER_DATA_INTNS || subtype == PLAYER_RANGER_DATA_INTNSSTAMPED);
  made->sequence = completes_last ? sequence_ : ++sequence_;
  last_ = made;
  return made;
}

}  // namespace playerlike
