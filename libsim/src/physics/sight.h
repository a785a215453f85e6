// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/bodies.h"
#include "sim/scan/scan_kernel.h"

namespace sim::physics {

using Face = PhysicsWorld::Face;

/// What sensors see: edges and faces of solids, robots and what they carry. The functions are those
/// of PhysicsWorld.
class Sight {
 public:
  explicit Sight(Bodies& bodies) : bodies_(bodies) { solids_changed(); }

  /// Writes or reads the state but for what robots carry. When reading, that of the solids is there
  /// already.
  void archive(StateArchive& archive);
  /// Obstacles were changed, extended or retracted.
  void solids_changed();
  /// Robots have moved, or carry something else.
  void robots_changed() noexcept { outlines_fresh_ = false; }
  /// A robot was added, or put somewhere.
  void add_robot(int robot) { by_place_.push_back({0, robot, 0.0}); }
  void robot_was_placed();

  void set_load(Robot& r, const std::vector<PhysicsWorld::Load>& loads);
  void collect_edges(const Vec2& p_WL, double radius_m, double sensor_height_m, int own_robot,
                     bool test_inside, scan::EdgeBuffer& edges);
  void scan(const scan::ScanGeometry& geometry, const Pose& X_WL, double sensor_height_m,
            int own_robot, bool test_inside, std::span<double> ranges_m);
  void collect_faces(const Vec2& low, const Vec2& high, int own_robot, std::vector<Face>& faces);
  [[nodiscard]] bool is_inside_solid(const Vec2& p_W, double height_m, int own_robot);
  [[nodiscard]] bool is_line_free(const Vec2& p_WA, const Vec2& p_WC, double height_m,
                                  int own_robot, const Contact& target);
  [[nodiscard]] double ray_cast_m(const Vec2& p_WL, double angle_rad, double range_max_m,
                                  int own_robot);

 private:
  // A robot in the order of its place.
  struct Spot {
    std::uint32_t place;
    int robot;
    double until_m;  // good until the robot has gone so far
  };
  // Of a robot and what it carries, in W.
  struct Outline {
    Vec2 p_WB;
    double seen_radius_m;  // round it, of all
    std::array<Vec2, b2_maxPolygonVertices + 1>
        corners;        // of the robot, the first once more at last
    std::size_t count;  // of its edges
    double height_m;
    int robot;
    std::size_t first_load;  // the edges of what it carries, in load_edges_
    std::size_t end_load;

    [[nodiscard]] Edge edge(std::size_t i) const {
      return {corners[i].x(), corners[i].y(), corners[i + 1].x(), corners[i + 1].y()};
    }
  };

  void sort_by_place();
  void rebuild_outlines();
  static void append_robot(const Outline& outline, const Vec2& p_WL, scan::EdgeBuffer& out);
  template <typename Filter, typename Visitor>
  void cast_at_robots(const Vec2& p_WA, const Vec2& p_WC, Filter may, Visitor visit);
  [[nodiscard]] scan::ScanKernel& kernel_of(const scan::ScanGeometry& geometry);
  void collect_static_edges(const Vec2& p_WL, double radius_m, double sensor_height_m,
                            scan::EdgeBuffer& edges);

  Bodies& bodies_;
  EdgeList fixed_edges_;  // of what is there now and does not move, if the world is small
  bool sweep_ = true;     // it is
  EdgeList load_edges_;
  std::vector<Outline> outlines_;
  scan::DiscBuffer robot_discs_;           // round them
  std::vector<Spot> by_place_;             // the order of both
  std::vector<scan::ScanKernel> kernels_;  // of scan(), one a geometry
  scan::EdgeBuffer scan_edges_;            // scratch memory of scan()
  bool outlines_fresh_ = false;
};

}  // namespace sim::physics
