// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include "sim/devices/device.h"

namespace sim {

/// Settings of a head that pans, tilts and zooms. Angles and speeds of pan and tilt, and the
/// narrowest view, are those of a Sony EVI-D30 (its data sheet), which Pioneers carried; the
/// widest view is that of the other devices that look.
struct PtzParams {
  double frequency_hz = 10.0;                                 ///< (0, 1000]
  double pan_max_rad = 100.0 / 180.0 * std::numbers::pi;      ///< to either side, [0, pi]
  double tilt_max_rad = 25.0 / 180.0 * std::numbers::pi;      ///< up and down, [0, pi/3]
  double view_min_rad = 4.4 / 180.0 * std::numbers::pi;       ///< field of view, zoomed in
  double view_max_rad = std::numbers::pi / 3.0;               ///< field of view, zoomed out
  double pan_speed_radps = 80.0 / 180.0 * std::numbers::pi;   ///< at most, > 0
  double tilt_speed_radps = 50.0 / 180.0 * std::numbers::pi;  ///< at most, > 0
  double zoom_speed_radps = 30.0 / 180.0 * std::numbers::pi;  ///< of the field of view, > 0
};

/// Where a head points.
struct PtzReading final : Reading {
  double pan_rad = 0.0;   ///< to the left
  double tilt_rad = 0.0;  ///< upwards
  double view_rad = 0.0;  ///< field of view from side to side
  double pan_speed_radps = 0.0;
  double tilt_speed_radps = 0.0;
  double zoom_speed_radps = 0.0;  ///< how fast the field of view widens
  bool moving = false;
};

/// A head that turns to where it is told at the speed it is told, without inertia, within its
/// limits. At the start it looks straight ahead, zoomed out. Takes PointCommand and PanCommand.
/// Blobfinders and cameras of the same robot may sit on it (ViewParams::ptz).
class Ptz final : public SensorOf<PtzReading> {
 public:
  Ptz(std::string name, const PtzParams& params);

  [[nodiscard]] double pan_rad() const noexcept { return pan_.now; }
  [[nodiscard]] double tilt_rad() const noexcept { return tilt_.now; }
  [[nodiscard]] double view_rad() const noexcept { return view_.now; }

  std::optional<std::string> apply(const Command& command) override;
  void integrate(const StepContext& context) override;
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  /// One of the three motions.
  struct Axis {
    double least;
    double most;
    double max_speed;
    double now;
    double goal;
    double speed;        ///< >= 0, on the way to the goal
    double moved = 0.0;  ///< speed in the last step
    /// Strives for a goal, brought into the limits. @param at  speed; 0: as fast as it goes.
    void go_to(double where, double at);
    /// Moves on for dt_s.
    void step(double dt_s);
  };

  Axis pan_;
  Axis tilt_;
  Axis view_;
};

}  // namespace sim
