// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "physics/bodies.h"

#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "sim/core/assert.h"
#include "sim/world/limits.h"
#include "sim/world/outline.h"

namespace sim::physics {
namespace {

// A robot that nothing hinders any more keeps its Box2D body for this many substeps.
constexpr std::uint8_t kSubstepsInBox2d = 5;

// Makes the body rotate around B, the axle's centre, as its wheels do: Box2D defines a body's
// velocity at its centre of mass. Outlines whose centre of mass is B, except for rounding, are not
// changed.
void center_mass_on_axle(b2Body& body) {
  constexpr float kRounding = 1e-4F;
  if (body.GetLocalCenter().Length() <= kRounding) return;
  b2MassData mass;
  body.GetMassData(&mass);
  mass.center.SetZero();
  body.SetMassData(&mass);
}

// Makes the body too heavy to be moved by others. A static body would have the same effect, but the
// change would end its contacts.
void make_heavy(b2Body& body) {
  constexpr float kMore = 1e9F;
  b2MassData mass;
  body.GetMassData(&mass);
  mass.mass *= kMore;
  mass.I *= kMore;
  body.SetMassData(&mass);
}

// Centre of a polygon's area.
Vec2 center_of_area(const Polygon& outline) {
  Vec2 sum = Vec2::Zero();
  double twice_area = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i] - outline[0];
    const Vec2 b = outline[(i + 1) % outline.size()] - outline[0];
    const double cross = a.x() * b.y() - a.y() * b.x();
    sum += cross * (a + b);
    twice_area += cross;
  }
  return outline[0] + sum / (3.0 * twice_area);
}

// Whether an outline is one polygon for Box2D. Otherwise Box2D has its sides as edges, as it has
// the walls of a map. Convex parts would not do for a concave outline: where two parts meet, Box2D
// would stop a robot that slides along the outline at the inner side of a part.
bool is_one_polygon(const std::vector<Vec2>& corners) {
  return corners.size() <= b2_maxPolygonVertices && is_convex(corners) &&
         least_extent_m(corners) >= kLeastLength_m;
}

}  // namespace

Bodies::Bodies(const ArenaDescription& arena)
    : world_(b2Vec2(0.0F, 0.0F)), separator_count_(arena.dock_separators.size()) {
  world_.SetAutoClearForces(false);    // no forces are ever applied
  world_.SetContinuousPhysics(false);  // kMaxTravel_m and feasible_twist prevent tunnelling
  b2BodyDef ground;
  static_body_ = world_.CreateBody(&ground);
  add_obstacles(arena);
  if (arena.border) add_border(arena);
  for (const WallLoop& loop : arena.walls) add_wall(loop);
}

FixtureInfo* Bodies::new_info(Contact::Kind kind, int index, double height_m) {
  infos_.push_back(std::make_unique<FixtureInfo>(FixtureInfo{kind, index, height_m}));
  infos_.back()->id = infos_.size() - 1;
  return infos_.back().get();
}

void Bodies::attach(b2Body* body, const b2Shape& shape, FixtureInfo* info, float density) {
  b2FixtureDef def;
  def.shape = &shape;
  def.density = density;
  def.friction = 0.0F;
  def.restitution = 0.0F;
  def.userData.pointer = reinterpret_cast<uintptr_t>(info);
  if (!info->solid) def.filter.maskBits = 0;
  body->CreateFixture(&def);
}

void Bodies::append_outline(FixtureInfo& info, const std::vector<Vec2>& vertices) {
  info.first_edge = edges_.edges.size();
  info.edge_count = vertices.size();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec2& a = vertices[i];
    const Vec2& b = vertices[(i + 1) % vertices.size()];
    edges_.add({a.x(), a.y(), b.x(), b.y()}, info.height_m, info.bottom_m);
  }
}

void Bodies::add_obstacle(const ObstacleDescription& o, Contact::Kind kind, int index) {
  const std::vector<Vec2> corners = corners_of(o);
  const auto new_part = [&] {
    FixtureInfo* info = new_info(kind, index, o.height_m);
    info->solid = o.solid;
    info->bottom_m = o.bottom_m;
    return info;
  };
  b2BodyDef def;  // a separate body, so that it can be disabled
  b2Body* body = world_.CreateBody(&def);
  Parts parts{infos_.size(), 1, o.shape};
  if (is_movable(o)) {
    parts.count = 0;
  } else if (o.shape == ObstacleShape::kCircle) {
    FixtureInfo* info = new_part();
    info->cylinder = static_cast<int>(cylinders_.size());
    cylinders_.push_back({o.center, radius_m(o), o.height_m, index, o.bottom_m, o.solid});
    attach(body, circle_shape(o.center, radius_m(o)), info, 0.0F);
  } else if (o.shape == ObstacleShape::kBox || is_one_polygon(corners)) {
    FixtureInfo* info = new_part();
    append_outline(*info, corners);
    attach(body, polygon_shape(corners), info, 0.0F);
  } else {
    parts.count = corners.size();
    edged_.push_back(obstacles_.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      FixtureInfo* info = new_part();
      const Vec2& a = corners[i];
      const Vec2& b = corners[(i + 1) % corners.size()];
      info->first_edge = edges_.edges.size();
      info->edge_count = 1;
      edges_.add({a.x(), a.y(), b.x(), b.y()}, info->height_m, info->bottom_m);
      attach(body, edge_shape(corners, i), info, 0.0F);
    }
  }
  body->SetEnabled(o.type == ObstacleType::kStatic || o.state == ObstacleState::kExtended);
  if (kind == Contact::Kind::kObstacle) {
    obstacles_.push_back(body);
    parts_.push_back(parts);
    body_of_.push_back(-1);
  }
}

void Bodies::add_obstacles(const ArenaDescription& arena) {
  for (std::size_t i = 0; i < arena.obstacles.size(); ++i) {
    add_obstacle(arena.obstacles[i], Contact::Kind::kObstacle, static_cast<int>(i));
  }
  for (std::size_t i = 0; i < arena.dock_separators.size(); ++i) {
    add_obstacle(arena.dock_separators[i], Contact::Kind::kSeparator, static_cast<int>(i));
  }
}

void Bodies::add_border(const ArenaDescription& arena) {
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
  // Seen from inside, edges that run clockwise around the floor have the solid on their left.
  const std::array<Edge, 4> faces = {
      {{x1, y0, x0, y0}, {x1, y1, x1, y0}, {x0, y1, x1, y1}, {x0, y0, x0, y1}}};
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    FixtureInfo* info = new_info(Contact::Kind::kBorder, -1, arena.border_height_m);
    info->first_edge = edges_.edges.size();
    info->edge_count = 1;
    edges_.add(faces[i], arena.border_height_m);
    attach(
        static_body_,
        polygon_shape(box_corners({boxes[i].first.x(), boxes[i].first.y(), 0.0}, boxes[i].second)),
        info, 0.0F);
  }
}

void Bodies::add_wall(const WallLoop& loop) {
  const std::size_t n = loop.vertices.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2& a = loop.vertices[i];
    const Vec2& b = loop.vertices[(i + 1) % n];
    FixtureInfo* info = new_info(Contact::Kind::kWall, -1, loop.height_m);
    info->solid = loop.solid;
    info->first_edge = edges_.edges.size();
    info->edge_count = 1;
    edges_.add({a.x(), a.y(), b.x(), b.y()}, info->height_m);
    attach(static_body_, edge_shape(loop.vertices, i), info, 0.0F);
    has_walls_ = true;
    wall_right_m_ = std::max({wall_right_m_, a.x(), b.x()});
  }
}

// The outline of an obstacle; empty for a circle.
std::vector<Vec2> Bodies::corners_of_parts(const Parts& parts) const {
  std::vector<Vec2> corners;
  for (std::size_t part = 0; part < parts.count; ++part) {
    const FixtureInfo& info = *infos_[parts.first_info + part];
    for (std::size_t i = 0; i < info.edge_count; ++i) {
      const Edge& edge = edges_.edges[info.first_edge + i];
      corners.emplace_back(edge.x0, edge.y0);
    }
  }
  return corners;
}

// Sets the edges that sensors see. All edges of an obstacle are adjacent.
void Bodies::set_corners(const Parts& parts, const std::vector<Vec2>& corners, double height_m) {
  const std::size_t first_edge = infos_[parts.first_info]->first_edge;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2& a = corners[i];
    const Vec2& b = corners[(i + 1) % corners.size()];
    edges_.edges[first_edge + i] = {a.x(), a.y(), b.x(), b.y()};
    edges_.heights_m[first_edge + i] = height_m;
  }
  if (!corners.empty()) edges_.least_height_m = std::min(edges_.least_height_m, height_m);
}

void Bodies::change_obstacle(int index, const ObstacleDescription& now) {
  if (const int moving = body_of(index); moving >= 0) {
    Body& r = at(moving);
    const Pose X_WO = pose_of(now);
    const Vec2 p_WB = X_WO * Vec2(-r.details->obstacle.p_BO);
    set_pose(r, {p_WB.x(), p_WB.y(), X_WO.yaw_rad});
    r.details->obstacle.v_WB.setZero();
    r.details->obstacle.omega_radps = 0.0;
    return;
  }
  b2Body& body = obstacle(index);
  const Parts& parts = parts_[static_cast<std::size_t>(index)];
  const std::vector<Vec2> corners = corners_of(now);
  set_corners(parts, corners, standing_height_m(now));
  while (b2Fixture* before = body.GetFixtureList()) body.DestroyFixture(before);
  for (std::size_t part = 0; part < parts.count; ++part) {
    FixtureInfo* info = infos_[parts.first_info + part].get();
    info->height_m = standing_height_m(now);
    if (info->cylinder >= 0) {
      cylinders_[static_cast<std::size_t>(info->cylinder)] = {
          now.center, radius_m(now), standing_height_m(now), index, now.bottom_m, now.solid};
      attach(&body, circle_shape(now.center, radius_m(now)), info, 0.0F);
    } else if (parts.count == 1) {
      attach(&body, polygon_shape(corners), info, 0.0F);
    } else {
      attach(&body, edge_shape(corners, part), info, 0.0F);
    }
  }
}

void Bodies::set_height(int index, double height_m) {
  const Parts& parts = parts_[static_cast<std::size_t>(index)];
  for (std::size_t part = 0; part < parts.count; ++part) {
    FixtureInfo& info = *infos_[parts.first_info + part];
    info.height_m = height_m;
    if (info.cylinder >= 0) cylinders_[static_cast<std::size_t>(info.cylinder)].height_m = height_m;
    const auto first = edges_.heights_m.begin() + static_cast<std::ptrdiff_t>(info.first_edge);
    std::fill_n(first, info.edge_count, height_m);
    if (info.edge_count > 0) edges_.least_height_m = std::min(edges_.least_height_m, height_m);
  }
}

int Bodies::add_robot(const RobotModel& model, const Pose& X_WB) {
  const int index = static_cast<int>(all_.size());
  Body r;
  r.state = &states_.emplace_back();
  r.details = &details_.emplace_back();
  const std::span<const Polygon> parts = body_parts(model);
  r.details->shape = polygon_shape(parts.front());
  for (const Polygon& part : parts.subspan(1)) {
    r.details->further.push_back(polygon_shape(part));
  }
  r.drive = model.drive.kind;
  r.details->height_m = model.height_m;
  for (const Polygon& part : parts) {
    for (const Vec2& v : part) r.radius_m = std::max(r.radius_m, v.norm());
  }
  r.details->own_radius_m = r.radius_m;
  r.details->superstructures = model.superstructures;
  for (const Superstructure& part : model.superstructures) {
    for (const Vec2& v : part.outline) {
      r.details->own_radius_m = std::max(r.details->own_radius_m, v.norm());
    }
  }
  if (!model.superstructures.empty()) with_superstructures_.push_back(index);
  r.details->seen_radius_m = r.details->own_radius_m;
  r.X_WB = X_WB;
  r.details->traction_arm_m =
      r.drive == DriveKind::kDifferential ? 0.5 * model.drive.wheel_separation_m : r.radius_m;
  r.details->info = new_info(Contact::Kind::kRobot, index, model.height_m);
  r.details->info->solid = model.solid;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    FixtureInfo* info = new_info(Contact::Kind::kRobot, index, model.height_m);
    info->body = index;
    info->part = i;
    info->solid = model.solid;
    r.details->further_infos.push_back(info);
  }
  has_parts_ = has_parts_ || parts.size() > 1;
  r.details->mass_kg = model.mass_kg;
  ++robot_count_;
  return add_body(std::move(r));
}

int Bodies::add_moving_obstacle(int index, const ObstacleDescription& o) {
  SIM_ASSERT(is_movable(o) && body_of(index) < 0);
  Body r;
  r.state = &states_.emplace_back();
  r.details = &details_.emplace_back();
  BodyDetails& d = *r.details;
  d.round = o.shape == ObstacleShape::kCircle;
  r.drive = DriveKind::kOmnidirectional;
  r.pushable = is_pushable(o);
  if (d.round) {
    r.radius_m = radius_m(o);
    d.disc = circle_shape(Vec2::Zero(), r.radius_m);
  } else {
    ObstacleDescription own = o;
    own.center.setZero();
    own.yaw_rad = 0.0;
    Polygon outline = corners_of(own);
    const Vec2 middle = center_of_area(outline);
    for (Vec2& p : outline) {
      p -= middle;
      r.radius_m = std::max(r.radius_m, p.norm());
    }
    d.obstacle.p_BO = -middle;
    d.shape = polygon_shape(outline);
  }
  d.height_m = o.height_m;
  d.own_radius_m = r.radius_m;
  d.seen_radius_m = r.radius_m;
  d.traction_arm_m = r.radius_m;
  const Pose X_WO = pose_of(o);
  const Vec2 p_WB = X_WO * Vec2(-d.obstacle.p_BO);
  r.X_WB = {p_WB.x(), p_WB.y(), X_WO.yaw_rad};
  d.mass_kg = o.mass_kg.value_or(kMovingObstacleMass_kg);
  d.info = new_info(Contact::Kind::kObstacle, index, o.height_m);
  d.info->solid = o.solid;
  if (d.round) {
    d.round_load.push_back({Vec2::Zero(), r.radius_m, d.height_m, index, o.bottom_m, o.solid});
  }
  has_pushable_ = has_pushable_ || r.pushable;
  if (r.pushable) d.obstacle.friction_mps2 = o.friction * kGravity_mps2;
  body_of_[static_cast<std::size_t>(index)] = static_cast<int>(all_.size());
  const int body = add_body(std::move(r));
  d.obstacle.friction_arm_m = 2.0 / 3.0 * std::sqrt(2.0 * d.inertia_kgm2 / d.mass_kg);
  return body;
}

// Adds a body that is complete except for what all bodies have in common.
int Bodies::add_body(Body&& r) {
  const int index = static_cast<int>(all_.size());
  r.state->X_WB = {r.X_WB.x_m, r.X_WB.y_m, normalize_angle(r.X_WB.yaw_rad)};
  r.details->info->body = index;
  ensure_box2d_body(r);
  r.details->inertia_kgm2 = static_cast<double>(r.body->GetInertia()) / (kScale * kScale);
  largest_radius_m_ = std::max(largest_radius_m_, r.radius_m);
  by_x_.push_back({r.X_WB.x_m, r.X_WB.y_m, r.radius_m, index});
  all_.push_back(std::move(r));
  order_fresh_ = false;
  return index;
}

int Bodies::body_of(const Contact& target) const {
  if (target.kind == Contact::Kind::kRobot) return target.index;
  if (target.kind != Contact::Kind::kObstacle || target.index < 0) return -1;
  return body_of(target.index);
}

Pose Bodies::obstacle_pose(const Body& r) {
  const Vec2& p_BO = r.details->obstacle.p_BO;
  if (p_BO.isZero(0.0)) return {r.X_WB.x_m, r.X_WB.y_m, normalize_angle(r.X_WB.yaw_rad)};
  const Vec2 p_WO = r.X_WB * p_BO;
  return {p_WO.x(), p_WO.y(), normalize_angle(r.X_WB.yaw_rad)};
}

std::vector<b2FrictionJoint*> Bodies::joints() const {
  std::vector<b2FrictionJoint*> joints;
  for (const Body& r : all_) {
    if (r.details->obstacle.joint != nullptr) joints.push_back(r.details->obstacle.joint);
  }
  return joints;
}

void Bodies::set_pose(Body& r, const Pose& X_WB) {
  r.X_WB = X_WB;
  if (r.body != nullptr) {
    r.body->SetTransform(to_box2d(X_WB.position()), static_cast<float>(X_WB.yaw_rad));
    r.body->SetLinearVelocity({0.0F, 0.0F});
    r.body->SetAngularVelocity(0.0F);
    r.body->SetAwake(true);
  }
  const Elevation elevation = r.state->elevation;
  *r.state = {};
  r.state->elevation = elevation;
  r.state->X_WB = {X_WB.x_m, X_WB.y_m, normalize_angle(X_WB.yaw_rad)};
  r.stall_clock_s = 0.0;
  order_fresh_ = false;
}

void Bodies::set_suspended(Body& r, bool suspended) {
  if (suspended == r.suspended) return;
  r.suspended = suspended;
  if (suspended) {
    r.target = {};
    r.details->obstacle.v_WB.setZero();
    r.details->obstacle.omega_radps = 0.0;
  }
  if (r.body == nullptr) return;
  if (!suspended) {
    r.body->ResetMassData();
    center_mass_on_axle(*r.body);
    return;
  }
  make_heavy(*r.body);
  r.body->SetLinearVelocity({0.0F, 0.0F});
  r.body->SetAngularVelocity(0.0F);
}

int Bodies::robot_within(const b2Shape& shape, const b2Transform& xf, int ignored) const {
  const auto it = std::find_if(all_.begin(), all_.end(), [&](const Body& r) {
    if (r.details->info->body == ignored || !r.details->info->solid) return false;
    for (std::size_t i = 0; i < r.details->part_count(); ++i) {
      if (overlap(shape, xf, r.details->part(i), transform_of(r))) return true;
    }
    return false;
  });
  return it == all_.end() ? -1 : static_cast<int>(it - all_.begin());
}

int Bodies::robot_within(const std::vector<Vec2>& outline, int ignored) const {
  const auto overlaps = [&outline, ignored](const Body& r) {
    if (r.details->info->body == ignored || !r.details->info->solid) return false;
    const b2Transform xf = transform_of(r);
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const b2EdgeShape side = edge_shape(outline, i);
      for (std::size_t k = 0; k < r.details->part_count(); ++k) {
        if (overlap(side, identity_transform(), r.details->part(k), xf)) return true;
      }
    }
    const auto is_within = [&](const b2Vec2& p_B) {
      const b2Vec2 point = b2Mul(xf, p_B);
      return is_inside(outline, {metres(point.x), metres(point.y)});
    };
    return is_within(r.details->round ? b2Vec2(0.0F, 0.0F) : r.details->shape.m_vertices[0]) ||
           std::any_of(r.details->further.begin(), r.details->further.end(),
                       [&](const b2PolygonShape& part) { return is_within(part.m_vertices[0]); });
  };
  const auto it = std::find_if(all_.begin(), all_.end(), overlaps);
  return it == all_.end() ? -1 : static_cast<int>(it - all_.begin());
}

int Bodies::robot_within(const ObstacleDescription& solid, int ignored) const {
  if (!solid.solid) return -1;
  if (solid.shape == ObstacleShape::kCircle) {
    return robot_within(circle_shape(solid.center, radius_m(solid)), identity_transform(), ignored);
  }
  const std::vector<Vec2> corners = corners_of(solid);
  if (solid.shape == ObstacleShape::kPolygon && !is_one_polygon(corners)) {
    return robot_within(corners, ignored);
  }
  return robot_within(polygon_shape(corners), identity_transform(), ignored);
}

int Bodies::robot_on(int index) const {
  const Parts& parts = parts_[static_cast<std::size_t>(index)];
  if (parts.count > 0 && !infos_[parts.first_info]->solid) return -1;
  if (parts.count > 1) return robot_within(corners_of_parts(parts), -1);
  const b2Body& block = obstacle(index);
  return robot_within(*block.GetFixtureList()->GetShape(), block.GetTransform(), -1);
}

bool Bodies::is_inside_edged(const Vec2& p_W, double height_m) const {
  for (const std::size_t i : edged_) {
    if (!obstacles_[i]->IsEnabled()) continue;
    const FixtureInfo& info = *infos_[parts_[i].first_info];
    if (!info.solid || !spans_height(info.bottom_m, info.height_m, height_m)) continue;
    if (is_inside(corners_of_parts(parts_[i]), p_W)) return true;
  }
  return false;
}

// Creates a Box2D body for a robot, at rest.
void Bodies::create_box2d_body(Body& r) {
  b2BodyDef def;
  def.type = b2_dynamicBody;
  def.position = to_box2d(r.X_WB.position());
  def.angle = static_cast<float>(r.X_WB.yaw_rad);
  r.body = world_.CreateBody(&def);
  ++in_box2d_;
  BodyDetails& d = *r.details;
  float area = 0.0F;
  for (std::size_t i = 0; i < d.part_count(); ++i) {
    b2MassData unit;
    d.part(i).ComputeMass(&unit, 1.0F);
    area += unit.mass;
  }
  const float density = static_cast<float>(d.mass_kg) / area;
  attach(r.body, d.solid(), d.info, density);
  for (std::size_t i = 0; i < d.further.size(); ++i) {
    attach(r.body, d.further[i], d.further_infos[i], density);
  }
  center_mass_on_axle(*r.body);
  if (r.suspended) make_heavy(*r.body);
  if (r.pushable) add_joint(r);
}

void Bodies::add_joint(Body& r) {
  b2FrictionJointDef def;
  def.Initialize(static_body_, r.body, r.body->GetPosition());
  def.collideConnected = true;
  r.details->obstacle.joint = static_cast<b2FrictionJoint*>(world_.CreateJoint(&def));
}

void Bodies::destroy_box2d_body(Body& r) {
  world_.DestroyBody(r.body);  // and its joint
  r.body = nullptr;
  r.details->obstacle.joint = nullptr;
  --in_box2d_;
}

void Bodies::ensure_box2d_body(Body& r) {
  if (r.body == nullptr) create_box2d_body(r);
  r.substeps_in_box2d = kSubstepsInBox2d;
}

const std::vector<Bodies::Circle>& Bodies::by_x() {
  if (order_fresh_) return by_x_;
  order_fresh_ = true;
  for (Circle& circle : by_x_) {
    const Body& r = at(circle.robot);
    circle.x = r.X_WB.x_m;
    circle.y = r.X_WB.y_m;
  }
  for (std::size_t i = 1; i < by_x_.size(); ++i) {  // insertion sort: nearly sorted already
    const Circle moving = by_x_[i];
    std::size_t j = i;
    for (; j > 0 && by_x_[j - 1].x > moving.x; --j) by_x_[j] = by_x_[j - 1];
    by_x_[j] = moving;
  }
  return by_x_;
}

}  // namespace sim::physics
