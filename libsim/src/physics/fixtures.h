// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <box2d/box2d.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "physics/physics_world.h"
#include "physics/shapes.h"
#include "sim/core/pose.h"

namespace sim::physics {

using Contact = PhysicsWorld::Contact;

/// The owner of a Box2D fixture.
struct FixtureInfo {
  Contact::Kind kind;
  int index;  ///< of the obstacle, separator or robot; -1 for borders and walls
  double height_m;
  double bottom_m = 0.0;
  int body = -1;  ///< index in Bodies::all() of a robot or a moving obstacle; -1: it is static
  std::size_t first_edge = 0;  ///< into Bodies::edges(); unused for bodies that move
  std::size_t edge_count = 0;
  std::size_t id = 0;    ///< its index in Bodies::infos()
  int cylinder = -1;     ///< index in Bodies::cylinders(), for round obstacles; these have no edges
  std::size_t part = 0;  ///< of a robot's body, see BodyDetails::part()
  bool solid = true;     ///< false: sensors see it, but nothing collides with it
};

/// A round obstacle. It has no edges: sensors see its exact circle.
struct Cylinder {
  Vec2 center;  ///< in W, or in B for a load
  double radius_m;
  double height_m;
  int obstacle;  ///< its index in the arena
  double bottom_m = 0.0;
  bool solid = true;
};

struct Edge {
  double x0, y0, x1, y1;
  friend bool operator==(const Edge&, const Edge&) = default;
};

/// Edges of solids with their heights, in one array, so that the edges of a small world are
/// collected in one sweep.
struct EdgeList {
  std::vector<Edge> edges;
  std::vector<double> heights_m;
  std::vector<double> bottoms_m;
  double least_height_m = std::numeric_limits<double>::infinity();
  double greatest_bottom_m = 0.0;

  void clear() {
    edges.clear();
    heights_m.clear();
    bottoms_m.clear();
    greatest_bottom_m = 0.0;
    least_height_m = std::numeric_limits<double>::infinity();
  }
  void reserve(std::size_t count) {
    edges.reserve(count);
    heights_m.reserve(count);
    bottoms_m.reserve(count);
  }
  void add(const Edge& edge, double height_m, double bottom_m = 0.0) {
    edges.push_back(edge);
    heights_m.push_back(height_m);
    bottoms_m.push_back(bottom_m);
    least_height_m = std::min(least_height_m, height_m);
    greatest_bottom_m = std::max(greatest_bottom_m, bottom_m);
  }
  friend bool operator==(const EdgeList&, const EdgeList&) = default;
};

inline const FixtureInfo& info_of(const b2Fixture* fixture) {
  return *reinterpret_cast<const FixtureInfo*>(
      const_cast<b2Fixture*>(fixture)->GetUserData().pointer);
}

/// Calls visit(fixture) for every static fixture whose fat AABB meets the box.
template <typename Visitor>
void visit_fixed(const b2World& world, const b2AABB& box, Visitor visit) {
  struct Callback : b2QueryCallback {
    explicit Callback(Visitor& v) : visitor(v) {}
    bool ReportFixture(b2Fixture* fixture) override {
      if (info_of(fixture).body < 0) visitor(*fixture);
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

}  // namespace sim::physics
