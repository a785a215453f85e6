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
/// Each column is a ray on the floor. What it meets is laid on from near to far, a face from the
/// floor up to its height, each thing lower than the lens with the lid on top of it; rows that
/// something nearer has taken are taken. That is exact for boxes on a plane, but for boxes that
/// overlap: there the lid of the lower one reaches no farther than the side of the higher one,
/// which is seen from its foot.
class ColumnView {
 public:
  /// Rows [top, bottom) of a column that show a thing.
  struct Run {
    int column;
    int top;
    int bottom;
    std::size_t face;  ///< of faces(): the one that is seen, or where a lid ends
    bool lid;          ///< seen from above
    double range_m;    ///< level distance of what is nearest of it in this column
  };

  explicit ColumnView(const ViewParams& params) : params_(params) {}

  /// Looks up the head that the settings name. @return as Device::connect().
  std::optional<std::string> connect(std::string_view robot, const DeviceDirectory& devices);
  /// Looks. Until the next call, runs() and faces() are what was seen.
  void look(const StepContext& context);

  /// By column, from left to right; in a column from bottom to top, none empty.
  [[nodiscard]] std::span<const Run> runs() const noexcept { return runs_; }
  [[nodiscard]] std::span<const PhysicsWorld::Face> faces() const noexcept { return faces_; }
  /// How it looked.
  [[nodiscard]] const PinholeView& pinhole() const noexcept { return pinhole_; }
  [[nodiscard]] const Pose& X_WS() const noexcept { return X_WS_; }
  [[nodiscard]] const ViewParams& params() const noexcept { return params_; }

 private:
  /// Where a column's ray meets a face.
  struct Hit {
    int column;
    double depth_m;
    bool back;  ///< it leaves the solid
    std::size_t face;
  };
  /// Where the ray of a column ends.
  struct End {
    double depth_m;
    std::size_t face;  ///< a wall of a map, which is as high as you like; none: kNothing
  };
  static constexpr std::size_t kNothing = static_cast<std::size_t>(-1);
  void meet(std::size_t face, double cos_yaw, double sin_yaw);
  void paint(int column, std::span<const Hit> hits);
  [[nodiscard]] bool before(const Hit& a, const Hit& b) const;

  ViewParams params_;
  const Ptz* head_ = nullptr;
  PinholeView pinhole_{};
  double focal_px_ = 0.0;    // of pinhole_
  double horizon_px_ = 0.0;  // row of what is as high as the lens
  Pose X_WS_;
  std::vector<PhysicsWorld::Face> faces_;
  std::vector<End> ends_;  // by column
  std::vector<Hit> hits_;  // in front of those
  std::vector<Run> runs_;
};

}  // namespace sim
