// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/stage/report.h"
#include "sim/world/description.h"

namespace sim::io::stage {

/// A prism of a model's body.
struct Block {
  Polygon points;        ///< in the model's frame, counter-clockwise [m]
  double z_min_m = 0.0;  ///< above the model's foot [m]
  double z_max_m = 0.0;  ///< [m]
};

/// The dark pixels of a bitmap, cut to the rectangle that contains them all. Row 0 is at the top.
struct DarkArea {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> solid;  ///< row-major; non-zero: dark
};

/// The body of a model, in its own frame: the middle of its size, without its origin.
struct Body {
  std::array<double, 3> size_m{};  ///< along x, y and z
  std::vector<Block> blocks;       ///< scaled to the size
  std::optional<DarkArea> bitmap;  ///< stretched over the size
  bool boundary = false;           ///< a thin wall along the sides of the size
  [[nodiscard]] bool empty() const { return blocks.empty() && !bitmap && !boundary; }
};

/// Thickness of the walls of a boundary [m], as in libstage/model.cc.
inline constexpr double kBoundaryThickness_m = 0.01;

/// Heights in a flat world (Units::flat) [m].
inline constexpr double kFlatTop_m = 0.3;
inline constexpr double kFlatTopWithoutLaser_m = 0.15;  ///< of what only sonars see
inline constexpr double kFlatSonar_m = 0.1;
inline constexpr double kFlatSensor_m = 0.2;  ///< of all other sensors

/// Whether lasers of Stage 2 and 3 see a model: `laser_return`.
[[nodiscard]] bool lasers_see(const Properties& model);

/// Reads the body of a model: `size`, `block` entities or the polygons of Stage 2, `bitmap`,
/// `boundary`, `noblocks`.
///
/// As in Stage (BlockGroup::CalcSize of libstage/blockgroup.cc), all blocks together are stretched
/// so that the box around them is the model's size, and so are the dark pixels of a bitmap. A pixel
/// is dark if its first sample is at most 127 (polys_from_image_file of libstage/stage.cc).
/// @param size_m     default of the size.
/// @param has_block  whether a model without blocks has one as large as its size.
[[nodiscard]] Body read_body(const Properties& model, const Units& units, Report& report,
                             const std::array<double, 3>& size_m, bool has_block);

/// Removes the corners of a convex outline whose removal changes its area least, until at most
/// `most` remain.
void reduce_corners(Polygon& outline, std::size_t most);

/// Corners of the dark area of a bitmap, in the model's frame [m]: enough for its convex outline.
[[nodiscard]] std::vector<Vec2> extreme_points(const DarkArea& area, const Vec2& size_m);

/// The outlines of a dark area as polygons in the model's frame, counter-clockwise [m],
/// straightened by at most 2 cm. nullopt if the area is no single object of a few parts without
/// holes, or large: then it is a floor plan.
[[nodiscard]] std::optional<std::vector<Polygon>> outlines_of(const DarkArea& area,
                                                              const Vec2& size_m);

/// A dark area for a map of that size: with coarser pixels if its own are less than 2 mm wide, or
/// if there are more than 8192 along a side. A coarse pixel is dark if one of those within is.
[[nodiscard]] DarkArea map_area(const DarkArea& area, const Vec2& size_m);

/// A dark area as a PNG, black on white.
[[nodiscard]] std::string png_of(const DarkArea& area);

}  // namespace sim::io::stage
