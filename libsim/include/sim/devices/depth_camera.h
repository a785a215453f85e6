// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/devices/device.h"
#include "sim/devices/view.h"

namespace sim {

class ColumnView;

/// Settings of a depth camera. Picture, place and maximum range are those of ViewParams.
struct DepthCameraParams : ViewParams {
  double frequency_hz = 10.0;  ///< pictures per second
  double range_min_m = 0.3;    ///< nearer points have no depth [m]
  double noise_m = 0.0;        ///< standard deviation of each depth [m]
  double latency_s = 0.0;      ///< [s]
};

/// A picture of depths.
struct DepthCameraReading final : Reading {
  int width = 0;           ///< [pixels]
  int height = 0;          ///< [pixels]
  double focal_px = 0.0;   ///< focal length [pixels]
  double centre_px = 0.0;  ///< row of the principal point, from the top; its column is width / 2
  /// Of the point that each pixel shows, along the camera's axis [m]; row-major from the top. 0:
  /// nothing between the minimum and the maximum range.
  std::vector<double> depths_m;
};

/// Measures the depth of each pixel of a picture (PinholeView): of floor, walls, obstacles with
/// their tops, and robots. A point counts if its depth is not below the minimum range and its
/// horizontal distance is not above the maximum range. Depths with noise stay within these limits.
class DepthCamera final : public SensorOf<DepthCameraReading> {
 public:
  DepthCamera(std::string name, const DepthCameraParams& params, RandomStream noise);
  ~DepthCamera() override;

  std::optional<std::string> connect(std::string_view robot,
                                     const DeviceDirectory& devices) override;
  [[nodiscard]] bool measures_after_others() const noexcept override { return true; }
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;
  void archive_reading(StateArchive& archive, DepthCameraReading& reading) override;

 private:
  DepthCameraParams params_;
  std::unique_ptr<ColumnView> view_;
  RandomStream noise_;
};

}  // namespace sim
