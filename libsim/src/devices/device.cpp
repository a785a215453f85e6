// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/device.h"

#include "devices/device_kind.h"
#include "sim/core/assert.h"

namespace sim {

std::optional<std::string> Device::apply(const Command& command) {
  static_cast<void>(command);
  return "a device of type \"" + type_ + "\" takes no such command";
}

std::optional<std::string> Device::execute(const Command& command, RobotControl& robot) {
  static_cast<void>(robot);
  return apply(command);
}

void Device::set_active(bool active, RobotControl& robot) {
  if (active == active_) return;
  active_ = active;
  if (!active_) deactivated(robot);
}

void Device::archive(StateArchive& archive) {
  auto state = static_cast<std::uint8_t>((active_ ? 1U : 0U) | (blind_ ? 2U : 0U));
  archive(state);
  archive.expect(state <= 3, "the state of a device");
  active_ = (state & 1U) != 0;
  blind_ = (state & 2U) != 0;
}

Sensor::Sensor(std::string name, std::string type, double frequency_hz, double latency_s)
    : Device(std::move(name), std::move(type)),
      frequency_hz_(frequency_hz),
      latency_ns_(from_seconds(latency_s)),
      period_ns_(from_seconds(1.0 / frequency_hz)),
      next_due_ns_(period_ns_) {
  SIM_ASSERT(frequency_hz > 0.0 && period_ns_ > 0 && latency_ns_ >= 0);
}

bool Sensor::update(const StepContext& context) {
  const bool is_new = latency_ns_ > 0 && deliver(context.now_ns);
  if (context.now_ns < next_due_ns_) return is_new;
  // A sensor faster than the simulation's step measures once per step; skipped readings are not
  // made up for.
  next_due_ns_ += period_ns_ * ((context.now_ns - next_due_ns_) / period_ns_ + 1);
  if (!active()) return is_new;
  ++sequence_;
  measure(context);
  return latency_ns_ == 0 || is_new;
}

void Sensor::take_over_from(const Device& before, SimTime later_ns) {
  sequence_ = before.sensor()->sequence_;
  next_due_ns_ += later_ns;
}

void Sensor::archive(StateArchive& archive) {
  Device::archive(archive);
  archive(sequence_);
  archive.time(next_due_ns_);
}

bool is_safely_inside(const RobotModel& model, const Pose& X_BL) {
  return std::ranges::any_of(body_parts(model), [&X_BL](const Polygon& part) {
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Vec2& a = part[i];
      const Vec2 edge = part[(i + 1) % part.size()] - a;
      const Vec2 inward = Vec2(-edge.y(), edge.x()).normalized();
      if (inward.dot(X_BL.position() - a) < 0.005) return false;
    }
    return true;
  });
}

}  // namespace sim
