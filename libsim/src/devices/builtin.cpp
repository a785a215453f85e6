// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/builtin.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/devices/aio.h"
#include "sim/devices/battery.h"
#include "sim/devices/blinkenlight.h"
#include "sim/devices/contact_sensors.h"
#include "sim/devices/dio.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"
#include "sim/devices/motion.h"
#include "sim/devices/opaque.h"
#include "sim/devices/pen.h"
#include "sim/devices/proximity.h"
#include "sim/devices/rangers.h"
#include "sim/devices/speech.h"
#include "sim/devices/teleport.h"
#include "sim/devices/waypoint.h"

namespace sim {
namespace {

constexpr io::NumberRange kFrequency{0.0, 1000.0, true, "Hz"};
constexpr io::NumberRange kNoise_m{0.0, 100.0, false, "m"};
constexpr io::NumberRange kPower_w{0.0, 10000.0, false, "W"};
constexpr io::NumberRange kVoltage_v{0.0, 1000.0, true, "V"};
constexpr double kDegrees = std::numbers::pi / 180.0;

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
                   std::to_string(p.empty_voltage_v) + " V empty, " +
                       std::to_string(p.full_voltage_v) + " V full");
  }
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

CollisionParams parse_collision(io::Reader& settings, CollisionParams p) {
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
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
  p.range_max_m = settings.number("range_max", p.range_max_m, {0.0, 1000.0, true, "m"});
  p.height_m = settings.number("height", p.height_m, {0.0, 100.0, false, "m"});
  p.X_BS = parse_mounts(settings, p.X_BS);
}

InfraredParams parse_infrared(io::Reader& settings, InfraredParams p) {
  parse_ranger(settings, p);
  return p;
}

LaserParams parse_laser(io::Reader& settings, LaserParams p) {
  p.frequency_hz = settings.number("frequency", p.frequency_hz, kFrequency);
  p.noise_m = settings.number("noise", p.noise_m, kNoise_m);
  p.beam_count = static_cast<int>(settings.integer("beams", p.beam_count, 1, 8192));
  p.resolution_rad =
      settings.angle_deg("resolution_deg", p.resolution_rad, {0.0, 360.0, true, "degrees"});
  p.range_max_m = settings.number("range_max", p.range_max_m, {0.0, 1000.0, true, "m"});
  p.X_BL = settings.pose("pose", p.X_BL);
  p.height_m = settings.number("height", p.height_m, {0.0, 100.0, false, "m"});
  const double field_of_view = p.resolution_rad * (p.beam_count - 1);
  if (field_of_view > 2.0 * std::numbers::pi + 1e-9) {
    settings.issue("device/laser-field-of-view",
                   "beams that span at most 360 degrees together, (beams - 1) * resolution_deg",
                   std::to_string(field_of_view / kDegrees) + " degrees");
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
  p.range_m = settings.number("range", p.range_m, {0.0, 1000.0, true, "m"});
  p.obstacles = settings.boolean("obstacles", p.obstacles);
  return p;
}

SonarParams parse_sonar(io::Reader& settings, SonarParams p) {
  parse_ranger(settings, p);
  p.field_of_view_rad =
      settings.angle_deg("field_of_view_deg", p.field_of_view_rad, {0.0, 180.0, true, "degrees"});
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

Properties describe(const LaserParams& p) {
  return {{"frequency", p.frequency_hz},
          {"noise", p.noise_m},
          {"beams", static_cast<double>(p.beam_count)},
          {"resolution", p.resolution_rad},
          {"range_max", p.range_max_m},
          {"mount_x", p.X_BL.x_m},
          {"mount_y", p.X_BL.y_m},
          {"mount_yaw", p.X_BL.yaw_rad},
          {"height", p.height_m}};
}
Properties describe(const MotionParams& p) {
  return {{"max_speed", p.max_speed_mps},
          {"max_turn_rate", p.max_turn_rate_radps},
          {"max_acceleration", p.max_acceleration_mps2},
          {"max_turn_acceleration", p.max_turn_acceleration_radps2}};
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
                            return std::make_unique<Battery>(d.name, p, model.wheel_separation_m);
                          }),
      kind<BlinkenlightParams>("blinkenlight", parse_blinkenlight,
                               [](D d, const BlinkenlightParams& p, R, M, const RandomStream&) {
                                 return std::make_unique<Blinkenlight>(d.name, p);
                               }),
      kind<CollisionParams>("collision", parse_collision,
                            [](D d, const CollisionParams& p, R, M, const RandomStream&) {
                              return std::make_unique<CollisionSensor>(d.name, p);
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
                         [](D d, const MotionParams& p, R, M, const RandomStream&) {
                           return std::make_unique<Motion>(d.name, p);
                         }),
      kind<OdometryParams>("odometry", parse_odometry,
                           [](D d, const OdometryParams& p, R, M model, RandomStream noise) {
                             return std::make_unique<Odometry>(d.name, p, model.wheel_separation_m,
                                                               std::move(noise));
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
