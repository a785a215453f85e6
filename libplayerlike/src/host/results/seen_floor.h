// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/core/pose.h"
#include "sim/devices/laser.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

/// Records which cells of the floor a robot's own range sensors have seen to be free, or the robot
/// itself has covered.
///
/// A cell is seen if its centre lies in the sector between two neighbouring beams of a scan, or in
/// the cone of a sonar or infrared ranger, nearer than the range there. For lasers this is the scan
/// without noise. So a program gets no credit for floor that it only knows of.
class SeenFloor {
 public:
  /// Side of a cell [m]; doubled until a large floor has at most kMostCells cells.
  static constexpr double kCell_m = 0.02;
  static constexpr std::size_t kMostCells = 4'000'000;

  SeenFloor(const sim::Simulation& simulation, int robot);

  /// Notes what the sensors that have measured in this step see.
  void observe(const sim::Simulation& simulation);

  [[nodiscard]] int robot() const noexcept { return robot_; }
  [[nodiscard]] double cell_size_m() const noexcept { return cell_m_; }
  /// Bottom left corner of the grid.
  [[nodiscard]] const sim::Vec2& origin() const noexcept { return origin_; }
  [[nodiscard]] int width() const noexcept { return width_; }    ///< columns
  [[nodiscard]] int height() const noexcept { return height_; }  ///< rows
  [[nodiscard]] double area_m2() const noexcept {
    return static_cast<double>(count_) * cell_m_ * cell_m_;
  }
  /// A bit for each cell, from the bottom left one along x, then y; bit 7 of a byte comes first.
  /// 1: seen.
  [[nodiscard]] std::vector<std::uint8_t> bits() const;

 private:
  void see_scan(const sim::Pose& X_WL, const sim::LaserReading& scan);
  void see_cone(const sim::Pose& X_WS, double field_of_view_rad, double range_m);
  /// Marks the cells whose centres lie in the polygon `corners_` (even-odd rule).
  void see_area();
  void cover(const sim::Simulation& simulation);
  /// Marks the unseen cells within a distance for whose centre sees(centre) is true.
  template <typename Sees>
  void mark_within(const sim::Vec2& middle, double radius_m, Sees sees);

  enum Cell : std::uint8_t {
    kUnseen,
    kSeen,
    kSolid,  ///< a solid that always stands there
  };

  int robot_;
  double cell_m_ = kCell_m;
  sim::Vec2 origin_;
  int width_ = 0;
  int height_ = 0;
  std::size_t count_ = 0;            ///< seen cells
  std::vector<std::uint8_t> cells_;  ///< Cell, in the order of bits()
  // Kept to avoid allocations and repeated sines.
  std::vector<sim::Vec2> corners_;
  std::vector<std::vector<double>> crossings_;  ///< by row: where its centre line crosses the area
  std::vector<sim::Vec2> directions_;           ///< of the beams of the newest scan, in L
  double first_angle_rad_ = 0.0;
  double resolution_rad_ = 0.0;
  sim::Pose covered_from_;  ///< where the robot was when cover() was last called
};

}  // namespace playerlike
