// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/wander.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "devices/device_kind.h"
#include "sim/devices/laser.h"

namespace sim {

WanderView wander_view(const std::vector<double>& ranges_m, const WanderParams& params) {
  WanderView view;
  const std::size_t count = ranges_m.size();
  double least_left_m = std::numeric_limits<double>::infinity();
  double least_right_m = least_left_m;
  for (std::size_t i = 0; i < count; ++i) {
    const double range_m = ranges_m[i];
    const bool ahead = i > count / 3 && i < count - count / 3;
    view.obstructed = view.obstructed || (ahead && range_m < params.front_distance_m);
    view.stop = view.stop || range_m < params.stop_distance_m;
    double& least_m = i > count / 2 ? least_left_m : least_right_m;
    least_m = std::min(least_m, range_m);
  }
  view.turn_right = least_left_m < least_right_m;
  return view;
}

Wander::Wander(std::string name, const WanderParams& params, RandomStream random)
    : Actuator(std::move(name), "wander"), params_(params), random_(std::move(random)) {}

std::optional<std::string> Wander::connect(std::string_view robot, const DeviceDirectory& devices) {
  laser_ = dynamic_cast<const Laser*>(devices.find(robot, params_.laser));
  if (laser_ != nullptr) return std::nullopt;
  return "it needs a laser of the name \"" + params_.laser + "\" on its robot";
}

void Wander::decide(const std::vector<double>& ranges_m) {
  const WanderView view = wander_view(ranges_m, params_);
  if (!view.obstructed && !view.stop && scans_to_turn_ <= 0) {
    twist_ = {params_.speed_mps, 0.0};
    return;
  }
  twist_.v_mps = view.stop ? 0.0 : params_.slow_speed_mps;
  if (scans_to_turn_ < 1) {
    constexpr double kLeastScans = 10.0;
    scans_to_turn_ = static_cast<std::int64_t>(kLeastScans + kLeastScans * random_.uniform());
    twist_.omega_radps = view.turn_right ? -params_.turn_rate_radps : params_.turn_rate_radps;
  }
  --scans_to_turn_;
}

void Wander::act(RobotControl& robot) {
  if (!started_) {
    started_ = true;
    drives_ = robot.acquire_motors(*this);
  }
  if (!drives_) return;
  const LaserReading& scan = laser_->reading();
  if (scan.sequence != scan_) {
    scan_ = scan.sequence;
    decide(scan.ranges_m);
  }
  robot.drive(twist_);
}

void Wander::on_motors_taken() { drives_ = false; }

void Wander::deactivated(RobotControl& robot) {
  if (drives_) robot.drive({});
  drives_ = false;
}

void Wander::archive(StateArchive& archive) {
  Actuator::archive(archive);
  archive(random_, started_, drives_, scan_, scans_to_turn_, twist_);
}

constexpr Field kWanderSettings[] = {
    field<&WanderParams::laser>("laser", "", "name of the robot's laser"),
    field<&WanderParams::speed_mps>("speed", "m/s", "while the way is free").above(0.0, 20.0),
    field<&WanderParams::slow_speed_mps>("slow_speed", "m/s", "while it turns away")
        .within(0.0, 20.0),
    field<&WanderParams::turn_rate_radps>("turn_rate_deg", "degrees/s",
                                          "while it turns away; default 0.5 rad/s")
        .above(0.0, 3600.0),
    field<&WanderParams::front_distance_m>("front_distance", "m",
                                           "nearer obstacles in front make it turn away")
        .above(0.0, 1000.0),
    field<&WanderParams::stop_distance_m>("stop_distance", "m",
                                          "nearer obstacles anywhere make it stop and turn")
        .above(0.0, 1000.0),
};
SIM_FIELDS(WanderParams, kWanderSettings)

DeviceKind wander_kind() { return device_kind<Wander, WanderParams, void>("wander", {}); }

}  // namespace sim
