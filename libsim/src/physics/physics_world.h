// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/core/body_state.h"
#include "sim/core/pose.h"
#include "sim/core/state_archive.h"
#include "sim/scan/scan_kernel.h"
#include "sim/world/description.h"
#include "sim/world/robot_model.h"

namespace sim {

/// The bodies of a world and how they move: the only part that knows Box2D.
///
/// Box2D works with a tolerance (b2_linearSlop) of 5 mm, too coarse for a robot of 17 cm, so one
/// metre is ten Box2D units here, which makes it 0.5 mm. All that crosses this interface is in
/// metres and radians, in double precision.
///
/// Robots are velocity-driven. A robot that touches nothing follows the exact arc of its twist in
/// double precision; near an obstacle the twist is first reduced to what wheels that cannot slip
/// sideways allow (see feasible_twist in the source); robots that touch one another are left to
/// Box2D's contact solver.
class PhysicsWorld {
 public:
  explicit PhysicsWorld(const ArenaDescription& arena);
  ~PhysicsWorld();
  PhysicsWorld(const PhysicsWorld&) = delete;
  PhysicsWorld& operator=(const PhysicsWorld&) = delete;

  /// Adds a robot; the first has index 0.
  int add_robot(const RobotModel& model, const Pose& X_WB);
  [[nodiscard]] int robot_count() const noexcept;
  [[nodiscard]] double height_m(int robot) const;

  /// The twist that a robot strives for in the next step.
  void set_target(int robot, const Twist& target);
  /// Puts a robot somewhere, at rest.
  void set_pose(int robot, const Pose& X_WB);
  /// Lets a robot stand where it is, at rest, as if it were part of the floor (true), or move
  /// again. While suspended it has a target of zero; set_pose() still works.
  void set_suspended(int robot, bool suspended);
  [[nodiscard]] bool suspended(int robot) const;
  /// Advances by dt_s (> 0).
  void step(double dt_s);
  [[nodiscard]] const BodyState& body(int robot) const;
  /// How far any point of any robot moved in the last step, at most [m].
  [[nodiscard]] double farthest_move_m() const noexcept;

  /// Whom a contact that began in the last step is with.
  struct Contact {
    enum class Kind : std::uint8_t { kObstacle, kSeparator, kBorder, kWall, kRobot };
    int robot;
    Kind kind;
    int index;                      ///< of the obstacle, separator or robot
    std::optional<Vec2> p_WC = {};  ///< a point of the contact when it began; none: not known
  };
  /// Contacts that began in the last step; one between robots is listed for both.
  [[nodiscard]] const std::vector<Contact>& new_contacts() const noexcept;
  /// Contacts that a robot has now. A partner may be listed more than once (a wall of several
  /// edges), in no particular order.
  [[nodiscard]] std::vector<Contact> contacts_of(int robot) const;

  /// Where a robot touches something: all along the line from one point to the other, which are
  /// one where only a corner touches. In W [m].
  struct Touch {
    int robot;
    Vec2 p_WA;
    Vec2 p_WC;
  };
  /// Where a robot touches something now, or began to in the last step. A contact that both goes on
  /// and began is listed twice; no particular order.
  [[nodiscard]] std::vector<Touch> touches_of(int robot) const;

  /// Extends (true) or retracts a dynamic obstacle, by its index in the arena.
  void set_extended(int obstacle, bool extended);
  /// Whether any robot's footprint overlaps the obstacle's place.
  [[nodiscard]] bool robot_stands_on(int obstacle) const;
  /// Gives an obstacle, by its index, another place, turn, size or height; extended or retracted it
  /// stays as it is.
  void change_obstacle(int obstacle, const ObstacleDescription& now);
  /// An obstacle that a robot carries.
  struct Load {
    int obstacle;               ///< its index in the arena
    ObstacleDescription box_B;  ///< the same with its place and turn in the robot's frame B
  };
  /// What a robot carries: in nobody's way, but other robots' sensors see it as they see the robot.
  void set_load(int robot, const std::vector<Load>& loads);
  /// The first robot whose footprint overlaps a box; -1 if none does.
  [[nodiscard]] int robot_within(const ObstacleDescription& box) const;

  /// Distance of a robot's footprint to the nearest solid, at most limit_m [m]; exact where it is
  /// below exact_below_m, otherwise a lower bound that is at least that.
  [[nodiscard]] double clearance_m(int robot, double limit_m, double exact_below_m);

  /// Collects the edges within radius_m of a sensor at p_WL that stand higher than the sensor.
  /// @param own_robot     robot whose body is not seen, or -1.
  /// @param test_inside   also find out whether p_WL lies inside a solid (edges.inside); may be
  ///                      left out for a sensor that lies within its robot's own footprint.
  void collect_edges(const Vec2& p_WL, double radius_m, double sensor_height_m, int own_robot,
                     bool test_inside, scan::EdgeBuffer& edges) const;

  /// Scans from X_WL, by collect_edges() in parts: nearer robots come first, those that are hidden
  /// behind walls or other robots are left out. The same ranges to the last bit, at a cost that
  /// grows with what is in sight rather than with what is in range.
  /// Sensors of one geometry share tables and scratch memory, which so stay in the cache.
  /// @param ranges_m  as for ScanKernel::scan().
  /// Others as for collect_edges().
  void scan(const scan::ScanGeometry& geometry, const Pose& X_WL, double sensor_height_m,
            int own_robot, bool test_inside, std::span<double> ranges_m) const;

  /// An upright face of something solid, from the floor up: an edge of its outline.
  struct Face {
    Contact::Kind kind;
    int index;        ///< of the obstacle, separator or robot; -1 for borders and walls
    double height_m;  ///< of the solid [m]; infinite for walls of a map
    Vec2 p_WA;        ///< [m]
    Vec2 p_WC;        ///< the solid lies on the left of the way from A to C [m]
  };
  /// Collects the faces of all that reaches into a box with sides along W's axes, and perhaps
  /// some others, in no particular order.
  /// @param own_robot  robot whose body is left out, or -1.
  void collect_faces(const Vec2& low, const Vec2& high, int own_robot,
                     std::vector<Face>& faces) const;

  /// Whether a point lies inside a solid that stands higher than `height_m`.
  /// @param own_robot  robot whose body does not count, or -1.
  [[nodiscard]] bool is_inside_solid(const Vec2& p_W, double height_m, int own_robot) const;

  /// Whether the line from one point to another meets no solid that stands higher than `height_m`.
  /// A solid that the line begins in does not count.
  /// @param own_robot  robot whose body does not count, or -1.
  /// @param target     what does not count either: an obstacle or a robot; its `robot` is ignored.
  [[nodiscard]] bool is_line_free(const Vec2& p_WA, const Vec2& p_WC, double height_m,
                                  int own_robot, const Contact& target) const;

  /// Writes the state, or reads one of a world with the same arena and robots. What robots carry is
  /// left to set_load().
  void archive(StateArchive& archive);

  /// Range along one ray by b2World::RayCast, the slow exact way (reference in tests and
  /// benchmarks); range_max_m if nothing is met. Ignores heights and insides.
  [[nodiscard]] double ray_cast_m(const Vec2& p_WL, double angle_rad, double range_max_m,
                                  int own_robot) const;

  /// A step in the plain Box2D way: each body gets the velocity of its target, then
  /// b2World::Step. The base that benchmarks compare with; robots slide and body() is not kept.
  void bare_step(double dt_s);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Name of whom a contact is with: of an obstacle, dock separator or robot of the world; "border"
/// or "wall".
[[nodiscard]] std::string partner_name(const PhysicsWorld::Contact& contact,
                                       const WorldDescription& world);

}  // namespace sim
