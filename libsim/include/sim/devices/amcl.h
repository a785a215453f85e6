// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/devices/device.h"
#include "sim/navigation/monte_carlo.h"

namespace sim {

struct LaserParams;
struct LaserReading;
struct PoseReading;

/// Settings of adaptive Monte Carlo localisation. Names are those of Player's driver amcl where it
/// has the setting.
struct AmclParams {
  double frequency_hz = 10.0;            ///< of readings
  std::string laser = "laser";           ///< the robot's laser
  std::string odometry = "odometry";     ///< the robot's device that measures its motion
  double map_resolution_m = 0.05;        ///< side of a cell of the map [m]
  std::optional<Pose> init_pose;         ///< where the robot is at the start; none: anywhere
  Vec2 init_pose_deviation_m{1.0, 1.0};  ///< standard deviations of x and y of init_pose, and of a
                                         ///< SetPoseCommand without covariance [m]
  double init_pose_deviation_rad = std::numbers::pi / 6.0;  ///< of the yaw
  double update_m = 0.2;                                    ///< see MonteCarloSettings::update_m
  double update_rad = std::numbers::pi / 6.0;               ///< see MonteCarloSettings::update_rad
  int min_samples = 100;                                    ///< particles
  int max_samples = 10000;                                  ///< particles, >= min_samples
  double kld_error = 0.01;                                  ///< error that KLD sampling accepts
  double kld_z = 3.0;                                       ///< quantile that KLD sampling uses
  OdometryNoise motion;                                     ///< of the motion between updates
  int max_beams = 60;                                       ///< beams of a scan to use
  double range_deviation_m = 0.1;                           ///< see LikelihoodSettings [m]
  double bad_share = 0.1;                                   ///< see LikelihoodSettings
  double independent_beams = 20.0;                          ///< see MonteCarloSettings
  double alpha_slow = 0.01;                                 ///< see MonteCarloSettings
  double alpha_fast = 0.3;                                  ///< see MonteCarloSettings
};

/// Settings of the filter.
[[nodiscard]] MonteCarloSettings monte_carlo_settings(const AmclParams& params);
/// Covariance of init_pose, and of a SetPoseCommand without one.
[[nodiscard]] PoseCovariance initial_covariance(const AmclParams& params);
/// The error that makes settings impossible together (max_samples below min_samples).
[[nodiscard]] std::optional<FieldError> check_amcl(const AmclParams& params);

/// The map of an arena for localisation: everything that stays where it is. Obstacles that move,
/// or that robots can push or carry, are left out; dynamic blocks are in it if they are extended.
/// If the arena has a border, the map is one cell wider on each side, for the border.
/// @return nullopt if the map would have more than kMaxCanvasSide cells along a side.
[[nodiscard]] std::optional<OccupancyMap> localization_map(const ArenaDescription& arena,
                                                           double cell_size_m);

/// Where the robot may be.
struct AmclReading final : Reading {
  std::vector<PoseHypothesis> hypotheses;  ///< the most likely one first; at most 10
  std::uint32_t particles = 0;             ///< number of particles
  std::uint32_t pending = 0;      ///< scans that wait for the filter: 0, since it uses a scan
                                  ///< in the step in which it is measured
  std::uint32_t map_width = 0;    ///< columns of the map
  std::uint32_t map_height = 0;   ///< rows of the map
  double map_resolution_m = 0.0;  ///< side of a cell [m]
  std::uint64_t updates = 0;      ///< number of scans that the filter has used
};

/// Localises its robot on the world's map by MonteCarloLocalizer, from the readings of the robot's
/// laser and odometry. It does not use the true pose.
///
/// The map is that of the world's start, see localization_map(). The filter uses a scan when the
/// robot has moved far enough; between two scans the readings follow the odometry. A SetPoseCommand
/// says where the robot is. Odometry may be a `pose` device; of an `odometry` device the increments
/// are used, so setting its pose has no effect here.
class Amcl final : public SensorOf<AmclReading> {
 public:
  Amcl(std::string name, const AmclParams& params, const Pose& X_BL, RandomStream random);

  std::optional<std::string> connect(std::string_view robot,
                                     const DeviceDirectory& devices) override;
  /// Refuses a pose or a covariance that is not finite, and a covariance that is not positive
  /// semidefinite.
  std::optional<std::string> apply(const Command& command) override;
  void integrate(const StepContext& context) override;
  [[nodiscard]] bool measures_after_others() const noexcept override { return true; }
  /// The most likely hypothesis.
  [[nodiscard]] std::optional<Pose> pose_estimate() const override;
  void show(SimTime now_ns, RobotSnapshot& shot) const override;
  void archive(StateArchive& archive) override;

  [[nodiscard]] const MonteCarloLocalizer& localizer() const { return *localizer_; }

 protected:
  void measure(const StepContext& context) override;

 private:
  void start();

  AmclParams params_;
  Pose X_BL_;
  RandomStream random_;  ///< as at the start; the filter has a copy
  const Sensor* laser_ = nullptr;
  const Sensor* odometry_ = nullptr;
  std::optional<MonteCarloLocalizer> localizer_;  ///< from connect() on
  std::uint64_t used_scan_ = 0;                   ///< sequence numbers of the readings used last
  std::uint64_t used_odometry_ = 0;
  std::optional<Pose> X_SB_;  ///< pose in the last odometry reading
};

}  // namespace sim
