// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Devices that measure ranges: laser, ranger, sonar and ir.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <variant>
#include <vector>

#include "libplayerinterface/player_constants.h"
#include "session/player_values/ranger.h"
#include "session/scan_drivers.h"
#include "sim/devices/laser.h"
#include "sim/devices/rangers.h"
#include "wire/robot_device.h"

namespace playerlike::wire {
namespace {

/// The beams of a laser that a client has chosen.
struct ShownBeams {
  explicit ShownBeams(const ScannerSettings& scanner)
      : count(scanner.count),
        least_rad(scanner.least_rad),
        native_rad(scanner.native_rad),
        window{0, 1, scanner.count} {}

  /// Takes the geometry of a scan. If its number of beams differs from the announced one, all of
  /// them are shown.
  void update(const sim::LaserReading& scan) {
    least_rad = scan.angle_min_rad;
    native_rad = scan.resolution_rad;
    if (scan.ranges_m.size() == count) return;
    count = scan.ranges_m.size();
    window = {0, 1, count};
  }
  /// @throws SessionError kBadArgument if no beam lies between the angles.
  void choose(double min_rad, double max_rad, double spacing_rad) {
    window = window_of(min_rad, max_rad, spacing_rad, count, least_rad, native_rad);
  }

  [[nodiscard]] double min_rad() const {
    return least_rad + static_cast<double>(window.first) * native_rad;
  }
  [[nodiscard]] double max_rad() const {
    return min_rad() + static_cast<double>(window.shown > 0 ? window.shown - 1 : 0) * spacing_rad();
  }
  [[nodiscard]] double spacing_rad() const {
    return native_rad * static_cast<double>(window.stride);
  }

  std::size_t count;
  double least_rad;
  double native_rad;
  BeamWindow window;
};

/// The nearest number that a byte has.
std::uint8_t to_byte(double value) {
  if (!(value > 0.0)) return 0;
  return static_cast<std::uint8_t>(std::min(value, 255.0));
}

/// LaserProxy's counterpart: a laser, or a driver that makes other scans of a laser's.
class LaserDevice final : public RobotDevice {
 public:
  explicit LaserDevice(const DeviceContext& context)
      : RobotDevice(context),
        scanner_(scanner_settings(info().properties)),
        beams_(scanner_),
        range_max_m_(scanner_.range_max_m) {
    const ScanDriverInfo* const driver = binding().scan_driver;
    if (driver == nullptr) return;
    if (const auto* stamps = std::get_if<PoseInterpolatorSettings>(&driver->settings)) {
      poses_.emplace(stamps->interpolate);
      pose_source_ =
          find_interface(session().robots(), robot().port, "position2d", stamps->position).reading;
    }
  }

  [[nodiscard]] std::vector<DeviceId> sources() const override {
    if (!poses_) return RobotDevice::sources();
    return {binding().reading, pose_source_};
  }

  void on_reading(DeviceId /*device*/, const sim::Reading& reading, DataSink& sink) override {
    if (const auto* pose = reading_as<sim::PoseReading>(reading); pose != nullptr && poses_) {
      poses_->add(*pose);
      send_waiting(sink);
    }
    const auto* measured = reading_as<sim::LaserReading>(reading);
    if (measured == nullptr) return;
    if (poses_) {
      if (waiting_.size() == kMostWaiting) waiting_.erase(waiting_.begin());
      waiting_.push_back(*measured);
      return send_waiting(sink);
    }
    const ScanDriverInfo* const driver = binding().scan_driver;
    const auto* cspace =
        driver == nullptr ? nullptr : std::get_if<CspaceSettings>(&driver->settings);
    if (cspace != nullptr) {
      take(*configuration_space(*measured, *cspace));
    } else {
      take(*measured);
    }
    sink.data(PLAYER_LASER_DATA_SCAN, encode_long(scan_, length()));
  }

 protected:
  std::optional<std::string> answer(std::uint8_t subtype, std::string_view payload) override {
    switch (subtype) {
      case PLAYER_LASER_REQ_GET_GEOM:
        return player::encode(player::LaserGeom{pose_3d(scanner_.mounting), box_3d(scanner_.size)});
      case PLAYER_LASER_REQ_SET_CONFIG:
        configure(player::decode<player::LaserConfig>(payload));
        return player::encode(config());
      case PLAYER_LASER_REQ_GET_CONFIG:
        return player::encode(config());
      case PLAYER_LASER_REQ_POWER:
        static_cast<void>(player::decode<player::LaserPowerConfig>(payload));
        return empty_payload();  // a simulated laser is always on
      case PLAYER_LASER_REQ_GET_ID:
        return player::encode(player::LaserGetIdConfig{0});
      default:
        return std::nullopt;
    }
  }

 private:
  // Player's driver keeps this many scans that wait for a pose.
  static constexpr std::size_t kMostWaiting = 100;

  // Sends the scans whose poses are known.
  void send_waiting(DataSink& sink) {
    while (!waiting_.empty() && poses_->knows(waiting_.front().time_ns)) {
      take(waiting_.front());
      const player::LaserDataScanpose stamped{scan_,
                                              pose_2d(*poses_->at(waiting_.front().time_ns))};
      waiting_.erase(waiting_.begin());
      sink.data(PLAYER_LASER_DATA_SCANPOSE, encode_long(stamped, length()));
    }
  }

  [[nodiscard]] std::size_t length() const {
    constexpr std::size_t kOtherFields = 64;
    return kOtherFields + 5 * scan_.ranges.size();
  }

  // Makes the message of a scan.
  void take(const sim::LaserReading& scan) {
    beams_.update(scan);
    range_max_m_ = scan.range_max_m;
    scan_.min_angle = static_cast<float>(beams_.min_rad());
    scan_.max_angle = static_cast<float>(beams_.max_rad());
    scan_.resolution = static_cast<float>(beams_.spacing_rad());
    scan_.max_range = static_cast<float>(range_max_m_);
    scan_.id = static_cast<std::uint32_t>(scan.sequence);
    const BeamWindow& window = beams_.window;
    scan_.ranges.resize(window.shown);
    // Clients expect an intensity for each range; simulated lasers measure none.
    scan_.intensity.assign(window.shown, 0);
    const bool has_intensities = scan.intensities.size() == scan.ranges_m.size();
    for (std::size_t i = 0; i < window.shown; ++i) {
      const double range_m = scan.ranges_m[window.first + i * window.stride];
      scan_.ranges[i] = static_cast<float>(
          range_res_m_ > 0.0 ? limited_range_m(range_m, range_res_m_, 0.0, range_max_m_) : range_m);
      if (has_intensities) {
        scan_.intensity[i] = to_byte(scan.intensities[window.first + i * window.stride]);
      }
    }
  }

  [[nodiscard]] player::LaserConfig config() const {
    player::LaserConfig now;
    now.min_angle = static_cast<float>(beams_.min_rad());
    now.max_angle = static_cast<float>(beams_.max_rad());
    now.resolution = static_cast<float>(beams_.spacing_rad());
    now.max_range = static_cast<float>(range_max_m_);
    now.range_res = static_cast<float>(range_res_m_ > 0.0 ? range_res_m_ : kRangeResolution_m);
    now.scanning_frequency = static_cast<float>(scanner_.frequency_hz);
    return now;
  }

  // The greatest range and the frequency cannot be set; clients leave the former undefined.
  void configure(const player::LaserConfig& wish) {
    double spacing_rad = static_cast<double>(wish.resolution);
    double range_res_m = static_cast<double>(wish.range_res);
    require_number("the least angle", static_cast<double>(wish.min_angle));
    require_number("the greatest angle", static_cast<double>(wish.max_angle));
    require_number("the angular resolution", spacing_rad);
    require_number("the resolution of ranges", range_res_m);
    // LaserProxy::Configure() of Player's client library sends its arguments as they are: whole
    // numbers of 0.01 degrees and of millimetres.
    if (spacing_rad > std::numbers::pi) spacing_rad *= 0.01 * std::numbers::pi / 180.0;
    if (range_res_m >= 1.0) range_res_m *= 0.001;
    // Angles are single-precision numbers: the tolerance keeps the beam at the limit.
    const double rounding_rad = 1e-3 * beams_.native_rad;
    beams_.choose(static_cast<double>(wish.min_angle) - rounding_rad,
                  static_cast<double>(wish.max_angle) + rounding_rad, spacing_rad);
    range_res_m_ = std::max(range_res_m, 0.0);
  }

  const ScannerSettings scanner_;
  ShownBeams beams_;
  double range_max_m_;
  double range_res_m_ = 0.0;  // 0: ranges are not rounded
  player::LaserData scan_;    // keeps its memory
  // Of a driver laserposeinterpolator.
  std::optional<ScanPoses> poses_;
  DeviceId pose_source_{-1, -1};
  std::vector<sim::LaserReading> waiting_;  // scans without a pose yet
};

/// RangerProxy's counterpart: a laser, or a ring of sonars or infrared sensors.
class RangerDevice final : public RobotDevice {
 public:
  explicit RangerDevice(const DeviceContext& context)
      : RobotDevice(context),
        is_laser_(info().type == "laser"),
        scanner_(is_laser_ ? scanner_settings(info().properties) : ScannerSettings{}),
        beams_(scanner_),
        limits_{setting("range_min"), setting("range_max")} {
    if (!is_laser_) elements_ = element_poses<player::Pose3d>(*settings());
  }

  void on_reading(DeviceId /*device*/, const sim::Reading& reading, DataSink& sink) override {
    if (const auto* scan = reading_as<sim::LaserReading>(reading)) {
      beams_.update(*scan);
      show(scan->ranges_m, beams_.window);
    } else if (const auto* ring = reading_as<sim::RangerReading>(reading)) {
      show(ring->ranges_m, {0, 1, ring->ranges_m.size()});
    } else {
      return;
    }
    constexpr std::size_t kCounts = 8;
    const std::size_t length = kCounts + sizeof(double) * data_.ranges.size();
    sink.data(PLAYER_RANGER_DATA_RANGE, encode_long(data_, length));
    const double echo = setting("intensity");
    if (echo <= 0.0) return;
    // As Stage's driver: intensities follow their ranges.
    player::RangerDataIntns strengths;
    for (const double range_m : data_.ranges) {
      strengths.intensities.push_back(echo_intensity(range_m, limits_.max_m, echo));
    }
    sink.data(PLAYER_RANGER_DATA_INTNS, encode_long(strengths, length));
  }

 protected:
  std::optional<std::string> answer(std::uint8_t subtype, std::string_view payload) override {
    switch (subtype) {
      case PLAYER_RANGER_REQ_GET_GEOM:
        return player::encode(geometry());
      case PLAYER_RANGER_REQ_POWER:
        static_cast<void>(player::decode<player::RangerPowerConfig>(payload));
        return empty_payload();  // simulated rangers are always on
      case PLAYER_RANGER_REQ_INTNS:
        static_cast<void>(player::decode<player::RangerIntnsConfig>(payload));
        return empty_payload();  // they measure no intensities, as RangerProxy
      case PLAYER_RANGER_REQ_SET_CONFIG:
        configure(player::decode<player::RangerConfig>(payload));
        return player::encode(config());
      case PLAYER_RANGER_REQ_GET_CONFIG:
        return player::encode(config());
      default:
        return std::nullopt;
    }
  }

 private:
  void show(const std::vector<double>& ranges_m, const BeamWindow& window) {
    data_.ranges.resize(window.shown);
    for (std::size_t i = 0; i < window.shown; ++i) {
      data_.ranges[i] = limits_.limited_m(ranges_m[window.first + i * window.stride]);
    }
  }

  [[nodiscard]] player::RangerGeom geometry() const {
    player::RangerGeom geometry;
    if (is_laser_) {
      geometry.pose = pose_3d(scanner_.mounting);
      geometry.size = box_3d(scanner_.size);
      geometry.element_poses.resize(1);
      geometry.element_sizes.assign(1, geometry.size);
      return geometry;
    }
    geometry.size = box_3d(robot());
    geometry.element_poses = elements_;
    geometry.element_sizes.resize(elements_.size());
    return geometry;
  }

  [[nodiscard]] player::RangerConfig config() const {
    const double view_rad = setting("field_of_view");
    player::RangerConfig now;
    now.min_angle = is_laser_ ? beams_.min_rad() : -0.5 * view_rad;
    now.max_angle = is_laser_ ? beams_.max_rad() : 0.5 * view_rad;
    now.angular_res = is_laser_ ? beams_.spacing_rad() : view_rad;
    now.min_range = limits_.min_m;
    now.max_range = limits_.max_m;
    now.range_res = limits_.resolution_m > 0.0 ? limits_.resolution_m : kRangeResolution_m;
    now.frequency = setting("frequency");
    return now;
  }

  // The frequency cannot be set.
  void configure(const player::RangerConfig& wish) {
    require_number("the least angle", wish.min_angle);
    require_number("the greatest angle", wish.max_angle);
    require_number("the angular resolution", wish.angular_res);
    for (const double range_m : {wish.min_range, wish.max_range, wish.range_res}) {
      require_number("a range", range_m);
    }
    const RangeLimits limits =
        range_limits({wish.min_range, wish.max_range, wish.range_res}, setting("range_max"));
    if (is_laser_) beams_.choose(wish.min_angle, wish.max_angle, wish.angular_res);
    limits_ = limits;
  }

  const bool is_laser_;
  const ScannerSettings scanner_;
  ShownBeams beams_;                      // of a laser
  std::vector<player::Pose3d> elements_;  // of a ring
  RangeLimits limits_;
  player::RangerDataRange data_ = {};  // keeps its memory
};

/// Common part of SonarProxy's and IrProxy's counterparts.
class RingDevice : public RobotDevice {
 public:
  explicit RingDevice(const DeviceContext& context)
      : RobotDevice(context), poses_(element_poses<player::Pose3d>(*settings())) {}

 protected:
  [[nodiscard]] const std::vector<player::Pose3d>& poses() const { return poses_; }

 private:
  const std::vector<player::Pose3d> poses_;
};

class SonarDevice final : public RingDevice {
 public:
  using RingDevice::RingDevice;

  void on_reading(DeviceId /*device*/, const sim::Reading& reading, DataSink& sink) override {
    const auto* ring = reading_as<sim::RangerReading>(reading);
    if (ring == nullptr) return;
    data_.ranges.clear();
    for (const double range_m : ring->ranges_m) data_.ranges.push_back(static_cast<float>(range_m));
    sink.data(PLAYER_SONAR_DATA_RANGES, player::encode(data_));
  }

 protected:
  std::optional<std::string> answer(std::uint8_t subtype, std::string_view payload) override {
    switch (subtype) {
      case PLAYER_SONAR_REQ_GET_GEOM:
        return player::encode(player::SonarGeom{poses()});
      case PLAYER_SONAR_REQ_POWER:
        static_cast<void>(player::decode<player::SonarPowerConfig>(payload));
        return empty_payload();  // simulated sonars are always on
      default:
        return std::nullopt;
    }
  }

 private:
  player::SonarData data_;
};

class IrDevice final : public RingDevice {
 public:
  using RingDevice::RingDevice;

  void on_reading(DeviceId /*device*/, const sim::Reading& reading, DataSink& sink) override {
    const auto* ring = reading_as<sim::RangerReading>(reading);
    if (ring == nullptr) return;
    data_.ranges.clear();
    data_.voltages.clear();
    for (std::size_t i = 0; i < ring->ranges_m.size(); ++i) {
      data_.ranges.push_back(static_cast<float>(ring->ranges_m[i]));
      data_.voltages.push_back(static_cast<float>(voltage_v(*ring, i, *settings())));
    }
    sink.data(PLAYER_IR_DATA_RANGES, player::encode(data_));
  }

 protected:
  std::optional<std::string> answer(std::uint8_t subtype, std::string_view payload) override {
    switch (subtype) {
      case PLAYER_IR_REQ_POSE:
        return player::encode(player::IrPose{poses()});
      case PLAYER_IR_REQ_POWER:
        static_cast<void>(player::decode<player::IrPowerReq>(payload));
        return empty_payload();  // simulated infrared sensors are always on
      default:
        return std::nullopt;
    }
  }

 private:
  player::IrData data_;
};

}  // namespace

MadeDevice make_ranging_device(const DeviceContext& context) {
  switch (context.interface) {
    case PLAYER_LASER_CODE:
      return std::make_unique<LaserDevice>(context);
    case PLAYER_RANGER_CODE:
      return std::make_unique<RangerDevice>(context);
    case PLAYER_SONAR_CODE:
      return std::make_unique<SonarDevice>(context);
    case PLAYER_IR_CODE:
      return std::make_unique<IrDevice>(context);
    default:
      return nullptr;
  }
}

}  // namespace playerlike::wire
