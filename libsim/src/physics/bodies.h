// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <box2d/box2d.h>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <limits>
#include <memory>
#include <vector>

#include "physics/body.h"
#include "physics/fixtures.h"
#include "sim/core/state_archive.h"
#include "sim/world/description.h"

namespace sim::physics {

/// Box2D's world: the solids of the arena, and a body for each hindered robot or moving obstacle.
class Bodies {
 public:
  /// The bounding circle of a robot or a moving obstacle.
  struct Circle {
    double x, y, radius;
    int robot;
  };

  explicit Bodies(const ArenaDescription& arena);

  [[nodiscard]] b2World& world() noexcept { return world_; }
  [[nodiscard]] const b2World& world() const noexcept { return world_; }

  // --- Robots
  /// Adds a robot at rest, with a Box2D body.
  int add_robot(const RobotModel& model, const Pose& X_WB);
  /// Adds an obstacle that moves, after all robots. @return its index in all().
  int add_moving_obstacle(int index, const ObstacleDescription& o);
  /// The number of robots; the moving obstacles follow them in all().
  [[nodiscard]] std::size_t robot_count() const noexcept { return robot_count_; }
  /// The index in all() of an obstacle that moves; -1: it is static.
  [[nodiscard]] int body_of(int obstacle) const {
    return body_of_[static_cast<std::size_t>(obstacle)];
  }
  /// The index in all() of a robot or an obstacle that moves; -1: it is static, or there is
  /// none.
  [[nodiscard]] int body_of(const Contact& target) const;
  /// Whether robots can push any obstacle.
  [[nodiscard]] bool has_pushable() const noexcept { return has_pushable_; }
  /// Whether any robot has a body of several parts.
  [[nodiscard]] bool has_parts() const noexcept { return has_parts_; }
  /// Pose X_WO of an obstacle that moves.
  [[nodiscard]] static Pose obstacle_pose(const Body& r);
  [[nodiscard]] std::vector<Body>& all() noexcept { return all_; }
  [[nodiscard]] const std::vector<Body>& all() const noexcept { return all_; }
  [[nodiscard]] Body& at(int index) { return all_[static_cast<std::size_t>(index)]; }
  [[nodiscard]] const Body& at(int index) const { return all_[static_cast<std::size_t>(index)]; }
  /// Places a robot at a pose, at rest.
  void set_pose(Body& r, const Pose& X_WB);
  void set_suspended(Body& r, bool suspended);
  /// The indices in all() of those that have superstructures.
  [[nodiscard]] const std::vector<int>& with_superstructures() const noexcept {
    return with_superstructures_;
  }
  [[nodiscard]] double largest_radius_m() const noexcept { return largest_radius_m_; }
  /// The first of all() that overlaps a solid; -1 if there is none.
  /// @param ignored  index in all() that does not count, or -1.
  [[nodiscard]] int robot_within(const ObstacleDescription& solid, int ignored) const;

  /// Gives a robot a Box2D body for the next substeps.
  void ensure_box2d_body(Body& r);
  void destroy_box2d_body(Body& r);
  /// Whether any robot has a Box2D body.
  [[nodiscard]] bool has_robots_in_box2d() const noexcept { return in_box2d_ > 0; }

  /// Must be called after robots have moved.
  void note_moved() noexcept { order_fresh_ = false; }
  /// The bounding circles of all robots, sorted by x.
  [[nodiscard]] const std::vector<Circle>& by_x();
  /// Calls visit(circle) for the bounding circle of every robot that may reach into a box, in order
  /// of x.
  template <typename Visitor>
  void for_robots_in(const Vec2& low, const Vec2& high, Visitor visit) {
    const std::vector<Circle>& order = by_x();
    auto it = std::partition_point(order.begin(), order.end(), [&](const Circle& c) {
      return c.x < low.x() - largest_radius_m_;
    });
    for (; it != order.end() && it->x <= high.x() + largest_radius_m_; ++it) {
      if (it->y + it->radius >= low.y() && it->y - it->radius <= high.y()) visit(*it);
    }
  }

  // --- Static solids
  [[nodiscard]] const std::vector<std::unique_ptr<FixtureInfo>>& infos() const noexcept {
    return infos_;
  }
  /// Edges of all static solids, extended or not.
  [[nodiscard]] const EdgeList& edges() const noexcept { return edges_; }
  [[nodiscard]] const std::vector<b2Body*>& obstacles() const noexcept { return obstacles_; }
  [[nodiscard]] b2Body& obstacle(int index) const {
    return *obstacles_[static_cast<std::size_t>(index)];
  }
  /// The circles of all round obstacles, extended or not.
  [[nodiscard]] const std::vector<Cylinder>& cylinders() const noexcept { return cylinders_; }
  /// Whether a point is inside an extended obstacle that is higher than `height_m` and consists of
  /// edges for Box2D.
  [[nodiscard]] bool is_inside_edged(const Vec2& p_W, double height_m) const;
  /// The first of all() that overlaps a static obstacle, extended or not; -1 if there is none.
  [[nodiscard]] int robot_on(int index) const;
  [[nodiscard]] std::size_t separator_count() const noexcept { return separator_count_; }
  void change_obstacle(int index, const ObstacleDescription& now);
  /// Sets the height up to which an obstacle stands now, >= 0 [m].
  void set_height(int index, double height_m);
  /// Writes or reads the state, including the shapes of obstacles.
  void archive(StateArchive& archive);
  /// The friction joints of pushed obstacles, in the order of all().
  [[nodiscard]] std::vector<b2FrictionJoint*> joints() const;
  /// All existing fixtures, by FixtureInfo::id; nullptr if Box2D has none of that id.
  [[nodiscard]] std::vector<b2Fixture*> fixtures();
  /// Whether the world has walls of a map, and their largest x coordinate.
  [[nodiscard]] bool has_walls() const noexcept { return has_walls_; }
  [[nodiscard]] double wall_right_m() const noexcept { return wall_right_m_; }

 private:
  // The fixtures of an obstacle: a polygon, a circle, or one edge for each side of the outline.
  // None if it moves.
  struct Parts {
    std::size_t first_info;
    std::size_t count;
    ObstacleShape shape;
  };
  FixtureInfo* new_info(Contact::Kind kind, int index, double height_m);
  static void attach(b2Body* body, const b2Shape& shape, FixtureInfo* info, float density);
  void append_outline(FixtureInfo& info, const std::vector<Vec2>& vertices);
  [[nodiscard]] std::vector<Vec2> corners_of_parts(const Parts& parts) const;
  void set_corners(const Parts& parts, const std::vector<Vec2>& corners, double height_m);
  [[nodiscard]] int robot_within(const b2Shape& shape, const b2Transform& xf, int ignored) const;
  [[nodiscard]] int robot_within(const std::vector<Vec2>& outline, int ignored) const;
  int add_body(Body&& r);
  void add_obstacle(const ObstacleDescription& o, Contact::Kind kind, int index);
  void add_obstacles(const ArenaDescription& arena);
  void add_border(const ArenaDescription& arena);
  void add_wall(const WallLoop& loop);
  void create_box2d_body(Body& r);
  void add_joint(Body& r);
  void archive_obstacle(StateArchive& archive, int index);
  void archive_cylinder(StateArchive& archive, b2Body& body, bool enabled, const FixtureInfo& info);

  b2World world_;
  b2Body* static_body_ = nullptr;
  std::vector<std::unique_ptr<FixtureInfo>> infos_;
  std::vector<b2Body*> obstacles_;
  std::vector<Parts> parts_;        // of `obstacles_`
  std::vector<int> body_of_;        // of `obstacles_`
  std::vector<std::size_t> edged_;  // those of more than one part
  std::vector<Cylinder> cylinders_;
  std::size_t separator_count_ = 0;
  bool has_walls_ = false;
  double wall_right_m_ = -std::numeric_limits<double>::infinity();
  EdgeList edges_;

  std::vector<Body> all_;  // robots, then obstacles that move
  std::size_t robot_count_ = 0;
  bool has_pushable_ = false;
  bool has_parts_ = false;
  std::deque<BodyState> states_;     // of `all_`
  std::deque<BodyDetails> details_;  // of `all_`
  std::vector<int> with_superstructures_;
  double largest_radius_m_ = 0.0;
  int in_box2d_ = 0;          // number of robots with a Box2D body
  std::vector<Circle> by_x_;  // bounding circles of the robots, sorted by x
  bool order_fresh_ = false;
};

}  // namespace sim::physics
