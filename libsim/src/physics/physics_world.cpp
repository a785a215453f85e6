// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "physics/physics_world.h"

#include <box2d/box2d.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <deque>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "physics/feasible_twist.h"
#include "physics/hilbert_curve.h"
#include "physics/shapes.h"
#include "sim/core/assert.h"

namespace sim {
namespace {

// Box2D keeps the hulls of touching polygons apart by their two skins less the slop.
constexpr double kRestingGap_m = (2.0 * b2_polygonRadius - b2_linearSlop) / kScale;

// Nearer than this they touch, to Box2D.
constexpr double kTouchingGap_m = 2.0 * b2_polygonRadius / kScale;

// By so much a gap may be less after a part of a step than the constraints say, as they are linear.
constexpr double kSecondOrder_m = 0.0003;

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

// How far round a robot whose pace is slow things are looked for as if it were this [m a part of a
// step]: enough for all that touches.
constexpr double kLeastTravel_m = 0.25 * kMaxTravel_m;

// Two robots are a pair while no more than this is between the circles round them, and all move.
constexpr double kPairReach_m = 0.2;

// Of a distance that is not known yet.
constexpr double kUnknown = -std::numeric_limits<double>::infinity();

// How far round a robot walls are looked for, and from where on how near the circle round it comes
// to them says enough.
constexpr double kWallSearch_m = 0.25;
constexpr double kRoughWall_m = 0.05;

// For so many parts of a step Box2D keeps the body of a robot that nothing hinders any more.
constexpr std::uint8_t kKeptParts = 5;

constexpr int kVelocityIterations = 8;
constexpr int kPositionIterations = 3;

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

// Something near a robot that does not move.
struct Wall {
  const b2Shape* shape = nullptr;
  b2SimplexCache cache{};  // of its and the robot's nearest points
  bool is_edge = false;    // of a map, whose start, direction and length are:
  Vec2 start = Vec2::Zero();
  Vec2 along = Vec2::UnitX();
  double length_m = 0.0;
};

// Something solid that may be the nearest to a robot.
struct Candidate {
  const b2Shape* shape;
  int robot;             // -1: none, but something that does not move
  b2AABB box;            // round it, if it does not move
  b2SimplexCache cache;  // of its and the robot's nearest points
};

// What of a robot is asked for less often.
struct RobotDetails {
  b2PolygonShape shape;
  b2PolygonShape reaching_shape;  // the same with a wide skin, which finds contacts ahead
  FixtureInfo* info = nullptr;
  double height_m = 0.0;
  double mass_kg = 0.0;
  double inertia_kgm2 = 0.0;
  std::vector<Candidate> candidates;  // all that is nearer than candidates_reach_m
  b2Vec2 nearest_direction{1.0F, 0.0F};
  double candidates_reach_m = -1.0;  // when all had gone candidates_gone_m; see clearance_m
  double candidates_gone_m = 0.0;
  std::vector<Wall> walls;  // all that it may be near to before it has gone so far:
  double walls_until_m = kUnknown;
  std::vector<int> touching;        // contacts per partner, see count_contact
  EdgeList load;                    // outlines of what it carries, in B
  std::vector<int> load_obstacles;  // whose each of these edges is
  double seen_radius_m = 0.0;       // of the footprint and the load about B
};

struct alignas(64) Robot {
  // What is asked for most often comes first: one line of the cache, then some others.
  b2Body* body = nullptr;  // none while nothing hinders it
  Twist target;
  double radius_m = 0.0;           // of the footprint about B
  double gone_m = 0.0;             // in all: any point of it, at most
  double wall_until_m = kUnknown;  // nothing solid but robots is reached before it has gone so far
  bool suspended = false;
  bool shoving = false;         // touches another, or one that does is near
  std::uint8_t kept_parts = 0;  // of a step, for which Box2D keeps the body
  DriveKind drive = DriveKind::kDifferential;

  Pose X_WB;             // exact; yaw not wrapped, in step with the body's angle
  double moved_m = 0.0;  // in this part of a step: any point of it, at most
  double stall_clock_s = 0.0;
  double wall_gone_m = kUnknown;  // what it had gone when it looked for walls
  BodyState* state = nullptr;
  RobotDetails* details = nullptr;
};

// How far a robot's outline is off the line through an edge.
struct OffLine {
  double apart_m;    // below 0: across it
  b2Vec2 direction;  // to it
  bool exact;  // the edge is where the line is nearest: so far the robot is from the edge, too
};

OffLine off_line(const Robot& r, const Wall& wall, const b2Transform& xf) {
  Vec2 normal(wall.along.y(), -wall.along.x());
  if (normal.dot(r.X_WB.position() - wall.start) < 0.0) normal = -normal;
  const b2Vec2 n(static_cast<float>(normal.x()), static_cast<float>(normal.y()));
  const b2Vec2 local = b2MulT(xf.q, n);
  const b2PolygonShape& shape = r.details->shape;
  const b2Vec2* nearest = std::min_element(
      shape.m_vertices, shape.m_vertices + shape.m_count,
      [&](const b2Vec2& p, const b2Vec2& q) { return b2Dot(local, p) < b2Dot(local, q); });
  const b2Vec2 corner = b2Mul(xf, *nearest);
  const Vec2 off = Vec2(metres(corner.x), metres(corner.y)) - wall.start;
  const double way_m = wall.along.dot(off);
  const double apart_m = normal.dot(off);
  return {apart_m, -n, apart_m > 0.0 && way_m >= 0.0 && way_m <= wall.length_m};
}

// Whether a wall may be so near to a robot, by the circle round it.
bool may_reach(const Robot& r, const Wall& wall, double reach_m) {
  if (!wall.is_edge) return true;
  const Vec2 off = r.X_WB.position() - wall.start;
  const double way_m = wall.along.dot(off);
  const double past_m = std::max({0.0, -way_m, way_m - wall.length_m});
  const double aside_m = wall.along.x() * off.y() - wall.along.y() * off.x();
  const double within_m = reach_m + r.radius_m;
  return past_m * past_m + aside_m * aside_m < within_m * within_m;
}

// Where a robot's shape is.
b2Transform transform_of(const Robot& r) {
  if (r.body != nullptr) return r.body->GetTransform();
  return {to_box2d(r.X_WB.position()), b2Rot(static_cast<float>(r.X_WB.yaw_rad))};
}

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

// How far any corner of a robot gets in a direction of W, at most, by a twist as if it were
// straight.
double advance_m(const Robot& r, const b2Transform& xf, const b2Vec2& direction, const Twist& twist,
                 double dt_s) {
  const b2Vec2 n = b2MulT(xf.q, direction);
  float lever = -b2_maxFloat;  // about B, in the sense of the turn
  const float sense = twist.omega_radps < 0.0 ? -1.0F : 1.0F;
  for (int32 i = 0; i < r.details->shape.m_count; ++i) {
    lever = std::max(lever, sense * b2Cross(r.details->shape.m_vertices[i], n));
  }
  return (static_cast<double>(n.x) * twist.v_mps + static_cast<double>(n.y) * twist.lateral_mps +
          metres(lever) * std::abs(twist.omega_radps)) *
         dt_s;
}

// How far the circles round two robots are apart.
double circles_apart_m(const Robot& a, const Robot& b) {
  return std::max(0.0, (a.X_WB.position() - b.X_WB.position()).norm() - a.radius_m - b.radius_m);
}

const FixtureInfo& info_of(const b2Fixture* fixture) {
  return *reinterpret_cast<const FixtureInfo*>(
      const_cast<b2Fixture*>(fixture)->GetUserData().pointer);
}

// Contacts of a body, if there is one.
const b2ContactEdge* contact_list(const b2Body* body) {
  return body == nullptr ? nullptr : body->GetContactList();
}

// Calls visit(fixture) for everything but robots whose fat box meets the box.
template <typename Visitor>
void visit_fixed(const b2World& world, const b2AABB& box, Visitor visit) {
  struct Callback : b2QueryCallback {
    explicit Callback(Visitor& v) : visitor(v) {}
    bool ReportFixture(b2Fixture* fixture) override {
      if (info_of(fixture).kind != PhysicsWorld::Contact::Kind::kRobot) visitor(*fixture);
      return true;
    }
    Visitor& visitor;
  } callback(visit);
  world.QueryAABB(&callback, box);
}

template <typename Visitor>
void visit_fixed(const b2World& world, const Vec2& low, const Vec2& high, Visitor visit) {
  b2AABB box;
  box.lowerBound = to_box2d(low);
  box.upperBound = to_box2d(high);
  visit_fixed(world, box, visit);
}

// Two robots that may come near one another.
struct Pair {
  int first, second;
  double both_gone_m;    // when these two had gone so far together,
  double apart_m;        // so far apart they were, at least
  b2Vec2 direction;      // from the first to the second, between their nearest points
  b2SimplexCache cache;  // of these points
};

bool comes_before(const Pair& a, const Pair& b) {
  return a.first != b.first ? a.first < b.first : a.second < b.second;
}

// A robot in that order.
struct Spot {
  std::uint32_t place;
  int robot;
  double until_m;  // good until the robot has gone so far
};

// Of a robot and what it carries, in W.
struct Outline {
  Vec2 p_WB;
  double seen_radius_m;                                 // round it, of all
  std::array<Vec2, b2_maxPolygonVertices + 1> corners;  // of the robot, the first once more at last
  std::size_t count;                                    // of its edges
  double height_m;
  int robot;
  std::size_t first_load;  // the edges of what it carries, in load_edges
  std::size_t end_load;

  [[nodiscard]] Edge edge(std::size_t i) const {
    return {corners[i].x(), corners[i].y(), corners[i + 1].x(), corners[i + 1].y()};
  }
};

// Round a robot.
struct Circle {
  double x, y, radius;
  int robot;
};

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
      return b2TestOverlap(&shape, 0, &r.details->shape, 0, xf, transform_of(r));
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
    const b2Transform xf = transform_of(r);
    b2Manifold manifold;
    b2WorldManifold points;
    double sign = 1.0;  // the normal points from A to B
    if (other.GetType() == b2Shape::e_polygon) {
      const auto& polygon = static_cast<const b2PolygonShape&>(other);
      b2CollidePolygons(&manifold, &r.details->reaching_shape, xf, &polygon, other_xf);
      points.Initialize(&manifold, xf, r.details->reaching_shape.m_radius, other_xf,
                        polygon.m_radius);
    } else {
      const auto& edge = static_cast<const b2EdgeShape&>(other);
      b2CollideEdgeAndPolygon(&manifold, &edge, other_xf, &r.details->reaching_shape, xf);
      points.Initialize(&manifold, other_xf, edge.m_radius, xf, r.details->reaching_shape.m_radius);
      sign = -1.0;
    }
    if (manifold.pointCount == 0) return;
    const double nx = sign * static_cast<double>(points.normal.x);
    const double ny = sign * static_cast<double>(points.normal.y);
    const double c = std::cos(r.X_WB.yaw_rad);
    const double s = std::sin(r.X_WB.yaw_rad);
    const double skins = static_cast<double>(r.details->reaching_shape.m_radius + other.m_radius);
    for (int32 i = 0; i < manifold.pointCount; ++i) {
      const double gap_m = (static_cast<double>(points.separations[i]) + skins) / kScale;
      const double rx = metres(points.points[i].x) - r.X_WB.x_m;
      const double ry = metres(points.points[i].y) - r.X_WB.y_m;
      constraints.push_back({nx * c + ny * s, rx * ny - ry * nx,
                             share * std::max(0.0, gap_m - kRestingGap_m) / dt_s, ny * c - nx * s});
    }
  }

  // Gives Box2D a body for a robot, at rest.
  void put_into_box2d(Robot& r) {
    b2BodyDef def;
    def.type = b2_dynamicBody;
    def.position = to_box2d(r.X_WB.position());
    def.angle = static_cast<float>(r.X_WB.yaw_rad);
    r.body = world.CreateBody(&def);
    ++bodies;
    b2MassData unit;
    r.details->shape.ComputeMass(&unit, 1.0F);
    attach(r.body, r.details->shape, r.details->info,
           static_cast<float>(r.details->mass_kg) / unit.mass);
    center_mass_on_axle(*r.body);
    if (r.suspended) make_heavy(*r.body);
  }

  void take_out_of_box2d(Robot& r) {
    world.DestroyBody(r.body);
    r.body = nullptr;
    --bodies;
  }

  void keep_in_box2d(Robot& r) {
    if (r.body == nullptr) put_into_box2d(r);
    r.kept_parts = kKeptParts;
  }

  // A mass beside which all others are nothing, rather than a static body: contacts live on.
  static void make_heavy(b2Body& body) {
    constexpr float kMore = 1e9F;
    b2MassData mass;
    body.GetMassData(&mass);
    mass.mass *= kMore;
    mass.I *= kMore;
    body.SetMassData(&mass);
  }

  // Puts the robots in order of x.
  void sort_by_x() {
    if (order_fresh) return;
    order_fresh = true;
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
  }

  // Calls visit(circle) for the circle round every robot that may reach into a box, in order of x.
  template <typename Visitor>
  void for_robots_in(const Vec2& low, const Vec2& high, Visitor visit) {
    sort_by_x();
    auto it = std::partition_point(by_x.begin(), by_x.end(), [&](const Circle& c) {
      return c.x < low.x() - largest_radius_m;
    });
    for (; it != by_x.end() && it->x <= high.x() + largest_radius_m; ++it) {
      if (it->y + it->radius >= low.y() && it->y - it->radius <= high.y()) visit(*it);
    }
  }

  // Lists the pairs of robots that may come near one another before all have gone some way (as
  // Verlet's neighbour lists do, Phys. Rev. 159, 98, 1967), by a sweep over their order in x.
  void list_pairs() {
    pairs_before.swap(pairs);
    pairs.clear();
    pairs_until_m = gone_m + 0.5 * (kPairReach_m - 3.0 * kMaxTravel_m);
    sort_by_x();
    for (std::size_t i = 0; i < by_x.size(); ++i) {
      const Circle& a = by_x[i];
      const double farthest_x = a.x + a.radius + largest_radius_m + kPairReach_m;
      for (std::size_t j = i + 1; j < by_x.size() && by_x[j].x <= farthest_x; ++j) {
        const Circle& b = by_x[j];
        const double reach = a.radius + b.radius + kPairReach_m;
        const double dx = b.x - a.x;
        const double dy = b.y - a.y;
        if (dx * dx + dy * dy >= reach * reach) continue;
        pairs.push_back({std::min(a.robot, b.robot),
                         std::max(a.robot, b.robot),
                         0.0,
                         kUnknown,
                         {1.0F, 0.0F},
                         {}});
      }
    }
    std::sort(pairs.begin(), pairs.end(), comes_before);
    meet_before.swap(meet_gone_m);
    meet_gone_m.assign(pairs.size(), kUnknown);
    if (placed) return;
    // What is known of those that were listed before still holds.
    std::size_t before = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      while (before < pairs_before.size() && comes_before(pairs_before[before], pairs[i])) ++before;
      if (before == pairs_before.size() || comes_before(pairs[i], pairs_before[before])) continue;
      pairs[i] = pairs_before[before];
      meet_gone_m[i] = meet_before[before];
    }
  }

  // How far the outlines of a pair are apart, along its direction: a lower bound, exact up to
  // `enough_m`.
  [[nodiscard]] static double distance_m(const Robot& a, const Robot& b, double enough_m,
                                         Pair& pair) {
    // Two cheap lower bounds, by the circles round them and along the direction of the last nearest
    // points, mostly say enough.
    const double circles_m = circles_apart_m(a, b);
    if (circles_m > enough_m) {
      const Vec2 way = (b.X_WB.position() - a.X_WB.position()).normalized();
      pair.direction = {static_cast<float>(way.x()), static_cast<float>(way.y())};
      return circles_m;
    }
    const b2Transform xf_a = transform_of(a);
    const b2Transform xf_b = transform_of(b);
    const double along_m = metres(least_along(pair.direction, b.details->shape, xf_b) +
                                  least_along(-pair.direction, a.details->shape, xf_a));
    if (along_m > enough_m) return along_m;
    const b2DistanceOutput found =
        distance_between(a.details->shape, xf_a, b.details->shape, xf_b, pair.cache);
    if (found.distance > 0.0F) {
      pair.direction = (1.0F / found.distance) * (found.pointB - found.pointA);
    }
    return metres(found.distance);
  }

  // Finds the robots so close that they may reach one another, and how near walls are. What was put
  // somewhere may touch already, so Box2D gets all that something is near to.
  void find_near(double dt_s) {
    if (gone_m >= pairs_until_m) list_pairs();
    near_to.resize(robots.size());
    for (const NearPair& pair : near_pairs) {
      near_to[static_cast<std::size_t>(pair.first)].clear();
      near_to[static_cast<std::size_t>(pair.second)].clear();
    }
    near_pairs.clear();
    const double in_the_way_m = 3.0 * travel_m;
    // Whether it may be so soon cannot be foreseen: to list first, without a branch, costs less.
    may_meet.resize(pairs.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      may_meet[count] = i;
      count += meet_gone_m[i] - gone_m <= 0.5 * in_the_way_m ? 1 : 0;
    }
    for (const std::size_t i : std::span(may_meet).first(count)) {
      Pair& pair = pairs[i];
      Robot& a = robots[static_cast<std::size_t>(pair.first)];
      Robot& b = robots[static_cast<std::size_t>(pair.second)];
      double apart_m = pair.apart_m - (a.gone_m + b.gone_m - pair.both_gone_m);
      if (apart_m > in_the_way_m) continue;
      // How near exactly need not be known while both can have their way.
      const double way_m = std::max(most_travel_m(a, dt_s), most_travel_m(b, dt_s));
      const double touch_m = 2.0 * way_m + kTouchingGap_m;
      if (pair.apart_m > in_the_way_m || a.shoving || b.shoving || apart_m <= touch_m) {
        apart_m = distance_m(a, b, pair.apart_m > in_the_way_m ? in_the_way_m : touch_m, pair);
        pair.apart_m = apart_m;
        meet_gone_m[i] = gone_m + 0.5 * apart_m;
        pair.both_gone_m = a.gone_m + b.gone_m;
        if (apart_m > in_the_way_m) continue;
      }
      if (placed) keep_in_box2d(a);
      if (placed) keep_in_box2d(b);
      near_pairs.push_back({pair.first, pair.second, apart_m, pair.direction});
    }
    for (const NearPair& pair : near_pairs) {
      near_to[static_cast<std::size_t>(pair.first)].push_back(
          {pair.second, pair.apart_m, pair.direction});
      near_to[static_cast<std::size_t>(pair.second)].push_back(
          {pair.first, pair.apart_m, -pair.direction});
    }
    for (Robot& r : robots) look_for_walls(r, dt_s);
  }

  // Finds out whether something that does not move is near a robot.
  void look_for_walls(Robot& r, double dt_s) {
    const double reach_m = wall_reach_m();
    double apart_m = r.wall_until_m - r.gone_m;
    if (apart_m > reach_m) return;
    const bool was_near = r.wall_until_m - r.wall_gone_m <= reach_m;
    // How near exactly need not be known while the robot can have its way.
    const double way_m = most_travel_m(r, dt_s) + kTouchingGap_m;
    if (apart_m <= (was_near ? way_m : reach_m) && r.gone_m != r.wall_gone_m) {
      apart_m = distance_to_walls_m(r);
      r.wall_until_m = r.gone_m + apart_m;
      r.wall_gone_m = r.gone_m;
    }
    if (placed && apart_m <= reach_m) keep_in_box2d(r);
  }

  // Nearer than this something that does not move may be in a robot's way.
  [[nodiscard]] double wall_reach_m() const { return 1.5 * travel_m + kRestingGap_m; }

  // Finds all that may come within reach_m of a robot that fills a box.
  void collect_candidates(Robot& r, const b2AABB& box, double reach_m) {
    r.details->candidates.clear();
    r.details->candidates_reach_m = reach_m;
    r.details->candidates_gone_m = gone_m;
    visit_fixed(world, grown(box, reach_m), [&](const b2Fixture& fixture) {
      r.details->candidates.push_back({fixture.GetShape(), -1, fixture.GetAABB(0), {}});
    });
    const Vec2 p_WB = r.X_WB.position();
    const Vec2 reach(r.radius_m + reach_m, r.radius_m + reach_m);
    for_robots_in(p_WB - reach, p_WB + reach, [&](const Circle& circle) {
      const Robot& other = robots[static_cast<std::size_t>(circle.robot)];
      if (&other == &r) return;
      r.details->candidates.push_back({&other.details->shape, circle.robot, {}, {}});
    });
  }

  [[nodiscard]] Wall wall_of(const b2Fixture& fixture) const {
    Wall wall;
    wall.shape = fixture.GetShape();
    const FixtureInfo& info = info_of(&fixture);
    if (info.kind != Contact::Kind::kWall) return wall;
    const Edge& edge = all_edges.edges[info.first_edge];
    const Vec2 way(edge.x1 - edge.x0, edge.y1 - edge.y0);
    wall.length_m = way.norm();
    if (wall.length_m <= 0.0) return wall;
    wall.is_edge = true;
    wall.start = {edge.x0, edge.y0};
    wall.along = way / wall.length_m;
    return wall;
  }

  // How near the nearest solid is to a robot's outline, robots apart: a lower bound, exact where it
  // matters; at most kWallSearch_m [m].
  [[nodiscard]] double distance_to_walls_m(Robot& r) {
    const b2Transform xf = transform_of(r);
    if (!(r.gone_m < r.details->walls_until_m)) {
      b2AABB box;
      r.details->shape.ComputeAABB(&box, xf, 0);
      r.details->walls.clear();
      r.details->walls_until_m = r.gone_m + kWallSearch_m;
      visit_fixed(world, grown(box, 2.0 * kWallSearch_m),
                  [&](const b2Fixture& fixture) { r.details->walls.push_back(wall_of(fixture)); });
    }
    double least_m = kWallSearch_m;
    for (Wall& wall : r.details->walls) {
      // Two cheap lower bounds, by the circle round the robot and by how far it is off the line,
      // mostly say enough.
      if (!may_reach(r, wall, least_m)) continue;
      if (wall.is_edge) {
        const OffLine off = off_line(r, wall, xf);
        if (off.exact || off.apart_m >= std::min(least_m, kRoughWall_m)) {
          least_m = std::min(least_m, off.apart_m);
          continue;
        }
        if (!may_reach(r, wall, kRoughWall_m)) {
          least_m = std::min(least_m, kRoughWall_m);
          continue;
        }
      }
      const b2DistanceOutput found =
          distance_between(r.details->shape, xf, *wall.shape, unmoved(), wall.cache);
      least_m = std::min(least_m, metres(found.distance));
    }
    return least_m;
  }

  // Whether a robot can have its way in this part of a step: it reaches nothing, and if others come
  // half as near as they are, they do not reach it. Not asked of robots that may be shoved.
  [[nodiscard]] bool is_free(std::size_t index, double dt_s) const {
    const Robot& r = robots[index];
    const double way_m = most_travel_m(r, dt_s);
    if (r.wall_until_m - r.gone_m <= way_m + kTouchingGap_m) return false;
    return std::all_of(near_to[index].begin(), near_to[index].end(), [&](const Neighbour& near) {
      const double share = robots[static_cast<std::size_t>(near.robot)].suspended ? 1.0 : 0.5;
      return share * (near.apart_m - kTouchingGap_m) > way_m;
    });
  }

  // Whether a contact is with something that does not move, and that is within reach.
  [[nodiscard]] bool is_near_wall(const Robot& r, const b2Contact& contact) const {
    const b2Fixture* other = contact.GetFixtureA();
    if (other->GetBody() == r.body) other = contact.GetFixtureB();
    if (info_of(other).kind == Contact::Kind::kRobot) return false;
    const b2Transform& xf = r.body->GetTransform();
    const double apart_m =
        metres(distance_between(r.details->shape, xf, *other->GetShape(), unmoved()).distance);
    return apart_m <= wall_reach_m();
  }

  // Whether a robot that is shoved might run into something that it does not touch yet.
  [[nodiscard]] bool may_be_shoved_into(std::size_t index) const {
    const Robot& r = robots[index];
    for (const Neighbour& near : near_to[index]) {
      if (!touches(r.body, robots[static_cast<std::size_t>(near.robot)].body)) return true;
    }
    for (const b2ContactEdge* e = r.body->GetContactList(); e != nullptr; e = e->next) {
      if (!e->contact->IsTouching() && is_near_wall(r, *e->contact)) return true;
    }
    return false;
  }

  // Whether a robot that gets its target stays clear of a wall: of the line through its edge.
  [[nodiscard]] static bool keeps_off(const Robot& r, const Wall& wall, const b2Transform& xf,
                                      double dt_s) {
    const OffLine off = off_line(r, wall, xf);
    return off.apart_m > 0.0 && advance_m(r, xf, off.direction, r.target, dt_s) + kSecondOrder_m <=
                                    off.apart_m - kTouchingGap_m;
  }

  [[nodiscard]] Twist allowed_twist(std::size_t index, double dt_s) {
    Robot& r = robots[index];
    constraints.clear();
    if (r.target == Twist{}) return r.target;
    const double way_m = most_travel_m(r, dt_s);
    // What is farther away, or not that way, leaves the robot its target, and clear of it.
    const b2Transform xf = transform_of(r);
    const double reach_m = way_m + kTouchingGap_m + kSecondOrder_m;
    if (r.wall_until_m - r.gone_m <= reach_m) {
      for (const Wall& wall : r.details->walls) {
        if (!may_reach(r, wall, reach_m)) continue;
        if (wall.is_edge && keeps_off(r, wall, xf, dt_s)) continue;
        add_constraints(r, *wall.shape, unmoved(), 1.0, dt_s);
      }
    }
    for (const Neighbour& near : near_to[index]) {
      const Robot& other = robots[static_cast<std::size_t>(near.robot)];
      const double share = other.suspended ? 1.0 : 0.5;  // as good as a wall
      const double apart_m = near.apart_m - r.moved_m - other.moved_m;
      const double mine_m = share * (apart_m - kTouchingGap_m);
      if (mine_m > way_m) continue;
      if (apart_m > 0.0 &&
          advance_m(r, xf, near.direction, r.target, dt_s) + kSecondOrder_m <= mine_m) {
        continue;
      }
      // Pushing: Box2D's solver shares the momentum.
      if (!other.suspended && touches(r.body, other.body)) continue;
      add_constraints(r, other.details->shape, transform_of(other), share, dt_s);
    }
    if (constraints.empty()) return r.target;
    switch (r.drive) {
      case DriveKind::kOmnidirectional:
        return feasible_planar_twist(r.target, r.details->mass_kg, r.details->inertia_kgm2,
                                     constraints);
      case DriveKind::kCar:
        return feasible_share(r.target, constraints);
      case DriveKind::kDifferential:
        break;
    }
    return feasible_twist(r.target, r.details->mass_kg, r.details->inertia_kgm2, constraints);
  }

  [[nodiscard]] static bool touches(const b2Body* a, const b2Body* b) {
    if (b == nullptr) return false;
    for (const b2ContactEdge* e = contact_list(a); e != nullptr; e = e->next) {
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
    pairs_until_m = gone_m;
    for (Robot& r : robots) {
      r.wall_until_m = kUnknown;
      r.wall_gone_m = kUnknown;
      r.details->walls_until_m = kUnknown;
      r.details->candidates_reach_m = -1.0;
    }
  }

  // Moves all for a time in which no robot travels farther than kMaxTravel_m. Robots that are free,
  // or stay clear of all that is near, are done with at once, without Box2D; those that shove one
  // another take several parts.
  void advance(double dt_s, bool first, bool last) {
    find_near(dt_s);
    if (placed) {  // lets Box2D find the contacts of what was put somewhere since the last step
      world.Step(0.0F, 1, 1);
      placed = false;
    }
    goals.resize(robots.size());
    twists.resize(robots.size());
    farthest_m = 0.0;
    find_shoving();
    hindered.clear();
    for (std::size_t i = 0; i < robots.size(); ++i) {
      Robot& r = robots[i];
      r.moved_m = 0.0;
      if (first) r.state->travel_m = r.state->turn_rad = r.state->side_m = 0.0;
      if (r.shoving || !is_free(i, dt_s)) {
        hindered.push_back(i);
        continue;
      }
      move_freely(r, dt_s);
      if (last) finish_step(r, step_s);
    }
    std::erase_if(hindered, [&](std::size_t i) {
      Robot& r = robots[i];
      if (!r.shoving) {
        twists[i] = allowed_twist(i, dt_s);
        if (stays_clear(r, twists[i], dt_s)) {
          move_freely(r, dt_s);
          if (last) finish_step(r, step_s);
          return true;
        }
      }
      keep_in_box2d(r);
      for (const Neighbour& near : near_to[i]) {
        keep_in_box2d(robots[static_cast<std::size_t>(near.robot)]);
      }
      return false;
    });
    double shove_m = 0.0;
    for (const std::size_t i : shoving) shove_m = std::max(shove_m, most_travel_m(robots[i], dt_s));
    const int parts = std::max(1, static_cast<int>(std::ceil(shove_m / most_shove_m)));
    substep(dt_s / parts, dt_s);
    for (int i = 1; i < parts; ++i) substep(dt_s / parts, 0.0);
    if (last) {
      for (const std::size_t i : hindered) finish_step(robots[i], step_s);
    }
    gone_m += farthest_m;
    order_fresh = false;
  }

  // Whether a robot that is not free has its way after all: it touches nothing, and by the
  // constraints that were just found for it, it will not either.
  [[nodiscard]] bool stays_clear(const Robot& r, const Twist& allowed, double dt_s) const {
    if (allowed != r.target || r.target == Twist{}) return false;
    for (const b2ContactEdge* e = contact_list(r.body); e != nullptr; e = e->next) {
      if (e->contact->IsTouching()) return false;
    }
    const double spare = (kTouchingGap_m - kRestingGap_m + kSecondOrder_m) / dt_s;
    return std::all_of(constraints.begin(), constraints.end(), [&](const TwistConstraint& c) {
      return c.closing(allowed) + spare <= c.limit;
    });
  }

  // How far any point of a robot that gets its target travels, at most [m].
  [[nodiscard]] static double most_travel_m(const Robot& r, double dt_s) {
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
    for (const NearPair& pair : near_pairs) {
      if (!touches(robots[static_cast<std::size_t>(pair.first)].body,
                   robots[static_cast<std::size_t>(pair.second)].body)) {
        continue;
      }
      add(pair.first);
      add(pair.second);
    }
    most_shove_m = std::any_of(shoving.begin(), shoving.end(),
                               [this](std::size_t i) { return may_be_shoved_into(i); })
                       ? kMaxShove_m
                       : kMaxLoneShove_m;
    for (std::size_t i = 0; i < shoving.size(); ++i) {
      for (const Neighbour& near : near_to[shoving[i]]) add(near.robot);
    }
  }

  // To Box2D a free robot, if it knows it at all, is a body at rest that is put somewhere else.
  void move_freely(Robot& r, double dt_s) {
    if (r.body != nullptr) {
      if (--r.kept_parts == 0) {
        take_out_of_box2d(r);
      } else if (r.body->IsAwake()) {
        r.body->SetAwake(false);
      }
    }
    if (r.target == Twist{}) return;
    const Pose goal = arc_end(r.X_WB, r.target, dt_s);
    if (r.body != nullptr) {
      r.body->SetTransform(to_box2d(goal.position()), static_cast<float>(goal.yaw_rad));
    }
    arrive(r, goal, r.target, dt_s);
  }

  // Moves the robots that are hindered: those that shove by dt_s, the others by others_dt_s, in one
  // step of Box2D. In the first part that is all the time there is; then it is 0, and they rest.
  void substep(double dt_s, double others_dt_s) {
    if (bodies == 0) return;
    const float inv_dt = static_cast<float>(1.0 / dt_s);
    for (const std::size_t i : hindered) {
      Robot& r = robots[i];
      const double own_dt_s = r.shoving ? dt_s : others_dt_s;
      if (own_dt_s == 0.0) {
        r.body->SetAwake(false);
        continue;
      }
      if (others_dt_s > 0.0 && r.shoving) twists[i] = allowed_twist(i, others_dt_s);
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
      arrive(r, goal, twists[index], dt_s);
      return;
    }
    const Pose before = r.X_WB;
    r.X_WB = {metres(p.x), metres(p.y), static_cast<double>(angle)};
    const double turn = r.X_WB.yaw_rad - before.yaw_rad;
    const double heading = before.yaw_rad + 0.5 * turn;
    const double dx = r.X_WB.x_m - before.x_m;
    const double dy = r.X_WB.y_m - before.y_m;
    // The wheels' path is the arc whose chord this is.
    r.state->travel_m += (dx * std::cos(heading) + dy * std::sin(heading)) / sinc(0.5 * turn);
    r.state->side_m += dy * std::cos(heading) - dx * std::sin(heading);
    moved(r, std::hypot(dx, dy), turn);
  }

  // The robot is where its twist took it.
  void arrive(Robot& r, const Pose& goal, const Twist& twist, double dt_s) {
    r.X_WB = goal;
    const double travel = twist.v_mps * dt_s;
    const double side = twist.lateral_mps * dt_s;
    r.state->travel_m += travel;
    r.state->side_m += side;
    moved(r, side == 0.0 ? std::abs(travel) : std::hypot(travel, side), twist.omega_radps * dt_s);
  }

  // Books that a robot went so far and turned so much.
  void moved(Robot& r, double way_m, double turn_rad) {
    r.state->turn_rad += turn_rad;
    if (std::abs(r.X_WB.yaw_rad) > 8.0 * std::numbers::pi) unwind(r);
    const double most_m = way_m + std::abs(turn_rad) * r.radius_m;  // of any point of it
    r.gone_m += most_m;
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
    if (r.body == nullptr) return;
    r.body->SetTransform(r.body->GetPosition(), static_cast<float>(r.X_WB.yaw_rad));
  }

  static void finish_step(Robot& r, double dt_s) {
    BodyState& s = *r.state;
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

  // Puts the robots in the order in which a Hilbert curve meets them, so that those that follow one
  // another are near each other. Which way a robot went since it was put somewhere in it matters
  // little for a while.
  void sort_by_place() {
    constexpr double kWhile_m = 0.1;
    for (Spot& spot : by_place) {
      const Robot& r = robots[static_cast<std::size_t>(spot.robot)];
      if (r.gone_m < spot.until_m) continue;
      spot.place = along_hilbert_curve(r.X_WB.position());
      spot.until_m = r.gone_m + kWhile_m;
    }
    for (std::size_t i = 1; i < by_place.size(); ++i) {  // insertion sort: nearly sorted already
      const Spot moving = by_place[i];
      std::size_t j = i;
      for (; j > 0 && by_place[j - 1].place > moving.place; --j) by_place[j] = by_place[j - 1];
      by_place[j] = moving;
    }
  }

  void rebuild_outlines() {
    load_edges.clear();
    outlines.resize(robots.size());
    robot_discs.clear();
    sort_by_place();
    for (std::size_t k = 0; k < by_place.size(); ++k) {
      const Robot& r = robots[static_cast<std::size_t>(by_place[k].robot)];
      robot_discs.add(static_cast<float>(r.X_WB.x_m), static_cast<float>(r.X_WB.y_m),
                      static_cast<float>(r.details->seen_radius_m));
      const double c = std::cos(r.X_WB.yaw_rad);
      const double s = std::sin(r.X_WB.yaw_rad);
      Outline& outline = outlines[k];
      outline.count = static_cast<std::size_t>(r.details->shape.m_count);
      for (std::size_t i = 0; i < outline.count; ++i) {
        const double x = metres(r.details->shape.m_vertices[i].x);
        const double y = metres(r.details->shape.m_vertices[i].y);
        outline.corners[i] = {r.X_WB.x_m + c * x - s * y, r.X_WB.y_m + s * x + c * y};
      }
      outline.corners[outline.count] = outline.corners[0];
      outline.p_WB = r.X_WB.position();
      outline.seen_radius_m = r.details->seen_radius_m;
      outline.height_m = r.details->height_m;
      outline.robot = by_place[k].robot;
      outline.first_load = load_edges.edges.size();
      for (std::size_t i = 0; i < r.details->load.edges.size(); ++i) {
        const Edge& e = r.details->load.edges[i];
        load_edges.add({r.X_WB.x_m + c * e.x0 - s * e.y0, r.X_WB.y_m + s * e.x0 + c * e.y0,
                        r.X_WB.x_m + c * e.x1 - s * e.y1, r.X_WB.y_m + s * e.x1 + c * e.y1},
                       r.details->load.heights_m[i]);
      }
      outline.end_load = load_edges.edges.size();
    }
    robot_discs.group();
    outlines_fresh = true;
  }

  // Casts a ray from A to C at the robots that may(robot) lets: calls visit(fraction of the line)
  // for each that it meets from outside, until that returns false.
  template <typename Filter, typename Visitor>
  void cast_at_robots(const Vec2& p_WA, const Vec2& p_WC, Filter may, Visitor visit) {
    const Vec2 line = p_WC - p_WA;
    b2RayCastInput input;
    input.p1 = to_box2d(p_WA);
    input.p2 = to_box2d(p_WC);
    input.maxFraction = 1.0F;
    bool more = true;
    for_robots_in(p_WA.cwiseMin(p_WC), p_WA.cwiseMax(p_WC), [&](const Circle& circle) {
      if (!more) return;
      const Vec2 p_AB = Vec2(circle.x, circle.y) - p_WA;
      const double aside = line.x() * p_AB.y() - line.y() * p_AB.x();  // times the line's length
      if (aside * aside > circle.radius * circle.radius * line.squaredNorm()) return;
      if (!may(circle.robot)) return;
      const Robot& r = robots[static_cast<std::size_t>(circle.robot)];
      b2RayCastOutput output;
      if (!r.details->shape.RayCast(&output, input, transform_of(r), 0)) return;
      more = visit(output.fraction);
    });
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
    std::vector<int>& touching = robots[static_cast<std::size_t>(mine.index)].details->touching;
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
  EdgeList load_edges;
  std::vector<Outline> outlines;
  scan::DiscBuffer robot_discs;           // round them
  std::vector<Spot> by_place;             // the order of both
  std::vector<scan::ScanKernel> kernels;  // of scan(), one a geometry
  scan::EdgeBuffer scan_edges;            // scratch memory of scan()
  bool outlines_fresh = false;

  bool placed = true;  // something was put somewhere since the last step

  std::vector<Robot> robots;
  std::deque<BodyState> states;      // of them
  std::deque<RobotDetails> details;  // likewise
  double largest_radius_m = 0.0;
  std::vector<Circle> by_x;  // round the robots, in this order
  bool order_fresh = false;
  std::vector<Pair> pairs;  // all that may come near before gone_m is pairs_until_m, in order
  std::vector<double> meet_gone_m;  // when any robot has gone so far, each of them may meet
  std::vector<Pair> pairs_before;   // the same as they were listed before
  std::vector<double> meet_before;
  std::vector<std::size_t> may_meet;  // those of them that may meet in this part of a step
  double pairs_until_m = 0.0;
  struct NearPair {
    int first, second;
    double apart_m;    // at least, when this part of a step began,
    b2Vec2 direction;  // along this, from the first to the second
  };
  std::vector<NearPair> near_pairs;  // of them, those that may be in each other's way
  struct Neighbour {
    int robot;
    double apart_m;
    b2Vec2 direction;  // towards it
  };
  std::vector<std::vector<Neighbour>> near_to;  // the same by robot, in the same order
  double step_s = 0.0;                          // the whole step under way
  double step_gone_m = 0.0;                     // how far any robot went in the last one, at most
  double travel_m = 0.0;    // of any robot in a part of a step that gets its target, at most
  double farthest_m = 0.0;  // that any robot has moved in this part of a step
  double gone_m = 0.0;      // the sum of it: so far any robot has gone, at most
  int bodies = 0;           // of robots that Box2D has
  std::vector<std::size_t> hindered;  // robots that are not free
  double most_shove_m = kMaxShove_m;
  std::vector<std::size_t> shoving;  // robots that touch others or are near such
  std::vector<Pose> goals;           // where hindered robots get to if nothing stops them
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
  r.state = &d.states.emplace_back();
  r.details = &d.details.emplace_back();
  r.details->shape = polygon_shape(model.footprint);
  r.details->reaching_shape = r.details->shape;
  r.details->reaching_shape.m_radius = static_cast<float>(3.0 * kMaxTravel_m) * kScaleF;
  r.drive = model.drive.kind;
  r.details->height_m = model.height_m;
  for (const Vec2& v : model.footprint) r.radius_m = std::max(r.radius_m, v.norm());
  r.details->seen_radius_m = r.radius_m;
  r.X_WB = X_WB;
  r.state->X_WB = {X_WB.x_m, X_WB.y_m, normalize_angle(X_WB.yaw_rad)};

  r.details->info = d.new_info(Contact::Kind::kRobot, index, model.height_m);
  r.details->mass_kg = model.mass_kg;
  d.keep_in_box2d(r);
  r.details->inertia_kgm2 = static_cast<double>(r.body->GetInertia()) / (kScale * kScale);

  d.largest_radius_m = std::max(d.largest_radius_m, r.radius_m);
  d.by_place.push_back({0, index, 0.0});
  d.by_x.push_back({X_WB.x_m, X_WB.y_m, r.radius_m, index});
  d.robots.push_back(std::move(r));
  d.order_fresh = false;
  d.something_was_placed();
  d.outlines_fresh = false;
  return index;
}

int PhysicsWorld::robot_count() const noexcept { return static_cast<int>(impl_->robots.size()); }

double PhysicsWorld::height_m(int robot) const {
  return impl_->robots[static_cast<std::size_t>(robot)].details->height_m;
}

void PhysicsWorld::set_target(int robot, const Twist& target) {
  Robot& r = impl_->robots[static_cast<std::size_t>(robot)];
  r.target = r.suspended ? Twist{} : target;
}

void PhysicsWorld::set_suspended(int robot, bool suspended) {
  Robot& r = impl_->robots[static_cast<std::size_t>(robot)];
  if (suspended == r.suspended) return;
  r.suspended = suspended;
  if (suspended) r.target = {};
  if (r.body == nullptr) return;
  if (!suspended) {
    r.body->ResetMassData();
    center_mass_on_axle(*r.body);
    return;
  }
  Impl::make_heavy(*r.body);
  r.body->SetLinearVelocity({0.0F, 0.0F});
  r.body->SetAngularVelocity(0.0F);
}

bool PhysicsWorld::suspended(int robot) const {
  return impl_->robots[static_cast<std::size_t>(robot)].suspended;
}

void PhysicsWorld::set_pose(int robot, const Pose& X_WB) {
  Robot& r = impl_->robots[static_cast<std::size_t>(robot)];
  r.X_WB = X_WB;
  for (Spot& spot : impl_->by_place) spot.until_m = 0.0;
  if (r.body != nullptr) {
    r.body->SetTransform(to_box2d(X_WB.position()), static_cast<float>(X_WB.yaw_rad));
    r.body->SetLinearVelocity({0.0F, 0.0F});
    r.body->SetAngularVelocity(0.0F);
    r.body->SetAwake(true);
  }
  *r.state = {};
  r.state->X_WB = {X_WB.x_m, X_WB.y_m, normalize_angle(X_WB.yaw_rad)};
  r.stall_clock_s = 0.0;
  impl_->outlines_fresh = false;
  impl_->order_fresh = false;
  impl_->something_was_placed();
}

void PhysicsWorld::step(double dt_s) {
  Impl& d = *impl_;
  d.contacts.clear();
  d.new_touches.clear();
  double travel_m = 0.0;
  for (const Robot& r : d.robots) travel_m = std::max(travel_m, Impl::most_travel_m(r, dt_s));
  const int parts = std::max(1, static_cast<int>(std::ceil(travel_m / kMaxTravel_m)));
  d.travel_m = std::max(travel_m / parts, kLeastTravel_m);
  d.step_s = dt_s;
  const double gone_m = d.gone_m;
  for (int i = 0; i < parts; ++i) d.advance(dt_s / parts, i == 0, i + 1 == parts);
  d.step_gone_m = d.gone_m - gone_m;
  d.outlines_fresh = false;
}

double PhysicsWorld::farthest_move_m() const noexcept { return impl_->step_gone_m; }

const BodyState& PhysicsWorld::body(int robot) const {
  return *impl_->robots[static_cast<std::size_t>(robot)].state;
}

const std::vector<PhysicsWorld::Contact>& PhysicsWorld::new_contacts() const noexcept {
  return impl_->contacts;
}

std::vector<PhysicsWorld::Contact> PhysicsWorld::contacts_of(int robot) const {
  std::vector<Contact> contacts;
  const b2Body* body = impl_->robots[static_cast<std::size_t>(robot)].body;
  for (const b2ContactEdge* e = contact_list(body); e != nullptr; e = e->next) {
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
  for (const b2ContactEdge* e = contact_list(body); e != nullptr; e = e->next) {
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
  r.details->load.clear();
  r.details->load_obstacles.clear();
  r.details->seen_radius_m = r.radius_m;
  for (const Load& load : loads) {
    const ObstacleDescription& box = load.box_B;
    const std::vector<Vec2> corners = box_corners(box);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2& a = corners[i];
      const Vec2& b = corners[(i + 1) % corners.size()];
      r.details->load.add({a.x(), a.y(), b.x(), b.y()}, box.height_m);
      r.details->load_obstacles.push_back(load.obstacle);
      r.details->seen_radius_m = std::max(r.details->seen_radius_m, a.norm());
    }
  }
  impl_->outlines_fresh = false;
}

int PhysicsWorld::robot_within(const ObstacleDescription& box) const {
  b2Transform here;
  here.SetIdentity();
  return impl_->robot_within(polygon_shape(box_corners(box)), here);
}

double PhysicsWorld::clearance_m(int robot, double limit_m, double exact_below_m) {
  Impl& d = *impl_;
  Robot& r = d.robots[static_cast<std::size_t>(robot)];
  const b2Transform xf = transform_of(r);
  b2AABB box;
  r.details->shape.ComputeAABB(&box, xf, 0);
  // What may be nearest is kept in a list that is good for some way (as Verlet's neighbour lists
  // are, Phys. Rev. 159, 98, 1967), most often the first of it. A list for a far greater limit is
  // too long.
  const double reach_m =
      r.details->candidates_reach_m - 2.0 * (d.gone_m - r.details->candidates_gone_m);
  if (limit_m > reach_m || reach_m > limit_m + 2.0 * kCandidateMargin_m) {
    d.collect_candidates(r, box, limit_m + kCandidateMargin_m);
  }
  double least_m = limit_m;
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < r.details->candidates.size(); ++i) {
    // Two cheap lower bounds, by what is round them and along the direction of the last nearest
    // points, mostly say enough.
    Candidate& candidate = r.details->candidates[i];
    const Robot* other =
        candidate.robot < 0 ? nullptr : &d.robots[static_cast<std::size_t>(candidate.robot)];
    const double boxes_apart_m =
        other == nullptr ? metres(gap_between(box, candidate.box)) : circles_apart_m(r, *other);
    if (boxes_apart_m >= least_m) continue;
    const b2Transform their_xf = other == nullptr ? unmoved() : transform_of(*other);
    const float apart = least_along(r.details->nearest_direction, *candidate.shape, their_xf) +
                        least_along(-r.details->nearest_direction, r.details->shape, xf);
    const double bound_m = std::max(boxes_apart_m, metres(apart));
    if (bound_m >= least_m) continue;
    if (bound_m >= exact_below_m) {
      least_m = bound_m;
      continue;
    }
    const b2DistanceOutput found =
        distance_between(r.details->shape, xf, *candidate.shape, their_xf, candidate.cache);
    if (metres(found.distance) >= least_m) continue;
    if (found.distance > 0.0F) {
      r.details->nearest_direction = (1.0F / found.distance) * (found.pointB - found.pointA);
    }
    least_m = metres(found.distance);
    nearest = i;
  }
  if (nearest > 0) std::swap(r.details->candidates[0], r.details->candidates[nearest]);
  return least_m;
}

namespace {

// Edges are many, so they are handled as one vector each.
using Four = double __attribute__((vector_size(4 * sizeof(double))));
using FourFloats = float __attribute__((vector_size(4 * sizeof(float))));

// Writes the edge between two points of W, which follow one another in memory, relative to
// `origin`.
void put_edge(scan::Edge* to, const double* points, const Four& origin) {
  static_assert(sizeof(scan::Edge) == sizeof(FourFloats));
  Four both;
  std::memcpy(&both, points, sizeof both);
  const FourFloats edge = __builtin_convertvector(both - origin, FourFloats);
  std::memcpy(&to->x0_m, &edge, sizeof edge);
}

// Appends the edges of list[first, last) that stand higher than the sensor, relative to it.
void append_edges(const EdgeList& list, std::size_t first, std::size_t last, const Vec2& p_WL,
                  double sensor_height_m, scan::EdgeBuffer& out) {
  static_assert(sizeof(Edge) == sizeof(Four));
  const std::size_t begin = out.size();
  const bool all_high_enough = list.least_height_m > sensor_height_m;
  scan::Edge* const target = out.append(last - first);
  const Four origin = {p_WL.x(), p_WL.y(), p_WL.x(), p_WL.y()};
  std::size_t count = 0;
  for (std::size_t i = first; i < last; ++i) {
    if (!all_high_enough && list.heights_m[i] <= sensor_height_m) continue;
    put_edge(target + count++, &list.edges[i].x0, origin);
  }
  out.truncate(begin + count);
}

// The same of a robot's outline.
void append_robot(const Outline& outline, const Vec2& p_WL, scan::EdgeBuffer& out) {
  static_assert(sizeof(Vec2) == 2 * sizeof(double));
  scan::Edge* const target = out.append(outline.count);
  const Four origin = {p_WL.x(), p_WL.y(), p_WL.x(), p_WL.y()};
  for (std::size_t i = 0; i < outline.count; ++i) {
    put_edge(target + i, outline.corners[i].data(), origin);
  }
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
  visit_fixed(world, p_WL - reach, p_WL + reach, [&](const b2Fixture& fixture) {
    const FixtureInfo& info = info_of(&fixture);
    append_edges(all_edges, info.first_edge, info.first_edge + info.edge_count, p_WL,
                 sensor_height_m, edges);
  });
}

void PhysicsWorld::collect_edges(const Vec2& p_WL, double radius_m, double sensor_height_m,
                                 int own_robot, bool test_inside, scan::EdgeBuffer& edges) const {
  Impl& d = *impl_;
  d.collect_static_edges(p_WL, radius_m, sensor_height_m, edges);
  if (!d.outlines_fresh) d.rebuild_outlines();
  for (const Outline& outline : d.outlines) {
    if (outline.robot == own_robot) continue;
    const double reach = radius_m + outline.seen_radius_m;
    if ((outline.p_WB - p_WL).squaredNorm() > reach * reach) continue;
    if (outline.height_m > sensor_height_m) {
      for (std::size_t i = 0; i < outline.count; ++i) {
        const Edge e = outline.edge(i);
        edges.add(static_cast<float>(e.x0 - p_WL.x()), static_cast<float>(e.y0 - p_WL.y()),
                  static_cast<float>(e.x1 - p_WL.x()), static_cast<float>(e.y1 - p_WL.y()));
      }
    }
    append_edges(d.load_edges, outline.first_load, outline.end_load, p_WL, sensor_height_m, edges);
  }
  if (test_inside) edges.inside = d.inside_solid(p_WL, sensor_height_m, own_robot);
}

void PhysicsWorld::scan(const scan::ScanGeometry& geometry, const Pose& X_WL,
                        double sensor_height_m, int own_robot, bool test_inside,
                        std::span<double> ranges_m) const {
  Impl& d = *impl_;
  if (!d.outlines_fresh) d.rebuild_outlines();
  scan::ScanKernel& kernel = d.kernel_of(geometry);
  scan::EdgeBuffer& edges = d.scan_edges;
  const Vec2 p_WL = X_WL.position();
  const auto append = [&](std::span<const std::int32_t> discs) {
    for (const std::int32_t disc : discs) {
      const Outline& outline = d.outlines[static_cast<std::size_t>(disc)];
      if (outline.robot == own_robot) continue;
      if (outline.height_m > sensor_height_m) append_robot(outline, p_WL, edges);
      if (outline.first_load == outline.end_load) continue;
      append_edges(d.load_edges, outline.first_load, outline.end_load, p_WL, sensor_height_m,
                   edges);
    }
  };

  d.collect_static_edges(p_WL, geometry.range_max_m, sensor_height_m, edges);
  if (test_inside) edges.inside = d.inside_solid(p_WL, sensor_height_m, own_robot);
  kernel.begin(X_WL.yaw_rad);
  kernel.locate(d.robot_discs, static_cast<float>(p_WL.x()), static_cast<float>(p_WL.y()));
  append(kernel.near());
  kernel.add(edges);
  edges.clear();
  append(kernel.visible());
  if (edges.size() > 0) kernel.add(edges);
  kernel.finish(ranges_m);
}

void PhysicsWorld::collect_faces(const Vec2& low, const Vec2& high, int own_robot,
                                 std::vector<Face>& faces) const {
  Impl& d = *impl_;
  faces.clear();
  if (!d.outlines_fresh) d.rebuild_outlines();
  const auto add = [&](const Edge& e, Contact::Kind kind, int index, double height_m) {
    if (std::max(e.x0, e.x1) < low.x() || std::min(e.x0, e.x1) > high.x()) return;
    if (std::max(e.y0, e.y1) < low.y() || std::min(e.y0, e.y1) > high.y()) return;
    faces.push_back({kind, index, height_m, {e.x0, e.y0}, {e.x1, e.y1}});
  };
  visit_fixed(d.world, low, high, [&](const b2Fixture& fixture) {
    const FixtureInfo& info = info_of(&fixture);
    for (std::size_t i = 0; i < info.edge_count; ++i) {
      add(d.all_edges.edges[info.first_edge + i], info.kind, info.index, info.height_m);
    }
  });
  for (const Outline& outline : d.outlines) {
    if (outline.robot == own_robot) continue;
    for (std::size_t i = 0; i < outline.count; ++i) {
      add(outline.edge(i), Contact::Kind::kRobot, outline.robot, outline.height_m);
    }
    const Robot& r = d.robots[static_cast<std::size_t>(outline.robot)];
    for (std::size_t i = outline.first_load; i < outline.end_load; ++i) {
      add(d.load_edges.edges[i], Contact::Kind::kObstacle,
          r.details->load_obstacles[i - outline.first_load], d.load_edges.heights_m[i]);
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
      const bool wanted = info.kind == target_kind && info.index == target_index;
      if (info.kind == Contact::Kind::kRobot || wanted || info.height_m <= height_m) return -1.0F;
      blocked = true;
      return 0.0F;
    }
    double height_m = 0.0;
    Contact::Kind target_kind = Contact::Kind::kRobot;
    int target_index = -1;
    bool blocked = false;
  } callback;
  callback.height_m = height_m;
  callback.target_kind = target.kind;
  callback.target_index = target.index;
  // Box2D takes no line without a length.
  if ((p_WC - p_WA).squaredNorm() <= 0.0) return true;
  // Robots first, which cost less to ask.
  const int target_robot = target.kind == Contact::Kind::kRobot ? target.index : -1;
  bool blocked = false;
  impl_->cast_at_robots(
      p_WA, p_WC,
      [&](int robot) {
        return robot != own_robot && robot != target_robot && this->height_m(robot) > height_m;
      },
      [&](float) {
        blocked = true;
        return false;
      });
  if (blocked) return false;
  impl_->world.RayCast(&callback, to_box2d(p_WA), to_box2d(p_WC));
  return !callback.blocked;
}

bool PhysicsWorld::Impl::inside_solid(const Vec2& p_W, double height_m, int own_robot) {
  bool inside = false;
  visit_fixed(world, p_W, p_W, [&](const b2Fixture& fixture) {
    if (info_of(&fixture).height_m <= height_m) return;
    inside = inside || fixture.TestPoint(to_box2d(p_W));
  });
  for_robots_in(p_W, p_W, [&](const Circle& circle) {
    const Robot& r = robots[static_cast<std::size_t>(circle.robot)];
    if (inside || circle.robot == own_robot || r.details->height_m <= height_m) return;
    inside = r.details->shape.TestPoint(transform_of(r), to_box2d(p_W));
  });
  if (inside || !has_walls) return inside;
  // Walls of a map are closed outlines: inside where a ray to the far right crosses an odd number
  // of them (half-open rule at vertices).
  int crossings = 0;
  visit_fixed(world, p_W, {wall_right_m, p_W.y()}, [&](const b2Fixture& fixture) {
    const FixtureInfo& info = info_of(&fixture);
    if (info.kind != Contact::Kind::kWall) return;
    const Edge& e = all_edges.edges[info.first_edge];
    if ((e.y0 > p_W.y()) == (e.y1 > p_W.y())) return;
    const double x = e.x0 + (p_W.y() - e.y0) / (e.y1 - e.y0) * (e.x1 - e.x0);
    if (x > p_W.x()) ++crossings;
  });
  return crossings % 2 == 1;
}

namespace {

void hash_body(const b2Body& body, StateHash& hash) {
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
}

}  // namespace

void PhysicsWorld::hash(StateHash& hash) const {
  for (const Robot& r : impl_->robots) {
    for (const double x : {r.X_WB.x_m, r.X_WB.y_m, r.X_WB.yaw_rad, r.stall_clock_s, r.target.v_mps,
                           r.target.omega_radps}) {
      hash.add(x);
    }
    if (r.body != nullptr) hash_body(*r.body, hash);
    if (r.target.lateral_mps != 0.0) hash.add(r.target.lateral_mps);
    if (r.suspended) hash.add(std::string_view("suspended"));
  }
  for (const b2Body* body : impl_->obstacle_bodies) hash.add(body->IsEnabled());
}

double PhysicsWorld::ray_cast_m(const Vec2& p_WL, double angle_rad, double range_max_m,
                                int own_robot) const {
  struct Closest : b2RayCastCallback {
    float fraction = 1.0F;
    float ReportFixture(b2Fixture* fixture, const b2Vec2&, const b2Vec2&, float f) override {
      if (info_of(fixture).kind == Contact::Kind::kRobot) return -1.0F;
      fraction = f;
      return f;
    }
  } closest;
  const Vec2 end = p_WL + range_max_m * Vec2(std::cos(angle_rad), std::sin(angle_rad));
  impl_->world.RayCast(&closest, to_box2d(p_WL), to_box2d(end));
  impl_->cast_at_robots(
      p_WL, end, [&](int robot) { return robot != own_robot; },
      [&](float fraction) {
        closest.fraction = std::min(closest.fraction, fraction);
        return true;
      });
  return static_cast<double>(closest.fraction) * range_max_m;
}

void PhysicsWorld::bare_step(double dt_s) {
  for (Robot& r : impl_->robots) {
    impl_->keep_in_box2d(r);
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
