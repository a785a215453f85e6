// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/dio.h"

#include <algorithm>
#include <utility>

#include "devices/device_kind.h"
#include "devices/parse_wire.h"
#include "physics/physics_world.h"
#include "sim/core/assert.h"
#include "sim/devices/battery.h"

namespace sim {
namespace {

// Bit mask with bits 0 to count - 1 set.
std::uint32_t mask(int count) {
  return count >= 32 ? ~std::uint32_t{0} : (std::uint32_t{1} << static_cast<unsigned>(count)) - 1U;
}

bool level(DigitalSignal signal, const StepContext& context) {
  switch (signal) {
    case DigitalSignal::kContact:
      return !context.physics.contacts_of(context.robot).empty();
    case DigitalSignal::kStalled:
      return context.body.stalled;
    case DigitalSignal::kDock:
      break;
  }
  const auto& docks = context.world.arena.docks;
  const Vec2 p_WB = context.body.X_WB.position();
  return std::any_of(docks.begin(), docks.end(),
                     [&](const DockDescription& dock) { return is_on_dock(dock, p_WB); });
}

}  // namespace

Dio::Dio(std::string name, const DioParams& params)
    : SensorOf(std::move(name), "dio", params.frequency_hz),
      params_(params),
      wired_(params.inputs.size(), nullptr) {
  SIM_ASSERT(params.inputs.size() <= DioParams::kMaxLines);
  SIM_ASSERT(params.outputs >= 0 && params.outputs <= DioParams::kMaxLines);
}

std::optional<std::string> Dio::connect(std::string_view robot, const DeviceDirectory& devices) {
  for (std::size_t i = 0; i < params_.inputs.size(); ++i) {
    const auto* wire = std::get_if<Wire>(&params_.inputs[i]);
    if (wire == nullptr) continue;
    const Device* other = devices.find(wire->robot.empty() ? robot : wire->robot, wire->device);
    wired_[i] = dynamic_cast<const Dio*>(other);
    if (wired_[i] == nullptr || wire->index >= wired_[i]->params().outputs) {
      return "an output of a dio device at \"" + to_string(*wire) + "\", to which input " +
             std::to_string(i) + " is wired";
    }
  }
  return std::nullopt;
}

std::optional<std::string> Dio::apply(const Command& command) {
  const auto* set = std::get_if<DigitalOutputCommand>(&command);
  if (set == nullptr) return Sensor::apply(command);
  if (set->count < 0 || set->count > params_.outputs) {
    return "device " + name() + " has " + std::to_string(params_.outputs) +
           " digital outputs, but " + std::to_string(set->count) + " are to be set";
  }
  const std::uint32_t which = mask(set->count);
  outputs_ = (outputs_ & ~which) | (set->bits & which);
  return std::nullopt;
}

void Dio::measure(const StepContext& context) {
  auto& reading = next(context);
  reading.input_count = static_cast<int>(params_.inputs.size());
  reading.inputs = 0;
  for (std::size_t i = 0; i < params_.inputs.size(); ++i) {
    bool high = false;
    if (const auto* constant = std::get_if<bool>(&params_.inputs[i])) high = *constant;
    if (const auto* signal = std::get_if<DigitalSignal>(&params_.inputs[i])) {
      high = level(*signal, context);
    }
    if (const auto* wire = std::get_if<Wire>(&params_.inputs[i])) {
      high = wired_[i] != nullptr && wired_[i]->output(wire->index);
    }
    if (high) reading.inputs |= std::uint32_t{1} << i;
  }
  reading.output_count = params_.outputs;
  reading.outputs = outputs_;
}

void Dio::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(outputs_);
}

namespace {

constexpr std::array<std::string_view, 3> kSignals = {"contact", "stalled", "dock"};

bool read_digital(const io::Reader& value, void* into) {
  auto& source = *static_cast<DigitalSource*>(into);
  const std::optional<std::string> text = value.scalar_text();
  if (!text || value.is_number()) return false;
  const auto* const signal = std::ranges::find(kSignals, *text);
  if (value.is_boolean()) {
    source = *text == "true";
  } else if (signal != kSignals.end()) {
    source = static_cast<DigitalSignal>(signal - kSignals.begin());
  } else if (std::optional<Wire> wire = parse_wire(*text)) {
    source = std::move(*wire);
  } else {
    return false;
  }
  return true;
}

std::string digital_text(const void* from) {
  const auto& source = *static_cast<const DigitalSource*>(from);
  if (const auto* level = std::get_if<bool>(&source)) return *level ? "true" : "false";
  if (const auto* wire = std::get_if<Wire>(&source)) return '"' + to_string(*wire) + '"';
  return '"' + std::string(kSignals[static_cast<std::size_t>(std::get<DigitalSignal>(source))]) +
         '"';
}

}  // namespace

constexpr ElementType kDigitalSource{
    read_digital, digital_text,
    R"({"oneOf": [{"type": "boolean"}, {"enum": ["contact", "stalled", "dock"]}, )"
    R"({"type": "string", "pattern": "^([A-Za-z0-9_-]+\\.)?[A-Za-z0-9_-]+\\.[0-9]+$"}]})"};

constexpr Field kDioSettings[] = {
    frequency_field<&DioParams::frequency_hz>(),
    field<&DioParams::inputs>("inputs", "", "sources of input 0, 1, ...; at most 32")
        .of(kDigitalSource)
        .counting(0, DioParams::kMaxLines)
        .with_issue("device/input",
                    "true, false, \"contact\", \"stalled\", \"dock\", or a wire: \"DEVICE.INDEX\", "
                    "\"ROBOT.DEVICE.INDEX\""),
    field<&DioParams::outputs>("outputs", "", "number of outputs").within(0, DioParams::kMaxLines),
};
SIM_FIELDS(DioParams, kDioSettings)

constexpr Field kDioReading[] = {
    field<&DioReading::input_count>("count", "", "number of inputs")
        .within(0, DioParams::kMaxLines),
    field<&DioReading::inputs>("inputs", "", "bits of the inputs, input 0 the lowest"),
    field<&DioReading::output_count>("output_count", "", "number of outputs")
        .within(0, DioParams::kMaxLines),
    field<&DioReading::outputs>("outputs", "", "bits of the outputs"),
};
SIM_FIELDS(DioReading, kDioReading)

DeviceKind dio_kind() { return device_kind<Dio, DioParams, DioReading>("dio", {{"dio"}}); }

}  // namespace sim
