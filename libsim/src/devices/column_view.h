// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "physics/physics_world.h"
#include "sim/devices/device.h"
#include "sim/devices/ptz.h"
#include "sim/devices/view.h"

namespace sim {

/// The picture of a pinhole camera, column by column: which rows show which face.
///
/// Each column is a ray on the floor. The faces that it meets are painted from near to far. A face
/// extends from the floor to its height; an object lower than the lens also shows its top. Rows
/// that a nearer face has filled stay unchanged. This is exact for upright solids on a plane,
/// unless they overlap: there the top of the lower one ends at the side of the higher one, which is
/// seen from its foot.
class ColumnView {
 public:
  /// Rows [top, bottom) of a column that show one object.
  struct Run {
    int column;
    int top;
    int bottom;
    std::size_t face;  ///< index in faces() of the visible face, or of the one where the visible
                       ///< top ends
    bool top_face;     ///< the top of the object is seen
    double range_m;    ///< horizontal distance of its nearest point in this column
  };

  explicit ColumnView(const ViewParams& params) : params_(params) {}

  /// Looks up the head that the settings name.
  /// @return as for Device::connect().
  std::optional<std::string> connect(std::string_view robot, const DeviceDirectory& devices);
  /// Computes the view. runs() and faces() describe it until the next call.
  void look(const StepContext& context);

  /// Sorted by column, from left to right; within a column from bottom to top. None is empty.
  [[nodiscard]] std::span<const Run> runs() const noexcept { return runs_; }
  [[nodiscard]] std::span<const PhysicsWorld::Face> faces() const noexcept { return faces_; }
  /// The projection of the current view.
  [[nodiscard]] const PinholeView& pinhole() const noexcept { return pinhole_; }
  [[nodiscard]] const Pose& X_WS() const noexcept { return X_WS_; }
  [[nodiscard]] const ViewParams& params() const noexcept { return params_; }

 private:
  /// Intersection of a column's ray with a face.
  struct Hit {
    int column;
    double depth_m;
    bool back;  ///< the ray leaves the solid here
    std::size_t face;
  };
  /// The end of a column's ray.
  struct End {
    double depth_m;
    std::size_t face;  ///< a wall of a map, which has unlimited height, or kNothing
  };
  static constexpr std::size_t kNothing = static_cast<std::size_t>(-1);
  void intersect(std::size_t face, double cos_yaw, double sin_yaw);
  void intersect_round(std::size_t face, double cos_yaw, double sin_yaw);
  void add_hit(int column, double depth_m, bool back, std::size_t face);
  void paint(int column, std::span<const Hit> hits);
  [[nodiscard]] bool before(const Hit& a, const Hit& b) const;

  ViewParams params_;
  const Ptz* head_ = nullptr;
  PinholeView pinhole_{};
  double focal_px_ = 0.0;    // of pinhole_
  double horizon_px_ = 0.0;  // row of points at the height of the lens
  Pose X_WS_;
  std::vector<PhysicsWorld::Face> faces_;
  std::vector<End> ends_;  // by column
  std::vector<Hit> hits_;  // in front of `ends_`
  std::vector<Run> runs_;
};

}  // namespace sim
