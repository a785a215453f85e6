// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/stage/shapes.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <utility>

#include "canvas/image_file.h"
#include "canvas/png_codec.h"
#include "io/document.h"
#include "io/map_io.h"
#include "io/stage/file_search.h"
#include "sim/world/outline.h"

namespace sim::io::stage {
namespace {

constexpr int kMostPoints = 1000;  ///< of a block
constexpr std::uint8_t kDarkest = 127;

/// Reads the corners [0] to [points - 1] of a block.
/// @param prefix  of the names of its properties.
Block read_corners(const Properties& block, const std::string& prefix, Report& report) {
  Block made;
  const int count = block.integer(prefix + "points", 0);
  if (count < 3 || count > kMostPoints) {
    report.error(block.place_of(prefix + "points"), "stage/bad-block",
                 "3 to " + std::to_string(kMostPoints) + " points of a block",
                 block.has(prefix + "points") ? std::to_string(count) : "no \"points\"");
    return made;
  }
  for (int i = 0; i < count; ++i) {
    const std::string name = prefix + "point[" + std::to_string(i) + "]";
    if (!block.has(name)) {  // as Block::Load() of libstage/block.cc
      report.note("missing point", block.entity().place,
                  "a block without " + name + " of its " + std::to_string(count) +
                      " points has it at [0 0], as in Stage");
    }
    const auto xy = block.tuple<2>(name, "ll", {0.0, 0.0});
    made.points.emplace_back(xy[0], xy[1]);
  }
  return made;
}

Block read_block(const Properties& block, Report& report) {
  Block made = read_corners(block, "", report);
  const auto z = block.tuple<2>("z", "ll", {0.0, 0.0});
  made.z_min_m = z[0];
  made.z_max_m = z[1];
  return made;
}

/// Reads the polygons of Stage 2: `polygons 1`, `polygon[0].points 3`, `polygon[0].point[0] [x y]`.
std::vector<Block> read_polygons(const Properties& model, Report& report) {
  constexpr int kMostPolygons = 1000;
  std::vector<Block> all;
  const int count = std::min(model.integer("polygons", 0), kMostPolygons);
  for (int i = 0; i < count; ++i) {
    const std::string prefix = "polygon[" + std::to_string(i) + "].";
    Block made = read_corners(model, prefix, report);
    made.z_max_m = 1.0;  // stretched to the size
    static_cast<void>(model.has(prefix + "filled"));
    if (!made.points.empty()) all.push_back(std::move(made));
  }
  return all;
}

/// The dark pixels of a picture.
DarkArea dark_area_of(const GreyImage& image) {
  int left = image.width;
  int right = -1;
  int top = image.height;
  int bottom = -1;
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
           static_cast<std::size_t>(x);
  };
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.pixels[at(x, y)] > kDarkest) continue;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
  }
  DarkArea area;
  if (right < 0) return area;
  area.width = right - left + 1;
  area.height = bottom - top + 1;
  area.solid.reserve(static_cast<std::size_t>(area.width) * static_cast<std::size_t>(area.height));
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      area.solid.push_back(image.pixels[at(x, y)] > kDarkest ? 0 : 1);
    }
  }
  return area;
}

/// Path of a bitmap. Stage looks in the folder of the world file even if an included file names it;
/// then follow that file's folder, the folders of Stage, and the folder above the world's.
std::string bitmap_file(const std::string& name, const Place& place, Report& report) {
  const std::filesystem::path folder = folder_of(report.world_file());
  std::vector<std::filesystem::path> folders{folder, folder_of(*place.file)};
  for (std::filesystem::path& further : stage_folders()) folders.push_back(std::move(further));
  folders.push_back(folder / "..");
  const auto found = find_file(name, folders);
  if (!found) return (folder / name).string();
  if (found->by_base_name) note_other_path(name, found->path, place, report);
  return found->path;
}

std::optional<DarkArea> read_bitmap(const Properties& model, Report& report) {
  const std::string name = model.text("bitmap", "");
  const Place& place = model.place_of("bitmap");
  if (name.empty()) {
    report.note("bitmap \"\"", place, "a bitmap without a name is left out");
    return std::nullopt;
  }
  const std::string file = bitmap_file(name, place, report);
  GreyImage image;
  try {
    image = load_first_samples(file);
  } catch (const std::runtime_error& error) {
    report.error(place, "stage/bitmap",
                 "a picture (PNG, JPEG, BMP, PBM, PGM, PPM) beside the world file", error.what(),
                 "other formats: convert NAME NAME.png");
    return std::nullopt;
  }
  DarkArea area = dark_area_of(image);
  if (area.width == 0) {
    report.note("bitmap " + name, place,
                "bitmap " + in_quotes(name) + " has no dark pixel (127 or less), so it is empty");
    return std::nullopt;
  }
  return area;
}

/// An area with pixels that are several times as large along x and y: dark if one of theirs is.
DarkArea coarser(const DarkArea& area, int times_x, int times_y) {
  DarkArea coarse;
  coarse.width = (area.width + times_x - 1) / times_x;
  coarse.height = (area.height + times_y - 1) / times_y;
  const auto width = static_cast<std::size_t>(coarse.width);
  coarse.solid.assign(width * static_cast<std::size_t>(coarse.height), 0);
  auto solid = area.solid.begin();
  for (int y = 0; y < area.height; ++y) {
    std::uint8_t* const row = coarse.solid.data() + static_cast<std::size_t>(y / times_y) * width;
    for (int x = 0; x < area.width; ++x) row[x / times_x] |= *solid++;
  }
  return coarse;
}

/// Stretches blocks to a size.
void stretch(std::vector<Block>& blocks, const std::array<double, 3>& size_m) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec2 least = Vec2::Constant(kInfinity);
  Vec2 most = Vec2::Constant(-kInfinity);
  double z_min_m = kInfinity;
  double z_max_m = -kInfinity;
  for (const Block& block : blocks) {
    for (const Vec2& point : block.points) {
      least = least.cwiseMin(point);
      most = most.cwiseMax(point);
    }
    z_min_m = std::min(z_min_m, block.z_min_m);
    z_max_m = std::max(z_max_m, block.z_max_m);
  }
  constexpr double kLeast = std::numeric_limits<double>::epsilon();
  const Vec2 extent = (most - least).cwiseMax(kLeast);
  const Vec2 middle = 0.5 * (least + most);
  const Vec2 scale = Vec2(size_m[0], size_m[1]).cwiseQuotient(extent);
  // Stage stretches heights about 0, not about the lowest one.
  const double z_scale = size_m[2] / std::max(z_max_m - z_min_m, kLeast);
  for (Block& block : blocks) {
    for (Vec2& point : block.points) point = (point - middle).cwiseProduct(scale);
    if (area_m2(block.points) < 0.0) std::reverse(block.points.begin(), block.points.end());
    block.z_min_m *= z_scale;
    block.z_max_m *= z_scale;
  }
}

}  // namespace

bool lasers_see(const Properties& model) { return model.flag("laser_return", true); }

Body read_body(const Properties& model, const Units& units, Report& report,
               const std::array<double, 3>& size_m, bool has_block) {
  Body body;
  body.size_m = model.tuple<3>("size", "lll", size_m);
  if (!model.has("size")) body.size_m = model.tuple<3>("size3", "lll", size_m);
  for (double& side_m : body.size_m) side_m = std::abs(side_m);
  for (const Entity& child : model.entity().children) {
    if (child.type != "block") continue;
    Block block = read_block(Properties(child, units, report), report);
    if (!block.points.empty()) body.blocks.push_back(std::move(block));
  }
  if (body.blocks.empty()) body.blocks = read_polygons(model, report);
  if (model.has("bitmap")) body.bitmap = read_bitmap(model, report);
  const bool own = has_block && !model.flag("noblocks", false);
  if (body.blocks.empty() && !model.has("bitmap") && own) {
    Block whole;
    whole.points = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
    whole.z_max_m = 1.0;
    body.blocks.push_back(std::move(whole));
  }
  body.boundary = model.flag("boundary", false);
  if (units.flat) {
    body.size_m[2] = lasers_see(model) ? kFlatTop_m : kFlatTopWithoutLaser_m;
    for (Block& block : body.blocks) block.z_min_m = 0.0;
    for (Block& block : body.blocks) block.z_max_m = 1.0;  // stretched to the size
  }
  if (!body.blocks.empty()) stretch(body.blocks, body.size_m);
  return body;
}

void reduce_corners(Polygon& outline, std::size_t most) {
  while (outline.size() > most) {
    std::size_t best = 0;
    double least_m2 = std::numeric_limits<double>::infinity();
    const std::size_t n = outline.size();
    for (std::size_t i = 0; i < n; ++i) {
      const double lost_m2 = area_m2({outline[(i + n - 1) % n], outline[i], outline[(i + 1) % n]});
      // Nearly equal losses: the first one, so that regular outlines lose every other corner.
      if (lost_m2 < least_m2 - 1e-9) {
        least_m2 = lost_m2;
        best = i;
      }
    }
    outline.erase(outline.begin() + static_cast<std::ptrdiff_t>(best));
  }
}

std::vector<Vec2> extreme_points(const DarkArea& area, const Vec2& size_m) {
  std::vector<Vec2> points;
  const Vec2 pixel(size_m.x() / area.width, size_m.y() / area.height);
  for (int y = 0; y < area.height; ++y) {
    const auto begin = area.solid.begin() + static_cast<std::ptrdiff_t>(y) * area.width;
    const auto end = begin + area.width;
    const auto first = std::find_if(begin, end, [](std::uint8_t solid) { return solid != 0; });
    if (first == end) continue;
    const auto last =
        std::find_if(std::make_reverse_iterator(end), std::make_reverse_iterator(begin),
                     [](std::uint8_t solid) { return solid != 0; });
    const double left_m = static_cast<double>(first - begin) * pixel.x() - 0.5 * size_m.x();
    const double right_m = static_cast<double>(last.base() - begin) * pixel.x() - 0.5 * size_m.x();
    for (const int row : {y, y + 1}) {
      const double y_m = 0.5 * size_m.y() - row * pixel.y();
      points.emplace_back(left_m, y_m);
      points.emplace_back(right_m, y_m);
    }
  }
  return points;
}

DarkArea map_area(const DarkArea& area, const Vec2& size_m) {
  const auto times = [](int pixels, double side_m) {
    constexpr double kLeastPixel_m = 0.002;  // the physics cannot build anything much thinner
    const double most = std::clamp(side_m / kLeastPixel_m, 1.0, double{kMaxMapSide});
    return static_cast<int>(std::ceil(pixels / most));
  };
  const int times_x = times(area.width, size_m.x());
  const int times_y = times(area.height, size_m.y());
  return times_x == 1 && times_y == 1 ? area : coarser(area, times_x, times_y);
}

std::optional<std::vector<Polygon>> outlines_of(const DarkArea& area, const Vec2& size_m) {
  constexpr double kLargest_m = 3.0;
  constexpr std::size_t kMostParts = 4;
  constexpr double kMostStraightened_m = 0.02;
  if (size_m.maxCoeff() > kLargest_m) return std::nullopt;
  std::optional<std::vector<WallLoop>> loops =
      trace_walls({area.width, area.height, area.solid}, Vec2::Zero(), 1.0);
  if (!loops || loops->size() > kMostParts) return std::nullopt;
  const Vec2 pixel(size_m.x() / area.width, size_m.y() / area.height);
  for (WallLoop& loop : *loops) {
    for (Vec2& vertex : loop.vertices) vertex = vertex.cwiseProduct(pixel) - 0.5 * size_m;
    if (area_m2(loop.vertices) < 0.0) return std::nullopt;  // a hole
  }
  std::vector<Polygon> outlines;
  for (const WallLoop& loop : *loops) {
    std::vector<WallLoop> straight{loop};
    for (double tolerance_m = 0.75 * pixel.maxCoeff();
         straight.front().vertices.size() > kMostOutlineVertices; tolerance_m *= 1.5) {
      if (tolerance_m > kMostStraightened_m) return std::nullopt;
      straight = {loop};
      simplify_walls(straight, tolerance_m);
    }
    if (crossing_sides(straight.front().vertices)) return std::nullopt;
    outlines.push_back(std::move(straight.front().vertices));
  }
  return outlines;
}

std::string png_of(const DarkArea& area) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(3 * area.solid.size());
  for (const std::uint8_t solid : area.solid) {
    rgb.insert(rgb.end(), 3, solid != 0 ? std::uint8_t{0} : std::uint8_t{255});
  }
  const std::vector<std::uint8_t> bytes = encode_png(area.width, area.height, rgb.data());
  return {bytes.begin(), bytes.end()};
}

}  // namespace sim::io::stage
