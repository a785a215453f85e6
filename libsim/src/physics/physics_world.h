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

/// The bodies of a world and their motion. This is the only part that uses Box2D.
///
/// Box2D's tolerance (b2_linearSlop) of 5 mm is too coarse for a robot of 17 cm. Therefore one
/// metre is ten Box2D units here, which makes the tolerance 0.5 mm. All values in this interface
/// are in metres and radians, in double precision.
///
/// Robots are driven by velocity. A robot that touches nothing follows the exact arc of its twist
/// in double precision. Near an obstacle the twist is first reduced to one that is feasible for
/// wheels that cannot slip sideways (see feasible_twist in the source). Box2D's contact solver
/// moves robots that touch one another.
class PhysicsWorld {
 public:
  explicit PhysicsWorld(const ArenaDescription& arena);
  ~PhysicsWorld();
  PhysicsWorld(const PhysicsWorld&) = delete;
  PhysicsWorld& operator=(const PhysicsWorld&) = delete;

  /// Adds a robot; the first has index 0.
  int add_robot(const RobotModel& model, const Pose& X_WB);
  [[nodiscard]] int robot_count() const noexcept;
  /// Adds an obstacle that is_movable(), after all robots. It is a body like a robot: the functions
  /// with a parameter `robot` take its index, too.
  /// @param obstacle  its index in the arena.
  /// @return the index of its body.
  int add_moving_obstacle(int obstacle, const ObstacleDescription& description);
  /// The body of an obstacle; -1: it is static.
  [[nodiscard]] int body_of_obstacle(int obstacle) const;
  /// The obstacle of a body that is not a robot.
  [[nodiscard]] int obstacle_of_body(int body) const;
  /// Pose X_WO of an obstacle that moves.
  [[nodiscard]] Pose obstacle_pose(int body) const;
  /// Sets the target of a driven obstacle for the next step: it reaches the pose X_WO at its end
  /// unless something hinders it.
  void drive_obstacle(int body, const Pose& X_WO, double dt_s);
  /// Velocity of an obstacle's centre of area in W over the last step [m/s].
  [[nodiscard]] Vec2 obstacle_velocity(int body) const;
  [[nodiscard]] double height_m(int robot) const;

  /// Sets a robot's target twist for the next step.
  void set_target(int robot, const Twist& target);
  /// Places a robot at a pose, at rest.
  void set_pose(int robot, const Pose& X_WB);
  /// Sets a robot's height and inclination, which have no effect on the physics.
  void set_elevation(int robot, const Elevation& elevation);
  /// Makes a robot stand still like a part of the floor (true), or lets it move again. A suspended
  /// robot has a target of zero; set_pose() still works.
  void set_suspended(int robot, bool suspended);
  [[nodiscard]] bool suspended(int robot) const;
  /// Advances by dt_s (> 0).
  void step(double dt_s);
  [[nodiscard]] const BodyState& body(int robot) const;
  /// Whether Box2D's code has computed part of the state: a robot was so near to something that it
  /// might touch it within a step, or touched it. Box2D's last bits depend on its compiler's
  /// processor; those of everything else do not.
  [[nodiscard]] bool used_box2d() const noexcept;
  /// Upper bound of how far any point of any robot moved in the last step [m].
  [[nodiscard]] double farthest_move_m() const noexcept;

  /// A contact of a robot with a partner.
  struct Contact {
    enum class Kind : std::uint8_t { kObstacle, kSeparator, kBorder, kWall, kRobot };
    int robot;
    Kind kind;
    int index;                      ///< of the obstacle, separator or robot
    std::optional<Vec2> p_WC = {};  ///< contact point at the start of the contact; none: unknown
  };
  /// Contacts that began in the last step. A contact between two robots is listed for both.
  [[nodiscard]] const std::vector<Contact>& new_contacts() const noexcept;
  /// The current contacts of a robot, in no particular order. A partner may be listed more than
  /// once (a wall of several edges).
  [[nodiscard]] std::vector<Contact> contacts_of(int robot) const;

  /// A line along which a robot touches something, in W [m]. Its ends are equal if only a corner
  /// touches.
  struct Touch {
    int robot;
    Vec2 p_WA;
    Vec2 p_WC;
  };
  /// Lines along which a robot touches something now, or began to in the last step, in no
  /// particular order. A contact that began in the last step and still exists is listed twice.
  [[nodiscard]] std::vector<Touch> touches_of(int robot) const;

  /// Extends (true) or retracts a dynamic obstacle, given by its index in the arena.
  void set_extended(int obstacle, bool extended);
  /// The first robot or moving obstacle that overlaps the obstacle's area; -1 if there is none.
  [[nodiscard]] int robot_on(int obstacle) const;
  /// Sets the height up to which the obstacle stands now, >= 0 [m]. Sensors above it look over it.
  void set_height(int obstacle, double height_m);
  /// Changes position, rotation, size or height of an obstacle, given by its index. It keeps its
  /// shape and the number of its vertices, and stays extended or retracted as it is. One that moves
  /// keeps its size and height too, and is at rest then.
  void change_obstacle(int obstacle, const ObstacleDescription& now);
  /// An obstacle that a robot carries.
  struct Load {
    int obstacle;                 ///< its index in the arena
    ObstacleDescription solid_B;  ///< the obstacle with its position and rotation in the robot's
                                  ///< frame B
  };
  /// Sets what a robot carries. It collides with nothing, but the sensors of other robots see it
  /// like the robot itself.
  void set_load(int robot, const std::vector<Load>& loads);
  /// The first robot or moving obstacle that overlaps a solid; -1 if there is none.
  /// @param ignored  body that does not count, or -1.
  [[nodiscard]] int robot_within(const ObstacleDescription& solid, int ignored = -1) const;

  /// Distance of a robot's footprint to the nearest solid, at most limit_m [m]. The result is exact
  /// if it is below exact_below_m. Otherwise it is a lower bound that is at least exact_below_m.
  [[nodiscard]] double clearance_m(int robot, double limit_m, double exact_below_m);
  /// Whether the robot's last clearance_m() has changed no state (of searches). Then the same call
  /// gives the same result and changes nothing, as long as nothing moves.
  [[nodiscard]] bool clearance_settled(int robot) const;

  /// Collects the edges and circles within radius_m of a sensor at p_WL whose solids are higher
  /// than the sensor.
  /// @param own_robot     robot whose body is not seen, or -1.
  /// @param test_inside   also test whether p_WL is inside a solid (edges.inside); not needed for a
  ///     sensor within its robot's own footprint.
  void collect_edges(const Vec2& p_WL, double radius_m, double sensor_height_m, int own_robot,
                     bool test_inside, scan::EdgeBuffer& edges) const;

  /// Scans from X_WL with collect_edges() in parts: nearer robots come first, and robots hidden
  /// behind walls or other robots are skipped. The ranges are bit-identical to those of a single
  /// scan, but the cost grows with the number of visible solids, not with the number in range.
  /// Sensors of equal geometry share tables and scratch memory, which stay in the cache.
  /// @param ranges_m  as for ScanKernel::scan(). The other parameters are those of collect_edges().
  void scan(const scan::ScanGeometry& geometry, const Pose& X_WL, double sensor_height_m,
            int own_robot, bool test_inside, std::span<double> ranges_m) const;
  /// The same with ranges that are rounded to single precision.
  /// @param workspace  of the calling thread.
  void scan(scan::ScanWorkspace& workspace, const scan::ScanGeometry& geometry, const Pose& X_WL,
            double sensor_height_m, int own_robot, bool test_inside,
            std::span<float> ranges_m) const;

  /// A vertical face of a solid, from the floor up: an edge of its outline, or the whole face of a
  /// round one.
  struct Face {
    Contact::Kind kind;
    int index;              ///< of the obstacle, separator or robot; -1 for borders and walls
    double height_m;        ///< of the solid [m]; infinite for walls of a map
    Vec2 p_WA;              ///< [m]
    Vec2 p_WC;              ///< the solid is on the left of the line from A to C [m]
    double radius_m = 0.0;  ///< of a round face, > 0; A and C are its centre then
  };
  /// Collects the faces of everything that reaches into a box with sides along W's axes, and
  /// possibly some others, in no particular order.
  /// @param own_robot  robot whose body is left out, or -1.
  void collect_faces(const Vec2& low, const Vec2& high, int own_robot,
                     std::vector<Face>& faces) const;

  /// Whether a point is inside a solid that is higher than `height_m`.
  /// @param own_robot  robot whose body is ignored, or -1.
  [[nodiscard]] bool is_inside_solid(const Vec2& p_W, double height_m, int own_robot) const;

  /// Whether the line between two points meets no solid that is higher than `height_m`. A solid
  /// that contains the line's start is ignored.
  /// @param own_robot  robot whose body is ignored, or -1.
  /// @param target     an obstacle or a robot that is ignored too; its member `robot` is not used.
  /// @param solid_only  ignores what is not solid, too.
  [[nodiscard]] bool is_line_free(const Vec2& p_WA, const Vec2& p_WC, double height_m,
                                  int own_robot, const Contact& target,
                                  bool solid_only = false) const;

  /// Uses the memory of another world for what is equal in both and does not change. Takes a
  /// comparison of all static solids. The worlds stay independent, also for threads.
  void share_memory_with(const PhysicsWorld& other);

  /// Writes the state, or reads the state of a world with the same arena and robots. It does not
  /// include what robots carry; the caller restores that with set_load().
  void archive(StateArchive& archive);

  /// Range along one ray, computed by b2World::RayCast and, for round obstacles, in closed form. It
  /// is slow and exact (reference in tests and benchmarks); range_max_m if nothing is met. Ignores
  /// heights and whether the ray starts inside a solid.
  [[nodiscard]] double ray_cast_m(const Vec2& p_WL, double angle_rad, double range_max_m,
                                  int own_robot) const;

  /// Runs a step with plain Box2D: each body gets the velocity of its target, then b2World::Step
  /// runs. It is the baseline of benchmarks; robots slide, and body() is not updated.
  void plain_box2d_step(double dt_s);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Name of a contact's partner: an obstacle, dock separator or robot of the world, or "border" or
/// "wall".
[[nodiscard]] std::string partner_name(const PhysicsWorld::Contact& contact,
                                       const WorldDescription& world);

}  // namespace sim
