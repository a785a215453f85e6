// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "physics/physics_world.h"

#include <box2d/b2_distance.h>
#include <box2d/box2d.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "physics/feasible_twist.h"
#include "sim/core/assert.h"

namespace sim {
namespace {

constexpr double kScale = 10.0;  // Box2D units a metre
constexpr float kScaleF = 10.0F;

// Box2D keeps the hulls of touching polygons apart by their two skins less the slop.
constexpr double kRestingGap_m = (2.0 * b2_polygonRadius - b2_linearSlop) / kScale;

// Farther than this a point of a robot must not move in one step of Box2D: broad phase boxes of
// obstacles are 1 cm fat, so a contact is known before it is reached.
constexpr double kMaxTravel_m = 0.0085;

// The same while robots touch: where one is shoved is up to Box2D, which sees a contact only once
// hulls are closer than their skins of 2 mm together.
constexpr double kMaxShove_m = 0.002;

// The same while those that touch have nothing else within reach.
constexpr double kMaxLoneShove_m = 0.003;

// A twist counts as achieved within these.
constexpr double kSpeedTolerance_mps = 0.01;
constexpr double kTurnTolerance_radps = 0.05;
constexpr double kStallDelay_s = 0.2;

// How much farther than asked for clearance_m looks for candidates: how far things may move until
// it must look again.
constexpr double kCandidateMargin_m = 0.1;

// So many of a free robot's contacts, none of which touches, may be out of date.
constexpr int kMostKeptContacts = 4;

constexpr int kVelocityIterations = 8;
constexpr int kPositionIterations = 3;

b2Vec2 to_box2d(const Vec2& p) {
  return {static_cast<float>(p.x() * kScale), static_cast<float>(p.y() * kScale)};
}

double metres(float units) { return static_cast<double>(units) / kScale; }

// sin(x) / x; by its series where that is exact to the last bit (a step's half turn is small).
double sinc(double x) {
  if (std::abs(x) > 0.05) return std::sin(x) / x;
  const double x2 = x * x;
  return 1.0 - x2 / 6.0 * (1.0 - x2 / 20.0 * (1.0 - x2 / 42.0));
}

struct FixtureInfo {
  PhysicsWorld::Contact::Kind kind;
  int index;  // of the obstacle, separator or robot; -1 for borders and walls
  double height_m;
  std::size_t first_edge = 0;  // into StaticEdges; unused for robots
  std::size_t edge_count = 0;
};

struct Edge {
  double x0, y0, x1, y1;
};

// Edges of everything that does not move, in W, in one array, so that a small world's are
// collected in one sweep.
struct EdgeList {
  std::vector<Edge> edges;
  std::vector<double> heights_m;
  double least_height_m = std::numeric_limits<double>::infinity();

  void clear() {
    edges.clear();
    heights_m.clear();
    least_height_m = std::numeric_limits<double>::infinity();
  }
  void add(const Edge& edge, double height_m) {
    edges.push_back(edge);
    heights_m.push_back(height_m);
    least_height_m = std::min(least_height_m, height_m);
  }
};

// More static edges than this are searched by Box2D's tree instead of swept.
constexpr std::size_t kSweepLimit = 512;

struct Robot {
  b2Body* body = nullptr;
  b2PolygonShape shape;
  b2PolygonShape reaching_shape;  // the same with a wide skin, which finds contacts ahead
  DriveKind drive = DriveKind::kDifferential;
  double height_m = 0.0;
  double mass_kg = 0.0;
  double inertia_kgm2 = 0.0;
  double radius_m = 0.0;  // of the footprint about B
  Pose X_WB;              // exact; yaw not wrapped, in step with the body's angle
  Twist target;
  bool suspended = false;
  bool shoving = false;  // touches another, or one that does is near
  double stall_clock_s = 0.0;
  double moved_m = 0.0;                // in this part of a step, any point of it, at most
  std::vector<b2Fixture*> candidates;  // all that is nearer than candidates_reach_m
  b2Vec2 nearest_direction{1.0F, 0.0F};
  double candidates_reach_m = -1.0;  // less all motion since; see clearance_m
  double free_m = 0.0;  // nothing solid is nearer than this: what clearance_m found, less
                        // all motion since
  BodyState state;
  std::vector<int> touching;        // contacts per partner, see ContactCounter
  EdgeList load;                    // outlines of what it carries, in B
  std::vector<int> load_obstacles;  // whose each of these edges is
  double seen_radius_m = 0.0;       // of the footprint and the load about B
};

// Lets the body turn about B, the axle's centre, as its wheels make it: to Box2D a body's velocity
// is that of its centre of mass. Outlines that are round about B but for rounding keep theirs.
void center_mass_on_axle(b2Body& body) {
  constexpr float kRounding = 1e-4F;
  if (body.GetLocalCenter().Length() <= kRounding) return;
  b2MassData mass;
  body.GetMassData(&mass);
  mass.center.SetZero();
  body.SetMassData(&mass);
}

b2PolygonShape polygon_shape(const std::vector<Vec2>& vertices) {
  SIM_ASSERT(vertices.size() >= 3 && vertices.size() <= b2_maxPolygonVertices);
  std::array<b2Vec2, b2_maxPolygonVertices> points;
  const std::size_t n = std::min(vertices.size(), points.size());
  std::transform(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(n),
                 points.begin(), to_box2d);
  b2PolygonShape shape;
  shape.Set(points.data(), static_cast<int32>(n));
  return shape;
}

// Least of n . v over the corners v of a polygon or an edge, in W (Box2D units).
float least_along(const b2Vec2& n, const b2Shape& shape, const b2Transform& xf) {
  const b2Vec2 local = b2MulT(xf.q, n);
  float least = std::numeric_limits<float>::infinity();
  if (shape.GetType() == b2Shape::e_polygon) {
    const auto& polygon = static_cast<const b2PolygonShape&>(shape);
    for (int32 i = 0; i < polygon.m_count; ++i) {
      least = std::min(least, b2Dot(local, polygon.m_vertices[i]));
    }
  } else {
    const auto& edge = static_cast<const b2EdgeShape&>(shape);
    least = std::min(b2Dot(local, edge.m_vertex1), b2Dot(local, edge.m_vertex2));
  }
  return least + b2Dot(n, xf.p);
}

// Whether some direction shows that a shape is farther from a robot's outline than so much (Box2D
// units): that of its middle, or one that a side of either looks in.
bool is_farther(const b2PolygonShape& outline, const b2Transform& xf, const b2Shape& other,
                const b2Transform& other_xf, const b2Vec2& towards, float least) {
  const auto apart = [&](const b2Vec2& n) {
    return least_along(n, other, other_xf) + least_along(-n, outline, xf) > least;
  };
  b2Vec2 direction = towards;
  if (direction.Normalize() > 0.0F && apart(direction)) return true;
  for (int32 i = 0; i < outline.m_count; ++i) {
    if (apart(b2Mul(xf.q, outline.m_normals[i]))) return true;
  }
  if (other.GetType() == b2Shape::e_polygon) {
    const auto& polygon = static_cast<const b2PolygonShape&>(other);
    for (int32 i = 0; i < polygon.m_count; ++i) {
      if (apart(-b2Mul(other_xf.q, polygon.m_normals[i]))) return true;
    }
    return false;
  }
  const auto& edge = static_cast<const b2EdgeShape&>(other);
  b2Vec2 side = b2Mul(other_xf.q, edge.m_vertex2 - edge.m_vertex1);
  side.Normalize();
  return apart({side.y, -side.x}) || apart({-side.y, side.x});
}

const FixtureInfo& info_of(const b2Fixture* fixture) {
  return *reinterpret_cast<const FixtureInfo*>(
      const_cast<b2Fixture*>(fixture)->GetUserData().pointer);
}

}  // namespace

struct PhysicsWorld::Impl : b2ContactListener {
  explicit Impl(const ArenaDescription& arena) : world(b2Vec2(0.0F, 0.0F)) {
    world.SetContactListener(this);
    world.SetAutoClearForces(false);    // there are none
    world.SetContinuousPhysics(false);  // kMaxTravel_m and feasible_twist do its work
    b2BodyDef ground;
    static_body = world.CreateBody(&ground);
    add_obstacles(arena);
    if (arena.border) add_border(arena);
    for (const WallLoop& loop : arena.walls) add_wall(loop);
    rebuild_fixed_edges();
  }

  // --- Building -------------------------------------------------------------------------------

  FixtureInfo* new_info(Contact::Kind kind, int index, double height_m) {
    infos.push_back(std::make_unique<FixtureInfo>(FixtureInfo{kind, index, height_m}));
    return infos.back().get();
  }

  void attach(b2Body* body, const b2Shape& shape, FixtureInfo* info, float density) {
    b2FixtureDef def;
    def.shape = &shape;
    def.density = density;
    def.friction = 0.0F;
    def.restitution = 0.0F;
    def.userData.pointer = reinterpret_cast<uintptr_t>(info);
    body->CreateFixture(&def);
  }

  void append_outline(FixtureInfo& info, const std::vector<Vec2>& vertices) {
    info.first_edge = all_edges.edges.size();
    info.edge_count = vertices.size();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const Vec2& a = vertices[i];
      const Vec2& b = vertices[(i + 1) % vertices.size()];
      all_edges.add({a.x(), a.y(), b.x(), b.y()}, info.height_m);
    }
  }

  void add_box(const ObstacleDescription& o, Contact::Kind kind, int index) {
    FixtureInfo* info = new_info(kind, index, o.height_m);
    const std::vector<Vec2> corners = box_corners(o);
    append_outline(*info, corners);
    b2BodyDef def;  // a body of its own, so that it can be switched off
    b2Body* body = world.CreateBody(&def);
    attach(body, polygon_shape(corners), info, 0.0F);
    body->SetEnabled(o.type == ObstacleType::kStatic || o.state == ObstacleState::kExtended);
    if (kind == Contact::Kind::kObstacle) {
      obstacle_bodies.push_back(body);
    }
  }

  void add_obstacles(const ArenaDescription& arena) {
    for (std::size_t i = 0; i < arena.obstacles.size(); ++i) {
      add_box(arena.obstacles[i], Contact::Kind::kObstacle, static_cast<int>(i));
    }
    for (std::size_t i = 0; i < arena.dock_separators.size(); ++i) {
      add_box(arena.dock_separators[i], Contact::Kind::kSeparator, static_cast<int>(i));
    }
  }

  void add_border(const ArenaDescription& arena) {
    const double x0 = arena.origin.x();
    const double y0 = arena.origin.y();
    const double x1 = x0 + arena.size.x();
    const double y1 = y0 + arena.size.y();
    const double t = 0.1;  // thickness [m]; only the inner faces matter
    const Vec2 mid(0.5 * (x0 + x1), 0.5 * (y0 + y1));
    const double w = arena.size.x() + 2.0 * t;
    const double h = arena.size.y() + 2.0 * t;
    const std::array<std::pair<Vec2, Vec2>, 4> boxes = {{{{mid.x(), y0 - 0.5 * t}, {w, t}},
                                                         {{x1 + 0.5 * t, mid.y()}, {t, h}},
                                                         {{mid.x(), y1 + 0.5 * t}, {w, t}},
                                                         {{x0 - 0.5 * t, mid.y()}, {t, h}}}};
    // Seen from inside, the solid is on the left of edges that run clockwise round the floor.
    const std::array<Edge, 4> faces = {
        {{x1, y0, x0, y0}, {x1, y1, x1, y0}, {x0, y1, x1, y1}, {x0, y0, x0, y1}}};
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      FixtureInfo* info = new_info(Contact::Kind::kBorder, -1, arena.border_height_m);
      info->first_edge = all_edges.edges.size();
      info->edge_count = 1;
      all_edges.add(faces[i], arena.border_height_m);
      attach(static_body,
             polygon_shape(
                 box_corners({boxes[i].first.x(), boxes[i].first.y(), 0.0}, boxes[i].second)),
             info, 0.0F);
    }
  }

  void add_wall(const WallLoop& loop) {
    const std::size_t n = loop.vertices.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2& before = loop.vertices[(i + n - 1) % n];
      const Vec2& a = loop.vertices[i];
      const Vec2& b = loop.vertices[(i + 1) % n];
      const Vec2& after = loop.vertices[(i + 2) % n];
      // Walls of a map have no height of their own: every sensor sees them.
      FixtureInfo* info =
          new_info(Contact::Kind::kWall, -1, std::numeric_limits<double>::infinity());
      info->first_edge = all_edges.edges.size();
      info->edge_count = 1;
      all_edges.add({a.x(), a.y(), b.x(), b.y()}, info->height_m);
      b2EdgeShape shape;
      shape.SetOneSided(to_box2d(before), to_box2d(a), to_box2d(b), to_box2d(after));
      attach(static_body, shape, info, 0.0F);
      has_walls = true;
      wall_right_m = std::max({wall_right_m, a.x(), b.x()});
    }
  }

  // The first robot whose footprint overlaps a shape; -1 if none does.
  [[nodiscard]] int robot_within(const b2Shape& shape, const b2Transform& xf) const {
    const auto it = std::find_if(robots.begin(), robots.end(), [&](const Robot& r) {
      return b2TestOverlap(&shape, 0, &r.shape, 0, xf, r.body->GetTransform());
    });
    return it == robots.end() ? -1 : static_cast<int>(it - robots.begin());
  }

  // The edges that are there now, for worlds small enough to sweep.
  void rebuild_fixed_edges() {
    sweep = all_edges.edges.size() <= kSweepLimit;
    fixed_edges.clear();
    if (!sweep) return;
    for (const auto& info : infos) {
      if (info->kind == Contact::Kind::kRobot) continue;
      if (info->kind == Contact::Kind::kObstacle &&
          !obstacle_bodies[static_cast<std::size_t>(info->index)]->IsEnabled()) {
        continue;
      }
      for (std::size_t i = 0; i < info->edge_count; ++i) {
        fixed_edges.add(all_edges.edges[info->first_edge + i], info->height_m);
      }
    }
  }

  // --- Moving ---------------------------------------------------------------------------------

  // Puts the closing-speed limits that a pair of shapes gives robot `r` into constraints.
  // `share` is the part of the gap that r may close in this step.
  void add_constraints(const Robot& r, const b2Shape& other, const b2Transform& other_xf,
                       double share, double dt_s) {
    const b2Transform& xf = r.body->GetTransform();
    b2Manifold manifold;
    b2WorldManifold points;
    double sign = 1.0;  // the normal points from A to B
    if (other.GetType() == b2Shape::e_polygon) {
      const auto& polygon = static_cast<const b2PolygonShape&>(other);
      b2CollidePolygons(&manifold, &r.reaching_shape, xf, &polygon, other_xf);
      points.Initialize(&manifold, xf, r.reaching_shape.m_radius, other_xf, polygon.m_radius);
    } else {
      const auto& edge = static_cast<const b2EdgeShape&>(other);
      b2CollideEdgeAndPolygon(&manifold, &edge, other_xf, &r.reaching_shape, xf);
      points.Initialize(&manifold, other_xf, edge.m_radius, xf, r.reaching_shape.m_radius);
      sign = -1.0;
    }
    if (manifold.pointCount == 0) return;
    const double nx = sign * static_cast<double>(points.normal.x);
    const double ny = sign * static_cast<double>(points.normal.y);
    const double c = std::cos(r.X_WB.yaw_rad);
    const double s = std::sin(r.X_WB.yaw_rad);
    const double skins = static_cast<double>(r.reaching_shape.m_radius + other.m_radius);
    for (int32 i = 0; i < manifold.pointCount; ++i) {
      const double gap_m = (static_cast<double>(points.separations[i]) + skins) / kScale;
      const double rx = metres(points.points[i].x) - r.X_WB.x_m;
      const double ry = metres(points.points[i].y) - r.X_WB.y_m;
      constraints.push_back({nx * c + ny * s, rx * ny - ry * nx,
                             share * std::max(0.0, gap_m - kRestingGap_m) / dt_s, ny * c - nx * s});
    }
  }

  // Robots so close that they may reach one another, by a sweep over their order in x.
  void find_near_pairs() {
    near_pairs.clear();
    for (Circle& circle : by_x) {
      const Robot& r = robots[static_cast<std::size_t>(circle.robot)];
      circle.x = r.X_WB.x_m;
      circle.y = r.X_WB.y_m;
    }
    for (std::size_t i = 1; i < by_x.size(); ++i) {  // insertion sort: nearly sorted already
      const Circle moving = by_x[i];
      std::size_t j = i;
      for (; j > 0 && by_x[j - 1].x > moving.x; --j) by_x[j] = by_x[j - 1];
      by_x[j] = moving;
    }
    for (std::size_t i = 0; i < by_x.size(); ++i) {
      const Circle& a = by_x[i];
      const double farthest_x = a.x + a.radius + largest_radius_m + 3.0 * kMaxTravel_m;
      for (std::size_t j = i + 1; j < by_x.size() && by_x[j].x <= farthest_x; ++j) {
        const Circle& b = by_x[j];
        const double reach = a.radius + b.radius + 3.0 * kMaxTravel_m;
        const double dx = b.x - a.x;
        const double dy = b.y - a.y;
        if (dx * dx + dy * dy < reach * reach &&
            !is_farther(robots[static_cast<std::size_t>(a.robot)],
                        robots[static_cast<std::size_t>(b.robot)])) {
          near_pairs.emplace_back(std::min(a.robot, b.robot), std::max(a.robot, b.robot));
        }
      }
    }
    std::sort(near_pairs.begin(), near_pairs.end());
    near_to.resize(robots.size());
    for (std::vector<int>& others : near_to) others.clear();
    for (const auto& [a, b] : near_pairs) {
      near_to[static_cast<std::size_t>(a)].push_back(b);
      near_to[static_cast<std::size_t>(b)].push_back(a);
    }
  }

  // Whether two robots are too far apart for either to be in the other's way.
  [[nodiscard]] static bool is_farther(const Robot& a, const Robot& b) {
    const b2Transform& xf_a = a.body->GetTransform();
    const b2Transform& xf_b = b.body->GetTransform();
    return sim::is_farther(a.shape, xf_a, b.shape, xf_b, xf_b.p - xf_a.p,
                           static_cast<float>(3.0 * kMaxTravel_m) * kScaleF);
  }

  // Whether nothing can be reached by the robot, nor reach it, in this part of a step.
  [[nodiscard]] bool is_free(std::size_t index) const {
    const Robot& r = robots[index];
    if (r.free_m > 2.0 * kMaxTravel_m + kRestingGap_m) return true;
    if (!near_to[index].empty()) return false;
    // Contacts of bodies at rest are kept: not too many, before a step in motion forgets them.
    int kept = 0;
    for (const b2ContactEdge* e = r.body->GetContactList(); e != nullptr; e = e->next) {
      if (++kept > kMostKeptContacts || is_near_wall(r, *e->contact)) return false;
    }
    return true;
  }

  // Whether a contact is with something that does not move, and that is within reach.
  [[nodiscard]] static bool is_near_wall(const Robot& r, const b2Contact& contact) {
    const b2Fixture* other = contact.GetFixtureA();
    if (other->GetBody() == r.body) other = contact.GetFixtureB();
    if (info_of(other).kind == Contact::Kind::kRobot) return false;
    const b2Transform& xf = r.body->GetTransform();
    return !sim::is_farther(r.shape, xf, *other->GetShape(), other->GetBody()->GetTransform(),
                            other->GetAABB(0).GetCenter() - xf.p,
                            static_cast<float>(kMaxTravel_m + kRestingGap_m) * kScaleF);
  }

  // Whether a robot that is shoved might run into something that it does not touch yet.
  [[nodiscard]] bool may_be_shoved_into(std::size_t index) const {
    const Robot& r = robots[index];
    for (const int near : near_to[index]) {
      if (!touches(r.body, robots[static_cast<std::size_t>(near)].body)) return true;
    }
    for (const b2ContactEdge* e = r.body->GetContactList(); e != nullptr; e = e->next) {
      if (!e->contact->IsTouching() && is_near_wall(r, *e->contact)) return true;
    }
    return false;
  }

  [[nodiscard]] Twist allowed_twist(std::size_t index, double dt_s) {
    Robot& r = robots[index];
    if (r.target == Twist{}) return r.target;
    constraints.clear();
    for (b2ContactEdge* e = r.body->GetContactList(); e != nullptr; e = e->next) {
      const b2Fixture* mine = e->contact->GetFixtureA();
      const b2Fixture* other = e->contact->GetFixtureB();
      if (mine->GetBody() != r.body) std::swap(mine, other);
      if (info_of(other).kind == Contact::Kind::kRobot) continue;
      add_constraints(r, *other->GetShape(), other->GetBody()->GetTransform(), 1.0, dt_s);
    }
    for (const int near : near_to[index]) {
      const Robot& other = robots[static_cast<std::size_t>(near)];
      if (other.suspended) {  // as good as a wall
        add_constraints(r, other.shape, other.body->GetTransform(), 1.0, dt_s);
        continue;
      }
      if (touches(r.body, other.body)) continue;  // pushing: Box2D's solver shares the momentum
      add_constraints(r, other.shape, other.body->GetTransform(), 0.5, dt_s);
    }
    if (constraints.empty()) return r.target;
    switch (r.drive) {
      case DriveKind::kOmnidirectional:
        return feasible_planar_twist(r.target, r.mass_kg, r.inertia_kgm2, constraints);
      case DriveKind::kCar:
        return feasible_share(r.target, constraints);
      case DriveKind::kDifferential:
        break;
    }
    return feasible_twist(r.target, r.mass_kg, r.inertia_kgm2, constraints);
  }

  [[nodiscard]] static bool touches(const b2Body* a, const b2Body* b) {
    for (const b2ContactEdge* e = a->GetContactList(); e != nullptr; e = e->next) {
      if (e->other == b && e->contact->IsTouching()) return true;
    }
    return false;
  }

  // Where an unhindered robot gets to: along the exact arc of the twist (the exponential map of
  // SE(2): Lynch and Park, Modern Robotics, 2017, sec. 3.3.3).
  [[nodiscard]] static Pose arc_end(const Pose& X_WB, const Twist& twist, double dt_s) {
    const double half_turn = 0.5 * twist.omega_radps * dt_s;
    const double chord = twist.v_mps * dt_s * sinc(half_turn);
    const double side = twist.lateral_mps * dt_s * sinc(half_turn);
    const double heading = X_WB.yaw_rad + half_turn;
    return {X_WB.x_m + chord * std::cos(heading) - side * std::sin(heading),
            X_WB.y_m + chord * std::sin(heading) + side * std::cos(heading),
            X_WB.yaw_rad + twist.omega_radps * dt_s};
  }

  void something_was_placed() {
    placed = true;
    for (Robot& r : robots) {
      r.free_m = 0.0;
      r.candidates_reach_m = -1.0;
    }
  }

  // Moves all for a time in which no robot travels farther than kMaxTravel_m. Free robots are done
  // with at once, without Box2D; those that shove one another take several parts.
  void advance(double dt_s) {
    if (placed) {  // lets Box2D find the contacts of what was put somewhere since the last step
      world.Step(0.0F, 1, 1);
      placed = false;
    }
    find_near_pairs();
    goals.resize(robots.size());
    twists.resize(robots.size());
    farthest_m = 0.0;
    hindered.clear();
    for (std::size_t i = 0; i < robots.size(); ++i) {
      robots[i].moved_m = 0.0;
      if (is_free(i)) {
        move_freely(i, dt_s);
      } else {
        hindered.push_back(i);
      }
    }
    find_shoving();
    double shove_m = 0.0;
    for (const std::size_t i : shoving) shove_m = std::max(shove_m, travel_m(robots[i], dt_s));
    const int parts = std::max(1, static_cast<int>(std::ceil(shove_m / most_shove_m)));
    substep(dt_s / parts, dt_s);
    for (int i = 1; i < parts; ++i) substep(dt_s / parts, 0.0);
    // So much nearer another robot may have come.
    for (Robot& r : robots) {
      r.free_m -= farthest_m;
      r.candidates_reach_m -= farthest_m;
    }
  }

  // How far any point of a robot that gets its target travels, at most [m].
  [[nodiscard]] static double travel_m(const Robot& r, double dt_s) {
    return (std::abs(r.target.v_mps) + std::abs(r.target.lateral_mps) +
            std::abs(r.target.omega_radps) * r.radius_m) *
           dt_s;
  }

  // Robots that touch others, with those near them, and those near these, and so on.
  void find_shoving() {
    for (const std::size_t i : shoving) robots[i].shoving = false;
    shoving.clear();
    const auto add = [this](int index) {
      const auto i = static_cast<std::size_t>(index);
      if (!std::exchange(robots[i].shoving, true)) shoving.push_back(i);
    };
    for (const auto& [a, b] : near_pairs) {
      if (!touches(robots[static_cast<std::size_t>(a)].body,
                   robots[static_cast<std::size_t>(b)].body)) {
        continue;
      }
      add(a);
      add(b);
    }
    most_shove_m = std::any_of(shoving.begin(), shoving.end(),
                               [this](std::size_t i) { return may_be_shoved_into(i); })
                       ? kMaxShove_m
                       : kMaxLoneShove_m;
    for (std::size_t i = 0; i < shoving.size(); ++i) {
      for (const int near : near_to[shoving[i]]) add(near);
    }
  }

  // To Box2D a free robot is a body at rest that is put somewhere else.
  void move_freely(std::size_t index, double dt_s) {
    Robot& r = robots[index];
    if (r.body->IsAwake()) r.body->SetAwake(false);
    if (r.target == Twist{}) return;
    twists[index] = r.target;
    goals[index] = arc_end(r.X_WB, r.target, dt_s);
    r.body->SetTransform(to_box2d(goals[index].position()),
                         static_cast<float>(goals[index].yaw_rad));
    arrive(index, dt_s);
  }

  // Moves the robots that are hindered: those that shove by dt_s, the others by others_dt_s, in one
  // step of Box2D; if that is 0 they rest.
  void substep(double dt_s, double others_dt_s) {
    const float inv_dt = static_cast<float>(1.0 / dt_s);
    for (const std::size_t i : hindered) {
      Robot& r = robots[i];
      const double own_dt_s = r.shoving ? dt_s : others_dt_s;
      if (own_dt_s == 0.0) {
        r.body->SetAwake(false);
        continue;
      }
      twists[i] = allowed_twist(i, own_dt_s);
      goals[i] = arc_end(r.X_WB, twists[i], own_dt_s);
      if (goals[i] == r.X_WB && !r.body->IsAwake()) continue;
      // The velocity that takes Box2D's single-precision body to the exact goal, so that rounding
      // does not pile up.
      const b2Vec2 goal = to_box2d(goals[i].position());
      r.body->SetLinearVelocity(inv_dt * (goal - r.body->GetPosition()));
      r.body->SetAngularVelocity(inv_dt *
                                 (static_cast<float>(goals[i].yaw_rad) - r.body->GetAngle()));
    }
    world.Step(static_cast<float>(dt_s), kVelocityIterations, kPositionIterations);
    for (const std::size_t i : hindered) {
      const double own_dt_s = robots[i].shoving ? dt_s : others_dt_s;
      if (own_dt_s > 0.0) follow_body(i, own_dt_s);
    }
  }

  // Takes over where Box2D put the robot: the exact goal if nothing hindered it.
  void follow_body(std::size_t index, double dt_s) {
    Robot& r = robots[index];
    if (r.suspended) {
      hold(r);
      return;
    }
    const Pose& goal = goals[index];
    const b2Vec2 p = r.body->GetPosition();
    const b2Vec2 wanted = to_box2d(goal.position());
    const float angle = r.body->GetAngle();
    // Rounding of position and angle, a few units in the last place.
    const float slack = 4e-6F * (4.0F + std::abs(p.x) + std::abs(p.y));
    if (std::abs(p.x - wanted.x) <= slack && std::abs(p.y - wanted.y) <= slack &&
        std::abs(angle - static_cast<float>(goal.yaw_rad)) <= 2e-5F) {
      arrive(index, dt_s);
      return;
    }
    const Pose before = r.X_WB;
    r.X_WB = {metres(p.x), metres(p.y), static_cast<double>(angle)};
    const double turn = r.X_WB.yaw_rad - before.yaw_rad;
    const double heading = before.yaw_rad + 0.5 * turn;
    const double dx = r.X_WB.x_m - before.x_m;
    const double dy = r.X_WB.y_m - before.y_m;
    // The wheels' path is the arc whose chord this is.
    r.state.travel_m += (dx * std::cos(heading) + dy * std::sin(heading)) / sinc(0.5 * turn);
    r.state.side_m += dy * std::cos(heading) - dx * std::sin(heading);
    moved(r, std::hypot(dx, dy), turn);
  }

  // The robot is where its twist took it.
  void arrive(std::size_t index, double dt_s) {
    Robot& r = robots[index];
    r.X_WB = goals[index];
    const double travel = twists[index].v_mps * dt_s;
    const double side = twists[index].lateral_mps * dt_s;
    r.state.travel_m += travel;
    r.state.side_m += side;
    moved(r, side == 0.0 ? std::abs(travel) : std::hypot(travel, side),
          twists[index].omega_radps * dt_s);
  }

  // Books that a robot went so far and turned so much.
  void moved(Robot& r, double way_m, double turn_rad) {
    r.state.turn_rad += turn_rad;
    if (std::abs(r.X_WB.yaw_rad) > 8.0 * std::numbers::pi) unwind(r);
    const double most_m = way_m + std::abs(turn_rad) * r.radius_m;  // of any point of it
    r.free_m -= most_m;
    r.candidates_reach_m -= most_m;
    r.moved_m += most_m;
    farthest_m = std::max(farthest_m, r.moved_m);
  }

  // Takes back what Box2D's solver may have done to a body that is not to move.
  static void hold(Robot& r) {
    const b2Vec2 p = to_box2d(r.X_WB.position());
    const float angle = static_cast<float>(r.X_WB.yaw_rad);
    if (r.body->GetPosition() == p && r.body->GetAngle() == angle) return;
    r.body->SetTransform(p, angle);
    r.body->SetLinearVelocity({0.0F, 0.0F});
    r.body->SetAngularVelocity(0.0F);
  }

  // Keeps angles small, where single precision is fine.
  void unwind(Robot& r) {
    r.X_WB.yaw_rad = normalize_angle(r.X_WB.yaw_rad);
    r.body->SetTransform(r.body->GetPosition(), static_cast<float>(r.X_WB.yaw_rad));
  }

  static void finish_step(Robot& r, double dt_s) {
    BodyState& s = r.state;
    s.X_WB = {r.X_WB.x_m, r.X_WB.y_m, normalize_angle(r.X_WB.yaw_rad)};
    s.twist = {s.travel_m / dt_s, s.turn_rad / dt_s, s.side_m / dt_s};
    s.commanded = r.target;
    const bool achieved =
        std::abs(s.twist.v_mps - r.target.v_mps) <= kSpeedTolerance_mps &&
        std::abs(s.twist.omega_radps - r.target.omega_radps) <= kTurnTolerance_radps &&
        (r.drive != DriveKind::kOmnidirectional ||
         std::abs(s.twist.lateral_mps - r.target.lateral_mps) <= kSpeedTolerance_mps);
    r.stall_clock_s = achieved ? 0.0 : r.stall_clock_s + dt_s;
    s.stalled = r.stall_clock_s >= kStallDelay_s - 1e-9;
  }

  void rebuild_robot_edges() {
    robot_edges.clear();
    robot_first_edge.clear();
    robot_discs.clear();
    for (const Robot& r : robots) {
      robot_discs.add(static_cast<float>(r.X_WB.x_m), static_cast<float>(r.X_WB.y_m),
                      static_cast<float>(r.seen_radius_m));
      robot_first_edge.push_back(robot_edges.edges.size());
      const double c = std::cos(r.X_WB.yaw_rad);
      const double s = std::sin(r.X_WB.yaw_rad);
      const b2Vec2* v = r.shape.m_vertices;
      const int n = r.shape.m_count;
      std::array<Vec2, b2_maxPolygonVertices> p;
      for (int i = 0; i < n; ++i) {
        const double x = metres(v[i].x);
        const double y = metres(v[i].y);
        p[static_cast<std::size_t>(i)] = {r.X_WB.x_m + c * x - s * y, r.X_WB.y_m + s * x + c * y};
      }
      for (int i = 0; i < n; ++i) {
        const Vec2& a = p[static_cast<std::size_t>(i)];
        const Vec2& b = p[static_cast<std::size_t>((i + 1) % n)];
        robot_edges.add({a.x(), a.y(), b.x(), b.y()}, r.height_m);
      }
      for (std::size_t i = 0; i < r.load.edges.size(); ++i) {
        const Edge& e = r.load.edges[i];
        robot_edges.add({r.X_WB.x_m + c * e.x0 - s * e.y0, r.X_WB.y_m + s * e.x0 + c * e.y0,
                         r.X_WB.x_m + c * e.x1 - s * e.y1, r.X_WB.y_m + s * e.x1 + c * e.y1},
                        r.load.heights_m[i]);
      }
    }
    robot_first_edge.push_back(robot_edges.edges.size());
    robot_edges_fresh = true;
  }

  [[nodiscard]] bool inside_solid(const Vec2& p_W, double height_m, int own_robot);

  [[nodiscard]] scan::ScanKernel& kernel_of(const scan::ScanGeometry& geometry) {
    const auto it = std::find_if(kernels.begin(), kernels.end(), [&](const scan::ScanKernel& k) {
      return k.geometry() == geometry;
    });
    return it != kernels.end() ? *it : kernels.emplace_back(geometry);
  }

  void collect_static_edges(const Vec2& p_WL, double radius_m, double sensor_height_m,
                            scan::EdgeBuffer& edges);
  // --- Contacts -------------------------------------------------------------------------------

  // One slot a partner: obstacles, separators, border, wall, robots.
  [[nodiscard]] std::size_t slot(const FixtureInfo& info) const {
    const std::size_t obstacles = obstacle_bodies.size();
    switch (info.kind) {
      case Contact::Kind::kObstacle:
        return static_cast<std::size_t>(info.index);
      case Contact::Kind::kSeparator:
        return obstacles + 2 + static_cast<std::size_t>(info.index);
      case Contact::Kind::kBorder:
        return obstacles;
      case Contact::Kind::kWall:
        return obstacles + 1;
      case Contact::Kind::kRobot:
        break;
    }
    return obstacles + 2 + separators() + static_cast<std::size_t>(info.index);
  }
  [[nodiscard]] std::size_t separators() const { return separator_count; }

  void count_contact(const b2Fixture* robot_fixture, const b2Fixture* other, int change) {
    const FixtureInfo& mine = info_of(robot_fixture);
    if (mine.kind != Contact::Kind::kRobot) return;
    const FixtureInfo& theirs = info_of(other);
    std::vector<int>& touching = robots[static_cast<std::size_t>(mine.index)].touching;
    const std::size_t where = slot(theirs);
    if (touching.size() <= where) touching.resize(where + 1, 0);
    touching[where] += change;
    if (change > 0 && touching[where] == 1) {
      contacts.push_back({mine.index, theirs.kind, theirs.index});
    }
  }
  // What a contact's points span, for one of the two robots that may be in it.
  static void add_touch(const b2Contact& contact, int robot, std::vector<Touch>& into) {
    const int32 count = contact.GetManifold()->pointCount;
    if (count == 0) return;
    b2WorldManifold points;
    contact.GetWorldManifold(&points);
    const auto in_metres = [](const b2Vec2& p) { return Vec2(metres(p.x), metres(p.y)); };
    into.push_back({robot, in_metres(points.points[0]), in_metres(points.points[count - 1])});
  }
  void BeginContact(b2Contact* contact) override {
    count_contact(contact->GetFixtureA(), contact->GetFixtureB(), 1);
    count_contact(contact->GetFixtureB(), contact->GetFixtureA(), 1);
    for (const b2Fixture* fixture : {contact->GetFixtureA(), contact->GetFixtureB()}) {
      const FixtureInfo& info = info_of(fixture);
      if (info.kind == Contact::Kind::kRobot) add_touch(*contact, info.index, new_touches);
    }
  }
  void EndContact(b2Contact* contact) override {
    count_contact(contact->GetFixtureA(), contact->GetFixtureB(), -1);
    count_contact(contact->GetFixtureB(), contact->GetFixtureA(), -1);
  }

  b2World world;
  b2Body* static_body = nullptr;
  std::vector<std::unique_ptr<FixtureInfo>> infos;
  std::vector<b2Body*> obstacle_bodies;
  std::size_t separator_count = 0;
  bool has_walls = false;
  double wall_right_m = -std::numeric_limits<double>::infinity();

  EdgeList all_edges;    // of every static thing, extended or not
  EdgeList fixed_edges;  // of those that are there now
  bool sweep = true;
  EdgeList robot_edges;
  std::vector<std::size_t> robot_first_edge;
  scan::DiscBuffer robot_discs;           // round them
  std::vector<scan::ScanKernel> kernels;  // of scan(), one a geometry
  scan::EdgeBuffer scan_edges;            // scratch memory of scan()
  bool robot_edges_fresh = false;

  bool placed = true;  // something was put somewhere since the last step

  std::vector<Robot> robots;
  double largest_radius_m = 0.0;
  struct Circle {
    double x, y, radius;
    int robot;
  };
  std::vector<Circle> by_x;  // round the robots, in this order
  std::vector<std::pair<int, int>> near_pairs;
  std::vector<std::vector<int>> near_to;  // the same by robot, in the same order
  double farthest_m = 0.0;                // that any robot has moved in this part of a step
  std::vector<std::size_t> hindered;      // robots that are not free
  double most_shove_m = kMaxShove_m;
  std::vector<std::size_t> shoving;  // robots that touch others or are near such
  std::vector<Pose> goals;           // where each robot gets to in this step if nothing hinders it
  std::vector<Twist> twists;         // by which twist
  std::vector<TwistConstraint> constraints;
  std::vector<Contact> contacts;
  std::vector<Touch> new_touches;
};

PhysicsWorld::PhysicsWorld(const ArenaDescription& arena) : impl_(std::make_unique<Impl>(arena)) {
  impl_->separator_count = arena.dock_separators.size();
}

PhysicsWorld::~PhysicsWorld() = default;

int PhysicsWorld::add_robot(const RobotModel& model, const Pose& X_WB) {
  Impl& d = *impl_;
  const int index = static_cast<int>(d.robots.size());
  Robot r;
  r.shape = polygon_shape(model.footprint);
  r.reaching_shape = r.shape;
  r.reaching_shape.m_radius = static_cast<float>(3.0 * kMaxTravel_m) * kScaleF;
  r.drive = model.drive.kind;
  r.height_m = model.height_m;
  for (const Vec2& v : model.footprint) r.radius_m = std::max(r.radius_m, v.norm());
  r.seen_radius_m = r.radius_m;
  r.X_WB = X_WB;
  r.state.X_WB = {X_WB.x_m, X_WB.y_m, normalize_angle(X_WB.yaw_rad)};

  b2BodyDef def;
  def.type = b2_dynamicBody;
  def.position = to_box2d(X_WB.position());
  def.angle = static_cast<float>(X_WB.yaw_rad);
  r.body = d.world.CreateBody(&def);
  b2MassData unit;
  r.shape.ComputeMass(&unit, 1.0F);
  FixtureInfo* info = d.new_info(Contact::Kind::kRobot, index, model.height_m);
  d.attach(r.body, r.shape, info, static_cast<float>(model.mass_kg) / unit.mass);
  center_mass_on_axle(*r.body);
  r.mass_kg = model.mass_kg;
  r.inertia_kgm2 = static_cast<double>(r.body->GetInertia()) / (kScale * kScale);

  d.largest_radius_m = std::max(d.largest_radius_m, r.radius_m);
  d.by_x.push_back({X_WB.x_m, X_WB.y_m, r.radius_m, index});
  d.robots.push_back(std::move(r));
  d.something_was_placed();
  d.robot_edges_fresh = false;
  return index;
}

int PhysicsWorld::robot_count() const noexcept { return static_cast<int>(impl_->robots.size()); }

double PhysicsWorld::height_m(int robot) const {
  return impl_->robots[static_cast<std::size_t>(robot)].height_m;
}

void PhysicsWorld::set_target(int robot, const Twist& target) {
  Robot& r = impl_->robots[static_cast<std::size_t>(robot)];
  r.target = r.suspended ? Twist{} : target;
}

void PhysicsWorld::set_suspended(int robot, bool suspended) {
  Robot& r = impl_->robots[static_cast<std::size_t>(robot)];
  if (suspended == r.suspended) return;
  r.suspended = suspended;
  if (!suspended) {
    r.body->ResetMassData();
    center_mass_on_axle(*r.body);
    return;
  }
  // A mass beside which all others are nothing, rather than a static body: contacts live on.
  constexpr float kMore = 1e9F;
  b2MassData mass;
  r.body->GetMassData(&mass);
  mass.mass *= kMore;
  mass.I *= kMore;
  r.body->SetMassData(&mass);
  r.body->SetLinearVelocity({0.0F, 0.0F});
  r.body->SetAngularVelocity(0.0F);
  r.target = {};
}

bool PhysicsWorld::suspended(int robot) const {
  return impl_->robots[static_cast<std::size_t>(robot)].suspended;
}

void PhysicsWorld::set_pose(int robot, const Pose& X_WB) {
  Robot& r = impl_->robots[static_cast<std::size_t>(robot)];
  r.X_WB = X_WB;
  r.body->SetTransform(to_box2d(X_WB.position()), static_cast<float>(X_WB.yaw_rad));
  r.body->SetLinearVelocity({0.0F, 0.0F});
  r.body->SetAngularVelocity(0.0F);
  r.body->SetAwake(true);
  r.state = {};
  r.state.X_WB = {X_WB.x_m, X_WB.y_m, normalize_angle(X_WB.yaw_rad)};
  r.stall_clock_s = 0.0;
  impl_->robot_edges_fresh = false;
  impl_->something_was_placed();
}

void PhysicsWorld::step(double dt_s) {
  Impl& d = *impl_;
  d.contacts.clear();
  d.new_touches.clear();
  double travel_m = 0.0;
  for (Robot& r : d.robots) {
    r.state.travel_m = 0.0;
    r.state.turn_rad = 0.0;
    r.state.side_m = 0.0;
    travel_m = std::max(travel_m, Impl::travel_m(r, dt_s));
  }
  const int parts = std::max(1, static_cast<int>(std::ceil(travel_m / kMaxTravel_m)));
  for (int i = 0; i < parts; ++i) d.advance(dt_s / parts);
  for (Robot& r : d.robots) Impl::finish_step(r, dt_s);
  d.robot_edges_fresh = false;
}

const BodyState& PhysicsWorld::body(int robot) const {
  return impl_->robots[static_cast<std::size_t>(robot)].state;
}

const std::vector<PhysicsWorld::Contact>& PhysicsWorld::new_contacts() const noexcept {
  return impl_->contacts;
}

std::vector<PhysicsWorld::Contact> PhysicsWorld::contacts_of(int robot) const {
  std::vector<Contact> contacts;
  const b2Body* body = impl_->robots[static_cast<std::size_t>(robot)].body;
  for (const b2ContactEdge* e = body->GetContactList(); e != nullptr; e = e->next) {
    if (!e->contact->IsTouching()) continue;
    const b2Fixture* a = e->contact->GetFixtureA();
    const b2Fixture* other = a->GetBody() == body ? e->contact->GetFixtureB() : a;
    const FixtureInfo& info = info_of(other);
    contacts.push_back({robot, info.kind, info.index});
  }
  return contacts;
}

std::vector<PhysicsWorld::Touch> PhysicsWorld::touches_of(int robot) const {
  std::vector<Touch> touches;
  const b2Body* body = impl_->robots[static_cast<std::size_t>(robot)].body;
  for (const b2ContactEdge* e = body->GetContactList(); e != nullptr; e = e->next) {
    if (e->contact->IsTouching()) Impl::add_touch(*e->contact, robot, touches);
  }
  // A step may be made in several parts: what began in one may have ended in another.
  for (const Touch& touch : impl_->new_touches) {
    if (touch.robot == robot) touches.push_back(touch);
  }
  return touches;
}

void PhysicsWorld::set_extended(int obstacle, bool extended) {
  impl_->obstacle_bodies[static_cast<std::size_t>(obstacle)]->SetEnabled(extended);
  impl_->something_was_placed();
  impl_->rebuild_fixed_edges();
}

bool PhysicsWorld::robot_stands_on(int obstacle) const {
  const b2Body* block = impl_->obstacle_bodies[static_cast<std::size_t>(obstacle)];
  return impl_->robot_within(*block->GetFixtureList()->GetShape(), block->GetTransform()) >= 0;
}

void PhysicsWorld::change_obstacle(int obstacle, const ObstacleDescription& now) {
  Impl& d = *impl_;
  b2Body* body = d.obstacle_bodies[static_cast<std::size_t>(obstacle)];
  b2Fixture* before = body->GetFixtureList();
  auto* info = reinterpret_cast<FixtureInfo*>(before->GetUserData().pointer);
  info->height_m = now.height_m;
  const std::vector<Vec2> corners = box_corners(now);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2& a = corners[i];
    const Vec2& b = corners[(i + 1) % corners.size()];
    d.all_edges.edges[info->first_edge + i] = {a.x(), a.y(), b.x(), b.y()};
    d.all_edges.heights_m[info->first_edge + i] = now.height_m;
  }
  d.all_edges.least_height_m = std::min(d.all_edges.least_height_m, now.height_m);
  body->DestroyFixture(before);
  d.attach(body, polygon_shape(corners), info, 0.0F);
  d.something_was_placed();
  d.rebuild_fixed_edges();
}

void PhysicsWorld::set_load(int robot, const std::vector<Load>& loads) {
  Robot& r = impl_->robots[static_cast<std::size_t>(robot)];
  r.load.clear();
  r.load_obstacles.clear();
  r.seen_radius_m = r.radius_m;
  for (const Load& load : loads) {
    const ObstacleDescription& box = load.box_B;
    const std::vector<Vec2> corners = box_corners(box);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2& a = corners[i];
      const Vec2& b = corners[(i + 1) % corners.size()];
      r.load.add({a.x(), a.y(), b.x(), b.y()}, box.height_m);
      r.load_obstacles.push_back(load.obstacle);
      r.seen_radius_m = std::max(r.seen_radius_m, a.norm());
    }
  }
  impl_->robot_edges_fresh = false;
}

int PhysicsWorld::robot_within(const ObstacleDescription& box) const {
  b2Transform here;
  here.SetIdentity();
  return impl_->robot_within(polygon_shape(box_corners(box)), here);
}

double PhysicsWorld::clearance_m(int robot, double limit_m, double exact_below_m) {
  Robot& r = impl_->robots[static_cast<std::size_t>(robot)];
  const b2AABB& box = r.body->GetFixtureList()->GetAABB(0);
  // What may be nearest is kept in a list that is good for some way (as Verlet's neighbour lists
  // are, Phys. Rev. 159, 98, 1967), most often the first of it. A list for a far greater limit is
  // too long.
  if (limit_m > r.candidates_reach_m || r.candidates_reach_m > limit_m + 2.0 * kCandidateMargin_m) {
    struct Collector : b2QueryCallback {
      bool ReportFixture(b2Fixture* fixture) override {
        if (fixture->GetBody() != own) into->push_back(fixture);
        return true;
      }
      const b2Body* own = nullptr;
      std::vector<b2Fixture*>* into = nullptr;
    } collector;
    collector.own = r.body;
    collector.into = &r.candidates;
    r.candidates.clear();
    r.candidates_reach_m = limit_m + kCandidateMargin_m;
    const float reach = static_cast<float>(r.candidates_reach_m) * kScaleF;
    b2AABB wide = box;
    wide.lowerBound -= b2Vec2(reach, reach);
    wide.upperBound += b2Vec2(reach, reach);
    impl_->world.QueryAABB(&collector, wide);
  }
  double least_m = limit_m;
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < r.candidates.size(); ++i) {
    b2Fixture* candidate = r.candidates[i];
    // Two cheap lower bounds, by the boxes (a little fat) and along the direction of the last
    // nearest points, mostly say enough.
    const b2AABB& theirs = candidate->GetAABB(0);
    const b2Vec2 gap =
        b2Max(b2Max(theirs.lowerBound - box.upperBound, box.lowerBound - theirs.upperBound),
              b2Vec2(0.0F, 0.0F));
    const double boxes_apart_m = metres(gap.Length());
    if (boxes_apart_m >= least_m) continue;
    const b2Transform& xf = r.body->GetTransform();
    const b2Transform& their_xf = candidate->GetBody()->GetTransform();
    const float apart = least_along(r.nearest_direction, *candidate->GetShape(), their_xf) +
                        least_along(-r.nearest_direction, r.shape, xf);
    const double bound_m = std::max(boxes_apart_m, metres(apart));
    if (bound_m >= least_m) continue;
    if (bound_m >= exact_below_m) {
      least_m = bound_m;
      continue;
    }
    b2DistanceInput input;
    input.proxyA.Set(&r.shape, 0);
    input.proxyB.Set(candidate->GetShape(), 0);
    input.transformA = xf;
    input.transformB = their_xf;
    input.useRadii = false;
    b2SimplexCache cache;
    cache.count = 0;
    b2DistanceOutput output;
    b2Distance(&output, &cache, &input);
    if (metres(output.distance) >= least_m) continue;
    if (output.distance > 0.0F) {
      r.nearest_direction = (1.0F / output.distance) * (output.pointB - output.pointA);
    }
    least_m = metres(output.distance);
    nearest = i;
  }
  if (nearest > 0) std::swap(r.candidates[0], r.candidates[nearest]);
  r.free_m = least_m;
  return least_m;
}

namespace {

// Appends the edges of list[first, last) that stand higher than the sensor, relative to it.
void append_edges(const EdgeList& list, std::size_t first, std::size_t last, const Vec2& p_WL,
                  double sensor_height_m, scan::EdgeBuffer& out) {
  const std::size_t begin = out.size();
  const bool all_high_enough = list.least_height_m > sensor_height_m;
  scan::Edge* target = out.append(last - first);
  const double x = p_WL.x();
  const double y = p_WL.y();
  std::size_t count = 0;
  for (std::size_t i = first; i < last; ++i) {
    if (!all_high_enough && list.heights_m[i] <= sensor_height_m) continue;
    const Edge& e = list.edges[i];
    target[count++] = {static_cast<float>(e.x0 - x), static_cast<float>(e.y0 - y),
                       static_cast<float>(e.x1 - x), static_cast<float>(e.y1 - y)};
  }
  out.truncate(begin + count);
}

// The same without the edges that face away from the sensor. Those that the scan kernel cannot
// tell about, in single precision, are kept.
void append_facing_edges(const EdgeList& list, std::size_t first, std::size_t last,
                         const Vec2& p_WL, double sensor_height_m, scan::EdgeBuffer& out) {
  constexpr double kDoubt = 1e-6;
  const std::size_t begin = out.size();
  scan::Edge* target = out.append(last - first);
  std::size_t count = 0;
  for (std::size_t i = first; i < last; ++i) {
    if (list.heights_m[i] <= sensor_height_m) continue;
    const Edge& e = list.edges[i];
    const double x0 = e.x0 - p_WL.x();
    const double y0 = e.y0 - p_WL.y();
    const double x1 = e.x1 - p_WL.x();
    const double y1 = e.y1 - p_WL.y();
    const double a = x0 * y1;
    const double b = y0 * x1;
    target[count] = {static_cast<float>(x0), static_cast<float>(y0), static_cast<float>(x1),
                     static_cast<float>(y1)};
    count += a - b < kDoubt * (std::abs(a) + std::abs(b)) ? 1 : 0;
  }
  out.truncate(begin + count);
}

// Calls visit(fixture) for every fixture whose fat box meets the box.
template <typename Visitor>
void query(const b2World& world, const Vec2& low, const Vec2& high, Visitor visit) {
  struct Callback : b2QueryCallback {
    explicit Callback(Visitor& v) : visitor(v) {}
    bool ReportFixture(b2Fixture* fixture) override {
      visitor(*fixture);
      return true;
    }
    Visitor& visitor;
  } callback(visit);
  b2AABB box;
  box.lowerBound = to_box2d(low);
  box.upperBound = to_box2d(high);
  world.QueryAABB(&callback, box);
}

}  // namespace

void PhysicsWorld::Impl::collect_static_edges(const Vec2& p_WL, double radius_m,
                                              double sensor_height_m, scan::EdgeBuffer& edges) {
  edges.clear();
  if (sweep) {
    append_edges(fixed_edges, 0, fixed_edges.edges.size(), p_WL, sensor_height_m, edges);
    return;
  }
  const Vec2 reach(radius_m, radius_m);
  query(world, p_WL - reach, p_WL + reach, [&](const b2Fixture& fixture) {
    const FixtureInfo& info = info_of(&fixture);
    if (info.kind == Contact::Kind::kRobot) return;
    append_edges(all_edges, info.first_edge, info.first_edge + info.edge_count, p_WL,
                 sensor_height_m, edges);
  });
}

void PhysicsWorld::collect_edges(const Vec2& p_WL, double radius_m, double sensor_height_m,
                                 int own_robot, bool test_inside, scan::EdgeBuffer& edges) const {
  Impl& d = *impl_;
  d.collect_static_edges(p_WL, radius_m, sensor_height_m, edges);
  if (!d.robot_edges_fresh) d.rebuild_robot_edges();
  for (std::size_t i = 0; i < d.robots.size(); ++i) {
    if (static_cast<int>(i) == own_robot) continue;
    const Robot& r = d.robots[i];
    const double reach = radius_m + r.seen_radius_m;
    if ((r.X_WB.position() - p_WL).squaredNorm() > reach * reach) continue;
    append_edges(d.robot_edges, d.robot_first_edge[i], d.robot_first_edge[i + 1], p_WL,
                 sensor_height_m, edges);
  }
  if (test_inside) edges.inside = d.inside_solid(p_WL, sensor_height_m, own_robot);
}

void PhysicsWorld::scan(const scan::ScanGeometry& geometry, const Pose& X_WL,
                        double sensor_height_m, int own_robot, bool test_inside,
                        std::span<double> ranges_m) const {
  Impl& d = *impl_;
  if (!d.robot_edges_fresh) d.rebuild_robot_edges();
  scan::ScanKernel& kernel = d.kernel_of(geometry);
  scan::EdgeBuffer& edges = d.scan_edges;
  const Vec2 p_WL = X_WL.position();
  const auto append = [&](std::span<const std::int32_t> robots) {
    for (const std::int32_t robot : robots) {
      if (robot == own_robot) continue;
      const auto i = static_cast<std::size_t>(robot);
      append_facing_edges(d.robot_edges, d.robot_first_edge[i], d.robot_first_edge[i + 1], p_WL,
                          sensor_height_m, edges);
    }
  };

  d.collect_static_edges(p_WL, geometry.range_max_m, sensor_height_m, edges);
  if (test_inside) edges.inside = d.inside_solid(p_WL, sensor_height_m, own_robot);
  kernel.begin(X_WL.yaw_rad);
  kernel.locate(d.robot_discs, static_cast<float>(p_WL.x()), static_cast<float>(p_WL.y()));
  append(kernel.in_view(0));
  kernel.add(edges);
  for (int ring = 1; ring < scan::ScanKernel::kRings; ++ring) {
    if (kernel.in_view(ring).empty()) continue;
    edges.clear();
    append(kernel.visible(ring));
    if (edges.size() > 0) kernel.add(edges);
  }
  kernel.finish(ranges_m);
}

void PhysicsWorld::collect_faces(const Vec2& low, const Vec2& high, int own_robot,
                                 std::vector<Face>& faces) const {
  Impl& d = *impl_;
  faces.clear();
  if (!d.robot_edges_fresh) d.rebuild_robot_edges();
  const auto add = [&](const EdgeList& list, std::size_t first, std::size_t last,
                       Contact::Kind kind, int index, double height_m) {
    for (std::size_t i = first; i < last; ++i) {
      const Edge& e = list.edges[i];
      if (std::max(e.x0, e.x1) < low.x() || std::min(e.x0, e.x1) > high.x()) continue;
      if (std::max(e.y0, e.y1) < low.y() || std::min(e.y0, e.y1) > high.y()) continue;
      faces.push_back({kind, index, height_m, {e.x0, e.y0}, {e.x1, e.y1}});
    }
  };
  query(d.world, low, high, [&](const b2Fixture& fixture) {
    const FixtureInfo& info = info_of(&fixture);
    if (info.kind == Contact::Kind::kRobot) return;
    add(d.all_edges, info.first_edge, info.first_edge + info.edge_count, info.kind, info.index,
        info.height_m);
  });
  for (std::size_t i = 0; i < d.robots.size(); ++i) {
    const int robot = static_cast<int>(i);
    if (robot == own_robot) continue;
    const Robot& r = d.robots[i];
    const std::size_t first = d.robot_first_edge[i];
    const std::size_t load = d.robot_first_edge[i + 1] - r.load_obstacles.size();
    add(d.robot_edges, first, load, Contact::Kind::kRobot, robot, r.height_m);
    for (std::size_t k = 0; k < r.load_obstacles.size(); ++k) {
      add(d.robot_edges, load + k, load + k + 1, Contact::Kind::kObstacle, r.load_obstacles[k],
          r.load.heights_m[k]);
    }
  }
}

bool PhysicsWorld::is_inside_solid(const Vec2& p_W, double height_m, int own_robot) const {
  return impl_->inside_solid(p_W, height_m, own_robot);
}

bool PhysicsWorld::is_line_free(const Vec2& p_WA, const Vec2& p_WC, double height_m, int own_robot,
                                const Contact& target) const {
  struct Blocked : b2RayCastCallback {
    float ReportFixture(b2Fixture* fixture, const b2Vec2&, const b2Vec2&, float) override {
      const FixtureInfo& info = info_of(fixture);
      const bool own = info.kind == Contact::Kind::kRobot && info.index == own_robot;
      const bool wanted = info.kind == target_kind && info.index == target_index;
      if (own || wanted || info.height_m <= height_m) return -1.0F;
      blocked = true;
      return 0.0F;
    }
    double height_m = 0.0;
    int own_robot = -1;
    Contact::Kind target_kind = Contact::Kind::kRobot;
    int target_index = -1;
    bool blocked = false;
  } callback;
  callback.height_m = height_m;
  callback.own_robot = own_robot;
  callback.target_kind = target.kind;
  callback.target_index = target.index;
  // Box2D takes no line without a length.
  if ((p_WC - p_WA).squaredNorm() <= 0.0) return true;
  impl_->world.RayCast(&callback, to_box2d(p_WA), to_box2d(p_WC));
  return !callback.blocked;
}

bool PhysicsWorld::Impl::inside_solid(const Vec2& p_W, double height_m, int own_robot) {
  bool inside = false;
  query(world, p_W, p_W, [&](b2Fixture& fixture) {
    const FixtureInfo& info = info_of(&fixture);
    if (info.height_m <= height_m) return;
    if (info.kind == Contact::Kind::kRobot && info.index == own_robot) return;
    inside = inside || fixture.TestPoint(to_box2d(p_W));
  });
  if (inside || !has_walls) return inside;
  // Walls of a map are closed outlines: inside where a ray to the far right crosses an odd number
  // of them (half-open rule at vertices).
  int crossings = 0;
  query(world, p_W, {wall_right_m, p_W.y()}, [&](const b2Fixture& fixture) {
    const FixtureInfo& info = info_of(&fixture);
    if (info.kind != Contact::Kind::kWall) return;
    const Edge& e = all_edges.edges[info.first_edge];
    if ((e.y0 > p_W.y()) == (e.y1 > p_W.y())) return;
    const double x = e.x0 + (p_W.y() - e.y0) / (e.y1 - e.y0) * (e.x1 - e.x0);
    if (x > p_W.x()) ++crossings;
  });
  return crossings % 2 == 1;
}

void PhysicsWorld::hash(StateHash& hash) const {
  for (const Robot& r : impl_->robots) {
    for (const double x : {r.X_WB.x_m, r.X_WB.y_m, r.X_WB.yaw_rad, r.stall_clock_s, r.target.v_mps,
                           r.target.omega_radps}) {
      hash.add(x);
    }
    const b2Body& body = *r.body;
    for (const float x :
         {body.GetPosition().x, body.GetPosition().y, body.GetAngle(), body.GetLinearVelocity().x,
          body.GetLinearVelocity().y, body.GetAngularVelocity()}) {
      hash.add(static_cast<double>(x));
    }
    for (const b2ContactEdge* e = body.GetContactList(); e != nullptr; e = e->next) {
      hash.add(e->contact->IsTouching());
      const b2Manifold& manifold = *e->contact->GetManifold();
      for (int32 i = 0; i < manifold.pointCount; ++i) {
        hash.add(static_cast<double>(manifold.points[i].normalImpulse));
      }
    }
    if (r.target.lateral_mps != 0.0) hash.add(r.target.lateral_mps);
    if (r.suspended) hash.add(std::string_view("suspended"));
  }
  for (const b2Body* body : impl_->obstacle_bodies) hash.add(body->IsEnabled());
}

double PhysicsWorld::ray_cast_m(const Vec2& p_WL, double angle_rad, double range_max_m,
                                int own_robot) const {
  struct Closest : b2RayCastCallback {
    const b2Body* own = nullptr;
    float fraction = 1.0F;
    float ReportFixture(b2Fixture* fixture, const b2Vec2&, const b2Vec2&, float f) override {
      if (fixture->GetBody() == own) return -1.0F;
      fraction = f;
      return f;
    }
  } closest;
  if (own_robot >= 0) closest.own = impl_->robots[static_cast<std::size_t>(own_robot)].body;
  const Vec2 end = p_WL + range_max_m * Vec2(std::cos(angle_rad), std::sin(angle_rad));
  impl_->world.RayCast(&closest, to_box2d(p_WL), to_box2d(end));
  return static_cast<double>(closest.fraction) * range_max_m;
}

void PhysicsWorld::bare_step(double dt_s) {
  for (Robot& r : impl_->robots) {
    const double yaw = static_cast<double>(r.body->GetAngle());
    r.body->SetLinearVelocity(
        to_box2d({r.target.v_mps * std::cos(yaw), r.target.v_mps * std::sin(yaw)}));
    r.body->SetAngularVelocity(static_cast<float>(r.target.omega_radps));
  }
  impl_->world.Step(static_cast<float>(dt_s), kVelocityIterations, kPositionIterations);
}

std::string partner_name(const PhysicsWorld::Contact& contact, const WorldDescription& world) {
  const auto index = static_cast<std::size_t>(contact.index);
  switch (contact.kind) {
    case PhysicsWorld::Contact::Kind::kObstacle:
      return world.arena.obstacles[index].name;
    case PhysicsWorld::Contact::Kind::kSeparator:
      return world.arena.dock_separators[index].name;
    case PhysicsWorld::Contact::Kind::kBorder:
      return "border";
    case PhysicsWorld::Contact::Kind::kWall:
      return "wall";
    case PhysicsWorld::Contact::Kind::kRobot:
      break;
  }
  return world.robots[index].name;
}

}  // namespace sim
