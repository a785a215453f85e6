// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/devices/device.h"
#include "sim/devices/view.h"

namespace sim {

class ColumnView;

/// Settings of a camera.
struct CameraParams : ViewParams {
  double frequency_hz = 10.0;  ///< pictures per second
  double latency_s = 0.0;      ///< [s]
};

/// A picture: red, green and blue of each pixel, row-major from the top.
struct CameraReading final : Reading {
  int width = 0;                     ///< [pixels]
  int height = 0;                    ///< [pixels]
  std::vector<std::uint8_t> pixels;  ///< width * height * 3
};

/// Brightness of a surface at a depth: 1 - 0.6 depth / range_max, and 0.4 beyond range_max.
[[nodiscard]] double brightness(double depth_m, double range_max_m);

/// Takes pictures (PinholeView) of floor, walls, obstacles and robots. Their colours are those of
/// the run's pictures, darkened by brightness(). Faces whose normal is along W's x axis are
/// brighter than those along its y axis, by the factor 0.85 + 0.15 cos(2 yaw), as if there were
/// windows on two sides. Docks and drawings on the floor are not visible.
class Camera final : public SensorOf<CameraReading> {
 public:
  Camera(std::string name, const CameraParams& params);
  ~Camera() override;

  std::optional<std::string> connect(std::string_view robot,
                                     const DeviceDirectory& devices) override;
  [[nodiscard]] bool measures_after_others() const noexcept override { return true; }

 protected:
  void measure(const StepContext& context) override;
  void archive_reading(StateArchive& archive, CameraReading& reading) override;

 private:
  void paint_background();

  std::unique_ptr<ColumnView> view_;
  std::vector<std::uint8_t> background_;  // valid for these angles of the head:
  double background_tilt_rad_ = 0.0;
  double background_view_rad_ = 0.0;
};

}  // namespace sim
