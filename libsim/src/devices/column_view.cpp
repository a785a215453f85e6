// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "devices/column_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "devices/device_kind.h"
#include "sim/core/math.h"
#include "sim/core/pose.h"
#include "sim/scan/circle.h"

namespace sim {
namespace {

// Surfaces nearer than this are not seen.
constexpr double kNear_m = 1e-3;

// The bounding box of everything that a view may see.
std::pair<Vec2, Vec2> box_round(const Pose& X_WS, double view_rad, double range_m) {
  Vec2 low = X_WS.position();
  Vec2 high = low;
  const auto take_in = [&](double yaw_rad) {
    const Vec2 p = X_WS.position() + range_m * unit_vector(yaw_rad);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  };
  take_in(X_WS.yaw_rad - 0.5 * view_rad);
  take_in(X_WS.yaw_rad + 0.5 * view_rad);
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double yaw_rad = 0.5 * std::numbers::pi * quarter;
    if (std::abs(normalize_angle(yaw_rad - X_WS.yaw_rad)) <= 0.5 * view_rad) take_in(yaw_rad);
  }
  return {low, high};
}

}  // namespace

double PinholeView::focal_px() const { return 0.5 * width / math::tan(0.5 * field_of_view_rad); }

double PinholeView::slope(int column) const { return (0.5 * width - (column + 0.5)) / focal_px(); }

double PinholeView::row_px(double depth_m, double rise_m) const {
  return 0.5 * height + focal_px() * (math::tan(tilt_rad) - rise_m / depth_m);
}

std::optional<std::string> ColumnView::connect(std::string_view robot,
                                               const DeviceDirectory& devices) {
  if (params_.ptz.empty()) return std::nullopt;
  head_ = dynamic_cast<const Ptz*>(devices.find(robot, params_.ptz));
  if (head_ != nullptr) return std::nullopt;
  return "a device of type \"ptz\" with the name \"" + params_.ptz + "\" on robot " +
         std::string(robot);
}

void ColumnView::look(const StepContext& context) {
  Pose X_BS = params_.X_BS;
  pinhole_ = {params_.width, params_.height, params_.field_of_view_rad, 0.0};
  if (head_ != nullptr) {
    X_BS.yaw_rad += head_->pan_rad();
    pinhole_.field_of_view_rad = head_->view_rad();
    // Pictures are those of at most 60 degrees: the shift of a lens grows without bounds.
    pinhole_.tilt_rad =
        std::clamp(head_->tilt_rad(), -std::numbers::pi / 3.0, std::numbers::pi / 3.0);
  }
  focal_px_ = pinhole_.focal_px();
  horizon_px_ = pinhole_.row_px(1.0, 0.0);
  X_WS_ = context.body.X_WB * X_BS;
  const auto [low, high] = box_round(X_WS_, pinhole_.field_of_view_rad, params_.range_max_m);
  context.physics.collect_faces(low, high, context.robot, faces_);
  hits_.clear();
  runs_.clear();
  ends_.assign(static_cast<std::size_t>(params_.width), {params_.range_max_m, kNothing});
  // Walls first, since they hide most other faces.
  const auto [sin_yaw, cos_yaw] = math::sin_cos(X_WS_.yaw_rad);
  for (const bool walls : {true, false}) {
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      if (std::isinf(faces_[i].height_m) == walls) intersect(i, cos_yaw, sin_yaw);
    }
  }
  std::sort(hits_.begin(), hits_.end(),
            [this](const Hit& a, const Hit& b) { return before(a, b); });
  std::size_t first = 0;
  for (int column = 0; column < params_.width; ++column) {
    std::size_t last = first;
    while (last < hits_.size() && hits_[last].column == column) ++last;
    paint(column, {hits_.data() + first, last - first});
    first = last;
  }
}

// A total order of hits that does not depend on the order in which faces were collected.
bool ColumnView::before(const Hit& a, const Hit& b) const {
  if (a.column != b.column) return a.column < b.column;
  if (a.depth_m != b.depth_m) return a.depth_m < b.depth_m;
  const auto key = [this](const Hit& hit) {
    const PhysicsWorld::Face& face = faces_[hit.face];
    return std::make_tuple(hit.back, -face.height_m, static_cast<int>(face.kind), face.index,
                           face.p_WA.x(), face.p_WA.y());
  };
  return key(a) < key(b);
}

// Intersects a face with the columns that it spans, in S. A ray of slope t meets the line through A
// and C at the depth x = (A x C) / (e_y - e_x t), with e = C - A.
void ColumnView::intersect(std::size_t index, double cos_yaw, double sin_yaw) {
  const PhysicsWorld::Face& face = faces_[index];
  if (face.radius_m > 0.0) {
    intersect_round(index, cos_yaw, sin_yaw);
    return;
  }
  const double ax = face.p_WA.x() - X_WS_.x_m;
  const double ay = face.p_WA.y() - X_WS_.y_m;
  const double bx = face.p_WC.x() - X_WS_.x_m;
  const double by = face.p_WC.y() - X_WS_.y_m;
  // A face has the solid on its left, so a face that is turned to the lens has the lens on its
  // right.
  const double cross = ax * by - ay * bx;
  const bool back = cross >= 0.0;
  if (back && (cross == 0.0 || face.height_m >= params_.height_m)) return;  // top not visible
  const Vec2 a(cos_yaw * ax + sin_yaw * ay, cos_yaw * ay - sin_yaw * ax);
  const Vec2 b(cos_yaw * bx + sin_yaw * by, cos_yaw * by - sin_yaw * bx);
  if (a.x() < kNear_m && b.x() < kNear_m) return;
  const Vec2 e = b - a;
  const auto slope_at = [&](const Vec2& end, const Vec2& other) {
    if (end.x() >= kNear_m) return end.y() / end.x();
    const Vec2 cut = end + (kNear_m - end.x()) / (other.x() - end.x()) * (other - end);
    return cut.y() / cut.x();
  };
  const double slope_a = slope_at(a, b);
  const double slope_b = slope_at(b, a);
  // The columns whose centres lie between the two slopes, including the left end: each column
  // belongs to only one of two faces that share a corner.
  const double middle = 0.5 * pinhole_.width - 0.5;
  const double left = std::ceil(middle - focal_px_ * std::max(slope_a, slope_b));
  const double right = std::ceil(middle - focal_px_ * std::min(slope_a, slope_b));
  const int first = static_cast<int>(std::clamp<double>(left, 0.0, pinhole_.width));
  const int end = static_cast<int>(std::clamp<double>(right, 0.0, pinhole_.width));
  const double nearest = std::max(kNear_m, std::min(a.x(), b.x()));
  const double farthest = std::max(a.x(), b.x());
  for (int column = first; column < end; ++column) {
    const double slope = (middle - column) / focal_px_;
    const double depth = std::clamp(cross / (e.y() - e.x() * slope), nearest, farthest);
    if (depth * std::sqrt(1.0 + slope * slope) > params_.range_max_m) continue;
    add_hit(column, depth, back, index);
  }
}

// Adds the intersection of a column's ray with a face, unless a wall of a map is nearer.
void ColumnView::add_hit(int column, double depth_m, bool back, std::size_t face) {
  End& end_of_ray = ends_[static_cast<std::size_t>(column)];
  if (depth_m >= end_of_ray.depth_m) return;
  if (std::isinf(faces_[face].height_m)) {
    end_of_ray = {depth_m, face};
  } else {
    hits_.push_back({column, depth_m, back, face});
  }
}

// Intersects a round face with the columns that it spans, in S.
void ColumnView::intersect_round(std::size_t index, double cos_yaw, double sin_yaw) {
  const PhysicsWorld::Face& face = faces_[index];
  const Vec2 off = face.p_WA - X_WS_.position();
  const scan::Circle circle{cos_yaw * off.x() + sin_yaw * off.y(),
                            cos_yaw * off.y() - sin_yaw * off.x(), face.radius_m};
  const bool top_visible = face.height_m < params_.height_m;
  const double distance_m = math::hypot(circle.x_m, circle.y_m);
  const double middle = 0.5 * pinhole_.width - 0.5;
  int first = 0;
  int end = pinhole_.width;
  if (distance_m > circle.radius_m) {
    // The columns between the two tangents, and one more on either side: the chord decides.
    const double bearing_rad = math::atan2(circle.y_m, circle.x_m);
    const double half_rad = math::asin(circle.radius_m / distance_m);
    const double view_rad = 0.5 * pinhole_.field_of_view_rad;
    if (bearing_rad - half_rad > view_rad || bearing_rad + half_rad < -view_rad) return;
    const auto column_at = [&](double angle_rad) {
      return middle - focal_px_ * math::tan(std::clamp(angle_rad, -view_rad, view_rad));
    };
    const auto last = static_cast<double>(pinhole_.width - 1);
    first = static_cast<int>(
        std::clamp(std::floor(column_at(bearing_rad + half_rad)) - 1.0, 0.0, last));
    end = static_cast<int>(
              std::clamp(std::ceil(column_at(bearing_rad - half_rad)) + 1.0, 0.0, last)) +
          1;
  }
  for (int column = first; column < end; ++column) {
    const double slope = (middle - column) / focal_px_;
    const double stretch = std::sqrt(1.0 + slope * slope);
    const auto chord = scan::chord_of(circle, 1.0 / stretch, slope / stretch);
    if (!chord) continue;
    const auto add = [&](double range_m, bool back) {
      if (range_m > params_.range_max_m || range_m < kNear_m * stretch) return;
      add_hit(column, range_m / stretch, back, index);
    };
    add(chord->enter_m, false);
    if (top_visible) add(chord->leave_m, true);
  }
}

// Paints one column from near to far, which is from the bottom up.
void ColumnView::paint(int column, std::span<const Hit> hits) {
  const double slope = (0.5 * pinhole_.width - 0.5 - column) / focal_px_;
  const double stretch = std::sqrt(1.0 + slope * slope);
  const auto row = [&](double depth_m, double rise_m) {
    const double edge = std::ceil(horizon_px_ - focal_px_ * rise_m / depth_m - 0.5);
    return static_cast<int>(std::clamp<double>(edge, 0.0, pinhole_.height));
  };
  const std::size_t before_it = runs_.size();
  int filled_from = pinhole_.height;  // rows from here down are filled
  for (const Hit& hit : hits) {
    const PhysicsWorld::Face& face = faces_[hit.face];
    const int top = row(hit.depth_m, face.height_m - params_.height_m);
    // The top of an object begins where its front ends, which was painted last. A front stands on
    // the floor.
    const int bottom =
        hit.back ? filled_from : std::min(filled_from, row(hit.depth_m, -params_.height_m));
    if (top >= bottom) continue;
    double range_m = hit.depth_m * stretch;
    if (hit.back && runs_.size() > before_it) {
      const PhysicsWorld::Face& front = faces_[runs_.back().face];
      if (front.kind == face.kind && front.index == face.index) range_m = runs_.back().range_m;
    }
    runs_.push_back({column, top, bottom, hit.face, hit.back, range_m});
    filled_from = top;
    if (filled_from == 0) return;
  }
  const End& end = ends_[static_cast<std::size_t>(column)];
  if (end.face == kNothing) return;
  const int foot = std::min(filled_from, row(end.depth_m, -params_.height_m));
  if (foot > 0) runs_.push_back({column, 0, foot, end.face, false, end.depth_m * stretch});
}

namespace {

void read_image(io::Reader& settings, const Field& field, void* object) {
  auto& p = *static_cast<ViewParams*>(object);
  const auto [width, height] =
      settings.integer_pair(field.name, {p.width, p.height}, 1, ViewParams::kMaxWidth);
  p.width = static_cast<int>(width);
  p.height = static_cast<int>(height);
  if (p.height > ViewParams::kMaxHeight) {
    settings.issue("device/image-height",
                   "a picture of at most " + std::to_string(ViewParams::kMaxHeight) + " rows",
                   std::to_string(p.height), "[columns, rows]", field.name);
  }
}

std::string image_text(const void* object) {
  const auto& p = *static_cast<const ViewParams*>(object);
  return "[" + std::to_string(p.width) + ", " + std::to_string(p.height) + "]";
}

void add_image_properties(const void* object, std::map<std::string, double>& properties) {
  const auto& p = *static_cast<const ViewParams*>(object);
  properties["image_width"] = p.width;
  properties["image_height"] = p.height;
}

}  // namespace

constexpr CustomField kImage{
    read_image, image_text,
    R"("type": "array", "prefixItems": [{"type": "integer", "minimum": 1, "maximum": 640}, )"
    R"({"type": "integer", "minimum": 1, "maximum": 480}], "minItems": 2, "maxItems": 2)"};

constexpr Field kViewSettings[] = {
    custom("image", kImage, add_image_properties, "pixels",
           "`[columns, rows]` of the picture, at most 640 x 480"),
    field<&ViewParams::field_of_view_rad>(
        "field_of_view_deg", "degrees",
        "horizontal angle of view; on a head, the head's value is used")
        .within(0.01, 170.0),
    range_max_field<&ViewParams::range_max_m>(),
    mount_field<&ViewParams::X_BS>("pose of the lens on the body, X_BS"),
    height_field<&ViewParams::height_m>("of the lens above the floor"),
    field<&ViewParams::ptz>("ptz", "", "name of the robot's ptz device that turns and zooms it"),
};
SIM_FIELDS(ViewParams, kViewSettings)

}  // namespace sim
