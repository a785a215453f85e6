// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/aio.h"

#include <charconv>
#include <cmath>
#include <utility>

#include "devices/device_kind.h"
#include "devices/parse_wire.h"
#include "sim/core/assert.h"
#include "sim/devices/battery.h"
#include "sim/devices/laser.h"
#include "sim/devices/rangers.h"

namespace sim {
namespace {

const Reading* newest(const Device* device) {
  const Sensor* sensor = device == nullptr ? nullptr : device->sensor();
  return sensor == nullptr ? nullptr : &sensor->reading();
}

const std::vector<double>* ranges_of(const Device* device) {
  const Reading* reading = newest(device);
  if (const auto* laser = dynamic_cast<const LaserReading*>(reading)) return &laser->ranges_m;
  if (const auto* ranger = dynamic_cast<const RangerReading*>(reading)) return &ranger->ranges_m;
  return nullptr;
}

// Whether the device has an output or a value of that index for an input to be wired to.
bool has_value(const Device* device, int index) {
  if (const auto* aio = dynamic_cast<const Aio*>(device)) return index < aio->params().outputs;
  if (const auto* laser = dynamic_cast<const Laser*>(device)) {
    return index < laser->params().beam_count;
  }
  if (const auto* ranger = dynamic_cast<const Ranger*>(device)) {
    return static_cast<std::size_t>(index) < ranger->params().X_BS.size();
  }
  return false;
}

}  // namespace

Aio::Aio(std::string name, const AioParams& params, RandomStream noise)
    : SensorOf(std::move(name), "aio", params.frequency_hz),
      params_(params),
      noise_(std::move(noise)),
      wired_(params.inputs.size(), nullptr),
      outputs_v_(static_cast<std::size_t>(params.outputs), 0.0) {
  SIM_ASSERT(params.inputs.size() <= AioParams::kMaxLines);
}

std::optional<std::string> Aio::connect(std::string_view robot, const DeviceDirectory& devices) {
  for (std::size_t i = 0; i < params_.inputs.size(); ++i) {
    if (const auto* tap = std::get_if<BatteryTap>(&params_.inputs[i])) {
      wired_[i] = devices.find(robot, tap->device);
      if (dynamic_cast<const BatteryReading*>(newest(wired_[i])) == nullptr) {
        return "a battery device \"" + tap->device + "\", whose voltage input " +
               std::to_string(i) + " shows";
      }
    }
    if (const auto* wire = std::get_if<Wire>(&params_.inputs[i])) {
      wired_[i] = devices.find(wire->robot.empty() ? robot : wire->robot, wire->device);
      if (!has_value(wired_[i], wire->index)) {
        return "an output of an aio device, or a range of a laser, sonar or infrared device, at "
               "\"" +
               to_string(*wire) + "\", to which input " + std::to_string(i) + " is wired";
      }
    }
  }
  return std::nullopt;
}

std::optional<std::string> Aio::apply(const Command& command) {
  const auto* set = std::get_if<AnalogOutputCommand>(&command);
  if (set == nullptr) return Sensor::apply(command);
  if (set->channel < 0 || set->channel >= params_.outputs) {
    return "device " + name() + " has " + std::to_string(params_.outputs) +
           " analog outputs, counted from 0; there is no output " + std::to_string(set->channel);
  }
  if (!(std::abs(set->voltage_v) <= AioParams::kMaxVolts)) {
    return "an output of device " + name() + " has at most 1e6 V to either side";
  }
  outputs_v_[static_cast<std::size_t>(set->channel)] = set->voltage_v;
  return std::nullopt;
}

double Aio::voltage_v(std::size_t input, const StepContext& context) const {
  const AnalogSource& source = params_.inputs[input];
  if (const auto* constant_v = std::get_if<double>(&source)) return *constant_v;
  if (const auto* signal = std::get_if<AnalogSignal>(&source)) {
    const Twist& twist = context.body.twist;
    return *signal == AnalogSignal::kSpeed ? twist.v_mps : twist.omega_radps;
  }
  const Device* device = wired_[input];
  if (const auto* battery = dynamic_cast<const BatteryReading*>(newest(device));
      battery != nullptr && std::holds_alternative<BatteryTap>(source)) {
    return battery->voltage_v;
  }
  const auto* wire = std::get_if<Wire>(&source);
  if (wire == nullptr) return 0.0;
  if (const auto* aio = dynamic_cast<const Aio*>(device)) return aio->output_v(wire->index);
  const std::vector<double>* ranges_m = ranges_of(device);
  const auto index = static_cast<std::size_t>(wire->index);
  return ranges_m != nullptr && index < ranges_m->size() ? (*ranges_m)[index] : 0.0;
}

void Aio::measure(const StepContext& context) {
  auto& reading = next(context);
  reading.inputs_v.resize(params_.inputs.size());
  for (std::size_t i = 0; i < params_.inputs.size(); ++i) {
    reading.inputs_v[i] = voltage_v(i, context);
    reading.inputs_v[i] += noise_.gaussian(params_.noise_v);
  }
  reading.outputs_v = outputs_v_;
}

void Aio::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(noise_, outputs_v_);
  archive.expect(outputs_v_.size() == static_cast<std::size_t>(params_.outputs),
                 "a voltage for each output");
}

namespace {

bool read_analog(const io::Reader& value, void* into) {
  auto& source = *static_cast<AnalogSource*>(into);
  const std::optional<std::string> text = value.scalar_text();
  if (!text || text->empty() || value.is_boolean()) return false;
  if (value.is_number()) {
    double voltage_v = 0.0;
    std::from_chars(text->data(), text->data() + text->size(), voltage_v);
    source = voltage_v;
    return std::abs(voltage_v) <= AioParams::kMaxVolts;
  }
  if (*text == "speed") {
    source = AnalogSignal::kSpeed;
  } else if (*text == "turn_rate") {
    source = AnalogSignal::kTurnRate;
  } else if (text->find('.') == std::string::npos) {
    source = BatteryTap{*text};
  } else if (std::optional<Wire> wire = parse_wire(*text)) {
    source = std::move(*wire);
  } else {
    return false;
  }
  return true;
}

std::string analog_text(const void* from) {
  const auto& source = *static_cast<const AnalogSource*>(from);
  if (const auto* voltage_v = std::get_if<double>(&source)) return shortest_text(*voltage_v);
  if (const auto* battery = std::get_if<BatteryTap>(&source)) return '"' + battery->device + '"';
  if (const auto* wire = std::get_if<Wire>(&source)) return '"' + to_string(*wire) + '"';
  return std::get<AnalogSignal>(source) == AnalogSignal::kSpeed ? R"("speed")" : R"("turn_rate")";
}

}  // namespace

constexpr ElementType kAnalogSource{read_analog, analog_text, R"({"type": ["number", "string"]})"};

constexpr Field kAioSettings[] = {
    frequency_field<&AioParams::frequency_hz>(),
    field<&AioParams::noise_v>("noise", "V", "standard deviation of each input")
        .with_realism(0.0, 0.005)
        .within(0.0, 1000.0),
    field<&AioParams::inputs>("inputs", "", "sources of input 0, 1, ...; at most 8")
        .of(kAnalogSource)
        .counting(0, AioParams::kMaxLines)
        .with_issue("device/input",
                    "a voltage, \"speed\", \"turn_rate\", \"battery\" (or another battery device's "
                    "name), or a wire: \"DEVICE.INDEX\", \"ROBOT.DEVICE.INDEX\""),
    field<&AioParams::outputs>("outputs", "", "number of outputs").within(0, AioParams::kMaxLines),
};
SIM_FIELDS(AioParams, kAioSettings)

constexpr Field kAioReading[] = {
    field<&AioReading::inputs_v>("inputs", "V", "voltages of the inputs"),
    field<&AioReading::outputs_v>("outputs", "V", "voltages of the outputs"),
};
SIM_FIELDS(AioReading, kAioReading)

DeviceKind aio_kind() { return device_kind<Aio, AioParams, AioReading>("aio", {{"aio"}}); }

}  // namespace sim
