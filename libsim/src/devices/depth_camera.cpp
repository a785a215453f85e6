// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/depth_camera.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "devices/column_view.h"
#include "devices/device_kind.h"

namespace sim {

DepthCamera::DepthCamera(std::string name, const DepthCameraParams& params, RandomStream noise)
    : SensorOf(std::move(name), "depth_camera", params.frequency_hz, params.latency_s),
      params_(params),
      view_(std::make_unique<ColumnView>(params)),
      noise_(std::move(noise)) {
  auto& first = edit();
  first.width = params.width;
  first.height = params.height;
}

DepthCamera::~DepthCamera() = default;

std::optional<std::string> DepthCamera::connect(std::string_view robot,
                                                const DeviceDirectory& devices) {
  return view_->connect(robot, devices);
}

void DepthCamera::measure(const StepContext& context) {
  auto& reading = next(context, Contents::kAnyEarlier);
  view_->look(context);
  const PinholeView& pinhole = view_->pinhole();
  const double horizon_px = pinhole.row_px(1.0, 0.0);
  reading.width = params_.width;
  reading.height = params_.height;
  reading.focal_px = pinhole.focal_px();
  reading.centre_px = horizon_px;
  const auto width = static_cast<std::size_t>(params_.width);
  reading.depths_m.assign(width * static_cast<std::size_t>(params_.height), 0.0);

  // The depth of a level plane below the lens, in a row; 0 above the horizon.
  const auto level_depth_m = [&](int row, double below_m) {
    const double below_px = row + 0.5 - horizon_px;
    return below_px > 0.0 ? reading.focal_px * below_m / below_px : 0.0;
  };
  const auto put = [&](int column, int row, double depth_m) {
    const double slope = pinhole.slope(column);
    if (depth_m < params_.range_min_m || depth_m <= 0.0 ||
        depth_m * std::sqrt(1.0 + slope * slope) > params_.range_max_m) {
      return;
    }
    reading.depths_m[static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column)] =
        std::clamp(depth_m + noise_.gaussian(params_.noise_m), params_.range_min_m,
                   params_.range_max_m);
  };
  // Rows of each column that no face fills show the floor.
  auto run = view_->runs().begin();
  const auto end = view_->runs().end();
  for (int column = 0; column < params_.width; ++column) {
    int unfilled_from = 0;  // rows above it have got a depth, or show the air
    const auto first = run;
    while (run != end && run->column == column) ++run;
    // The runs of a column are sorted from the bottom to the top.
    for (auto one = run; one != first;) {
      --one;
      const double below_m = params_.height_m - view_->faces()[one->face].height_m;
      const double slope = pinhole.slope(column);
      const double front_m = one->range_m / std::sqrt(1.0 + slope * slope);
      for (int row = unfilled_from; row < one->top; ++row) {
        put(column, row, level_depth_m(row, params_.height_m));
      }
      for (int row = one->top; row < one->bottom; ++row) {
        put(column, row, one->top_face ? level_depth_m(row, below_m) : front_m);
      }
      unfilled_from = one->bottom;
    }
    for (int row = unfilled_from; row < params_.height; ++row) {
      put(column, row, level_depth_m(row, params_.height_m));
    }
  }
}

void DepthCamera::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(noise_);
}

namespace {

bool is_whole(const DepthCameraReading& reading) {
  const std::int64_t size = std::int64_t{reading.width} * reading.height;
  return static_cast<std::int64_t>(reading.depths_m.size()) == size;
}

std::optional<FieldError> check_depths(const void* object) {
  if (is_whole(*static_cast<const DepthCameraReading*>(object))) return std::nullopt;
  return FieldError{"", "a depth for each pixel", "", "", "depths"};
}

std::optional<FieldError> check_ranges(const void* object) {
  const auto& p = *static_cast<const DepthCameraParams*>(object);
  if (p.range_min_m < p.range_max_m) return std::nullopt;
  return FieldError{
      "device/depth-range", "a minimum range less than the maximum range",
      rounded_text(p.range_min_m, 6) + " and " + rounded_text(p.range_max_m, 6) + " m", "",
      "range_min"};
}

}  // namespace

void DepthCamera::archive_reading(StateArchive& archive, DepthCameraReading& reading) {
  SensorOf::archive_reading(archive, reading);
  archive.expect(reading.depths_m.empty() || is_whole(reading), "a depth for each pixel");
}

constexpr Field kDepthCameraSettings[] = {
    frequency_field<&DepthCameraParams::frequency_hz>("pictures per simulated second"),
    include<DepthCameraParams, ViewParams>(),
    field<&DepthCameraParams::range_min_m>("range_min", "m", "nearer points have no depth")
        .within(0.0, 1000.0),
    noise_field<&DepthCameraParams::noise_m>("standard deviation of each depth")
        .with_realism(0.0, 0.01),
    latency_field<&DepthCameraParams::latency_s>(),
};
SIM_FIELDS(DepthCameraParams, kDepthCameraSettings, check_ranges)

constexpr Field kDepthCameraReading[] = {
    field<&DepthCameraReading::width>("width", "pixels", "of the picture")
        .within(0, ViewParams::kMaxWidth),
    field<&DepthCameraReading::height>("height", "pixels", "of the picture")
        .within(0, ViewParams::kMaxHeight),
    field<&DepthCameraReading::focal_px>("focal", "pixels", "focal length"),
    field<&DepthCameraReading::centre_px>("centre", "pixels", "row of the horizon"),
    field<&DepthCameraReading::depths_m>("depths", "m",
                                         "of each pixel, row by row from the top; 0: none"),
};
SIM_FIELDS(DepthCameraReading, kDepthCameraReading, check_depths)

DeviceKind depth_camera_kind() {
  return device_kind<DepthCamera, DepthCameraParams, DepthCameraReading>("depth_camera", {});
}

}  // namespace sim
