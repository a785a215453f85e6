// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/builtin.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/core/degrees.h"
#include "sim/core/number_text.h"
#include "sim/devices/aio.h"
#include "sim/devices/battery.h"
#include "sim/devices/blinkenlight.h"
#include "sim/devices/blobfinder.h"
#include "sim/devices/bumper.h"
#include "sim/devices/camera.h"
#include "sim/devices/contact_sensors.h"
#include "sim/devices/dio.h"
#include "sim/devices/fiducial.h"
#include "sim/devices/gps.h"
#include "sim/devices/gripper.h"
#include "sim/devices/imu.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"
#include "sim/devices/motion.h"
#include "sim/devices/opaque.h"
#include "sim/devices/pen.h"
#include "sim/devices/proximity.h"
#include "sim/devices/ptz.h"
#include "sim/devices/rangers.h"
#include "sim/devices/speech.h"
#include "sim/devices/teleport.h"
#include "sim/devices/waypoint.h"
#include "sim/devices/wifi.h"
#include "sim/world/limits.h"

namespace sim {
namespace {

constexpr io::NumberRange kFrequency{0.0, 1000.0, true, "Hz"};
constexpr io::NumberRange kRange_m{kLeastLength_m, 1000.0, false, "m"};
constexpr io::NumberRange kNoise_m{0.0, 100.0, false, "m"};
constexpr io::NumberRange kPower_w{0.0, 10000.0, false, "W"};
constexpr io::NumberRange kVoltage_v{0.0, 1000.0, true, "V"};
constexpr io::NumberRange kNorth{-360.0, 360.0, false, "degrees"};
// Of robots that have no steering: beyond it the turn rate has long reached its limit.
constexpr double kMostSteering_rad = 80.0 * kDegrees;

RandomStream noise_stream(const DeviceDescription& device, const RobotDescription& robot,
                          std::uint64_t world_seed) {
  return {world_seed, robot.name + "/" + device.name};
}

// "ROBOT.DEVICE.INDEX" or "DEVICE.INDEX".
std::optional<Wire> parse_wire(const std::string& text) {
  const std::size_t last = text.rfind('.');
  if (last == std::string::npos || last == 0) return std::nullopt;
  const std::size_t first = text.find('.');
  Wire wire;
  if (first != last) wire.robot = text.substr(0, first);
  wire.device = first == last ? text.substr(0, last) : text.substr(first + 1, last - first - 1);
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + last + 1, end, wire.index);
  const bool whole = error == std::errc() && stop == end && wire.index >= 0;
  if (!whole || wire.device.empty() || first == 0 || wire.device.find('.') != std::string::npos) {
    return std::nullopt;
  }
  return wire;
}

// The members of a list of inputs; read(element) gives one, or nullopt if it makes no sense.
template <typename Source, typename Read>
std::vector<Source> parse_inputs(io::Reader& settings, std::vector<Source> fallback, int most,
                                 const char* what, Read read) {
  const std::optional<io::Reader> list = settings.child("inputs");
  if (!list) return fallback;
  std::vector<io::Reader> elements = settings.array("inputs", static_cast<std::size_t>(most));
  if (!list->is_array()) return fallback;
  std::vector<Source> sources;
  for (io::Reader& element : elements) {
    if (std::optional<Source> source = read(element)) {
      sources.push_back(std::move(*source));
    } else {
      element.issue("device/input", what, element.described());
    }
  }
  return sources;
}

AioParams parse_aio(io::Reader& settings, AioParams p) {
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
  p.noise_v = settings.number("noise", p.noise_v, {0.0, 1000.0, false, "V"});
  p.inputs = parse_inputs(
      settings, p.inputs, AioParams::kMaxLines,
      "a voltage, \"speed\", \"turn_rate\", \"battery\" (or another battery device's name), or a "
      "wire: \"DEVICE.INDEX\", \"ROBOT.DEVICE.INDEX\"",
      [](const io::Reader& element) -> std::optional<AnalogSource> {
        const std::optional<std::string> text = element.scalar_text();
        if (!text || text->empty() || element.is_boolean()) return std::nullopt;
        if (element.is_number()) {
          double voltage_v = 0.0;
          std::from_chars(text->data(), text->data() + text->size(), voltage_v);
          if (!(std::abs(voltage_v) <= AioParams::kMaxVolts)) return std::nullopt;
          return voltage_v;
        }
        if (*text == "speed") return AnalogSignal::kSpeed;
        if (*text == "turn_rate") return AnalogSignal::kTurnRate;
        if (text->find('.') == std::string::npos) return BatteryTap{*text};
        if (std::optional<Wire> wire = parse_wire(*text)) return std::move(*wire);
        return std::nullopt;
      });
  p.outputs = static_cast<int>(settings.integer("outputs", p.outputs, 0, AioParams::kMaxLines));
  return p;
}

BatteryParams parse_battery(io::Reader& settings, BatteryParams p) {
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
  p.capacity_wh = settings.number("capacity", p.capacity_wh, {0.0, 100000.0, true, "W h"});
  p.initial_charge_percent =
      settings.number("initial_charge", p.initial_charge_percent, {0.0, 100.0, false, "percent"});
  p.idle_power_w = settings.number("idle_power", p.idle_power_w, kPower_w);
  p.drive_power_ws_per_m = settings.number("drive_power", p.drive_power_ws_per_m,
                                           {0.0, 10000.0, false, "W for each m/s"});
  p.charging_power_w = settings.number("charging_power", p.charging_power_w, kPower_w);
  p.full_voltage_v = settings.number("full_voltage", p.full_voltage_v, kVoltage_v);
  p.empty_voltage_v = settings.number("empty_voltage", p.empty_voltage_v, kVoltage_v);
  if (p.empty_voltage_v > p.full_voltage_v) {
    settings.issue("device/battery-voltage", "an empty_voltage of at most full_voltage",
                   rounded_text(p.empty_voltage_v, 6) + " V empty, " +
                       rounded_text(p.full_voltage_v, 6) + " V full");
  }
  return p;
}

BumperSegment parse_segment(io::Reader& reader) {
  BumperSegment segment;
  if (!reader.expect_object()) return segment;
  constexpr io::NumberRange kPlace_m{-100.0, 100.0, false, "m"};
  segment.X_BS = {reader.number("x", 0.0, kPlace_m), reader.number("y", 0.0, kPlace_m),
                  normalize_angle(reader.angle_deg("yaw_deg", 0.0))};
  segment.length_m = reader.number("length", segment.length_m, {kLeastLength_m, 100.0, false, "m"});
  segment.radius_m = reader.number("radius", segment.radius_m, {0.0, 100.0, false, "m"});
  if (segment.radius_m > 0.0 &&
      segment.length_m > 2.0 * std::numbers::pi * segment.radius_m * (1.0 + 1e-9)) {
    reader.issue("device/bumper-segment", "an arc that is at most a whole circle, 2 pi radius",
                 rounded_text(segment.length_m, 6) + " m long with a radius of " +
                     rounded_text(segment.radius_m, 6) + " m");
  }
  reader.finish();
  return segment;
}

BumperParams parse_bumper(io::Reader& settings, BumperParams p) {
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
  p.reach_m = settings.number("reach", p.reach_m, {0.0, 1.0, true, "m"});
  const std::optional<io::Reader> list = settings.child("segments");
  if (!list) return p;
  std::vector<io::Reader> elements = settings.array("segments", BumperParams::kMaxSegments);
  if (!list->is_array()) return p;
  p.segments.clear();
  for (io::Reader& element : elements) p.segments.push_back(parse_segment(element));
  return p;
}

BlinkenlightParams parse_blinkenlight(io::Reader& settings, BlinkenlightParams p) {
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
  p.colour = settings.colour("colour", p.colour);
  p.enabled = settings.boolean("enabled", p.enabled);
  p.period_s = settings.number("period", p.period_s, {0.0, 1e6, false, "s"});
  p.duty_cycle = settings.number("duty_cycle", p.duty_cycle, {0.0, 1.0, false, ""});
  p.p_BL = settings.vec2("position", p.p_BL, {-100.0, 100.0, false, "m"});
  return p;
}

// What blobfinders and cameras have in common.
void parse_view(io::Reader& settings, ViewParams& p) {
  const auto [width, height] =
      settings.integer_pair("image", {p.width, p.height}, 1, ViewParams::kMaxWidth);
  p.width = static_cast<int>(width);
  p.height = static_cast<int>(height);
  if (p.height > ViewParams::kMaxHeight) {
    settings.issue("device/image-height",
                   "a picture of at most " + std::to_string(ViewParams::kMaxHeight) + " rows",
                   std::to_string(p.height), "[columns, rows]", "image");
  }
  p.field_of_view_rad =
      settings.angle_deg("field_of_view_deg", p.field_of_view_rad, {0.01, 170.0, false, "degrees"});
  p.range_max_m = settings.number("range_max", p.range_max_m, kRange_m);
  p.X_BS = settings.pose("pose", p.X_BS);
  p.height_m = settings.number("height", p.height_m, {0.0, 100.0, false, "m"});
  p.ptz = settings.string("ptz", p.ptz);
}

BlobfinderParams parse_blobfinder(io::Reader& settings, BlobfinderParams p) {
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
  parse_view(settings, p);
  p.noise_m = settings.number("noise", p.noise_m, kNoise_m);
  const std::optional<io::Reader> list = settings.child("colours");
  if (!list) return p;
  std::vector<io::Reader> elements = settings.array("colours", BlobfinderParams::kMaxColours);
  if (!list->is_array()) return p;
  p.colours.clear();
  for (io::Reader& element : elements) {
    const std::optional<Colour> colour =
        element.is_string() ? parse_colour(element.scalar_text().value_or("")) : std::nullopt;
    if (colour) {
      p.colours.push_back(*colour);
    } else {
      element.issue("world/bad-colour", "a colour like \"#ff8800\" or \"#f80\"",
                    element.described());
    }
  }
  return p;
}

CameraParams parse_camera(io::Reader& settings, CameraParams p) {
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
  parse_view(settings, p);
  return p;
}

CollisionParams parse_collision(io::Reader& settings, CollisionParams p) {
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
  return p;
}

FiducialParams parse_fiducial(io::Reader& settings, FiducialParams p) {
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
  p.range_max_m = settings.number("range_max", p.range_max_m, kRange_m);
  p.range_max_id_m = settings.number("range_max_id", p.range_max_id_m, {0.0, 1000.0, false, "m"});
  p.field_of_view_rad =
      settings.angle_deg("field_of_view_deg", p.field_of_view_rad, {0.01, 360.0, false, "degrees"});
  p.X_BS = settings.pose("pose", p.X_BS);
  p.height_m = settings.number("height", p.height_m, {0.0, 100.0, false, "m"});
  p.noise_m = settings.number("noise", p.noise_m, kNoise_m);
  p.noise_bearing_rad =
      settings.angle_deg("noise_bearing_deg", p.noise_bearing_rad, {0.0, 180.0, false, "degrees"});
  p.noise_yaw_rad =
      settings.angle_deg("noise_yaw_deg", p.noise_yaw_rad, {0.0, 360.0, false, "degrees"});
  return p;
}

GpsParams parse_gps(io::Reader& settings, GpsParams p) {
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
  // Snyder's series are for Mercator's part of the world, as UTM is.
  p.latitude_rad =
      settings.angle_deg("latitude_deg", p.latitude_rad, {-84.0, 84.0, false, "degrees"});
  p.longitude_rad =
      settings.angle_deg("longitude_deg", p.longitude_rad, {-180.0, 180.0, false, "degrees"});
  p.altitude_m = settings.number("altitude", p.altitude_m, {-1000.0, 100'000.0, false, "m"});
  p.north_rad = settings.angle_deg("north_deg", p.north_rad, kNorth);
  p.noise_m = settings.number("noise", p.noise_m, kNoise_m);
  p.noise_vertical_m = settings.number("noise_vertical", p.noise_vertical_m, kNoise_m);
  p.satellites = static_cast<int>(settings.integer("satellites", p.satellites, 0, 64));
  return p;
}

GripperParams parse_gripper(io::Reader& settings, GripperParams p) {
  constexpr io::NumberRange kSide_m{kLeastLength_m, 10.0, false, "m"};
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
  if (std::optional<io::Reader> place = settings.child("pose")) {
    const Pose X_BG = settings.pose("pose", {});
    const bool given = place->has("x") || place->has("y") || place->has("yaw_deg");
    p.X_BG = given ? std::optional(X_BG) : std::nullopt;
  }
  p.length_m = settings.number("length", p.length_m, kSide_m);
  p.thickness_m = settings.number("thickness", p.thickness_m, {0.0, 10.0, false, "m"});
  p.opening_m = settings.number("opening", p.opening_m, kSide_m);
  p.height_m = settings.number("height", p.height_m, {0.0, 100.0, false, "m"});
  p.travel_time_s = settings.number("travel_time", p.travel_time_s, {0.0, 3600.0, true, "s"});
  p.capacity =
      static_cast<int>(settings.integer("capacity", p.capacity, 0, GripperParams::kMaxStored));
  return p;
}

ImuParams parse_imu(io::Reader& settings, ImuParams p) {
  constexpr io::NumberRange kError_mps2{0.0, 1000.0, false, "m/s^2"};
  constexpr io::NumberRange kError_deg{0.0, 3600.0, false, "degrees/s"};
  constexpr io::NumberRange kField_ut{0.0, 1000.0, false, "uT"};
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
  p.noise_mps2 = settings.number("noise_acceleration", p.noise_mps2, kError_mps2);
  p.noise_radps = settings.angle_deg("noise_rate_deg", p.noise_radps, kError_deg);
  p.noise_ut = settings.number("noise_field", p.noise_ut, kField_ut);
  p.bias_mps2 = settings.number("bias_acceleration", p.bias_mps2, kError_mps2);
  p.bias_radps = settings.angle_deg("bias_rate_deg", p.bias_radps, kError_deg);
  p.field_horizontal_ut = settings.number("field_horizontal", p.field_horizontal_ut, kField_ut);
  p.field_down_ut = settings.number("field_down", p.field_down_ut, {-1000.0, 1000.0, false, "uT"});
  p.north_rad = settings.angle_deg("north_deg", p.north_rad, kNorth);
  return p;
}

DioParams parse_dio(io::Reader& settings, DioParams p) {
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
  p.inputs =
      parse_inputs(settings, p.inputs, DioParams::kMaxLines,
                   "true, false, \"contact\", \"stalled\", \"dock\", or a wire: \"DEVICE.INDEX\", "
                   "\"ROBOT.DEVICE.INDEX\"",
                   [](const io::Reader& element) -> std::optional<DigitalSource> {
                     const std::optional<std::string> text = element.scalar_text();
                     if (!text || element.is_number()) return std::nullopt;
                     if (element.is_boolean()) return *text == "true";
                     if (*text == "contact") return DigitalSignal::kContact;
                     if (*text == "stalled") return DigitalSignal::kStalled;
                     if (*text == "dock") return DigitalSignal::kDock;
                     if (std::optional<Wire> wire = parse_wire(*text)) return std::move(*wire);
                     return std::nullopt;
                   });
  p.outputs = static_cast<int>(settings.integer("outputs", p.outputs, 0, DioParams::kMaxLines));
  return p;
}

std::vector<Pose> parse_mounts(io::Reader& settings, const std::vector<Pose>& fallback) {
  std::vector<Pose> mounts;
  std::optional<io::Reader> list = settings.child("mounts");
  if (!list) return fallback;
  std::vector<io::Reader> elements = settings.array("mounts");
  if (!list->is_array()) return fallback;
  if (elements.empty() || elements.size() > RangerParams::kMaxTransducers) {
    list->issue("device/ranger-mounts",
                "a list of 1 to " + std::to_string(RangerParams::kMaxTransducers) +
                    " poses {\"x\", \"y\", \"yaw_deg\"}, one for each transducer",
                "a list of " + std::to_string(elements.size()));
    return fallback;
  }
  for (io::Reader& element : elements) mounts.push_back(element.as_pose({}));
  return mounts;
}

// What infrared and sonar have in common.
void parse_ranger(io::Reader& settings, RangerParams& p) {
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
  p.noise_m = settings.number("noise", p.noise_m, kNoise_m);
  p.range_max_m = settings.number("range_max", p.range_max_m, kRange_m);
  p.height_m = settings.number("height", p.height_m, {0.0, 100.0, false, "m"});
  p.X_BS = parse_mounts(settings, p.X_BS);
}

InfraredParams parse_infrared(io::Reader& settings, InfraredParams p) {
  parse_ranger(settings, p);
  p.voltage_gain_vm =
      settings.number("voltage_gain", p.voltage_gain_vm, {0.0, 1000.0, true, "V m"});
  p.voltage_shift_m = settings.number("voltage_shift", p.voltage_shift_m, {0.0, 10.0, true, "m"});
  return p;
}

LaserParams parse_laser(io::Reader& settings, LaserParams p) {
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
  p.noise_m = settings.number("noise", p.noise_m, kNoise_m);
  p.beam_count = static_cast<int>(settings.integer("beams", p.beam_count, 1, 8192));
  p.resolution_rad =
      settings.angle_deg("resolution_deg", p.resolution_rad, {1e-4, 360.0, false, "degrees"});
  p.range_max_m = settings.number("range_max", p.range_max_m, kRange_m);
  p.X_BL = settings.pose("pose", p.X_BL);
  p.height_m = settings.number("height", p.height_m, {0.0, 100.0, false, "m"});
  constexpr io::NumberRange kSize_m{0.0, 100.0, false, "m"};
  p.size_m = settings.vec2("size", p.size_m, kSize_m);
  p.size_height_m = settings.number("size_height", p.size_height_m, kSize_m);
  const double field_of_view = p.resolution_rad * (p.beam_count - 1);
  if (field_of_view > 2.0 * std::numbers::pi + 1e-9) {
    settings.issue("device/laser-field-of-view",
                   "beams that span at most 360 degrees together, (beams - 1) * resolution_deg",
                   rounded_text(field_of_view / kDegrees, 6) + " degrees");
  }
  return p;
}

PoseParams parse_pose(io::Reader& settings, PoseParams p) {
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
  p.noise_m = settings.number("noise", p.noise_m, kNoise_m);
  p.noise_yaw_rad =
      settings.angle_deg("noise_yaw_deg", p.noise_yaw_rad, {0.0, 360.0, false, "degrees"});
  return p;
}

OdometryParams parse_odometry(io::Reader& settings, OdometryParams p) {
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
  p.noise = settings.number("noise", p.noise, {0.0, 10.0, false, "m after 1 m"});
  const std::vector<std::string> levels = {"integrated", "differential", "raw"};
  const std::string level =
      settings.choice("level", levels[static_cast<std::size_t>(p.level)], levels);
  p.level =
      static_cast<OdometryLevel>(std::find(levels.begin(), levels.end(), level) - levels.begin());
  return p;
}

MotionParams parse_motion(io::Reader& settings, MotionParams p) {
  p.max_speed_mps = settings.number("max_speed", p.max_speed_mps, {0.0, 20.0, true, "m/s"});
  p.max_turn_rate_radps = settings.angle_deg("max_turn_rate_deg", p.max_turn_rate_radps,
                                             {0.0, 3600.0, true, "degrees/s"});
  p.max_acceleration_mps2 =
      settings.number("max_acceleration", p.max_acceleration_mps2, {0.0, 1000.0, false, "m/s^2"});
  p.max_turn_acceleration_radps2 =
      settings.angle_deg("max_turn_acceleration_deg", p.max_turn_acceleration_radps2,
                         {0.0, 1e6, false, "degrees/s^2"});
  p.enabled_at_start = settings.boolean("enabled", p.enabled_at_start);
  p.approach_gain = settings.number("approach_gain", p.approach_gain, {0.0, 50.0, true, "1/s"});
  p.turn_gain = settings.number("turn_gain", p.turn_gain, {0.0, 50.0, true, "1/s"});
  p.tolerance_m = settings.number("tolerance", p.tolerance_m, {0.0, 1000.0, true, "m"});
  p.heading_tolerance_rad = settings.angle_deg("heading_tolerance_deg", p.heading_tolerance_rad,
                                               {0.0, 180.0, true, "degrees"});
  return p;
}

OpaqueParams parse_opaque(io::Reader& settings, OpaqueParams p) {
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
  if (!settings.has("from")) return p;
  p.from.clear();
  for (io::Reader& element : settings.array("from", OpaqueParams::kMaxSenders)) {
    const std::optional<std::string> text = element.scalar_text();
    if (element.is_string() && text && !text->empty()) {
      p.from.push_back(*text);
    } else {
      element.issue("device/input", "\"ROBOT\" or \"ROBOT.DEVICE\"", element.described());
    }
  }
  return p;
}

PenParams parse_pen(io::Reader& settings, PenParams p) {
  p.colour = settings.colour("colour", p.colour);
  p.trail = settings.boolean("trail", p.trail);
  return p;
}

ProximityParams parse_proximity(io::Reader& settings, ProximityParams p) {
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
  p.range_m = settings.number("range", p.range_m, kRange_m);
  p.obstacles = settings.boolean("obstacles", p.obstacles);
  return p;
}

PtzParams parse_ptz(io::Reader& settings, PtzParams p) {
  constexpr io::NumberRange kView_deg{0.01, 170.0, false, "degrees"};
  constexpr io::NumberRange kSpeed_deg{0.0, 3600.0, true, "degrees/s"};
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
  p.pan_max_rad = settings.angle_deg("pan_max_deg", p.pan_max_rad, {0.0, 180.0, false, "degrees"});
  p.tilt_max_rad =
      settings.angle_deg("tilt_max_deg", p.tilt_max_rad, {0.0, 60.0, false, "degrees"});
  p.view_min_rad = settings.angle_deg("field_of_view_min_deg", p.view_min_rad, kView_deg);
  p.view_max_rad = settings.angle_deg("field_of_view_max_deg", p.view_max_rad, kView_deg);
  p.pan_speed_radps = settings.angle_deg("pan_speed_deg", p.pan_speed_radps, kSpeed_deg);
  p.tilt_speed_radps = settings.angle_deg("tilt_speed_deg", p.tilt_speed_radps, kSpeed_deg);
  p.zoom_speed_radps = settings.angle_deg("zoom_speed_deg", p.zoom_speed_radps, kSpeed_deg);
  if (p.view_min_rad > p.view_max_rad) {
    settings.issue("device/ptz-field-of-view",
                   "a field_of_view_min_deg of at most field_of_view_max_deg",
                   rounded_text(p.view_min_rad / kDegrees, 6) + " and " +
                       rounded_text(p.view_max_rad / kDegrees, 6) + " degrees");
    p.view_min_rad = p.view_max_rad;
  }
  return p;
}

SonarParams parse_sonar(io::Reader& settings, SonarParams p) {
  parse_ranger(settings, p);
  p.field_of_view_rad =
      settings.angle_deg("field_of_view_deg", p.field_of_view_rad, {0.01, 180.0, false, "degrees"});
  return p;
}

SpeechParams parse_speech(io::Reader& settings, SpeechParams p) {
  p.shown_s = settings.number("shown", p.shown_s, {0.0, 1000.0, true, "s"});
  return p;
}

TeleportParams parse_teleport(io::Reader&, TeleportParams p) { return p; }

WaypointParams parse_waypoint(io::Reader& settings, WaypointParams p) {
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
  p.tolerance_m = settings.number("tolerance", p.tolerance_m, {0.0, 1000.0, true, "m"});
  p.speed_mps = settings.number("speed", p.speed_mps, {0.0, 20.0, true, "m/s"});
  p.turn_gain = settings.number("turn_gain", p.turn_gain, {0.0, 50.0, true, "1/s"});
  p.approach_gain = settings.number("approach_gain", p.approach_gain, {0.0, 50.0, true, "1/s"});
  p.max_turn_rate_radps = settings.angle_deg("max_turn_rate_deg", p.max_turn_rate_radps,
                                             {0.0, 3600.0, true, "degrees/s"});
  return p;
}

WifiParams parse_wifi(io::Reader& settings, WifiParams p) {
  constexpr io::NumberRange kLevel_dbm{-200.0, 100.0, false, "dBm"};
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
  p.level_1m_dbm = settings.number("level_1m", p.level_1m_dbm, kLevel_dbm);
  p.exponent = settings.number("exponent", p.exponent, {0.0, 10.0, true, ""});
  p.noise_db = settings.number("noise", p.noise_db, {0.0, 100.0, false, "dB"});
  p.floor_dbm = settings.number("floor", p.floor_dbm, kLevel_dbm);
  p.least_dbm = settings.number("least", p.least_dbm, kLevel_dbm);
  p.channel_mhz = settings.number("channel", p.channel_mhz, {0.0, 100'000.0, true, "MHz"});
  const std::optional<io::Reader> list = settings.child("access_points");
  if (!list) return p;
  std::vector<io::Reader> elements = settings.array("access_points", 64);
  if (!list->is_array()) return p;
  p.access_points.clear();
  for (io::Reader& element : elements) {
    AccessPoint point;
    if (element.expect_object()) {
      if (element.require("name", "the name of its network")) {
        point.name = element.name("name", "");
      }
      constexpr io::NumberRange kPlace_m{-kFarthest_m, kFarthest_m, false, "m"};
      point.p_W = {element.number("x", 0.0, kPlace_m), element.number("y", 0.0, kPlace_m)};
      element.finish();
    }
    p.access_points.push_back(std::move(point));
  }
  return p;
}

// Whether a mount lies so far within the footprint that no solid reaches it: robots sink into
// solids by less than 2 mm.
bool well_within(const Polygon& footprint, const Pose& X_BL) {
  for (std::size_t i = 0; i < footprint.size(); ++i) {
    const Vec2& a = footprint[i];
    const Vec2 edge = footprint[(i + 1) % footprint.size()] - a;
    const Vec2 inward = Vec2(-edge.y(), edge.x()).normalized();
    if (inward.dot(X_BL.position() - a) < 0.005) return false;
  }
  return true;
}

std::unique_ptr<Device> make_ranger(const DeviceDescription& device, const RangerParams& params,
                                    const RobotModel& model, RandomStream noise) {
  const bool may_be_inside =
      !std::all_of(params.X_BS.begin(), params.X_BS.end(),
                   [&model](const Pose& X_BS) { return well_within(model.footprint, X_BS); });
  return std::make_unique<Ranger>(device.name, device.type, params, may_be_inside,
                                  std::move(noise));
}

// The drive as its motors are told of it: a robot that is no car pretends to be one as long as
// itself when it is told to drive like one.
DriveDescription drive_of(const RobotModel& model) {
  DriveDescription drive = model.drive;
  if (drive.kind == DriveKind::kCar || model.footprint.empty()) return drive;
  const auto [rear, front] =
      std::minmax_element(model.footprint.begin(), model.footprint.end(),
                          [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); });
  drive.wheelbase_m = front->x() - rear->x();
  drive.max_steering_rad = kMostSteering_rad;
  return drive;
}

using Properties = std::map<std::string, double>;

Properties describe(const BatteryParams& p) {
  return {{"frequency", p.frequency_hz},
          {"capacity", p.capacity_wh},
          {"initial_charge", p.initial_charge_percent},
          {"idle_power", p.idle_power_w},
          {"drive_power", p.drive_power_ws_per_m},
          {"charging_power", p.charging_power_w},
          {"full_voltage", p.full_voltage_v},
          {"empty_voltage", p.empty_voltage_v}};
}
// With segments: those that are set, or those that the model gives.
Properties describe(const BumperParams& p) {
  Properties properties{{"frequency", p.frequency_hz},
                        {"reach", p.reach_m},
                        {"count", static_cast<double>(p.segments.size())}};
  for (std::size_t i = 0; i < p.segments.size(); ++i) {
    const std::string number = std::to_string(i);
    properties["mount_x_" + number] = p.segments[i].X_BS.x_m;
    properties["mount_y_" + number] = p.segments[i].X_BS.y_m;
    properties["mount_yaw_" + number] = p.segments[i].X_BS.yaw_rad;
    properties["length_" + number] = p.segments[i].length_m;
    properties["radius_" + number] = p.segments[i].radius_m;
  }
  return properties;
}
Properties describe(const AioParams& p) {
  return {{"frequency", p.frequency_hz},
          {"noise", p.noise_v},
          {"inputs", static_cast<double>(p.inputs.size())},
          {"outputs", static_cast<double>(p.outputs)}};
}
Properties describe(const BlinkenlightParams& p) {
  return {{"frequency", p.frequency_hz},
          {"enabled", p.enabled ? 1.0 : 0.0},
          {"period", p.period_s},
          {"duty_cycle", p.duty_cycle},
          {"x", p.p_BL.x()},
          {"y", p.p_BL.y()}};
}
Properties describe(const ViewParams& p) {
  return {{"image_width", static_cast<double>(p.width)},
          {"image_height", static_cast<double>(p.height)},
          {"field_of_view", p.field_of_view_rad},
          {"range_max", p.range_max_m},
          {"mount_x", p.X_BS.x_m},
          {"mount_y", p.X_BS.y_m},
          {"mount_yaw", p.X_BS.yaw_rad},
          {"height", p.height_m}};
}
Properties describe(const BlobfinderParams& p) {
  Properties properties = describe(static_cast<const ViewParams&>(p));
  properties["frequency"] = p.frequency_hz;
  properties["noise"] = p.noise_m;
  properties["colours"] = static_cast<double>(p.colours.size());
  return properties;
}
Properties describe(const CameraParams& p) {
  Properties properties = describe(static_cast<const ViewParams&>(p));
  properties["frequency"] = p.frequency_hz;
  return properties;
}
Properties describe(const PtzParams& p) {
  return {{"frequency", p.frequency_hz},         {"pan_max", p.pan_max_rad},
          {"tilt_max", p.tilt_max_rad},          {"field_of_view_min", p.view_min_rad},
          {"field_of_view_max", p.view_max_rad}, {"pan_speed", p.pan_speed_radps},
          {"tilt_speed", p.tilt_speed_radps},    {"zoom_speed", p.zoom_speed_radps}};
}
Properties describe(const DioParams& p) {
  return {{"frequency", p.frequency_hz},
          {"inputs", static_cast<double>(p.inputs.size())},
          {"outputs", static_cast<double>(p.outputs)}};
}
Properties describe(const OpaqueParams& p) {
  return {{"frequency", p.frequency_hz}, {"from", static_cast<double>(p.from.size())}};
}
Properties describe(const SpeechParams& p) { return {{"shown", p.shown_s}}; }
Properties describe(const CollisionParams& p) { return {{"frequency", p.frequency_hz}}; }

Properties describe(const FiducialParams& p) {
  return {{"frequency", p.frequency_hz},
          {"range_max", p.range_max_m},
          {"range_max_id", p.range_max_id_m},
          {"field_of_view", p.field_of_view_rad},
          {"mount_x", p.X_BS.x_m},
          {"mount_y", p.X_BS.y_m},
          {"mount_yaw", p.X_BS.yaw_rad},
          {"height", p.height_m},
          {"noise", p.noise_m},
          {"noise_bearing", p.noise_bearing_rad},
          {"noise_yaw", p.noise_yaw_rad}};
}
Properties describe(const GpsParams& p) {
  return {{"frequency", p.frequency_hz},
          {"latitude", p.latitude_rad},
          {"longitude", p.longitude_rad},
          {"altitude", p.altitude_m},
          {"north", p.north_rad},
          {"noise", p.noise_m},
          {"noise_vertical", p.noise_vertical_m},
          {"satellites", static_cast<double>(p.satellites)}};
}
Properties describe(const GripperParams& p) {
  const Pose X_BG = p.X_BG.value_or(Pose{});
  return {{"frequency", p.frequency_hz},
          {"mount_x", X_BG.x_m},
          {"mount_y", X_BG.y_m},
          {"mount_yaw", X_BG.yaw_rad},
          {"length", p.length_m},
          {"thickness", p.thickness_m},
          {"opening", p.opening_m},
          {"height", p.height_m},
          {"travel_time", p.travel_time_s},
          {"capacity", static_cast<double>(p.capacity)}};
}
Properties describe(const ImuParams& p) {
  return {{"frequency", p.frequency_hz},
          {"noise_acceleration", p.noise_mps2},
          {"noise_rate", p.noise_radps},
          {"noise_field", p.noise_ut},
          {"bias_acceleration", p.bias_mps2},
          {"bias_rate", p.bias_radps},
          {"field_horizontal", p.field_horizontal_ut},
          {"field_down", p.field_down_ut},
          {"north", p.north_rad}};
}
Properties describe(const LaserParams& p) {
  return {{"frequency", p.frequency_hz},
          {"noise", p.noise_m},
          {"beams", static_cast<double>(p.beam_count)},
          {"resolution", p.resolution_rad},
          {"range_max", p.range_max_m},
          {"mount_x", p.X_BL.x_m},
          {"mount_y", p.X_BL.y_m},
          {"mount_yaw", p.X_BL.yaw_rad},
          {"height", p.height_m},
          {"size_x", p.size_m.x()},
          {"size_y", p.size_m.y()},
          {"size_height", p.size_height_m}};
}
Properties describe(const MotionParams& p) {
  return {{"max_speed", p.max_speed_mps},
          {"max_turn_rate", p.max_turn_rate_radps},
          {"max_acceleration", p.max_acceleration_mps2},
          {"max_turn_acceleration", p.max_turn_acceleration_radps2},
          {"approach_gain", p.approach_gain},
          {"turn_gain", p.turn_gain},
          {"tolerance", p.tolerance_m},
          {"heading_tolerance", p.heading_tolerance_rad}};
}
Properties describe(const OdometryParams& p) {
  return {
      {"frequency", p.frequency_hz}, {"noise", p.noise}, {"level", static_cast<double>(p.level)}};
}
Properties describe(const PenParams& p) { return {{"trail", p.trail ? 1.0 : 0.0}}; }
Properties describe(const PoseParams& p) {
  return {{"frequency", p.frequency_hz}, {"noise", p.noise_m}, {"noise_yaw", p.noise_yaw_rad}};
}
Properties describe(const TeleportParams&) { return {}; }
Properties describe(const WaypointParams& p) {
  return {{"frequency", p.frequency_hz},
          {"tolerance", p.tolerance_m},
          {"speed", p.speed_mps},
          {"turn_gain", p.turn_gain},
          {"approach_gain", p.approach_gain},
          {"max_turn_rate", p.max_turn_rate_radps}};
}

Properties describe(const WifiParams& p) {
  return {{"frequency", p.frequency_hz},
          {"level_1m", p.level_1m_dbm},
          {"exponent", p.exponent},
          {"noise", p.noise_db},
          {"floor", p.floor_dbm},
          {"least", p.least_dbm},
          {"channel", p.channel_mhz},
          {"access_points", static_cast<double>(p.access_points.size())}};
}

Properties describe(const ProximityParams& p) {
  return {
      {"frequency", p.frequency_hz}, {"range", p.range_m}, {"obstacles", p.obstacles ? 1.0 : 0.0}};
}
Properties describe(const RangerParams& p) {
  Properties properties{
      {"frequency", p.frequency_hz},          {"noise", p.noise_m},
      {"range_max", p.range_max_m},           {"height", p.height_m},
      {"field_of_view", p.field_of_view_rad}, {"count", static_cast<double>(p.X_BS.size())}};
  for (std::size_t i = 0; i < p.X_BS.size(); ++i) {
    const std::string number = std::to_string(i);
    properties["mount_x_" + number] = p.X_BS[i].x_m;
    properties["mount_y_" + number] = p.X_BS[i].y_m;
    properties["mount_yaw_" + number] = p.X_BS[i].yaw_rad;
  }
  return properties;
}

Properties describe(const InfraredParams& p) {
  Properties properties = describe(static_cast<const RangerParams&>(p));
  properties["voltage_gain"] = p.voltage_gain_vm;
  properties["voltage_shift"] = p.voltage_shift_m;
  return properties;
}

// A row of the table: `parse` reads Params, `make` builds the device from them.
template <typename Params, typename Parse, typename Make>
DeviceKind kind(std::string name, Parse parse, Make make) {
  DeviceKind row;
  row.name = std::move(name);
  row.parse = [parse](io::Reader& settings, const std::any& defaults) -> std::any {
    return parse(settings, std::any_cast<const Params&>(defaults));
  };
  row.defaults = [] { return std::any(Params{}); };
  row.create = [make](const DeviceDescription& device, const RobotDescription& robot,
                      const RobotModel& model, std::uint64_t seed) -> std::unique_ptr<Device> {
    const Params params =
        device.params.has_value() ? std::any_cast<const Params&>(device.params) : Params{};
    return make(device, params, robot, model, noise_stream(device, robot, seed));
  };
  row.properties = [](const std::any& params) {
    return describe(params.has_value() ? std::any_cast<const Params&>(params) : Params{});
  };
  return row;
}

DeviceKind bumper_kind() {
  DeviceKind row =
      kind<BumperParams>("bumper", parse_bumper,
                         [](const DeviceDescription& d, const BumperParams& p,
                            const RobotDescription&, const RobotModel& model, const RandomStream&) {
                           return std::make_unique<Bumper>(d.name, p, model.footprint);
                         });
  row.model_properties = [](const std::any& params, const RobotModel& model) {
    BumperParams p =
        params.has_value() ? std::any_cast<const BumperParams&>(params) : BumperParams{};
    if (p.segments.empty()) p.segments = segments_round(model.footprint);
    return describe(p);
  };
  return row;
}

// The middle of a robot's front.
Pose front_of(const RobotModel& model) {
  double front_m = 0.0;
  for (const Vec2& v : model.footprint) front_m = std::max(front_m, v.x());
  return {front_m, 0.0, 0.0};
}

DeviceKind gripper_kind() {
  DeviceKind row = kind<GripperParams>(
      "gripper", parse_gripper,
      [](const DeviceDescription& d, const GripperParams& p, const RobotDescription&,
         const RobotModel& model, const RandomStream&) {
        return std::make_unique<Gripper>(d.name, p, p.X_BG ? *p.X_BG : front_of(model));
      });
  row.model_properties = [](const std::any& params, const RobotModel& model) {
    GripperParams p =
        params.has_value() ? std::any_cast<const GripperParams&>(params) : GripperParams{};
    if (!p.X_BG) p.X_BG = front_of(model);
    return describe(p);
  };
  return row;
}

std::vector<DeviceKind> make_table() {
  using D = const DeviceDescription&;
  using R = const RobotDescription&;
  using M = const RobotModel&;
  return {
      kind<AioParams>("aio", parse_aio,
                      [](D d, const AioParams& p, R, M, RandomStream noise) {
                        return std::make_unique<Aio>(d.name, p, std::move(noise));
                      }),
      kind<BatteryParams>("battery", parse_battery,
                          [](D d, const BatteryParams& p, R, M model, const RandomStream&) {
                            return std::make_unique<Battery>(d.name, p,
                                                             model.drive.wheel_separation_m);
                          }),
      bumper_kind(),
      kind<BlinkenlightParams>("blinkenlight", parse_blinkenlight,
                               [](D d, const BlinkenlightParams& p, R, M, const RandomStream&) {
                                 return std::make_unique<Blinkenlight>(d.name, p);
                               }),
      kind<BlobfinderParams>("blobfinder", parse_blobfinder,
                             [](D d, const BlobfinderParams& p, R, M, RandomStream noise) {
                               return std::make_unique<Blobfinder>(d.name, p, std::move(noise));
                             }),
      kind<CameraParams>("camera", parse_camera,
                         [](D d, const CameraParams& p, R, M, const RandomStream&) {
                           return std::make_unique<Camera>(d.name, p);
                         }),
      kind<CollisionParams>("collision", parse_collision,
                            [](D d, const CollisionParams& p, R, M, const RandomStream&) {
                              return std::make_unique<CollisionSensor>(d.name, p);
                            }),
      kind<FiducialParams>("fiducial", parse_fiducial,
                           [](D d, const FiducialParams& p, R, M, RandomStream noise) {
                             return std::make_unique<FiducialFinder>(d.name, p, std::move(noise));
                           }),
      kind<GpsParams>("gps", parse_gps,
                      [](D d, const GpsParams& p, R, M, RandomStream noise) {
                        return std::make_unique<Gps>(d.name, p, std::move(noise));
                      }),
      gripper_kind(),
      kind<ImuParams>("imu", parse_imu,
                      [](D d, const ImuParams& p, R robot, M, RandomStream noise) {
                        return std::make_unique<Imu>(d.name, p, robot.pose.yaw_rad,
                                                     std::move(noise));
                      }),
      kind<DioParams>("dio", parse_dio,
                      [](D d, const DioParams& p, R, M, const RandomStream&) {
                        return std::make_unique<Dio>(d.name, p);
                      }),
      kind<InfraredParams>("infrared", parse_infrared,
                           [](D d, const InfraredParams& p, R, M model, RandomStream noise) {
                             return make_ranger(d, p, model, std::move(noise));
                           }),
      kind<LaserParams>("laser", parse_laser,
                        [](D d, const LaserParams& p, R, M model, RandomStream noise) {
                          return std::make_unique<Laser>(
                              d.name, p, !well_within(model.footprint, p.X_BL), std::move(noise));
                        }),
      kind<MotionParams>("motion", parse_motion,
                         [](D d, const MotionParams& p, R, M model, const RandomStream&) {
                           return std::make_unique<Motion>(d.name, p, drive_of(model));
                         }),
      kind<OdometryParams>("odometry", parse_odometry,
                           [](D d, const OdometryParams& p, R, M model, RandomStream noise) {
                             return std::make_unique<Odometry>(
                                 d.name, p, model.drive.wheel_separation_m,
                                 model.drive.kind == DriveKind::kOmnidirectional, std::move(noise));
                           }),
      kind<OpaqueParams>("opaque", parse_opaque,
                         [](D d, const OpaqueParams& p, R, M, const RandomStream&) {
                           return std::make_unique<Opaque>(d.name, p);
                         }),
      kind<PenParams>("pen", parse_pen,
                      [](D d, const PenParams& p, R, M, const RandomStream&) {
                        return std::make_unique<Pen>(d.name, p);
                      }),
      kind<PoseParams>("pose", parse_pose,
                       [](D d, const PoseParams& p, R robot, M, RandomStream noise) {
                         return std::make_unique<PoseSensor>(d.name, p, robot.pose,
                                                             std::move(noise));
                       }),
      kind<ProximityParams>("proximity", parse_proximity,
                            [](D d, const ProximityParams& p, R, M, const RandomStream&) {
                              return std::make_unique<Proximity>(d.name, p);
                            }),
      kind<PtzParams>("ptz", parse_ptz,
                      [](D d, const PtzParams& p, R, M, const RandomStream&) {
                        return std::make_unique<Ptz>(d.name, p);
                      }),
      kind<SonarParams>("sonar", parse_sonar,
                        [](D d, const SonarParams& p, R, M model, RandomStream noise) {
                          return make_ranger(d, p, model, std::move(noise));
                        }),
      kind<SpeechParams>("speech", parse_speech,
                         [](D d, const SpeechParams& p, R, M, const RandomStream&) {
                           return std::make_unique<Speech>(d.name, p);
                         }),
      kind<TeleportParams>("teleport", parse_teleport,
                           [](D d, const TeleportParams& p, R, M, const RandomStream&) {
                             return std::make_unique<Teleport>(d.name, p);
                           }),
      kind<WaypointParams>("waypoint", parse_waypoint,
                           [](D d, const WaypointParams& p, R robot, M, const RandomStream&) {
                             return std::make_unique<Waypoint>(d.name, p, robot.pose);
                           }),
      kind<WifiParams>("wifi", parse_wifi,
                       [](D d, const WifiParams& p, R, M, RandomStream noise) {
                         return std::make_unique<Wifi>(d.name, p, std::move(noise));
                       }),
  };
}

}  // namespace

const std::vector<DeviceKind>& device_kinds() {
  // Never destroyed: a simulation may still be in use while the program exits.
  static const auto* const table = new std::vector<DeviceKind>(make_table());
  return *table;
}

std::vector<io::DeviceType> device_types() {
  return {device_kinds().begin(), device_kinds().end()};
}

}  // namespace sim
