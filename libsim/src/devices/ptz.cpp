// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/ptz.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "devices/device_kind.h"
#include "sim/world/description.h"

namespace sim {

void Ptz::Axis::go_to(double where, double at) {
  goal = std::clamp(where, least, most);
  speed = at == 0.0 ? max_speed : std::min(std::abs(at), max_speed);
}

void Ptz::Axis::step(double dt_s) {
  const double before = now;
  const double reach = speed * dt_s;
  now = std::abs(goal - now) <= reach ? goal : now + std::copysign(reach, goal - now);
  moved = (now - before) / dt_s;
}

Ptz::Ptz(std::string name, const PtzParams& params)
    : SensorOf(std::move(name), "ptz", params.frequency_hz),
      mount_(static_cast<const MountPose&>(params)),
      pan_{-params.pan_max_rad, params.pan_max_rad, params.pan_speed_radps, 0.0, 0.0, 0.0},
      tilt_{-params.tilt_max_rad, params.tilt_max_rad, params.tilt_speed_radps, 0.0, 0.0, 0.0},
      view_{params.view_min_rad, params.view_max_rad, params.zoom_speed_radps,
            params.view_max_rad, params.view_max_rad, 0.0} {}

Eigen::Isometry3d Ptz::head_in_body() const {
  // A positive tilt looks upwards, a positive pitch downwards.
  return mount_.transform() * in_space({0.0, 0.0, pan_.now}, {0.0, 0.0, -tilt_.now});
}

std::optional<std::string> Ptz::apply(const Command& command) {
  if (const auto* point = std::get_if<PointCommand>(&command)) {
    pan_.go_to(point->pan_rad, point->pan_speed_radps);
    tilt_.go_to(point->tilt_rad, point->tilt_speed_radps);
    view_.go_to(point->view_rad > 0.0 ? point->view_rad : view_.now, 0.0);
    return std::nullopt;
  }
  if (const auto* pan = std::get_if<PanCommand>(&command)) {
    // A speed command moves the axis to its limit; speed 0 makes it stop at its current angle.
    for (const auto& [axis, speed] :
         {std::pair(&pan_, pan->pan_speed_radps), std::pair(&tilt_, pan->tilt_speed_radps),
          std::pair(&view_, pan->zoom_speed_radps)}) {
      axis->go_to(speed == 0.0 ? axis->now : std::copysign(4.0, speed), speed);
    }
    return std::nullopt;
  }
  return Sensor::apply(command);
}

void Ptz::integrate(const StepContext& context) {
  const double dt_s = to_seconds(context.world.simulation.step_ns);
  for (Axis* axis : {&pan_, &tilt_, &view_}) axis->step(dt_s);
}

void Ptz::measure(const StepContext& context) {
  auto& reading = next(context);
  reading.pan_rad = pan_.now;
  reading.tilt_rad = tilt_.now;
  reading.view_rad = view_.now;
  reading.pan_speed_radps = pan_.moved;
  reading.tilt_speed_radps = tilt_.moved;
  reading.zoom_speed_radps = view_.moved;
  reading.moving = moving();
}

void Ptz::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  for (Axis* axis : {&pan_, &tilt_, &view_}) {
    archive(axis->now, axis->goal, axis->speed, axis->moved);
    archive.expect(axis->least <= axis->now && axis->now <= axis->most, "a head within its limits");
  }
}

namespace {

std::optional<FieldError> check_ptz_view(const void* object) {
  const auto& p = *static_cast<const PtzParams*>(object);
  if (p.view_min_rad <= p.view_max_rad) return std::nullopt;
  return FieldError{"device/ptz-field-of-view",
                    "a field_of_view_min_deg of at most field_of_view_max_deg",
                    rounded_text(p.view_min_rad / kDegrees, 6) + " and " +
                        rounded_text(p.view_max_rad / kDegrees, 6) + " degrees",
                    ""};
}

}  // namespace

constexpr Field kPtzSettings[] = {
    frequency_field<&PtzParams::frequency_hz>(),
    field<&PtzParams::pan_max_rad>("pan_max_deg", "degrees", "maximum pan to either side")
        .within(0.0, 180.0),
    field<&PtzParams::tilt_max_rad>("tilt_max_deg", "degrees", "maximum tilt, up and down")
        .within(0.0, 90.0),
    field<&PtzParams::view_min_rad>("field_of_view_min_deg", "degrees",
                                    "of the lens, from side to side, zoomed in")
        .within(0.01, 170.0),
    field<&PtzParams::view_max_rad>("field_of_view_max_deg", "degrees",
                                    "zoomed out, as at the start")
        .within(0.01, 170.0),
    field<&PtzParams::pan_speed_radps>("pan_speed_deg", "degrees/s", "maximum pan rate")
        .above(0.0, 3600.0),
    field<&PtzParams::tilt_speed_radps>("tilt_speed_deg", "degrees/s", "maximum tilt rate")
        .above(0.0, 3600.0),
    field<&PtzParams::zoom_speed_radps>("zoom_speed_deg", "degrees/s",
                                        "maximum rate of change of the field of view")
        .above(0.0, 3600.0),
    include<PtzParams, MountPose>(),
};
SIM_FIELDS(PtzParams, kPtzSettings, check_ptz_view)

constexpr Field kPtzReading[] = {
    field<&PtzReading::pan_rad>("pan", "rad", "to the left"),
    field<&PtzReading::tilt_rad>("tilt", "rad", "upwards"),
    field<&PtzReading::view_rad>("view", "rad", "field of view"),
    field<&PtzReading::pan_speed_radps>("pan_speed", "rad/s", "of the pan"),
    field<&PtzReading::tilt_speed_radps>("tilt_speed", "rad/s", "of the tilt"),
    field<&PtzReading::zoom_speed_radps>("zoom_speed", "rad/s", "of the field of view"),
    field<&PtzReading::moving>("moving", "", "whether it moves"),
};
SIM_FIELDS(PtzReading, kPtzReading)

DeviceKind ptz_kind() { return device_kind<Ptz, PtzParams, PtzReading>("ptz", {{"ptz"}}); }

}  // namespace sim
