// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/ptz.h"

#include <algorithm>
#include <cmath>
#include <utility>

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
    : Sensor(std::move(name), "ptz", params.frequency_hz),
      pan_{-params.pan_max_rad, params.pan_max_rad, params.pan_speed_radps, 0.0, 0.0, 0.0},
      tilt_{-params.tilt_max_rad, params.tilt_max_rad, params.tilt_speed_radps, 0.0, 0.0, 0.0},
      view_{params.view_min_rad, params.view_max_rad, params.zoom_speed_radps,
            params.view_max_rad, params.view_max_rad, 0.0} {}

std::optional<std::string> Ptz::apply(const Command& command) {
  if (const auto* point = std::get_if<PointCommand>(&command)) {
    pan_.go_to(point->pan_rad, point->pan_speed_radps);
    tilt_.go_to(point->tilt_rad, point->tilt_speed_radps);
    view_.go_to(point->view_rad > 0.0 ? point->view_rad : view_.now, 0.0);
    return std::nullopt;
  }
  if (const auto* pan = std::get_if<PanCommand>(&command)) {
    // A speed is a way to the limit; none is one to where the head is.
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
  stamp(context, reading_);
  reading_.pan_rad = pan_.now;
  reading_.tilt_rad = tilt_.now;
  reading_.view_rad = view_.now;
  reading_.pan_speed_radps = pan_.moved;
  reading_.tilt_speed_radps = tilt_.moved;
  reading_.zoom_speed_radps = view_.moved;
  reading_.moving = pan_.now != pan_.goal || tilt_.now != tilt_.goal || view_.now != view_.goal;
}

void Ptz::hash(StateHash& hash) const {
  Sensor::hash(hash);
  for (const Axis* axis : {&pan_, &tilt_, &view_}) {
    for (const double x : {axis->now, axis->goal, axis->speed}) hash.add(x);
  }
}

}  // namespace sim
