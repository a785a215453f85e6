// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include "sim/devices/device.h"
#include "sim/devices/mount.h"

namespace sim {

/// Settings of a head that pans, tilts and zooms. The default angles and speeds of pan and tilt,
/// and the narrowest field of view, are those of the Sony EVI-D30 of Pioneer robots (from its data
/// sheet). The default widest field of view is that of the other viewing devices.
struct PtzParams : MountPose {
  double frequency_hz = 10.0;                                 ///< [Hz]
  double pan_max_rad = 100.0 / 180.0 * std::numbers::pi;      ///< to either side, [0, pi]
  double tilt_max_rad = 25.0 / 180.0 * std::numbers::pi;      ///< up and down, [0, pi/2]
  double view_min_rad = 4.4 / 180.0 * std::numbers::pi;       ///< field of view, zoomed in
  double view_max_rad = std::numbers::pi / 3.0;               ///< field of view, zoomed out
  double pan_speed_radps = 80.0 / 180.0 * std::numbers::pi;   ///< maximum
  double tilt_speed_radps = 50.0 / 180.0 * std::numbers::pi;  ///< maximum
  double zoom_speed_radps = 30.0 / 180.0 * std::numbers::pi;  ///< of the view, maximum
};

/// Direction of a head.
struct PtzReading final : Reading {
  double pan_rad = 0.0;   ///< to the left
  double tilt_rad = 0.0;  ///< upwards
  double view_rad = 0.0;  ///< horizontal field of view
  double pan_speed_radps = 0.0;
  double tilt_speed_radps = 0.0;
  double zoom_speed_radps = 0.0;  ///< rate of change of the field of view
  bool moving = false;
};

/// A head that turns to a commanded direction at a commanded speed, without inertia, within its
/// limits. Initially it points straight ahead, zoomed out. Takes PointCommand and PanCommand.
/// Blobfinders and cameras of the same robot may be mounted on it (ViewParams::ptz).
class Ptz final : public SensorOf<PtzReading> {
 public:
  Ptz(std::string name, const PtzParams& params);

  [[nodiscard]] double pan_rad() const noexcept { return pan_.now; }
  [[nodiscard]] double tilt_rad() const noexcept { return tilt_.now; }
  /// Whether it is on its way.
  [[nodiscard]] bool moving() const noexcept {
    return pan_.now != pan_.goal || tilt_.now != tilt_.goal || view_.now != view_.goal;
  }
  /// Its place on the body.
  [[nodiscard]] const MountPose& mount() const noexcept { return mount_; }
  /// Pose of the head in the body's frame B: x along the view, z upwards.
  [[nodiscard]] Eigen::Isometry3d head_in_body() const;
  [[nodiscard]] double view_rad() const noexcept { return view_.now; }

  std::optional<std::string> apply(const Command& command) override;
  void integrate(const StepContext& context) override;
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  /// One of the three axes.
  struct Axis {
    double least;
    double most;
    double max_speed;
    double now;
    double goal;
    double speed;        ///< >= 0, on the way to the goal
    double moved = 0.0;  ///< speed in the last step
    /// Sets the goal, clamped to the limits.
    /// @param at  speed; 0: the maximum.
    void go_to(double where, double at);
    /// Moves for dt_s.
    void step(double dt_s);
  };

  MountPose mount_;
  Axis pan_;
  Axis tilt_;
  Axis view_;
};

}  // namespace sim
