// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/amcl.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "devices/device_kind.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"
#include "sim/devices/robot_snapshot.h"
#include "sim/world/description.h"
#include "sim/world/occupancy_map.h"

namespace sim {

MonteCarloSettings monte_carlo_settings(const AmclParams& params) {
  MonteCarloSettings settings;
  settings.min_samples = params.min_samples;
  settings.max_samples = params.max_samples;
  settings.kld_error = params.kld_error;
  settings.kld_z = params.kld_z;
  settings.update_m = params.update_m;
  settings.update_rad = params.update_rad;
  settings.independent_beams = params.independent_beams;
  settings.alpha_slow = params.alpha_slow;
  settings.alpha_fast = params.alpha_fast;
  settings.motion = params.motion;
  return settings;
}

PoseCovariance initial_covariance(const AmclParams& params) {
  const Vec2 variance = params.init_pose_deviation_m.cwiseAbs2();
  return {
      {variance.x(), variance.y(), params.init_pose_deviation_rad * params.init_pose_deviation_rad},
      {}};
}

std::optional<FieldError> check_amcl(const AmclParams& params) {
  if (params.max_samples >= params.min_samples) return std::nullopt;
  return FieldError{"device/amcl-samples",
                    "at least pf_min_samples (" + std::to_string(params.min_samples) + ")",
                    std::to_string(params.max_samples), "", "pf_max_samples"};
}

std::optional<OccupancyMap> localization_map(const ArenaDescription& arena, double cell_size_m) {
  ArenaDescription room = arena;
  if (arena.border) {
    // With the cells in which the border stands.
    room.origin -= Vec2(cell_size_m, cell_size_m);
    room.size += 2.0 * Vec2(cell_size_m, cell_size_m);
  }
  const auto grid = floor_grid(room, cell_size_m);
  if (!grid) return std::nullopt;
  ArenaDescription fixed = arena;
  std::erase_if(fixed.obstacles, [](const ObstacleDescription& obstacle) {
    return is_movable(obstacle) || obstacle.portable;
  });
  return true_map(fixed, *grid);
}

Amcl::Amcl(std::string name, const AmclParams& params, const Pose& X_BL, RandomStream random)
    : SensorOf(std::move(name), "amcl", params.frequency_hz),
      params_(params),
      X_BL_(X_BL),
      random_(std::move(random)) {}

std::optional<std::string> Amcl::connect(std::string_view robot, const DeviceDirectory& devices) {
  const auto wired = [&](const std::string& name) -> const Sensor* {
    const Device* device = devices.find(robot, name);
    return device == nullptr ? nullptr : device->sensor();
  };
  laser_ = wired(params_.laser);
  if (laser_ == nullptr || dynamic_cast<const LaserReading*>(&laser_->reading()) == nullptr) {
    return "a laser device \"" + params_.laser + "\" on robot " + std::string(robot);
  }
  odometry_ = wired(params_.odometry);
  if (odometry_ == nullptr || dynamic_cast<const PoseReading*>(&odometry_->reading()) == nullptr) {
    return "an odometry or pose device \"" + params_.odometry + "\" on robot " + std::string(robot);
  }
  const auto map = localization_map(devices.arena(), params_.map_resolution_m);
  if (!map) {
    return "a map_resolution with which the map has at most " + std::to_string(kMaxCanvasSide) +
           " cells along a side";
  }
  auto field = std::make_shared<const LikelihoodField>(
      *map, LikelihoodSettings{params_.range_deviation_m, params_.bad_share});
  if (field->free_cells() == 0) return "a free cell in the map of the arena";
  localizer_.emplace(monte_carlo_settings(params_), std::move(field), random_);
  if (params_.init_pose) {
    localizer_->set_pose(*params_.init_pose, initial_covariance(params_));
  } else {
    localizer_->spread();
  }
  return std::nullopt;
}

std::optional<std::string> Amcl::apply(const Command& command) {
  const auto* set = std::get_if<SetPoseCommand>(&command);
  if (set == nullptr) return Device::apply(command);
  if (auto fault = fault_of(*set)) return fault;
  PoseCovariance covariance = initial_covariance(params_);
  if (set->variance)
    covariance = {*set->variance, set->covariance.value_or(std::array<double, 3>{})};
  const Pose& pose = set->pose;
  localizer_->set_pose({pose.x_m, pose.y_m, normalize_angle(pose.yaw_rad)}, covariance);
  return std::nullopt;
}

void Amcl::integrate(const StepContext& /*context*/) {
  const auto& odometry = static_cast<const PoseReading&>(odometry_->reading());
  if (odometry.sequence != used_odometry_) {
    used_odometry_ = odometry.sequence;
    if (odometry_->type() == "odometry") {
      localizer_->move(odometry.increment);
    } else if (X_SB_) {
      localizer_->move(*X_SB_ == odometry.pose ? Pose{} : X_SB_->inverse() * odometry.pose);
    }
    X_SB_ = odometry.pose;
  }
  const auto& scan = static_cast<const LaserReading&>(laser_->reading());
  if (scan.sequence == used_scan_ || !active()) return;
  used_scan_ = scan.sequence;
  if (!localizer_->wants_scan()) return;
  localizer_->update(scan_points(X_BL_, scan.ranges_m, scan.angle_min_rad, scan.resolution_rad,
                                 scan.range_max_m, params_.max_beams));
}

void Amcl::measure(const StepContext& context) {
  auto& reading = next(context);
  reading.hypotheses = localizer_->hypotheses();
  reading.particles = static_cast<std::uint32_t>(localizer_->size());
  reading.map_width = static_cast<std::uint32_t>(localizer_->field().width());
  reading.map_height = static_cast<std::uint32_t>(localizer_->field().height());
  reading.map_resolution_m = localizer_->field().cell_size_m();
  reading.updates = localizer_->updates();
}

std::optional<Pose> Amcl::pose_estimate() const {
  const std::vector<PoseHypothesis> hypotheses = localizer_->hypotheses();
  if (hypotheses.empty()) return std::nullopt;
  return hypotheses.front().mean;
}

void Amcl::show(SimTime /*now_ns*/, RobotSnapshot& shot) const {
  for (const Particle& particle : localizer_->particles()) shot.particles.push_back(particle.pose);
  for (const PoseHypothesis& hypothesis : localizer_->hypotheses()) {
    shot.hypotheses.push_back(hypothesis);
  }
}

void Amcl::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(*localizer_, used_scan_, used_odometry_, X_SB_);
}

namespace {

std::optional<FieldError> check_settings(const void* object) {
  return check_amcl(*static_cast<const AmclParams*>(object));
}

/// The laser's mounting; that of a robot without such a laser is never used, see connect().
Pose laser_pose(const RobotDescription& robot, const std::string& laser) {
  for (const DeviceDescription& device : robot.devices) {
    if (device.name == laser && device.type == "laser") {
      return params_in<LaserParams>(device.params).X_BL;
    }
  }
  return {};
}

}  // namespace

constexpr Field kAmclSettings[] = {
    frequency_field<&AmclParams::frequency_hz>(
        "readings per simulated second; the filter runs when the laser has a new scan"),
    field<&AmclParams::laser>("laser", "", "name of the robot's laser"),
    field<&AmclParams::odometry>("odometry", "",
                                 "name of the robot's device that measures its motion"),
    field<&AmclParams::map_resolution_m>("map_resolution", "m", "side of a cell of the map")
        .within(0.001, 10.0),
    field<&AmclParams::init_pose>("init_pose", "",
                                  "the robot's pose at the start; without it: anywhere on the map")
        .not_property(),
    field<&AmclParams::init_pose_deviation_m>(
        "init_pose_var", "m", "standard deviations of x and y of `init_pose` (Player's name)")
        .within(0.0, 1000.0),
    field<&AmclParams::init_pose_deviation_rad>("init_pose_var_yaw_deg", "degrees",
                                                "standard deviation of its heading")
        .within(0.0, 360.0),
    field<&AmclParams::update_m>("update_thresh", "m", "a scan is used after this distance")
        .within(0.0, 100.0),
    field<&AmclParams::update_rad>("update_thresh_yaw_deg", "degrees", "or after this turn")
        .within(0.0, 360.0),
    field<&AmclParams::min_samples>("pf_min_samples", "", "least number of particles")
        .within(1, 100000),
    field<&AmclParams::max_samples>("pf_max_samples", "", "greatest number of particles")
        .within(1, 100000),
    field<&AmclParams::kld_error>(
        "pf_err", "", "error of the particles' distribution that determines their number")
        .above(0.0, 1.0),
    field<&AmclParams::kld_z>("pf_z", "", "quantile of the probability that the error is smaller")
        .within(0.0, 10.0),
    field<&AmclParams::motion, &OdometryNoise::turn_from_turn>(
        "odom_alpha1", "rad^2/rad^2", "variance of a turn that turning causes")
        .within(0.0, 100.0),
    field<&AmclParams::motion, &OdometryNoise::turn_from_drive>(
        "odom_alpha2", "rad^2/m^2", "variance of a turn that driving causes")
        .within(0.0, 100.0),
    field<&AmclParams::motion, &OdometryNoise::drive_from_drive>(
        "odom_alpha3", "m^2/m^2", "variance of a distance that driving causes")
        .within(0.0, 100.0),
    field<&AmclParams::motion, &OdometryNoise::drive_from_turn>(
        "odom_alpha4", "m^2/rad^2", "variance of a distance that turning causes")
        .within(0.0, 100.0),
    field<&AmclParams::max_beams>("laser_max_beams", "", "beams of a scan to use").within(1, 8192),
    field<&AmclParams::range_deviation_m>(
        "laser_range_var", "m",
        "standard deviation of a range, errors of the map included (Player's name)")
        .within(0.001, 10.0),
    field<&AmclParams::bad_share>("laser_range_bad", "",
                                  "share of ranges that do not come from the map")
        .within(0.001, 0.999),
    field<&AmclParams::independent_beams>("laser_independent_beams", "",
                                          "a scan counts like this many independent beams")
        .above(0.0, 1000.0),
    field<&AmclParams::alpha_slow>("recovery_alpha_slow", "",
                                   "rate of the slow mean of the scans' likelihood")
        .within(0.0, 1.0),
    field<&AmclParams::alpha_fast>("recovery_alpha_fast", "",
                                   "rate of the fast mean; 0: no recovery")
        .within(0.0, 1.0),
};
SIM_FIELDS(AmclParams, kAmclSettings, check_settings)

constexpr Field kHypothesis[] = {
    field<&PoseHypothesis::mean>("", "m, rad"),
    field<&PoseHypothesis::weight>("weight"),
    field<&PoseHypothesis::covariance, &PoseCovariance::variance>("variance", "m^2, m^2, rad^2"),
    field<&PoseHypothesis::covariance, &PoseCovariance::covariance>("covariance",
                                                                    "m^2, m rad, m rad"),
};
SIM_FIELDS(PoseHypothesis, kHypothesis)

constexpr Field kAmclReading[] = {
    field<&AmclReading::hypotheses>("hypotheses", "",
                                    "`variance`: of x, y, yaw; `covariance`: of xy, y yaw, x yaw"),
    field<&AmclReading::particles>("particles", "", "number of particles"),
    field<&AmclReading::pending>("pending", "", "scans that wait"),
    field<&AmclReading::map_width>("map_width", "", "columns of its map"),
    field<&AmclReading::map_height>("map_height", "", "rows of its map"),
    field<&AmclReading::map_resolution_m>("map_resolution", "m", "side of a cell of its map"),
    field<&AmclReading::updates>("updates", "", "scans used"),
};
SIM_FIELDS(AmclReading, kAmclReading)

DeviceKind amcl_kind() {
  // Its rank makes it the robot's localize:0; the arena's localisation (pose) follows.
  return device_kind<AmclParams, AmclReading>(
      "amcl", {{"localize", -1}},
      [](const DeviceConstruction& construction, const AmclParams& params) {
        return std::make_unique<Amcl>(construction.name(), params,
                                      laser_pose(construction.robot, params.laser),
                                      construction.noise());
      });
}

}  // namespace sim
