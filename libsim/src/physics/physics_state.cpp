// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The complete state of the physics that a step changes and the next one depends on. This includes
// lower bounds and starting points of searches, which determine when distances are measured again.
#include <cmath>
#include <utility>

#include "physics/bodies.h"
#include "physics/box2d_state.h"
#include "physics/contacts.h"
#include "physics/mover.h"
#include "physics/neighbours.h"
#include "physics/sensor_view.h"
#include "sim/world/limits.h"
#include "sim/world/outline.h"

namespace sim::physics {
namespace {

void archive_robot_state(StateArchive& archive, Body& r) {
  BodyState& s = *r.state;
  archive(r.target, r.X_WB, r.cumulative_max_travel_m, r.suspended, r.in_contact_group,
          r.substeps_in_box2d, r.stall_clock_s);
  archive.unbounded(r.wall_until_m);
  archive.unbounded(r.wall_at_travel_m);
  archive(s.X_WB, s.twist, s.commanded, s.travel_m, s.turn_rad, s.stalled, s.side_m);
  archive(s.elevation.z_m, s.elevation.roll_rad, s.elevation.pitch_rad);
  for (const double x : {r.X_WB.x_m, r.X_WB.y_m, r.target.v_mps, r.target.lateral_mps,
                         r.target.omega_radps, r.X_WB.yaw_rad}) {
    archive.expect(std::abs(x) <= kFarthest_m, "robots within reach");
  }
}

void archive_velocity(StateArchive& archive, Body& r) {
  ObstacleBody& o = r.details->obstacle;
  archive(o.v_WB, o.omega_radps);
  for (const double x : {o.v_WB.x(), o.v_WB.y(), o.omega_radps}) {
    archive.expect(std::abs(x) <= kFarthest_m, "velocities of obstacles");
  }
}

// A permutation of all robots: each of `entries` names its robot.
template <typename Entry>
void archive_order(StateArchive& archive, std::vector<Entry>& entries) {
  std::vector<bool> seen(entries.size());
  for (Entry& entry : entries) {
    archive.index(entry.robot, entries.size());
    const auto robot = static_cast<std::size_t>(entry.robot);
    archive.expect(!seen[robot], "each robot once");
    seen[robot] = true;
  }
}

// Whether Box2D recognises the corners as a box.
bool are_of_box(const std::vector<Vec2>& corners) {
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 side = corners[(i + 1) % 4] - corners[i];
    const Vec2 next = corners[(i + 2) % 4] - corners[(i + 1) % 4];
    if (!(corners[i].cwiseAbs().maxCoeff() <= 2.0 * kFarthest_m)) return false;
    if (!(side.norm() >= 0.9 * kLeastLength_m)) return false;
    if (!(side.x() * next.y() - side.y() * next.x() >= 0.9 * side.norm() * next.norm()))
      return false;
  }
  return true;
}

// Whether the corners can be an outline for Box2D, as one convex polygon or as edges.
bool are_of_outline(const std::vector<Vec2>& corners, bool one_polygon) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!(corners[i].cwiseAbs().maxCoeff() <= 2.0 * kFarthest_m)) return false;
    if (!((corners[(i + 1) % corners.size()] - corners[i]).norm() >= 0.9 * kLeastLength_m)) {
      return false;
    }
  }
  return !one_polygon || (is_convex(corners) && least_extent_m(corners) >= 0.9 * kLeastLength_m);
}

}  // namespace

std::vector<b2Fixture*> Bodies::fixtures() {
  std::vector<b2Fixture*> fixtures(infos_.size());
  for (b2Body* body = world_.GetBodyList(); body != nullptr; body = body->GetNext()) {
    for (b2Fixture* fixture = body->GetFixtureList(); fixture != nullptr;
         fixture = fixture->GetNext()) {
      fixtures[info_of(fixture).id] = fixture;
    }
  }
  return fixtures;
}

void Bodies::archive_cylinder(StateArchive& archive, b2Body& body, bool enabled,
                              const FixtureInfo& info) {
  Cylinder& cylinder = cylinders_[static_cast<std::size_t>(info.cylinder)];
  archive(cylinder.center, cylinder.radius_m);
  if (!archive.reading()) return;
  archive.expect(cylinder.center.cwiseAbs().maxCoeff() <= 2.0 * kFarthest_m &&
                     cylinder.radius_m >= 0.9 * kLeastLength_m &&
                     cylinder.radius_m <= kGreatestLength_m,
                 "circles");
  cylinder.height_m = info.height_m;
  body.SetEnabled(false);  // enabling it creates a broad-phase proxy from the new shape
  *static_cast<b2CircleShape*>(body.GetFixtureList()->GetShape()) =
      circle_shape(cylinder.center, cylinder.radius_m);
  body.SetEnabled(enabled);
}

void Bodies::archive_obstacle(StateArchive& archive, int index) {
  if (body_of(index) >= 0) return;  // it is among the robots
  b2Body& body = obstacle(index);
  const Parts& parts = parts_[static_cast<std::size_t>(index)];
  bool enabled = body.IsEnabled();
  double height_m = infos_[parts.first_info]->height_m;
  archive(enabled, height_m);
  for (std::size_t i = 0; i < parts.count; ++i) infos_[parts.first_info + i]->height_m = height_m;
  if (parts.shape == ObstacleShape::kCircle) {
    archive_cylinder(archive, body, enabled, *infos_[parts.first_info]);
    return;
  }
  std::vector<Vec2> corners = corners_of_parts(parts);
  for (Vec2& corner : corners) archive(corner);
  if (!archive.reading()) return;
  archive.expect(parts.shape == ObstacleShape::kBox ? are_of_box(corners)
                                                    : are_of_outline(corners, parts.count == 1),
                 "boxes");
  set_corners(parts, corners, height_m);
  body.SetEnabled(false);  // enabling it creates a broad-phase proxy from the new shape
  for (b2Fixture* fixture = body.GetFixtureList(); fixture != nullptr;
       fixture = fixture->GetNext()) {
    if (parts.count == 1) {
      *static_cast<b2PolygonShape*>(fixture->GetShape()) = polygon_shape(corners);
    } else {
      *static_cast<b2EdgeShape*>(fixture->GetShape()) =
          edge_shape(corners, info_of(fixture).id - parts.first_info);
    }
  }
  body.SetEnabled(enabled);
}

void Bodies::archive(StateArchive& archive) {
  for (Body& r : all_) archive_robot_state(archive, r);
  for (std::size_t i = robot_count_; i < all_.size(); ++i) archive_velocity(archive, all_[i]);
  for (Body& r : all_) {
    if (has_pushable_) archive(r.details->achieved, r.details->excess);
  }
  archive_order(archive, by_x_);
  if (archive.reading()) {
    order_fresh_ = false;
    for (Circle& circle : by_x_) circle.radius = at(circle.robot).radius_m;
  }
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    archive_obstacle(archive, static_cast<int>(i));
  }

  std::vector<std::uint32_t> newest_first;  // robots with a Box2D body
  for (b2Body* body = world_.GetBodyList(); body->GetType() == b2_dynamicBody;
       body = body->GetNext()) {
    newest_first.push_back(static_cast<std::uint32_t>(info_of(body->GetFixtureList()).body));
  }
  archive(newest_first);
  if (archive.reading()) {
    for (Body& r : all_) {
      if (r.body != nullptr) destroy_box2d_body(r);
    }
    for (auto robot = newest_first.rbegin(); robot != newest_first.rend(); ++robot) {
      archive.expect(*robot < all_.size() && all_[*robot].body == nullptr, "each robot once");
      create_box2d_body(all_[*robot]);
    }
  }
  archive_box2d(archive, world_, fixtures());
  for (b2FrictionJoint* joint : joints()) archive_joint(archive, *joint);
}

void Contacts::archive(StateArchive& archive) {
  constexpr auto kLastKind = Contact::Kind::kRobot;
  const std::size_t robots = bodies_.robot_count();
  archive.list(fresh_, [&](Contact& contact) {
    archive.index(contact.robot, robots);
    archive.choice(contact.kind, kLastKind);
    const std::size_t ends[] = {bodies_.obstacles().size(), bodies_.separator_count(), 0, 0,
                                robots};
    archive.index(contact.index, ends[static_cast<std::size_t>(contact.kind)], -1);
  });
  archive.list(new_touches_, [&](Touch& touch) {
    archive.index(touch.robot, robots);
    archive(touch.p_WA, touch.p_WC);
    for (const Vec2& p : {touch.p_WA, touch.p_WC}) {
      archive.expect(p.cwiseAbs().maxCoeff() <= 2.0 * kFarthest_m, "touches within reach");
    }
  });
  if (!archive.reading()) return;
  for (Body& r : bodies_.all()) r.details->touching.clear();
  const std::vector<Contact> fresh = fresh_;
  for (b2Contact* c = bodies_.world().GetContactList(); c != nullptr; c = c->GetNext()) {
    if (!c->IsTouching()) continue;
    count_contact(*c, c->GetFixtureA(), c->GetFixtureB(), 1);
    count_contact(*c, c->GetFixtureB(), c->GetFixtureA(), 1);
  }
  fresh_ = fresh;
}

void Neighbours::archive_robot(StateArchive& archive, Body& r,
                               const std::vector<b2Fixture*>& fixtures) {
  BodyDetails& d = *r.details;
  archive_vector(archive, d.nearest_direction);
  archive(d.candidates_reach_m, d.candidates_at_travel_m);
  archive.unbounded(d.walls_until_m);
  if (archive.reading()) {
    d.candidates.clear();
    d.walls.clear();
  }
  // Outdated lists may name things that no longer exist.
  if (d.candidates_reach_m >= 0.0) {
    archive.list(d.candidates, [&](Candidate& candidate) {
      archive(candidate.robot);
      const int fixture = -1 - candidate.robot;
      const auto robots = static_cast<int>(bodies_.all().size());
      archive.expect(candidate.robot < robots && fixture < static_cast<int>(fixtures.size()),
                     "candidates that there are");
      if (archive.reading() && candidate.robot >= 0) {
        candidate.shape = &bodies_.at(candidate.robot).details->solid();
      } else if (archive.reading()) {
        const b2Fixture* solid = fixtures[static_cast<std::size_t>(fixture)];
        archive.expect(solid != nullptr && info_of(solid).body < 0 && solid->GetBody()->IsEnabled(),
                       "candidates that stand");
        candidate.shape = solid->GetShape();
        candidate.box = solid->GetAABB(0);
      }
    });
  }
  if (std::isinf(d.walls_until_m)) return;
  archive.list(d.walls, [&](Wall& wall) {
    archive.index(wall.fixture, fixtures.size());
    if (archive.reading()) {
      const b2Fixture* solid = fixtures[static_cast<std::size_t>(wall.fixture)];
      archive.expect(solid != nullptr && info_of(solid).body < 0, "walls");
      wall = wall_of(*solid);
    }
  });
}

void Neighbours::archive(StateArchive& archive) {
  archive(placed_, travel_m_, cumulative_max_travel_m_, pairs_until_m_);
  const std::size_t robots = bodies_.all().size();
  archive.list(pairs_, [&](Pair& pair) {
    archive.index(pair.first, robots);
    archive.index(pair.second, robots, pair.first + 1);
    archive(pair.pair_at_travel_m);
    archive.unbounded(pair.apart_m);
    archive_vector(archive, pair.direction);
  });
  meet_at_travel_m_.resize(pairs_.size());
  for (double& meet_m : meet_at_travel_m_) archive.unbounded(meet_m);
  const std::vector<b2Fixture*> fixtures = bodies_.fixtures();
  for (Body& r : bodies_.all()) archive_robot(archive, r, fixtures);
}

void Mover::archive(StateArchive& archive) {
  archive(step_max_travel_m_, used_box2d_);
  if (!archive.reading()) return;
  contact_robots_.clear();
  for (std::size_t i = 0; i < bodies_.all().size(); ++i) {
    if (bodies_.all()[i].in_contact_group) contact_robots_.push_back(i);
  }
}

void SensorView::archive(StateArchive& archive) {
  archive_order(archive, by_hilbert_index_);
  for (HilbertEntry& entry : by_hilbert_index_) archive(entry.hilbert_index, entry.until_m);
  if (!archive.reading()) return;
  solids_changed();
  outlines_fresh_ = false;
}

}  // namespace sim::physics
