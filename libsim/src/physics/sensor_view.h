// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "physics/bodies.h"
#include "sim/scan/scan_kernel.h"

namespace sim::physics {

using Face = PhysicsWorld::Face;

/// What sensors see: edges and faces of solids, of robots with their superstructures, and of
/// carried objects. The functions have the same meaning as in PhysicsWorld.
class SensorView {
 public:
  explicit SensorView(Bodies& bodies) : bodies_(bodies) { solids_changed(); }

  /// Writes or reads the state, except what robots carry. When reading, the state of the solids
  /// must have been read before.
  void archive(StateArchive& archive);
  /// Must be called after obstacles were changed, extended or retracted.
  void solids_changed();
  /// Must be called after robots have moved or their loads have changed.
  void robots_changed() noexcept { outlines_fresh_ = false; }
  /// Must be called after a robot was added or placed.
  void add_robot(int robot) { by_hilbert_index_.push_back({0, robot, 0.0}); }
  void robot_was_placed();

  /// Uses the memory of another world's view for what is equal in both and does not change.
  void share_memory_with(const SensorView& other);

  void set_load(Body& r, const std::vector<PhysicsWorld::Load>& loads);
  void collect_edges(const Vec2& p_WL, double radius_m, double sensor_height_m, int own_robot,
                     bool test_inside, scan::EdgeBuffer& edges);
  void scan(const scan::ScanGeometry& geometry, const Pose& X_WL, double sensor_height_m,
            int own_robot, bool test_inside, std::span<double> ranges_m);
  void scan(scan::ScanWorkspace& workspace, const scan::ScanGeometry& geometry, const Pose& X_WL,
            double sensor_height_m, int own_robot, bool test_inside, std::span<float> ranges_m);
  void collect_faces(const Vec2& low, const Vec2& high, int own_robot, std::vector<Face>& faces);
  [[nodiscard]] bool is_inside_solid(const Vec2& p_W, double height_m, int own_robot);
  [[nodiscard]] bool is_line_free(const Vec2& p_WA, const Vec2& p_WC, double height_m,
                                  int own_robot, const Contact& target, bool solid_only);
  [[nodiscard]] double ray_cast_m(const Vec2& p_WL, double angle_rad, double range_max_m,
                                  int own_robot);

 private:
  // A robot with its index along the Hilbert curve.
  struct HilbertEntry {
    std::uint32_t hilbert_index;
    int robot;
    double until_m;  // valid until the robot's cumulative travel has this value
  };
  // The outlines of a robot, its superstructures and its load, or of a moving obstacle, in W. The
  // outline of a round one is a cylinder.
  struct Outline {
    Vec2 p_WB;
    double seen_radius_m;  // bounding radius of all of them
    std::array<Vec2, b2_maxPolygonVertices + 1>
        corners;        // of the robot; the first corner is repeated at the end
    std::size_t count;  // number of the robot's edges here: 0 if its body has several parts
    double height_m;
    int robot;
    Contact::Kind kind;
    int index;                // of the robot or obstacle
    std::size_t first_upper;  // range of the parts' and superstructures' edges in further_edges_
    std::size_t first_load;   // range of the load's edges in further_edges_, which follow
    std::size_t end_load;
    std::size_t first_cylinder;  // range of the load's cylinders in load_cylinders_
    std::size_t end_cylinder;

    [[nodiscard]] Edge edge(std::size_t i) const {
      return {corners[i].x(), corners[i].y(), corners[i + 1].x(), corners[i + 1].y()};
    }
  };

  // Whether a robot is the only body that moves, so that it sees nothing but static solids.
  [[nodiscard]] bool is_alone(int robot) const {
    return by_hilbert_index_.size() == 1 && by_hilbert_index_.front().robot == robot;
  }
  void sort_by_hilbert_index();
  void rebuild_outlines();
  template <typename Visitor>
  void visit_cylinders(const Vec2& low, const Vec2& high, Visitor visit);
  [[nodiscard]] double cast_at_cylinders(const Vec2& p_WA, const Vec2& p_WC,
                                         std::optional<double> height_m, const Contact* ignored,
                                         bool solid_only);
  static void append_robot(const Outline& outline, const Vec2& p_WL, scan::EdgeBuffer& out);
  [[nodiscard]] static double entry_of_superstructures(const Body& r, const Vec2& p_WA,
                                                       const Vec2& p_WC,
                                                       std::optional<double> height_m);
  template <typename Filter, typename Visitor>
  void cast_at_robots(const Vec2& p_WA, const Vec2& p_WC, Filter may, Visitor visit);
  template <typename Range>
  void scan_with(scan::ScanWorkspace& workspace, const scan::ScanGeometry& geometry,
                 const Pose& X_WL, double sensor_height_m, int own_robot, bool test_inside,
                 std::span<Range> ranges_m);
  void collect_static_edges(const Vec2& p_WL, double radius_m, double sensor_height_m,
                            scan::EdgeBuffer& edges);

  Bodies& bodies_;
  // Static solids that exist now, if the world is small. The views of other worlds may have the
  // same list.
  std::shared_ptr<const EdgeList> fixed_edges_ = std::make_shared<EdgeList>();
  std::vector<Cylinder> fixed_cylinders_;  // round obstacles that exist now, if the world is small
  bool sweep_ = true;                      // the world is small
  EdgeList further_edges_;                 // of several parts, superstructures and loads
  std::vector<Cylinder> load_cylinders_;   // in W
  std::vector<Outline> outlines_;
  scan::DiscBuffer robot_discs_;                // bounding discs of `outlines_`
  std::vector<HilbertEntry> by_hilbert_index_;  // order of `outlines_` and `robot_discs_`
  scan::ScanWorkspace workspace_;               // for scan()
  bool outlines_fresh_ = false;
};

}  // namespace sim::physics
