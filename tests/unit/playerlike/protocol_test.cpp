// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Playpen's protocol as bytes and as values: data survives both encodings bit by bit, however the
// bytes are split; invalid data gets a specific error.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "print_encoding.h"
#include "protocol/codec.h"
#include "protocol/framing.h"
#include "sim/devices/actarray.h"
#include "sim/devices/aio.h"
#include "sim/devices/air_sensors.h"
#include "sim/devices/amcl.h"
#include "sim/devices/battery.h"
#include "sim/devices/blinkenlight.h"
#include "sim/devices/blobfinder.h"
#include "sim/devices/builtin.h"
#include "sim/devices/bumper.h"
#include "sim/devices/camera.h"
#include "sim/devices/compass.h"
#include "sim/devices/contact_sensors.h"
#include "sim/devices/depth_camera.h"
#include "sim/devices/dio.h"
#include "sim/devices/fiducial.h"
#include "sim/devices/gps.h"
#include "sim/devices/gripper.h"
#include "sim/devices/hand.h"
#include "sim/devices/imu.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"
#include "sim/devices/opaque.h"
#include "sim/devices/posture.h"
#include "sim/devices/proximity.h"
#include "sim/devices/ptz.h"
#include "sim/devices/rangers.h"
#include "sim/devices/semantic_camera.h"
#include "sim/devices/space_sensors.h"
#include "sim/devices/waypoint.h"
#include "sim/devices/wifi.h"

namespace playerlike::protocol {

namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::size_t kLimit = std::size_t{1} << 20U;

/// The id of the ProtocolError that a call throws; "" if it throws none.
std::string error_of(const std::function<void()>& call, std::string* message = nullptr) {
  try {
    call();
  } catch (const ProtocolError& e) {
    if (message != nullptr) *message = e.what();
    return e.id();
  }
  return "";
}

std::string decode_error(std::string_view bytes, Encoding encoding) {
  return error_of([&] { static_cast<void>(decode(bytes, encoding)); });
}

/// The message after encoding and decoding.
json through(const json& message, Encoding encoding) {
  MessageSplitter splitter(encoding, 4 * kLimit);
  splitter.add(encode(message, encoding));
  const std::optional<std::string_view> bytes = splitter.next();
  if (!bytes) throw std::runtime_error("an encoded message is not whole");
  return decode(*bytes, encoding);
}

/// Does this for a value that is not a message by itself.
json value_through(const json& value, Encoding encoding) {
  return through({{"value", value}}, encoding).at("value");
}

// --- random values, and values as texts for comparison. `each(struct, f)` visits all members.

/// A finite double with uniformly distributed bits: also tiny, huge and -0.
double any_double(std::mt19937_64& random) {
  for (;;) {
    const auto value = std::bit_cast<double>(random());
    if (std::isfinite(value)) return random() % 16 == 0 ? -0.0 : value;
  }
}

std::string any_text(std::mt19937_64& random) {
  static const std::vector<std::string> kPieces = {"a", "Z",  "0",    " ",    "\"",   "\\",
                                                   "/", "\n", "\t",   "\x01", "\x7f", "é",
                                                   "Ř", "→",  "🤖", "[1,2"};
  std::string text;
  for (auto i = random() % 12; i > 0; --i) text += kPieces[random() % kPieces.size()];
  return text;
}

// Before the classes that call it: for an array they find no function by its type.
template <typename F>
void each(std::array<double, 3>& v, F& f) {
  f(v[0]), f(v[1]), f(v[2]);
}

class Filler {
 public:
  explicit Filler(std::mt19937_64& random) : random_(random) {}

  void operator()(double& value) { value = any_double(random_); }
  void operator()(bool& value) { value = random_() % 2 == 0; }
  void operator()(std::string& value) { value = any_text(random_); }
  void operator()(int& value) { value = static_cast<int>(random_()); }
  void operator()(std::int64_t& value) { value = static_cast<std::int64_t>(random_() >> 1U); }
  void operator()(std::uint64_t& value) { value = random_() >> 1U; }
  void operator()(std::uint32_t& value) { value = static_cast<std::uint32_t>(random_()); }
  void operator()(std::uint8_t& value) { value = static_cast<std::uint8_t>(random_()); }
  void operator()(sim::BatteryStatus& value) { pick(value, 3); }
  void operator()(sim::WaypointStatus& value) { pick(value, 3); }
  void operator()(sim::GripperState& value) { pick(value, 4); }
  void operator()(sim::GripCommand::Action& value) { pick(value, 5); }
  void operator()(sim::JointState& value) { pick(value, 4); }
  void operator()(sim::JointCommand::Mode& value) { pick(value, 5); }
  void operator()(sim::JointSettingCommand::Setting& value) { pick(value, 4); }
  void operator()(sim::LayerKind& value) { pick(value, 3); }
  void operator()(sim::TimeMode& value) { pick(value, 2); }
  template <typename T>
  void operator()(std::optional<T>& value) {
    value.reset();
    if (random_() % 2 == 0) (*this)(value.emplace());
  }
  template <typename T>
  void operator()(std::vector<T>& values) {
    // Often so many that a list of numbers counts as long.
    values.resize(random_() % (2 * kLongList));
    for (T& value : values) (*this)(value);
  }
  template <typename T>
  void operator()(std::map<std::string, T>& values) {
    values.clear();
    for (auto i = random_() % 5; i > 0; --i) (*this)(values[any_text(random_)]);
  }
  template <typename Struct>
  void operator()(Struct& value) {
    each(value, *this);
  }

 private:
  template <typename Enum>
  void pick(Enum& value, std::uint64_t count) {
    value = static_cast<Enum>(random_() % count);
  }
  std::mt19937_64& random_;
};

template <typename T>
void fill(T& value, std::mt19937_64& random) {
  Filler filler(random);
  filler(value);
}

class Writer {
 public:
  void operator()(const double& value) { append(std::bit_cast<std::uint64_t>(value)); }
  void operator()(const std::string& value) { out += value + ';'; }
  template <typename T>
  void operator()(const std::optional<T>& value) {
    append(value.has_value());
    if (value) (*this)(*value);
  }
  template <typename T>
  void operator()(const std::vector<T>& values) {
    append(values.size());
    for (const T& value : values) (*this)(value);
  }
  template <typename T>
  void operator()(const std::map<std::string, T>& values) {
    append(values.size());
    for (const auto& [key, value] : values) {
      (*this)(key);
      (*this)(value);
    }
  }
  template <typename T>
  void operator()(const T& value) {
    if constexpr (std::is_enum_v<T>) {
      append(static_cast<int>(value));
    } else if constexpr (std::is_integral_v<T>) {
      append(value);
    } else {
      each(const_cast<T&>(value), *this);
    }
  }

  std::string out;

 private:
  template <typename T>
  void append(T value) {
    out += std::to_string(value) + ' ';
  }
};

template <typename F>
void each(sim::Pose& v, F& f) {
  f(v.x_m), f(v.y_m), f(v.yaw_rad);
}
template <typename F>
void each(sim::Twist& v, F& f) {
  f(v.v_mps), f(v.omega_radps), f(v.lateral_mps);
}
template <typename F>
void each(sim::Vec2& v, F& f) {
  f(v.x()), f(v.y());
}
template <typename F>
void each(sim::Colour& v, F& f) {
  f(v.r), f(v.g), f(v.b), f(v.a);
}
template <typename F>
void each_of_reading(sim::Reading& v, F& f) {
  f(v.time_ns), f(v.sequence);
}
/// Limits a number of lines.
void limit(int& count, int most) { count = std::abs(count % (most + 1)); }
template <typename F>
void each(sim::JointReading& v, F& f) {
  f(v.state), f(v.position), f(v.speed), f(v.acceleration), f(v.current_a);
  f(v.speed_setting), f(v.acceleration_setting);
}
template <typename F>
void each(sim::ActArrayReading& v, F& f) {
  each_of_reading(v, f);
  f(v.joints), f(v.is_powered);
}
template <typename F>
void each(sim::AioReading& v, F& f) {
  each_of_reading(v, f);
  f(v.inputs_v), f(v.outputs_v);
}
template <typename F>
void each(sim::BlinkenlightReading& v, F& f) {
  each_of_reading(v, f);
  f(v.enabled), f(v.colour), f(v.period_s), f(v.duty_cycle), f(v.lit);
}
template <typename F>
void each(sim::DioReading& v, F& f) {
  each_of_reading(v, f);
  f(v.input_count), f(v.inputs), f(v.output_count), f(v.outputs);
  limit(v.input_count, sim::DioParams::kMaxLines);
  limit(v.output_count, sim::DioParams::kMaxLines);
}
template <typename F>
void each(sim::GripperReading& v, F& f) {
  each_of_reading(v, f);
  f(v.state), f(v.outer_beam), f(v.inner_beam), f(v.holding), f(v.stored), f(v.gap_m);
  limit(v.stored, sim::GripperParams::kMaxStored);
}
template <typename F>
void each(sim::OpaqueReading& v, F& f) {
  each_of_reading(v, f);
  f(v.data), f(v.number), f(v.lost);
}
template <typename F>
void each(sim::BatteryReading& v, F& f) {
  each_of_reading(v, f);
  f(v.charge_percent), f(v.status), f(v.voltage_v), f(v.energy_wh), f(v.capacity_wh);
  f(v.power_w);
}
template <typename F>
void each(sim::BlobfinderReading::Blob& v, F& f) {
  f(v.colour);
  for (int* pixels : {&v.area, &v.x, &v.y, &v.left, &v.right, &v.top, &v.bottom}) {
    f(*pixels);
    limit(*pixels, 1'000'000);
  }
  f(v.range_m);
}
template <typename F>
void each(sim::BlobfinderReading& v, F& f) {
  each_of_reading(v, f);
  f(v.width), f(v.height), f(v.blobs);
  limit(v.width, 10'000);
  limit(v.height, 10'000);
}
template <typename F>
void each(sim::CameraReading& v, F& f) {
  each_of_reading(v, f);
  f(v.width), f(v.height), f(v.pixels);
  limit(v.width, 7);
  limit(v.height, 5);
  v.pixels.resize(static_cast<std::size_t>(3 * v.width * v.height));
}
template <typename F>
void each(sim::DepthCameraReading& v, F& f) {
  each_of_reading(v, f);
  f(v.width), f(v.height), f(v.focal_px), f(v.centre_px), f(v.depths_m);
  limit(v.width, 7);
  limit(v.height, 5);
  v.depths_m.resize(static_cast<std::size_t>(v.width * v.height));
}
template <typename F>
void each(sim::HandReading& v, F& f) {
  each_of_reading(v, f);
  f(v.held), f(v.near);
}
template <typename F>
void each(sim::PtzReading& v, F& f) {
  each_of_reading(v, f);
  f(v.pan_rad), f(v.tilt_rad), f(v.view_rad), f(v.moving);
  f(v.pan_speed_radps), f(v.tilt_speed_radps), f(v.zoom_speed_radps);
}
template <typename F>
void each(sim::PoseHypothesis& v, F& f) {
  f(v.mean), f(v.weight), f(v.covariance.variance), f(v.covariance.covariance);
}
template <typename F>
void each(sim::AmclReading& v, F& f) {
  each_of_reading(v, f);
  f(v.hypotheses), f(v.particles), f(v.pending), f(v.map_width), f(v.map_height);
  f(v.map_resolution_m), f(v.updates);
}
template <typename F>
void each(sim::BumperReading& v, F& f) {
  each_of_reading(v, f);
  f(v.pressed);
}
template <typename F>
void each(sim::CollisionReading& v, F& f) {
  each_of_reading(v, f);
  f(v.collision), f(v.objects);
}
template <typename F>
void each(sim::AccelerometerReading& v, F& f) {
  each_of_reading(v, f);
  f(v.distance_m), f(v.velocity_mps), f(v.acceleration_mps2), f(v.angular_radps2);
}
template <typename F>
void each(sim::AirspeedReading& v, F& f) {
  each_of_reading(v, f);
  f(v.pressure_pa);
}
template <typename F>
void each(sim::AltimeterReading& v, F& f) {
  each_of_reading(v, f);
  f(v.height_m), f(v.in_range);
}
template <typename F>
void each(sim::AttitudeReading& v, F& f) {
  each_of_reading(v, f);
  f(v.yaw_rad), f(v.pitch_rad), f(v.roll_rad), f(v.rate_radps);
}
template <typename F>
void each(sim::BarometerReading& v, F& f) {
  each_of_reading(v, f);
  f(v.pressure_pa);
}
template <typename F>
void each(sim::ClockReading& v, F& f) {
  each_of_reading(v, f);
}
template <typename F>
void each(sim::GyroscopeReading& v, F& f) {
  each_of_reading(v, f);
  f(v.yaw_rad), f(v.pitch_rad), f(v.roll_rad);
}
template <typename F>
void each(sim::PostureReading& v, F& f) {
  each_of_reading(v, f);
  f(v.joints), f(v.positions);
}
template <typename F>
void each(sim::SemanticCameraReading::Object& v, F& f) {
  f(v.name), f(v.type), f(v.position_m), f(v.vector), f(v.scalar);
}
template <typename F>
void each(sim::SemanticCameraReading& v, F& f) {
  each_of_reading(v, f);
  f(v.objects);
}
template <typename F>
void each(sim::ThermometerReading& v, F& f) {
  each_of_reading(v, f);
  f(v.temperature_c);
}
template <typename F>
void each(sim::VelocityReading& v, F& f) {
  each_of_reading(v, f);
  f(v.linear_mps), f(v.angular_radps), f(v.world_mps);
}
template <typename F>
void each(sim::CompassReading& v, F& f) {
  each_of_reading(v, f);
  f(v.heading_rad);
}
template <typename F>
void each(sim::FiducialReading::Mark& v, F& f) {
  f(v.id), f(v.X_ST);
}
template <typename F>
void each(sim::FiducialReading& v, F& f) {
  each_of_reading(v, f);
  f(v.marks);
}
template <typename F>
void each(sim::GpsReading& v, F& f) {
  each_of_reading(v, f);
  f(v.latitude_rad), f(v.longitude_rad), f(v.altitude_m), f(v.speed_mps), f(v.course_rad);
  f(v.utm_easting_m), f(v.utm_northing_m), f(v.satellites), f(v.quality);
  f(v.position_m), f(v.velocity_mps), f(v.heading_rad);
}
template <typename F>
void each(sim::ImuReading& v, F& f) {
  each_of_reading(v, f);
  for (auto* vector : {&v.acceleration_mps2, &v.rate_radps, &v.field_ut}) {
    for (double& value : *vector) f(value);
  }
  f(v.yaw_rad);
}
template <typename F>
void each(sim::LaserReading& v, F& f) {  // without X_WB, which is not sent to clients
  each_of_reading(v, f);
  f(v.ranges_m), f(v.angle_min_rad), f(v.resolution_rad), f(v.range_max_m);
}
template <typename F>
void each(sim::PoseReading& v, F& f) {
  each_of_reading(v, f);
  f(v.pose), f(v.twist), f(v.stalled), f(v.path_length_m), f(v.increment);
}
template <typename F>
void each(sim::ProximityReading::Neighbour& v, F& f) {
  f(v.name), f(v.distance_m);
}
template <typename F>
void each(sim::ProximityReading& v, F& f) {
  each_of_reading(v, f);
  f(v.near_objects);
}
template <typename F>
void each(sim::RangerReading& v, F& f) {
  each_of_reading(v, f);
  f(v.ranges_m), f(v.X_BS), f(v.range_max_m), f(v.field_of_view_rad);
  v.X_BS.resize(v.ranges_m.size());  // as many as there are
}
template <typename F>
void each(sim::WaypointReading& v, F& f) {
  each_of_reading(v, f);
  f(v.status), f(v.goal_number), f(v.goal_m), f(v.distance_m);
}
template <typename F>
void each(sim::WifiReading::Link& v, F& f) {
  f(v.name), f(v.mac), f(v.ip), f(v.access_point), f(v.level_dbm);
}
template <typename F>
void each(sim::WifiReading& v, F& f) {
  each_of_reading(v, f);
  f(v.links), f(v.own_ip), f(v.floor_dbm), f(v.channel_mhz);
}
template <typename F>
void each(sim::TwistCommand& v, F& f) {
  f(v.twist);
}
template <typename F>
void each(sim::MotorEnableCommand& v, F& f) {
  f(v.enabled);
}
template <typename F>
void each(sim::SetPoseCommand& v, F& f) {
  f(v.pose), f(v.variance), f(v.covariance);
}
template <typename F>
void each(sim::GotoCommand& v, F& f) {
  f(v.goal_m), f(v.tolerance_m), f(v.speed_mps), f(v.z_m);
}
template <typename F>
void each(sim::StopCommand&, F&) {}
template <typename F>
void each(sim::ResumeCommand&, F&) {}
template <typename F>
void each(sim::PlaceCommand& v, F& f) {
  f(v.pose);
}
template <typename F>
void each(sim::TranslateCommand& v, F& f) {
  f(v.offset_m);
}
template <typename F>
void each(sim::RotateCommand& v, F& f) {
  f(v.yaw_rad);
}
template <typename F>
void each(sim::OrientCommand& v, F& f) {
  f(v.roll_rad), f(v.pitch_rad), f(v.yaw_rad);
}
template <typename F>
void each(sim::TrackCommand& v, F& f) {
  f(v.range_m), f(v.tag);
}
template <typename F>
void each(sim::TrajectoryCommand& v, F& f) {
  f(v.start_s), f(v.times_s), f(v.positions);
}
template <typename F>
void each(sim::HeadingCommand& v, F& f) {
  f(v.v_mps), f(v.lateral_mps), f(v.yaw_rad), f(v.frame);
}
template <typename F>
void each(sim::PositionCommand& v, F& f) {
  f(v.goal), f(v.max_speed_mps), f(v.max_turn_rate_radps), f(v.frame);
}
template <typename F>
void each(sim::CarCommand& v, F& f) {
  f(v.v_mps), f(v.steering_rad);
}
template <typename F>
void each(sim::SayCommand& v, F& f) {
  f(v.text);
}
template <typename F>
void each(sim::DigitalOutputCommand& v, F& f) {
  f(v.count), f(v.bits);
  limit(v.count, sim::DioParams::kMaxLines);
}
template <typename F>
void each(sim::AnalogOutputCommand& v, F& f) {
  f(v.channel), f(v.voltage_v);
  limit(v.channel, sim::AioParams::kMaxLines - 1);
}
template <typename F>
void each(sim::LightCommand& v, F& f) {
  f(v.enabled), f(v.colour), f(v.period_s), f(v.duty_cycle);
}
template <typename F>
void each(sim::GripCommand& v, F& f) {
  f(v.action);
}
template <typename F>
void each(sim::PointCommand& v, F& f) {
  f(v.pan_rad), f(v.tilt_rad), f(v.view_rad), f(v.pan_speed_radps), f(v.tilt_speed_radps);
}
template <typename F>
void each(sim::PanCommand& v, F& f) {
  f(v.pan_speed_radps), f(v.tilt_speed_radps), f(v.zoom_speed_radps);
}
template <typename F>
void each(sim::OpaqueCommand& v, F& f) {
  f(v.data);
}
template <typename F>
void each(sim::JointCommand& v, F& f) {
  f(v.mode), f(v.joint), f(v.values);
  limit(v.joint, sim::ActArrayParams::kMaxJoints - 1);
}
template <typename F>
void each(sim::JointSettingCommand& v, F& f) {
  f(v.setting), f(v.joint), f(v.value);
  limit(v.joint, sim::ActArrayParams::kMaxJoints - 1);
}
template <typename F>
void each(DeviceInfo& v, F& f) {  // the id follows from the position
  f(v.name), f(v.type), f(v.properties);
}
template <typename F>
void each(sim::DriverDescription& v, F& f) {
  f(v.type), f(v.settings);
}
template <typename F>
void each(RobotInfo& v, F& f) {
  f(v.name), f(v.model), f(v.colour), f(v.initial_pose);
  f(v.length_m), f(v.width_m), f(v.height_m), f(v.center_m);
  f(v.max_speed_mps), f(v.max_turn_rate_radps);
  f(v.proxies), f(v.interfaces), f(v.drivers), f(v.devices);
}
template <typename F>
void each(CanvasInfo& v, F& f) {
  f(v.width), f(v.height), f(v.cell_size_m), f(v.origin_x_m), f(v.origin_y_m);
}
template <typename F>
void each(TimeStatistics& v, F& f) {
  f(v.sim_time_ns), f(v.steps), f(v.step_s), f(v.wall_time_s), f(v.real_time_factor);
  f(v.duration_s), f(v.mode), f(v.finished);
}
template <typename F>
void each(sim::LayerStyle& v, F& f) {
  f(v.name), f(v.colour), f(v.transparency), f(v.transparent_colour), f(v.priority), f(v.visible);
}
template <typename F>
void each(sim::LayerInfo& v, F& f) {
  f(v.id), f(v.kind), f(v.owner), f(v.style);
}

template <typename T>
std::string written(const T& value) {
  Writer writer;
  writer(value);
  return writer.out;
}

class EachEncoding : public testing::TestWithParam<Encoding> {};
INSTANTIATE_TEST_SUITE_P(Protocol, EachEncoding, testing::Values(Encoding::kJson, Encoding::kCbor),
                         [](const auto& it) { return std::string(to_string(it.param)); });

// --- framing

TEST(Framing, NamesEncodings) {
  EXPECT_EQ(parse_encoding("json"), Encoding::kJson);
  EXPECT_EQ(parse_encoding("cbor"), Encoding::kCbor);
  EXPECT_EQ(parse_encoding("CBOR"), std::nullopt);
  EXPECT_EQ(parse_encoding(""), std::nullopt);
}

TEST_P(EachEncoding, SplitsAStreamWhateverItsPieces) {
  std::vector<json> messages;
  for (std::size_t length : {0U, 1U, 2U, 30U, 300U, 3U, 70000U, 5U}) {
    messages.push_back({{"id", messages.size()}, {"text", std::string(length, 'x')}});
  }
  std::string stream;
  for (const json& message : messages) stream += encode(message, GetParam());
  std::mt19937_64 random(1);
  for (const std::size_t most : {1U, 2U, 3U, 4U, 5U, 7U, 100U, 5000U, 100000U}) {
    MessageSplitter splitter(GetParam(), kLimit);
    std::vector<json> received;
    for (std::size_t at = 0; at < stream.size();) {
      const std::size_t size =
          std::min(stream.size() - at, most < 100 ? most : 1 + random() % most);
      // Half of the time like a socket, which may write less than there is room for.
      if (random() % 2 == 0) {
        splitter.add(std::string_view(stream).substr(at, size));
      } else {
        std::memcpy(splitter.room(size + random() % 100).data(), stream.data() + at, size);
        splitter.added(size);
      }
      at += size;
      while (const auto message = splitter.next()) {
        received.push_back(decode(*message, GetParam()));
      }
    }
    EXPECT_EQ(received, messages) << "pieces of up to " << most;
    EXPECT_FALSE(splitter.partial());
  }
}

TEST_P(EachEncoding, KnowsWhetherPartOfAMessageWaits) {
  const std::string bytes = encode({{"id", 1}}, GetParam());
  MessageSplitter splitter(GetParam(), kLimit);
  EXPECT_FALSE(splitter.partial());
  splitter.add(std::string_view(bytes).substr(0, 1));
  EXPECT_EQ(splitter.next(), std::nullopt);
  EXPECT_TRUE(splitter.partial());
  splitter.add(std::string_view(bytes).substr(1));
  EXPECT_NE(splitter.next(), std::nullopt);
  EXPECT_FALSE(splitter.partial());
  splitter.add("");
  EXPECT_FALSE(splitter.partial());
}

TEST(Framing, LinesMayEndWithReturnAndLineFeed) {
  MessageSplitter splitter(Encoding::kJson, 3);
  splitter.add("abc\r\n\n\r\na\rb\nx");
  EXPECT_EQ(splitter.next(), "abc");
  EXPECT_EQ(splitter.next(), "");
  EXPECT_EQ(splitter.next(), "");
  EXPECT_EQ(splitter.next(), "a\rb");
  EXPECT_EQ(splitter.next(), std::nullopt);
}

TEST(Framing, ALineThatIsTooLongIsKnownBeforeItsEnd) {
  MessageSplitter splitter(Encoding::kJson, 3);
  splitter.add("abc");
  EXPECT_EQ(splitter.next(), std::nullopt);
  splitter.add("\r");  // may be a part of the line's end
  EXPECT_EQ(splitter.next(), std::nullopt);
  splitter.add("x");
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(error_of([&] { static_cast<void>(splitter.next()); }), "protocol/too-long");
  }
  MessageSplitter whole(Encoding::kJson, 3);
  whole.add("abcd\n");
  EXPECT_EQ(error_of([&] { static_cast<void>(whole.next()); }), "protocol/too-long");
}

TEST(Framing, AFrameThatIsTooLongIsKnownByItsLength) {
  MessageSplitter splitter(Encoding::kCbor, 3);
  splitter.add(std::string_view("\0\0\0\3abc\0\0\0", 10));
  EXPECT_EQ(splitter.next(), "abc");
  EXPECT_EQ(splitter.next(), std::nullopt);
  splitter.add("\4");
  EXPECT_EQ(error_of([&] { static_cast<void>(splitter.next()); }), "protocol/too-long");
  MessageSplitter gigabytes(Encoding::kCbor, kLimit);
  gigabytes.add("\xff\xff\xff\xff");
  EXPECT_EQ(error_of([&] { static_cast<void>(gigabytes.next()); }), "protocol/too-long");
}

TEST(Framing, TheEncodingMayChangeInTheMiddleOfAPiece) {
  const json message = {{"id", 7}};
  MessageSplitter splitter(Encoding::kJson, kLimit);
  splitter.add("1 playpen hello\n" + encode(message, Encoding::kCbor) + "1 time now\n");
  EXPECT_EQ(splitter.next(), "1 playpen hello");
  splitter.set_encoding(Encoding::kCbor);
  EXPECT_EQ(decode(splitter.next().value(), Encoding::kCbor), message);
  splitter.set_encoding(Encoding::kJson);
  EXPECT_EQ(splitter.next(), "1 time now");
}

TEST(Framing, TheLimitMayChange) {
  MessageSplitter splitter(Encoding::kJson, 10);
  splitter.add("123456\n1234\n");
  EXPECT_EQ(splitter.next(), "123456");
  splitter.set_limit(3);
  EXPECT_EQ(error_of([&] { static_cast<void>(splitter.next()); }), "protocol/too-long");
}

// --- values

TEST_P(EachEncoding, ValuesComeOutAsTheyWentIn) {
  const json message = {
      {"null", nullptr},
      {"yes", true},
      {"no", false},
      {"zero", 0},
      {"greatest", std::numeric_limits<std::uint64_t>::max()},
      {"least", std::numeric_limits<std::int64_t>::min()},
      {"counts", {23, 24, 255, 256, 65535, 65536, 4294967295, 4294967296, -24, -25, -256, -257}},
      {"text", "a\"b\\c\n\x01 é→🤖"},
      {"", {{"deep", {{{"list", json::array()}, {"object", json::object()}}}}}}};
  EXPECT_EQ(through(message, GetParam()), message);
}

TEST_P(EachEncoding, DoublesComeOutToTheBit) {
  std::mt19937_64 random(2);
  std::vector<double> numbers = {0.0,
                                 -0.0,
                                 1.0,
                                 -5.0,
                                 0.1,
                                 1e22,
                                 1e300,
                                 9007199254740993.0,
                                 18446744073709551616.0,
                                 std::numeric_limits<double>::max(),
                                 std::numeric_limits<double>::min(),
                                 std::numeric_limits<double>::denorm_min(),
                                 -std::numeric_limits<double>::denorm_min()};
  for (int i = 0; i < 5000; ++i) numbers.push_back(any_double(random));
  for (const double number : numbers) {
    const json value = value_through(number, GetParam());
    ASSERT_TRUE(value.is_number_float()) << number;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(value.get<double>()),
              std::bit_cast<std::uint64_t>(number))
        << number;
  }
  for (const std::size_t count : {0U, 1U, 15U, 16U, 17U, 5000U}) {
    const std::vector<double> some(numbers.begin(), numbers.begin() + static_cast<int>(count));
    const json message = through({{"numbers", doubles(some, GetParam())}}, GetParam());
    EXPECT_EQ(written(require_doubles(message, "numbers", GetParam())), written(some)) << count;
  }
}

TEST_P(EachEncoding, BytesComeOutAsTheyWentIn) {
  std::mt19937_64 random(3);
  for (std::size_t size = 0; size < 70; ++size) {
    std::vector<std::uint8_t> data(size);
    for (std::uint8_t& byte : data) byte = static_cast<std::uint8_t>(random());
    const json message = through({{"data", bytes(data, GetParam())}}, GetParam());
    EXPECT_EQ(require_bytes(message, "data", GetParam()), data);
  }
}

TEST(JsonText, BytesAreBase64AsInTheStandard) {
  // RFC 4648, section 10.
  const std::map<std::string, std::string> vectors = {{"", ""},
                                                      {"f", "Zg=="},
                                                      {"fo", "Zm8="},
                                                      {"foo", "Zm9v"},
                                                      {"foob", "Zm9vYg=="},
                                                      {"fooba", "Zm9vYmE="},
                                                      {"foobar", "Zm9vYmFy"}};
  for (const auto& [plain, text] : vectors) {
    EXPECT_EQ(bytes({plain.begin(), plain.end()}, Encoding::kJson), text);
  }
  for (const char* wrong : {"Z", "Zg", "Zg=", "Zg===", "=",
                            "====", "Z===", "Zg==Zg==", "Zh==", "Zm9=", "Zm 9", "Zm9v\n", "Zm-_"}) {
    EXPECT_EQ(error_of([&] {
                static_cast<void>(require_bytes({{"b", wrong}}, "b", Encoding::kJson));
              }),
              "protocol/bad-value")
        << wrong;
  }
}

TEST_P(EachEncoding, TextsThatAreNoUtf8AreSentWithReplacements) {
  const json message = {{"te\xffxt", {"a\xc3", {{"k\xed\xa0\x80", "\xf0\x9f\xa4\x96"}}}}, {"n", 1}};
  const json received = through(message, GetParam());
  EXPECT_EQ(received.at("te\uFFFDxt").at(0), "a\uFFFD");
  EXPECT_EQ(received.at("te\uFFFDxt").at(1).begin().value(), "🤖");
  EXPECT_EQ(received.at("n"), 1);
}

TEST(JsonText, AMessageIsOneLine) {
  const std::string line = encode({{"text", "a\nb\r\u2028"}, {"n", 1.0}}, Encoding::kJson);
  EXPECT_EQ(line, "{\"n\":1.0,\"text\":\"a\\nb\\r\u2028\"}\n");
}

TEST(JsonText, NumbersThatAreNotFiniteAreWrittenAsNull) {
  EXPECT_EQ(encode({{"n", std::nan("")}}, Encoding::kJson), "{\"n\":null}\n");
}

TEST(JsonText, LongListsOfNumbersAreReadAsTheParserWould) {
  // Many spellings, between other lists that look similar.
  const std::string numbers =
      " 0 ,-0,1.5e3,1E-2 ,\t12345678901234567890,0.1,2e+2,-7.25,8,9,10,11,12,13,14,15,1e-300 ";
  const std::string text = "{\"a\":[[],[1,2],[" + numbers + "],{\"b\":[" + numbers + "]},\"[" +
                           "1,2\\\"\"],\"c\":[1,[" + numbers + "]]}";
  const json expected = json::parse(text);
  const json decoded = decode(text, Encoding::kJson);
  const auto check = [](const json& holder, const char* key, const json& list) {
    ASSERT_TRUE(holder.at(key).is_binary());
    EXPECT_EQ(require_doubles(holder, key, Encoding::kJson), list.get<std::vector<double>>());
  };
  EXPECT_EQ(decoded["a"][0], expected["a"][0]);
  EXPECT_EQ(decoded["a"][1], expected["a"][1]);
  check({{"x", decoded["a"][2]}}, "x", expected["a"][2]);
  check(decoded["a"][3], "b", expected["a"][3]["b"]);
  EXPECT_EQ(decoded["a"][4], expected["a"][4]);
  EXPECT_EQ(decoded["c"][0], expected["c"][0]);
  check({{"x", decoded["c"][1]}}, "x", expected["c"][1]);
  // A number that from_chars does not accept leaves the list to the parser.
  const std::string tiny = "[" + numbers + ",1e-400]";
  EXPECT_EQ(decode("{\"a\":" + tiny + "}", Encoding::kJson).at("a"), json::parse(tiny));
}

TEST(JsonText, ShortListsAndValuesOfLinesStayLists) {
  EXPECT_EQ(decode("{\"a\":[1,2,3]}", Encoding::kJson), (json{{"a", {1, 2, 3}}}));
  const json list = std::vector<int>(100, 3);
  EXPECT_EQ(decode_json_value(list.dump()), list);
  EXPECT_EQ(decode_json_value(" 3 "), 3);
  EXPECT_EQ(decode_json_value("null"), nullptr);
  EXPECT_EQ(error_of([] { static_cast<void>(decode_json_value("3 4")); }), "protocol/syntax");
}

// --- what is refused

std::string repeated(const std::string& text, int times) {
  std::string out;
  for (int i = 0; i < times; ++i) out += text;
  return out;
}

TEST(JsonText, RefusesWhatIsNoJson) {
  for (const std::string text : {"",
                                 " ",
                                 "{",
                                 "}",
                                 "{\"a\":1",
                                 "{\"a\":1}}",
                                 "{\"a\":1} x",
                                 "{a:1}",
                                 "{'a':1}",
                                 "{\"a\":01}",
                                 "{\"a\":.5}",
                                 "{\"a\":1.}",
                                 "{\"a\":+1}",
                                 "{\"a\":NaN}",
                                 "{\"a\":Infinity}",
                                 "{\"a\":nul}",
                                 "{\"a\":1,}",
                                 "{\"a\":[1,]}",
                                 "{\"a\":\"\\x\"}",
                                 "{\"a\":\"\\ud800\"}",
                                 "{\"a\":\"\xff\"}",
                                 "{\"a\":\"\xc3\"}",
                                 "{\"a\":\"\xed\xa0\x80\"}",
                                 "{\"a\":\"\xc0\x80\"}",
                                 "{\"\xff\":1}",
                                 "{\"a\":\"\n\"}",
                                 "// no\n{}",
                                 "\x7f\x45\x4c\x46",
                                 "{\"a\":\"b",
                                 "{\"a\":\"b\\"}) {
    EXPECT_EQ(decode_error(text, Encoding::kJson), "protocol/syntax") << text;
  }
  EXPECT_EQ(decode_error(std::string(3, '\0'), Encoding::kJson), "protocol/syntax");
  // The same errors in lists that are read by the fast method.
  const std::string many = repeated("1,", kLongList);
  for (const char* last : {"01", ".5", "1.", "1.e5", "+1", "NaN", "inf", "0x1", "1e", "-", "",
                           "1 2", "1]", "\"", "1.5.5", "--1"}) {
    EXPECT_EQ(decode_error("{\"a\":[" + many + last + "]}", Encoding::kJson), "protocol/syntax")
        << last;
  }
}

TEST(JsonText, TellsWhereTheTextIsWrong) {
  std::string message;
  const std::string text = "{\"a\":[" + repeated("1.25,", 30) + "1],\"b\":x}";
  error_of([&] { static_cast<void>(decode(text, Encoding::kJson)); }, &message);
  // In the original text, although the list was taken out: 6 + 30 * 5 + 3 + 4 bytes precede the x.
  EXPECT_THAT(message, HasSubstr("column 164"));
  error_of([&] { static_cast<void>(decode('"' + std::string(5000, 'x'), Encoding::kJson)); },
           &message);
  EXPECT_THAT(message, SizeIs(testing::Lt(300U))) << "as long as what was sent";
}

TEST(JsonText, RefusesNumbersThatAreTooLarge) {
  for (const std::string& number : {std::string("1e999"), std::string("-1e999"),
                                    std::string(400, '9'), "-" + std::string(400, '9')}) {
    EXPECT_EQ(decode_error("{\"a\":" + number + "}", Encoding::kJson), "protocol/number") << number;
    EXPECT_EQ(decode_error("{\"a\":[" + repeated("1,", kLongList) + number + "]}", Encoding::kJson),
              "protocol/number")
        << number;
  }
}

TEST(JsonText, RefusesDeepNesting) {
  const auto nested = [](int levels, const char* open, const char* close) {
    return "{\"a\":" + repeated(open, levels - 1) + "1" + repeated(close, levels - 1) + "}";
  };
  EXPECT_EQ(decode_error(nested(kMaxDepth, "[", "]"), Encoding::kJson), "");
  EXPECT_EQ(decode_error(nested(kMaxDepth + 1, "[", "]"), Encoding::kJson), "protocol/too-deep");
  EXPECT_EQ(decode_error(nested(kMaxDepth, "{\"a\":", "}"), Encoding::kJson), "");
  EXPECT_EQ(decode_error(nested(kMaxDepth + 1, "{\"a\":", "}"), Encoding::kJson),
            "protocol/too-deep");
  EXPECT_EQ(decode_error(repeated("[", 1000000), Encoding::kJson), "protocol/too-deep");
  EXPECT_EQ(decode_error(repeated("{\"a\":", 200000), Encoding::kJson), "protocol/too-deep");
}

TEST(JsonText, RefusesAKeyThatStandsTwice) {
  EXPECT_EQ(decode_error(R"({"a":1,"b":{"c":1,"d":2,"c":3}})", Encoding::kJson),
            "protocol/duplicate-key");
  EXPECT_EQ(decode_error(R"({"a":1,"b":{"a":1}})", Encoding::kJson), "");
}

TEST_P(EachEncoding, RefusesAMessageThatIsNoObject) {
  for (const json& value : {json(nullptr), json(1), json("text"), json{1, 2}}) {
    const std::string bytes = encode(value, GetParam());
    MessageSplitter splitter(GetParam(), kLimit);
    splitter.add(bytes);
    EXPECT_EQ(decode_error(splitter.next().value(), GetParam()), "protocol/not-an-object");
  }
}

/// {"a": ITEM} in CBOR.
std::string cbor_of(const std::string& item) { return "\xa1\x61" + ("a" + item); }

TEST(Cbor, ReadsWhatTheStandardHas) {
  // RFC 8949, appendix A.
  const std::vector<std::pair<std::string, json>> items = {
      {{"\x00", 1}, 0},
      {{"\x18\x18", 2}, 24},
      {{"\x1b\xff\xff\xff\xff\xff\xff\xff\xff", 9}, std::numeric_limits<std::uint64_t>::max()},
      {{"\x38\x63", 2}, -100},
      {{"\x3b\x7f\xff\xff\xff\xff\xff\xff\xff", 9}, std::numeric_limits<std::int64_t>::min()},
      {{"\xf9\x00\x00", 3}, 0.0},
      {{"\xf9\x3c\x00", 3}, 1.0},
      {{"\xf9\x3e\x00", 3}, 1.5},
      {{"\xf9\x7b\xff", 3}, 65504.0},
      {{"\xf9\x00\x01", 3}, 5.960464477539063e-8},
      {{"\xf9\x04\x00", 3}, 0.00006103515625},
      {{"\xf9\xc4\x00", 3}, -4.0},
      {{"\xfa\x47\xc3\x50\x00", 5}, 100000.0},
      {{"\xfb\x3f\xf1\x99\x99\x99\x99\x99\x9a", 9}, 1.1},
      {{"\xf4", 1}, false},
      {{"\xf5", 1}, true},
      {{"\xf6", 1}, nullptr},
      {{"\x62\xc3\xbc", 3}, "ü"},
      {{"\x83\x01\x82\x02\x03\x80", 6}, {1, {2, 3}, json::array()}},
      {{"\x1b\x00\x00\x00\x00\x00\x00\x00\x01", 9}, 1},  // longer than need be
  };
  for (const auto& [item, value] : items) {
    EXPECT_EQ(decode(cbor_of(item), Encoding::kCbor).at("a"), value) << value;
  }
  EXPECT_TRUE(
      std::signbit(decode(cbor_of({"\xf9\x80\x00", 3}), Encoding::kCbor).at("a").get<double>()));
}

TEST(Cbor, RefusesWhatIsNotPartOfTheProtocol) {
  using namespace std::string_literals;
  const std::vector<std::string> items = {
      ""s,      // nothing
      "\x18"s,  // a length cut off
      "\x1c"s,
      "\x1d"s,
      "\x1e"s,  // reserved
      "\x1f"s,  // reserved
      "\x42z"s,
      "\x62z"s,  // ends too early
      "\x5f\x41z\xff"s,
      "\x7f\x61z\xff"s,  // indefinite lengths
      "\x9f\x01\xff"s,
      "\xbf\x61z\x01\xff"s,  //
      "\xff"s,               // a break without
      "\x61\xff"s,
      "\x62\xc0\x80"s,          // no UTF-8
      "\x63\xed\xa0\x80"s,      // a surrogate
      "\x64\xf4\x90\x80\x80"s,  // beyond Unicode
      "\xa1\x01\x01"s,          // a key that is no text
      "\xc0\x61z"s,
      "\xc2\x41\x01"s,  // tags: a date, a large number
      "\xd8\x56\x01"s,
      "\xd8\x56\x61z"s,  // tag 86 of what is no byte string
      "\xd8\x56\x47"
      "1234567"s,  // of what is no whole double
      "\xd8\x55\x44"
      "1234"s,              // an array of floats
      "\xd9\xd9\xf7\x01"s,  // CBOR's own mark
      "\xf7"s,
      "\xf3"s,
      "\xe0"s,
      "\xf8\x20"s,  // simple values
      "\x01\x01"s,  // bytes behind the end
  };
  for (const std::string& item : items) {
    EXPECT_EQ(decode_error(cbor_of(item), Encoding::kCbor), "protocol/syntax")
        << testing::PrintToString(item);
  }
  EXPECT_EQ(decode_error("", Encoding::kCbor), "protocol/syntax");
}

TEST(Cbor, BelievesNoLengthThatIsNotThere) {
  using namespace std::string_literals;
  // 2^64 - 1 and 2^32 - 1 bytes, characters, elements and members.
  for (const char first : {'\x5b', '\x7b', '\x9b', '\xbb'}) {
    EXPECT_EQ(decode_error(cbor_of(first + std::string(8, '\xff') + "\x01"), Encoding::kCbor),
              "protocol/syntax");
  }
  for (const char first : {'\x5a', '\x7a', '\x9a', '\xba'}) {
    EXPECT_EQ(decode_error(cbor_of(first + std::string(4, '\xff') + "\x01"), Encoding::kCbor),
              "protocol/syntax");
  }
  EXPECT_EQ(decode_error(cbor_of("\xd8\x56\x5b\xff\xff\xff\xff\xff\xff\xff\xf8"s), Encoding::kCbor),
            "protocol/syntax");
}

TEST(Cbor, RefusesNumbersThatAreNotFiniteOrTooLarge) {
  using namespace std::string_literals;
  for (const std::string& item :
       {"\xf9\x7c\x00"s, "\xf9\xfc\x00"s, "\xf9\x7e\x00"s, "\xfa\x7f\x80\x00\x00"s,
        "\xfa\x7f\xc0\x00\x00"s, "\xfb\x7f\xf0\x00\x00\x00\x00\x00\x00"s,
        "\xfb\xff\xf0\x00\x00\x00\x00\x00\x00"s, "\xfb\x7f\xf8\x00\x00\x00\x00\x00\x00"s,
        "\xfb\x7f\xf0\x00\x00\x00\x00\x00\x01"s, "\x3b\x80\x00\x00\x00\x00\x00\x00\x00"s,
        "\x3b\xff\xff\xff\xff\xff\xff\xff\xff"s}) {
    EXPECT_EQ(decode_error(cbor_of(item), Encoding::kCbor), "protocol/number")
        << testing::PrintToString(item);
  }
  // At any place in typed arrays.
  for (const double wrong : {std::nan(""), -std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    for (const std::size_t place : {0U, 1U, 5U}) {
      std::vector<double> numbers(6, -std::numeric_limits<double>::max());
      numbers[place] = wrong;
      const std::string bytes =
          encode({{"a", doubles(numbers, Encoding::kCbor)}}, Encoding::kCbor).substr(4);
      EXPECT_EQ(decode_error(bytes, Encoding::kCbor), "protocol/number");
    }
  }
}

TEST(Cbor, RefusesDeepNesting) {
  const auto nested = [](int lists) { return cbor_of(repeated("\x81", lists) + "\x01"); };
  EXPECT_EQ(decode_error(nested(kMaxDepth - 1), Encoding::kCbor), "");
  EXPECT_EQ(decode_error(nested(kMaxDepth), Encoding::kCbor), "protocol/too-deep");
  EXPECT_EQ(decode_error(nested(1000000), Encoding::kCbor), "protocol/too-deep");
  EXPECT_EQ(decode_error(repeated("\xa1\x61"
                                  "a",
                                  300000),
                         Encoding::kCbor),
            "protocol/too-deep");
}

TEST(Cbor, RefusesAKeyThatStandsTwice) {
  EXPECT_EQ(decode_error("\xa2\x61"
                         "a\x01\x61"
                         "a\x02",
                         Encoding::kCbor),
            "protocol/duplicate-key");
}

TEST_P(EachEncoding, BrokenMessagesGiveNothingButProtocolErrors) {
  const json message = {{"id", 12},
                        {"do", "read"},
                        {"list", {1, 2.5, "x", nullptr, {{"deep", {true}}}}},
                        {"numbers", doubles(std::vector<double>(20, 0.1), GetParam())},
                        {"bytes", bytes({1, 2, 3, 4}, GetParam())}};
  std::string whole = encode(message, GetParam());
  whole = GetParam() == Encoding::kCbor ? whole.substr(4) : whole.substr(0, whole.size() - 1);
  std::mt19937_64 random(4);
  int refused = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string bytes = whole.substr(0, random() % 4 == 0 ? random() % whole.size() : whole.size());
    for (auto changes = random() % 4; changes > 0 && !bytes.empty(); --changes) {
      bytes[random() % bytes.size()] = static_cast<char>(random());
    }
    refused += decode_error(bytes, GetParam()).empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 5000);
}

// --- reading members

TEST(Members, AreRequiredWithTheirKind) {
  const json object = {{"n", 2.5}, {"w", 3.0}, {"i", 7}, {"b", true}, {"t", "x"}, {"l", {1}}};
  EXPECT_EQ(require_number(object, "n"), 2.5);
  EXPECT_EQ(require_number(object, "i"), 7.0);
  EXPECT_EQ(require_integer(object, "i", 7, 7), 7);
  EXPECT_EQ(require_integer(object, "w", 0, 10), 3);
  EXPECT_EQ(require_bool(object, "b"), true);
  EXPECT_EQ(require_text(object, "t"), "x");
  std::string message;
  const auto refused = [&](const std::function<void()>& call) {
    EXPECT_EQ(error_of(call, &message), "protocol/bad-value");
    return message;
  };
  EXPECT_THAT(refused([&] { static_cast<void>(require(object, "none")); }), HasSubstr("\"none\""));
  EXPECT_THAT(refused([&] { static_cast<void>(require(7, "n")); }), HasSubstr("object"));
  EXPECT_EQ(refused([&] { static_cast<void>(require_number(object, "t")); }),
            "t: expected a number, found \"x\"");
  EXPECT_EQ(refused([&] { static_cast<void>(require_integer(object, "n", 0, 10)); }),
            "n: expected a whole number from 0 to 10, found 2.5");
  EXPECT_EQ(refused([&] { static_cast<void>(require_integer(object, "i", 0, 6)); }),
            "i: expected a whole number from 0 to 6, found 7");
  EXPECT_EQ(refused([&] { static_cast<void>(require_bool(object, "i")); }),
            "i: expected true or false, found 7");
  EXPECT_EQ(refused([&] { static_cast<void>(require_text(object, "l")); }),
            "l: expected a text, found a list of 1");
  refused([&] { static_cast<void>(require_number({{"n", std::nan("")}}, "n")); });
  refused([&] { static_cast<void>(require_integer({{"n", 1e300}}, "n", 0, 10)); });
  refused([&] {
    static_cast<void>(require_integer({{"n", std::numeric_limits<std::uint64_t>::max()}}, "n",
                                      std::numeric_limits<std::int64_t>::min(),
                                      std::numeric_limits<std::int64_t>::max()));
  });
  refused([&] { static_cast<void>(require_doubles({{"d", {1, "x"}}}, "d", Encoding::kJson)); });
  refused([&] { static_cast<void>(require_doubles({{"d", 1}}, "d", Encoding::kCbor)); });
  refused([&] {
    static_cast<void>(require_doubles({{"d", bytes(std::vector<std::uint8_t>(8), Encoding::kCbor)}},
                                      "d", Encoding::kCbor));
  });
  refused([&] {
    const json typed = doubles(std::vector<double>(1), Encoding::kCbor);
    static_cast<void>(require_bytes({{"b", typed}}, "b", Encoding::kCbor));
  });
  refused([&] { static_cast<void>(require_bytes({{"b", "AAAA"}}, "b", Encoding::kCbor)); });
}

TEST(Members, UnknownKeysAreNamed) {
  std::string message;
  refuse_unknown_keys({{"a", 1}}, {"a", "b"}, "a thing");
  EXPECT_EQ(error_of(
                [] {
                  refuse_unknown_keys({{"a", 1}, {"c", 1}}, {"a", "b"}, "a thing");
                },
                &message),
            "protocol/bad-value");
  EXPECT_EQ(message, "a thing has the unknown key \"c\"; it may have: a, b");
  EXPECT_EQ(error_of([] { refuse_unknown_keys(3, {"a"}, "a thing"); }), "protocol/bad-value");
}

TEST_P(EachEncoding, DeviceIdsComeOutAsTheyWentIn) {
  const json message = through({{"device", encode_device_id({3, 14})}}, GetParam());
  const DeviceId id = require_device_id(message, "device");
  EXPECT_EQ(id.robot, 3);
  EXPECT_EQ(id.device, 14);
  for (const json& wrong : {json(3), json{1}, json{1, 2, 3}, json{-1, 0}, json{0, 2147483648},
                            json{0.5, 0}, json{"0", 0}, json(nullptr)}) {
    EXPECT_EQ(error_of([&] {
                static_cast<void>(require_device_id({{"device", wrong}}, "device"));
              }),
              "protocol/bad-value")
        << wrong;
  }
}

// --- readings

/// Fills a reading with random values, sends it, and compares the result.
template <typename ReadingType>
void expect_to_arrive(const std::string& type, Encoding encoding) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 100; ++i) {
    ReadingType sent;
    fill(sent, random);
    const json message = value_through(encode_reading({2, 5}, type, sent, encoding), encoding);
    const DecodedReading decoded = decode_reading(message, encoding);
    EXPECT_EQ(decoded.device.robot, 2);
    EXPECT_EQ(decoded.device.device, 5);
    const auto* received = dynamic_cast<const ReadingType*>(decoded.reading.get());
    ASSERT_NE(received, nullptr) << type;
    ASSERT_EQ(written(*received), written(sent)) << type;
  }
}

/// If a sensor's readings are of this type, sends some. @return whether they are.
template <typename ReadingType>
bool arrives_if(const sim::Sensor& sensor, Encoding encoding) {
  if (dynamic_cast<const ReadingType*>(&sensor.reading()) == nullptr) return false;
  expect_to_arrive<ReadingType>(sensor.type(), encoding);
  return true;
}

TEST_P(EachEncoding, ReadingsOfAllSensorsComeOutToTheBit) {
  int sensors = 0;
  for (const sim::DeviceKind& kind : sim::device_kinds()) {
    const std::unique_ptr<sim::Device> device = kind.create(
        {"it", kind.name, kind.defaults()}, sim::RobotDescription{}, sim::s1r_model(), 1);
    const auto* sensor = dynamic_cast<const sim::Sensor*>(device.get());
    if (sensor == nullptr) {
      const sim::PoseReading reading;
      EXPECT_EQ(error_of([&] {
                  static_cast<void>(encode_reading({0, 0}, kind.name, reading, GetParam()));
                }),
                "protocol/bad-value")
          << kind.name;
      continue;
    }
    ++sensors;
    EXPECT_EQ(sensor->type(), kind.name);
    EXPECT_TRUE(arrives_if<sim::ActArrayReading>(*sensor, GetParam()) ||
                arrives_if<sim::AccelerometerReading>(*sensor, GetParam()) ||
                arrives_if<sim::AirspeedReading>(*sensor, GetParam()) ||
                arrives_if<sim::AltimeterReading>(*sensor, GetParam()) ||
                arrives_if<sim::AttitudeReading>(*sensor, GetParam()) ||
                arrives_if<sim::BarometerReading>(*sensor, GetParam()) ||
                arrives_if<sim::ClockReading>(*sensor, GetParam()) ||
                arrives_if<sim::GyroscopeReading>(*sensor, GetParam()) ||
                arrives_if<sim::PostureReading>(*sensor, GetParam()) ||
                arrives_if<sim::SemanticCameraReading>(*sensor, GetParam()) ||
                arrives_if<sim::ThermometerReading>(*sensor, GetParam()) ||
                arrives_if<sim::VelocityReading>(*sensor, GetParam()) ||
                arrives_if<sim::AioReading>(*sensor, GetParam()) ||
                arrives_if<sim::AmclReading>(*sensor, GetParam()) ||
                arrives_if<sim::BatteryReading>(*sensor, GetParam()) ||
                arrives_if<sim::BlinkenlightReading>(*sensor, GetParam()) ||
                arrives_if<sim::BlobfinderReading>(*sensor, GetParam()) ||
                arrives_if<sim::BumperReading>(*sensor, GetParam()) ||
                arrives_if<sim::CameraReading>(*sensor, GetParam()) ||
                arrives_if<sim::DepthCameraReading>(*sensor, GetParam()) ||
                arrives_if<sim::DioReading>(*sensor, GetParam()) ||
                arrives_if<sim::HandReading>(*sensor, GetParam()) ||
                arrives_if<sim::OpaqueReading>(*sensor, GetParam()) ||
                arrives_if<sim::CollisionReading>(*sensor, GetParam()) ||
                arrives_if<sim::CompassReading>(*sensor, GetParam()) ||
                arrives_if<sim::FiducialReading>(*sensor, GetParam()) ||
                arrives_if<sim::GpsReading>(*sensor, GetParam()) ||
                arrives_if<sim::GripperReading>(*sensor, GetParam()) ||
                arrives_if<sim::ImuReading>(*sensor, GetParam()) ||
                arrives_if<sim::LaserReading>(*sensor, GetParam()) ||
                arrives_if<sim::PoseReading>(*sensor, GetParam()) ||
                arrives_if<sim::ProximityReading>(*sensor, GetParam()) ||
                arrives_if<sim::PtzReading>(*sensor, GetParam()) ||
                arrives_if<sim::RangerReading>(*sensor, GetParam()) ||
                arrives_if<sim::WaypointReading>(*sensor, GetParam()) ||
                arrives_if<sim::WifiReading>(*sensor, GetParam()))
        << "the readings of " << kind.name << " need a line here";
  }
  EXPECT_GE(sensors, 9);
}

TEST(Readings, DoNotTellWhereTheLaserReallyWas) {
  sim::LaserReading reading;
  reading.X_WB = {1.0, 2.0, 3.0};
  const json message = encode_reading({0, 0}, "laser", reading, Encoding::kCbor);
  const DecodedReading decoded = decode_reading(message, Encoding::kCbor);
  EXPECT_EQ(dynamic_cast<const sim::LaserReading&>(*decoded.reading).X_WB, sim::Pose());
}

TEST(Readings, LookAsTheReferenceSays) {
  sim::PoseReading reading;
  reading.time_ns = 100'000'000;
  reading.sequence = 1;
  reading.pose = {0.5, 1.25, 0.0};
  EXPECT_EQ(encode(encode_reading({0, 4}, "pose", reading, Encoding::kJson), Encoding::kJson),
            R"({"device":[0,4],"increment":{"x":0.0,"y":0.0,"yaw":0.0},"lateral":0.0,"omega":0.0,)"
            R"("path_length":0.0,"pitch":0.0,"roll":0.0,"seq":1,"stalled":false,"t":100000000,)"
            R"("type":"pose","v":0.0,"x":0.5,"y":1.25,"yaw":0.0,"z":0.0})"
            "\n");
}

TEST(Readings, MayHaveMoreKeysThanAreKnown) {
  json message = encode_reading({0, 0}, "pose", sim::PoseReading(), Encoding::kJson);
  message["altitude"] = 3;
  EXPECT_NE(decode_reading(message, Encoding::kJson).reading, nullptr);
}

TEST(Readings, AreRefusedWhenAnythingIsMissingOrWrong) {
  const std::vector<std::pair<std::string, std::unique_ptr<sim::Reading>>> readings = [] {
    std::vector<std::pair<std::string, std::unique_ptr<sim::Reading>>> all;
    all.emplace_back("accelerometer", std::make_unique<sim::AccelerometerReading>());
    all.emplace_back("airspeed", std::make_unique<sim::AirspeedReading>());
    all.emplace_back("altimeter", std::make_unique<sim::AltimeterReading>());
    all.emplace_back("attitude", std::make_unique<sim::AttitudeReading>());
    all.emplace_back("barometer", std::make_unique<sim::BarometerReading>());
    all.emplace_back("gyroscope", std::make_unique<sim::GyroscopeReading>());
    all.emplace_back("posture", std::make_unique<sim::PostureReading>());
    all.emplace_back("semantic_camera", std::make_unique<sim::SemanticCameraReading>());
    all.emplace_back("thermometer", std::make_unique<sim::ThermometerReading>());
    all.emplace_back("velocity", std::make_unique<sim::VelocityReading>());
    all.emplace_back("actarray", std::make_unique<sim::ActArrayReading>());
    all.emplace_back("aio", std::make_unique<sim::AioReading>());
    all.emplace_back("battery", std::make_unique<sim::BatteryReading>());
    all.emplace_back("blobfinder", std::make_unique<sim::BlobfinderReading>());
    all.emplace_back("amcl", std::make_unique<sim::AmclReading>());
    all.emplace_back("bumper", std::make_unique<sim::BumperReading>());
    all.emplace_back("camera", std::make_unique<sim::CameraReading>());
    all.emplace_back("depth_camera", std::make_unique<sim::DepthCameraReading>());
    all.emplace_back("hand", std::make_unique<sim::HandReading>());
    all.emplace_back("ptz", std::make_unique<sim::PtzReading>());
    all.emplace_back("blinkenlight", std::make_unique<sim::BlinkenlightReading>());
    all.emplace_back("dio", std::make_unique<sim::DioReading>());
    all.emplace_back("opaque", std::make_unique<sim::OpaqueReading>());
    all.emplace_back("collision", std::make_unique<sim::CollisionReading>());
    all.emplace_back("compass", std::make_unique<sim::CompassReading>());
    all.emplace_back("fiducial", std::make_unique<sim::FiducialReading>());
    all.emplace_back("gps", std::make_unique<sim::GpsReading>());
    all.emplace_back("gripper", std::make_unique<sim::GripperReading>());
    all.emplace_back("imu", std::make_unique<sim::ImuReading>());
    all.emplace_back("laser", std::make_unique<sim::LaserReading>());
    all.emplace_back("odometry", std::make_unique<sim::PoseReading>());
    all.emplace_back("proximity", std::make_unique<sim::ProximityReading>());
    all.emplace_back("sonar", std::make_unique<sim::RangerReading>());
    all.emplace_back("waypoint", std::make_unique<sim::WaypointReading>());
    all.emplace_back("wifi", std::make_unique<sim::WifiReading>());
    return all;
  }();
  for (const auto& [type, reading] : readings) {
    for (const Encoding encoding : {Encoding::kJson, Encoding::kCbor}) {
      const json whole = encode_reading({0, 0}, type, *reading, encoding);
      for (const auto& [key, value] : whole.items()) {
        json changed = whole;
        changed.erase(key);
        EXPECT_EQ(error_of([&] { static_cast<void>(decode_reading(changed, encoding)); }),
                  "protocol/bad-value")
            << type << " without " << key;
        for (const json& wrong : {json(nullptr), json("no such word"), json::object(), json(-1.5),
                                  json({json::object()}), json::array({nullptr})}) {
          if (wrong.type() == value.type() && !value.is_string()) continue;
          const bool any_text = key == "held" || key == "near";
          if (any_text && wrong.is_string()) continue;
          changed[key] = wrong;
          EXPECT_EQ(error_of([&] { static_cast<void>(decode_reading(changed, encoding)); }),
                    "protocol/bad-value")
              << type << " with " << key << " = " << wrong;
        }
      }
    }
  }
  json sonar = encode_reading({0, 0}, "sonar", sim::RangerReading(), Encoding::kJson);
  sonar["ranges"] = {1.0, 2.0};
  EXPECT_EQ(error_of([&] { static_cast<void>(decode_reading(sonar, Encoding::kJson)); }),
            "protocol/bad-value");
}

// --- commands

template <std::size_t... kIndices>
std::vector<sim::Command> all_commands(std::mt19937_64& random, std::index_sequence<kIndices...>) {
  std::vector<sim::Command> commands;
  const auto add = [&](auto command) {
    fill(command, random);
    commands.emplace_back(command);
  };
  (add(std::variant_alternative_t<kIndices, sim::Command>{}), ...);
  return commands;
}

std::vector<sim::Command> all_commands(std::mt19937_64& random) {
  return all_commands(random, std::make_index_sequence<std::variant_size_v<sim::Command>>());
}

TEST_P(EachEncoding, CommandsOfAllKindsComeOutToTheBit) {
  std::mt19937_64 random(6);
  for (int i = 0; i < 100; ++i) {
    for (const sim::Command& sent : all_commands(random)) {
      const sim::Command received = decode_command(value_through(encode_command(sent), GetParam()));
      ASSERT_EQ(received.index(), sent.index());
      const auto text = [](const auto& command) { return written(command); };
      ASSERT_EQ(std::visit(text, received), std::visit(text, sent)) << encode_command(sent);
    }
  }
}

TEST(Commands, LookAsTheReferenceSays) {
  const auto line = [](const sim::Command& command) {
    return encode(encode_command(command), Encoding::kJson);
  };
  EXPECT_EQ(line(sim::TwistCommand{{0.3, -1.0, 0.0}}),
            "{\"kind\":\"twist\",\"lateral\":0.0,\"omega\":-1.0,\"v\":0.3}\n");
  EXPECT_EQ(line(sim::MotorEnableCommand{true}), "{\"kind\":\"motors\",\"on\":true}\n");
  const sim::Command short_twist =
      decode_command(json::parse(R"({"kind": "twist", "v": 0.3, "omega": 0})"));
  EXPECT_EQ(std::get<sim::TwistCommand>(short_twist).twist, (sim::Twist{0.3, 0.0, 0.0}));
}

TEST(Commands, AreRefusedWhenAnythingIsMissingWrongOrUnknown) {
  std::mt19937_64 random(7);
  for (const sim::Command& command : all_commands(random)) {
    const json whole = encode_command(command);
    const auto refused = [](const json& message) {
      return error_of([&] { static_cast<void>(decode_command(message)); }) == "protocol/bad-value";
    };
    for (const auto& [key, value] : whole.items()) {
      json changed = whole;
      changed.erase(key);
      const bool optional = key == "lateral" || key == "range" || key == "tag" ||
                            key == "variance" || key == "covariance" || key == "start" ||
                            (whole["kind"] == "goto" && key == "z") ||
                            (whole["kind"] == "light" && key != "kind");
      EXPECT_TRUE(refused(changed) || optional) << whole << " without " << key;
      for (const json& wrong : {json(nullptr), json("x"), json({1}), json(std::nan(""))}) {
        changed[key] = wrong;
        const bool any_text = (key == "text" || key == "tag") && wrong.is_string();
        const bool any_numbers =
            (key == "values" || key == "times" || key == "positions") && wrong.is_array();
        EXPECT_TRUE(refused(changed) || any_text || any_numbers) << changed;
      }
    }
    json more = whole;
    more["omgea"] = 1.0;
    EXPECT_TRUE(refused(more));
  }
  std::string message;
  error_of([] { static_cast<void>(decode_command({{"kind", "fly"}})); }, &message);
  EXPECT_THAT(message, AllOf(HasSubstr("\"fly\""), HasSubstr("twist, "), HasSubstr("rotate")));
  EXPECT_EQ(error_of([] { static_cast<void>(decode_command(3)); }), "protocol/bad-value");
}

// --- other messages

TEST_P(EachEncoding, RobotsComeOutToTheBit) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 20; ++i) {
    std::vector<RobotInfo> sent(random() % 4);
    for (std::size_t r = 0; r < sent.size(); ++r) {
      fill(sent[r], random);
      sent[r].port = static_cast<int>(random() % 65536);
      for (std::size_t d = 0; d < sent[r].devices.size(); ++d) {
        sent[r].devices[d].id = {static_cast<int>(r), static_cast<int>(d)};
      }
    }
    const std::vector<RobotInfo> received =
        decode_robots(value_through(encode_robots(sent), GetParam()));
    ASSERT_EQ(written(received), written(sent));
    for (std::size_t r = 0; r < sent.size(); ++r) {
      EXPECT_EQ(received[r].port, sent[r].port);
      for (std::size_t d = 0; d < sent[r].devices.size(); ++d) {
        EXPECT_EQ(received[r].devices[d].id.robot, static_cast<int>(r));
        EXPECT_EQ(received[r].devices[d].id.device, static_cast<int>(d));
      }
    }
  }
}

TEST(Robots, AreRefusedWithDevicesOutOfPlaceAndDriversOutOfRange) {
  RobotInfo robot;
  robot.devices.push_back({{0, 1}, "laser", "laser", {}});
  const auto refused = [](const json& robots) {
    return error_of([&] { static_cast<void>(decode_robots(robots)); });
  };
  EXPECT_EQ(refused(encode_robots({robot})), "protocol/bad-value");
  robot.devices[0].id = {0, 0};
  EXPECT_EQ(refused(encode_robots({robot})), "");
  robot.devices.push_back({{0, 1}, "pose", "pose", {}});
  robot.devices.push_back({{0, 2}, "motion", "motion", {}});
  robot.drivers = {{"snd", {{"max_speed", "0.25"}}}, {"of_a_newer_server", {{"a", "b"}}}};
  EXPECT_EQ(refused(encode_robots({robot})), "");
  const std::vector<RobotInfo> received = decode_robots(encode_robots({robot}));
  EXPECT_EQ(received[0].drivers.size(), 2U);
  ASSERT_EQ(received[0].goal_drivers.size(), 1U);
  EXPECT_EQ(received[0].goal_drivers[0].index, 1);
  EXPECT_EQ(std::get<SndSettings>(received[0].goal_drivers[0].settings).max_speed_mps, 0.25);
  robot.drivers[0].settings["max_speed"] = "-1";
  EXPECT_EQ(refused(encode_robots({robot})), "protocol/bad-value");
  EXPECT_EQ(refused(json::object()), "protocol/bad-value");
  EXPECT_EQ(refused({1}), "protocol/bad-value");
}

TEST_P(EachEncoding, CanvasTimeAndLayersComeOutToTheBit) {
  std::mt19937_64 random(9);
  for (int i = 0; i < 100; ++i) {
    CanvasInfo canvas;
    fill(canvas, random);
    canvas.width = static_cast<int>(1 + random() % 8192);
    canvas.height = static_cast<int>(1 + random() % 8192);
    canvas.cell_size_m = 1e-300 + std::abs(canvas.cell_size_m);
    EXPECT_EQ(written(decode_canvas(value_through(encode_canvas(canvas), GetParam()))),
              written(canvas));
    TimeStatistics time;
    fill(time, random);
    EXPECT_EQ(written(decode_time(value_through(encode_time(time), GetParam()))), written(time));
    std::vector<sim::LayerInfo> layers;
    fill(layers, random);
    EXPECT_EQ(written(decode_layers(value_through(encode_layers(layers), GetParam()))),
              written(layers));
  }
}

TEST(Canvas, IsRefusedWithAnImpossibleSize) {
  const json sound = encode_canvas({172, 186, 0.02, 0.0, 0.0});
  const auto refused = [&](const char* key, const json& value) {
    json canvas = sound;
    canvas[key] = value;
    return error_of([&] { static_cast<void>(decode_canvas(canvas)); }) == "protocol/bad-value";
  };
  EXPECT_FALSE(refused("width", 8192));
  EXPECT_TRUE(refused("width", 8193));
  EXPECT_TRUE(refused("height", 0));
  EXPECT_TRUE(refused("cell_size", 0));
  EXPECT_TRUE(refused("x", nullptr));
}

TEST(Time, IsRefusedWithAnUnknownMode) {
  json time = encode_time({});
  EXPECT_EQ(error_of([&] { static_cast<void>(decode_time(time)); }), "");
  time["mode"] = "fast";
  EXPECT_EQ(error_of([&] { static_cast<void>(decode_time(time)); }), "protocol/bad-value");
}

TEST(Styles, HaveDefaultsAndRefuseWhatIsUnknown) {
  EXPECT_EQ(decode_style(json::object()), sim::LayerStyle());
  EXPECT_EQ(decode_style({{"name", "way"}, {"colour", "#f00"}}),
            (sim::LayerStyle{.name = "way", .colour = {255, 0, 0, 255}}));
  for (const json& wrong :
       {json{{"color", "#f00"}}, json{{"colour", "red"}}, json{{"colour", 3}},
        json{{"transparency", "half"}}, json{{"priority", 1.5}}, json{{"priority", 4294967296}},
        json{{"visible", 1}}, json{{"name", nullptr}}, json{{"transparent_colour", ""}}, json(1)}) {
    EXPECT_EQ(error_of([&] { static_cast<void>(decode_style(wrong)); }), "protocol/bad-value")
        << wrong;
  }
  for (const json& wrong : {json("red"), json(nullptr), json(0)}) {
    const json layer = {{"layer", 1}, {"kind", wrong}, {"owner", 0}, {"style", json::object()}};
    EXPECT_EQ(error_of([&] { static_cast<void>(decode_layers(json::array({layer}))); }),
              "protocol/bad-value");
  }
}

TEST_P(EachEncoding, MapsComeOutToTheBit) {
  std::mt19937_64 random(10);
  for (int i = 0; i < 50; ++i) {
    sim::OccupancyMap sent{static_cast<int>(1 + random() % 40),
                           static_cast<int>(1 + random() % 40),
                           1e-300 + std::abs(any_double(random)),
                           {any_double(random), any_double(random)},
                           {}};
    sent.cells.resize(static_cast<std::size_t>(sent.width * sent.height));
    for (float& cell : sent.cells) cell = static_cast<float>(random() >> 40U) * 0x1p-24F;
    const sim::OccupancyMap received =
        decode_map(value_through(encode_map(sent, GetParam()), GetParam()), GetParam());
    EXPECT_EQ(received.width, sent.width);
    EXPECT_EQ(received.height, sent.height);
    EXPECT_EQ(received.cell_size_m, sent.cell_size_m);
    EXPECT_EQ(received.origin, sent.origin);
    EXPECT_EQ(received.cells, sent.cells);
  }
}

TEST_P(EachEncoding, MapsAreRefusedWithWrongCells) {
  sim::OccupancyMap map{3, 2, 0.02, {0.0, 0.0}, std::vector<float>(6, 1.0F)};
  const auto refused = [&] {
    return error_of(
        [&] { static_cast<void>(decode_map(encode_map(map, GetParam()), GetParam())); });
  };
  EXPECT_EQ(refused(), "");
  for (const float wrong : {-0.1F, 1.1F, std::nanf("")}) {
    map.cells[5] = wrong;
    EXPECT_EQ(refused(), "protocol/bad-value") << wrong;
  }
  map.cells.assign(5, 0.0F);
  EXPECT_EQ(refused(), "protocol/bad-value");
}

using Kind = sim::DrawOperation::Kind;

std::string written(const sim::DrawOperation& v) {
  std::string text;
  for (const std::int64_t number :
       {std::int64_t{static_cast<int>(v.kind)}, std::int64_t{v.layer}, std::int64_t{v.x0},
        std::int64_t{v.y0}, std::int64_t{v.x1}, std::int64_t{v.y1}, std::int64_t{v.value.bits}}) {
    text += std::to_string(number) + ' ';
  }
  return text;
}

TEST_P(EachEncoding, DrawingsComeOutAsTheyWentIn) {
  std::mt19937_64 random(11);
  const auto any_int = [&] { return static_cast<int>(random()); };
  std::vector<sim::DrawOperation> sent(1000);
  for (sim::DrawOperation& drawing : sent) {
    drawing = {static_cast<Kind>(random() % 3),
               any_int(),
               any_int(),
               any_int(),
               any_int(),
               any_int(),
               {static_cast<std::uint32_t>(random())}};
  }
  const std::vector<sim::DrawOperation> received =
      decode_drawings(value_through(encode_drawings(sent, GetParam()), GetParam()), GetParam());
  ASSERT_THAT(received, SizeIs(sent.size()));
  for (std::size_t i = 0; i < sent.size(); ++i) {
    // Members that a kind does not use are not sent: they may be uninitialised.
    if (sent[i].kind != Kind::kLine) sent[i].x1 = sent[i].y1 = 0;
    if (sent[i].kind == Kind::kFill) sent[i].x0 = sent[i].y0 = 0;
    ASSERT_EQ(written(received[i]), written(sent[i]));
  }
  const json none = value_through(encode_drawings({}, GetParam()), GetParam());
  EXPECT_THAT(decode_drawings(none, GetParam()), IsEmpty());
}

TEST(Drawings, LookAsTheReferenceSays) {
  const std::vector<sim::DrawOperation> drawings = {
      {Kind::kPixel, 0, 3, 4, 0, 0, sim::CellValue::of(sim::Colour{255, 0, 0, 255})},
      {Kind::kLine, 2, 0, 1, 5, -6, sim::CellValue::of(true)},
      {Kind::kFill, 1, 0, 0, 0, 0, sim::CellValue::of(0.5F)}};
  // Red is the lowest of the four bytes, alpha the highest; 0.5 as a float is 0x3f000000.
  EXPECT_EQ(encode(encode_drawings(drawings, Encoding::kJson), Encoding::kJson),
            "[[\"pixel\",0,3,4,4278190335],[\"line\",2,0,1,5,-6,1],[\"fill\",1,1056964608]]\n");
  const json bytes = encode_drawings(std::span(drawings).first(2), Encoding::kCbor);
  const std::vector<std::uint8_t>& data = bytes.get_binary();
  const std::vector<std::uint8_t> expected = {0, 0, 0, 0, 0, 0, 0,   0,   3,   0,   0,   0, 4, 0,
                                              0, 0, 0, 0, 0, 0, 0,   0,   0,   0,   255, 0, 0, 255,
                                              1, 0, 0, 0, 2, 0, 0,   0,   0,   0,   0,   0, 1, 0,
                                              0, 0, 5, 0, 0, 0, 250, 255, 255, 255, 1,   0, 0, 0};
  EXPECT_EQ(data, expected);
}

TEST(Drawings, AreRefusedWhenTheyAreWrong) {
  for (const json& wrong :
       {json(1), json::array({1}), json::array({json::array()}), json{{"dot", 0, 1, 1, 0}},
        json{{"pixel", 0, 1, 1}}, json{{"pixel", 0, 1, 1, 0, 0}}, json{{"pixel", 0, 1.5, 1, 0}},
        json{{"pixel", 0, 1, 1, -1}}, json{{"pixel", 0, 1, 1, 4294967296}},
        json{{"pixel", 0, 2147483648, 1, 0}}, json{{"fill", "0", 1}}, json{{0, 0, 1, 1, 0}}}) {
    EXPECT_EQ(error_of([&] { static_cast<void>(decode_drawings(wrong, Encoding::kJson)); }),
              "protocol/bad-value")
        << wrong;
  }
  std::vector<std::uint8_t> data(28);
  const auto refused = [&] {
    return error_of(
        [&] { static_cast<void>(decode_drawings(bytes(data, Encoding::kCbor), Encoding::kCbor)); });
  };
  EXPECT_EQ(refused(), "");
  data[0] = 3;
  EXPECT_EQ(refused(), "protocol/bad-value");
  data[0] = 0;
  data[3] = 0x80;
  EXPECT_EQ(refused(), "protocol/bad-value");
  data.assign(27, 0);
  EXPECT_EQ(refused(), "protocol/bad-value");
  EXPECT_EQ(error_of([] { static_cast<void>(decode_drawings("AAAA", Encoding::kCbor)); }),
            "protocol/bad-value");
}

TEST_P(EachEncoding, CellsComeOutAsTheyWentIn) {
  std::mt19937_64 random(12);
  std::vector<sim::CellValue> sent(1000);
  for (sim::CellValue& cell : sent) cell.bits = static_cast<std::uint32_t>(random());
  EXPECT_EQ(decode_cells(value_through(encode_cells(sent, GetParam()), GetParam()), GetParam()),
            sent);
  for (const std::size_t size : {1U, 2U, 3U, 5U}) {
    const json wrong = bytes(std::vector<std::uint8_t>(size), GetParam());
    EXPECT_EQ(error_of([&] { static_cast<void>(decode_cells(wrong, GetParam())); }),
              "protocol/bad-value");
  }
}

TEST(Cells, LieAsTheReferenceSays) {
  const std::vector<sim::CellValue> cells = {sim::CellValue::of(sim::Colour{1, 2, 3, 4}),
                                             sim::CellValue::of(true), sim::CellValue::of(1.0F)};
  EXPECT_THAT(encode_cells(cells, Encoding::kCbor).get_binary(),
              ElementsAre(1, 2, 3, 4, 1, 0, 0, 0, 0, 0, 0x80, 0x3f));
}

TEST(Errors, OfSessionsHaveNamesThatLeadBack) {
  using Code = SessionError::Code;
  for (const Code code : {Code::kFinished, Code::kDisconnected, Code::kNoSuchDevice,
                          Code::kNotAvailable, Code::kBadArgument}) {
    EXPECT_EQ(session_error_code(error_id(code)), code);
    EXPECT_THAT(std::string(error_id(code)), testing::StartsWith("session/"));
  }
  EXPECT_EQ(error_id(Code::kFinished), "session/finished");
  EXPECT_EQ(session_error_code("protocol/syntax"), std::nullopt);
}

}  // namespace
}  // namespace playerlike::protocol
