// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/camera.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "devices/column_view.h"
#include "devices/device_kind.h"
#include "sim/world/description.h"

namespace sim {
namespace {

// The colours of the run's pictures.
constexpr Colour kFloor{0xfc, 0xfb, 0xf8};
constexpr Colour kBorder{0x8c, 0x5e, 0x3c};
constexpr Colour kStatic{0xcd, 0xd1, 0xd6};
constexpr Colour kDynamic{0xd6, 0x45, 0x41};
constexpr Colour kWall{0x45, 0x4b, 0x54};
// Colour of everything above the solids.
constexpr Colour kAir{0xdc, 0xe8, 0xf2};

Colour shown_colour(const PhysicsWorld::Face& face, const WorldDescription& world) {
  using Kind = PhysicsWorld::Contact::Kind;
  const auto index = static_cast<std::size_t>(face.index);
  switch (face.kind) {
    case Kind::kRobot:
      return world.robots[index].colour;
    case Kind::kObstacle: {
      const ObstacleDescription& o = world.arena.obstacles[index];
      return o.colour.value_or(o.type == ObstacleType::kDynamic ? kDynamic : kStatic);
    }
    case Kind::kWall:
      return kWall;
    case Kind::kBorder:
    case Kind::kSeparator:
      break;
  }
  return kBorder;
}

Colour scaled(const Colour& colour, double factor) {
  const auto channel = [factor](std::uint8_t value) {
    return static_cast<std::uint8_t>(std::lround(factor * value));
  };
  return {channel(colour.r), channel(colour.g), channel(colour.b), 255};
}

// Relative brightness of an upright face along the direction e.
double side_light(const Vec2& e) {
  // cos(2 yaw) of the normal, which is e rotated by a quarter turn.
  const double cos2 = (e.y() * e.y() - e.x() * e.x()) / e.squaredNorm();
  return 0.85 + 0.15 * cos2;
}

// The direction of an upright face in W where the ray of a column meets it.
// @param slope    of the ray in S.
// @param depth_m  along the x axis of S.
Vec2 along(const PhysicsWorld::Face& face, const Pose& X_WS, double slope, double depth_m) {
  if (face.radius_m <= 0.0) return face.p_WC - face.p_WA;
  const Vec2 normal = X_WS * Vec2(depth_m, slope * depth_m) - face.p_WA;
  return {-normal.y(), normal.x()};
}

}  // namespace

double brightness(double depth_m, double range_max_m) {
  return 1.0 - 0.6 * std::clamp(depth_m / range_max_m, 0.0, 1.0);
}

Camera::Camera(std::string name, const CameraParams& params)
    : SensorOf(std::move(name), "camera", params.frequency_hz, params.latency_s),
      view_(std::make_unique<ColumnView>(params)) {
  auto& first = edit();
  first.width = params.width;
  first.height = params.height;
}

Camera::~Camera() = default;

std::optional<std::string> Camera::connect(std::string_view robot, const DeviceDirectory& devices) {
  return view_->connect(robot, devices);
}

void Camera::measure(const StepContext& context) {
  auto& reading = next(context, Contents::kAnyEarlier);
  view_->look(context);
  const ViewParams& params = view_->params();
  const PinholeView& pinhole = view_->pinhole();
  const auto row_bytes = static_cast<std::size_t>(params.width) * 3;
  if (background_.empty() || pinhole.tilt_rad != background_tilt_rad_ ||
      pinhole.field_of_view_rad != background_view_rad_) {
    paint_background();
  }
  reading.pixels = background_;
  const double focal_px = pinhole.focal_px();
  for (const ColumnView::Run& run : view_->runs()) {
    const PhysicsWorld::Face& face = view_->faces()[run.face];
    const double slope = (0.5 * params.width - (run.column + 0.5)) / focal_px;
    const double depth_m = run.range_m / std::sqrt(1.0 + slope * slope);
    const double light =
        brightness(depth_m, params.range_max_m) *
        (run.top_face ? 1.0 : side_light(along(face, view_->X_WS(), slope, depth_m)));
    const Colour colour = scaled(shown_colour(face, context.world), light);
    std::uint8_t* pixel = reading.pixels.data() + static_cast<std::size_t>(run.top) * row_bytes +
                          static_cast<std::size_t>(run.column) * 3;
    for (int row = run.top; row < run.bottom; ++row) {
      pixel[0] = colour.r;
      pixel[1] = colour.g;
      pixel[2] = colour.b;
      pixel += row_bytes;
    }
  }
}

// Floor and air, which change only when the head moves.
void Camera::paint_background() {
  const ViewParams& params = view_->params();
  const PinholeView& pinhole = view_->pinhole();
  background_tilt_rad_ = pinhole.tilt_rad;
  background_view_rad_ = pinhole.field_of_view_rad;
  background_.clear();
  const double horizon_px = pinhole.row_px(1.0, 0.0);
  for (int row = 0; row < params.height; ++row) {
    const double below_px = row + 0.5 - horizon_px;
    const Colour colour =
        below_px > 0.0 ? scaled(kFloor, brightness(pinhole.focal_px() * params.height_m / below_px,
                                                   params.range_max_m))
                       : kAir;
    for (int column = 0; column < params.width; ++column) {
      background_.insert(background_.end(), {colour.r, colour.g, colour.b});
    }
  }
}

void Camera::archive_reading(StateArchive& archive, CameraReading& reading) {
  SensorOf::archive_reading(archive, reading);
  const std::int64_t size = std::int64_t{3} * reading.width * reading.height;
  archive.expect(reading.pixels.empty() || static_cast<std::int64_t>(reading.pixels.size()) == size,
                 "three bytes for each pixel");
}

namespace {

std::optional<FieldError> check_pixels(const void* object) {
  const auto& reading = *static_cast<const CameraReading*>(object);
  const std::int64_t size = std::int64_t{3} * reading.width * reading.height;
  if (static_cast<std::int64_t>(reading.pixels.size()) == size) return std::nullopt;
  return FieldError{"", "three bytes for each pixel", "", "", "pixels"};
}

}  // namespace

constexpr Field kCameraSettings[] = {
    frequency_field<&CameraParams::frequency_hz>("pictures per simulated second"),
    include<CameraParams, ViewParams>(),
    latency_field<&CameraParams::latency_s>(),
};
SIM_FIELDS(CameraParams, kCameraSettings)

constexpr Field kCameraReading[] = {
    field<&CameraReading::width>("width", "pixels", "of the picture")
        .within(0, ViewParams::kMaxWidth),
    field<&CameraReading::height>("height", "pixels", "of the picture")
        .within(0, ViewParams::kMaxHeight),
    field<&CameraReading::pixels>("pixels", "",
                                  "red, green and blue of each pixel, row by row from the top"),
};
SIM_FIELDS(CameraReading, kCameraReading, check_pixels)

DeviceKind camera_kind() {
  return device_kind<Camera, CameraParams, CameraReading>("camera", {{"camera"}});
}

}  // namespace sim
