// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "physics/sensor_view.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "physics/hilbert_curve.h"
#include "sim/core/math.h"
#include "sim/core/pose.h"
#include "sim/world/limits.h"
#include "sim/world/outline.h"

namespace sim::physics {
namespace {

// Larger numbers of static edges are searched with Box2D's tree instead of a sweep.
constexpr std::size_t kSweepLimit = 512;

// One vector per edge, since there are many edges.
using Four = double __attribute__((vector_size(4 * sizeof(double))));
using FourFloats = float __attribute__((vector_size(4 * sizeof(float))));

// Writes the edge between two points in W, relative to `origin`. The points are adjacent in memory.
void put_edge(scan::Edge* to, const double* points, const Four& origin) {
  static_assert(sizeof(scan::Edge) == sizeof(FourFloats));
  Four both;
  std::memcpy(&both, points, sizeof both);
  const FourFloats edge = __builtin_convertvector(both - origin, FourFloats);
  std::memcpy(&to->x0_m, &edge, sizeof edge);
}

// Appends the edges of list[first, last) that the sensor meets at its height, relative to it.
void append_edges(const EdgeList& list, std::size_t first, std::size_t last, const Vec2& p_WL,
                  double sensor_height_m, scan::EdgeBuffer& out) {
  static_assert(sizeof(Edge) == sizeof(Four));
  const std::size_t begin = out.size();
  const bool all_seen = spans_height(list.greatest_bottom_m, list.least_height_m, sensor_height_m);
  scan::Edge* const target = out.append(last - first);
  const Four origin = {p_WL.x(), p_WL.y(), p_WL.x(), p_WL.y()};
  std::size_t count = 0;
  for (std::size_t i = first; i < last; ++i) {
    if (!all_seen && !spans_height(list.bottoms_m[i], list.heights_m[i], sensor_height_m)) continue;
    put_edge(target + count++, &list.edges[i].x0, origin);
  }
  out.truncate(begin + count);
}

// Appends a round solid, relative to the sensor, if the sensor meets it at its height.
void append_cylinder(const Cylinder& cylinder, const Vec2& p_WL, double sensor_height_m,
                     scan::EdgeBuffer& out) {
  if (!spans_height(cylinder.bottom_m, cylinder.height_m, sensor_height_m)) return;
  const Vec2 p_LC = cylinder.center - p_WL;
  out.add(scan::Circle{p_LC.x(), p_LC.y(), cylinder.radius_m});
}

bool is_within(const Cylinder& cylinder, const Vec2& p_W) {
  return (cylinder.center - p_W).squaredNorm() <= cylinder.radius_m * cylinder.radius_m;
}

// Where the ray from A enters a circle; infinite if it does not.
double entry_m(const Cylinder& cylinder, const Vec2& p_WA, const Vec2& along) {
  const Vec2 p_AC = cylinder.center - p_WA;
  const std::optional<scan::Chord> chord =
      scan::chord_of({p_AC.x(), p_AC.y(), cylinder.radius_m}, along.x(), along.y());
  if (chord && chord->enter_m >= 0.0) return chord->enter_m;
  return std::numeric_limits<double>::infinity();
}

// The fraction of the line from A to C at which it enters a circle from outside; at least 1: it
// does not.
double entry_of(const Cylinder& cylinder, const Vec2& p_WA, const Vec2& p_WC) {
  if (is_within(cylinder, p_WA)) return 1.0;
  const double length_m = (p_WC - p_WA).norm();
  return entry_m(cylinder, p_WA, (p_WC - p_WA) / length_m) / length_m;
}

}  // namespace

void SensorView::solids_changed() {
  sweep_ = bodies_.edges().edges.size() + bodies_.cylinders().size() <= kSweepLimit;
  const auto fixed_edges = std::make_shared<EdgeList>();
  fixed_edges_ = fixed_edges;
  fixed_cylinders_.clear();
  if (!sweep_) return;
  fixed_edges->reserve(bodies_.edges().edges.size());
  for (const auto& info : bodies_.infos()) {
    if (info->body >= 0) continue;
    if (info->kind == Contact::Kind::kObstacle && !bodies_.obstacle(info->index).IsEnabled()) {
      continue;
    }
    for (std::size_t i = 0; i < info->edge_count; ++i) {
      fixed_edges->add(bodies_.edges().edges[info->first_edge + i], info->height_m, info->bottom_m);
    }
    if (info->cylinder >= 0) {
      fixed_cylinders_.push_back(bodies_.cylinders()[static_cast<std::size_t>(info->cylinder)]);
    }
  }
}

void SensorView::share_memory_with(const SensorView& other) {
  if (*fixed_edges_ == *other.fixed_edges_) fixed_edges_ = other.fixed_edges_;
}

void SensorView::robot_was_placed() {
  for (HilbertEntry& entry : by_hilbert_index_) entry.until_m = 0.0;
  outlines_fresh_ = false;
}

void SensorView::set_load(Body& r, const std::vector<PhysicsWorld::Load>& loads) {
  r.details->load.clear();
  r.details->load_obstacles.clear();
  r.details->round_load.clear();
  r.details->seen_radius_m = r.details->own_radius_m;
  for (const PhysicsWorld::Load& load : loads) {
    const ObstacleDescription& solid = load.solid_B;
    if (solid.shape == ObstacleShape::kCircle) {
      r.details->round_load.push_back(
          {solid.center, radius_m(solid), solid.height_m, load.obstacle});
      r.details->seen_radius_m =
          std::max(r.details->seen_radius_m, solid.center.norm() + radius_m(solid));
    }
    const std::vector<Vec2> corners = corners_of(solid);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2& a = corners[i];
      const Vec2& b = corners[(i + 1) % corners.size()];
      r.details->load.add({a.x(), a.y(), b.x(), b.y()}, solid.height_m);
      r.details->load_obstacles.push_back(load.obstacle);
      r.details->seen_radius_m = std::max(r.details->seen_radius_m, a.norm());
    }
  }
  outlines_fresh_ = false;
}

// Sorts the robots by their position on a Hilbert curve, so that consecutive robots are near each
// other. A position is kept until the robot has moved by kWhile_m, since small moves hardly matter.
void SensorView::sort_by_hilbert_index() {
  constexpr double kWhile_m = 0.1;
  for (HilbertEntry& entry : by_hilbert_index_) {
    const Body& r = bodies_.at(entry.robot);
    if (r.cumulative_max_travel_m < entry.until_m) continue;
    entry.hilbert_index = along_hilbert_curve(r.X_WB.position());
    entry.until_m = r.cumulative_max_travel_m + kWhile_m;
  }
  // Insertion sort, since the robots are nearly sorted already.
  for (std::size_t i = 1; i < by_hilbert_index_.size(); ++i) {
    const HilbertEntry moving = by_hilbert_index_[i];
    std::size_t j = i;
    for (; j > 0 && by_hilbert_index_[j - 1].hilbert_index > moving.hilbert_index; --j) {
      by_hilbert_index_[j] = by_hilbert_index_[j - 1];
    }
    by_hilbert_index_[j] = moving;
  }
}

void SensorView::rebuild_outlines() {
  further_edges_.clear();
  load_cylinders_.clear();
  outlines_.resize(bodies_.all().size());
  robot_discs_.clear();
  sort_by_hilbert_index();
  for (std::size_t k = 0; k < by_hilbert_index_.size(); ++k) {
    const Body& r = bodies_.at(by_hilbert_index_[k].robot);
    robot_discs_.add(static_cast<float>(r.X_WB.x_m), static_cast<float>(r.X_WB.y_m),
                     static_cast<float>(r.details->seen_radius_m));
    const math::SinCos turn = math::sin_cos(r.X_WB.yaw_rad);
    const double s = turn.sin;
    const double c = turn.cos;
    Outline& outline = outlines_[k];
    const bool one_polygon = !r.details->round && r.details->further.empty();
    outline.count = one_polygon ? static_cast<std::size_t>(r.details->shape.m_count) : 0;
    for (std::size_t i = 0; i < outline.count; ++i) {
      const double x = metres(r.details->shape.m_vertices[i].x);
      const double y = metres(r.details->shape.m_vertices[i].y);
      outline.corners[i] = {r.X_WB.x_m + c * x - s * y, r.X_WB.y_m + s * x + c * y};
    }
    outline.corners[outline.count] = outline.corners[0];
    outline.p_WB = r.X_WB.position();
    outline.seen_radius_m = r.details->seen_radius_m;
    outline.height_m = r.details->height_m;
    outline.robot = by_hilbert_index_[k].robot;
    outline.kind = r.details->info->kind;
    outline.index = r.details->info->index;
    const auto add = [&](double x0, double y0, double x1, double y1, double height_m,
                         double bottom_m = 0.0) {
      further_edges_.add({r.X_WB.x_m + c * x0 - s * y0, r.X_WB.y_m + s * x0 + c * y0,
                          r.X_WB.x_m + c * x1 - s * y1, r.X_WB.y_m + s * x1 + c * y1},
                         height_m, bottom_m);
    };
    outline.first_upper = further_edges_.edges.size();
    for (std::size_t part = 0; part < r.details->part_count() && !r.details->further.empty();
         ++part) {
      const auto& shape = static_cast<const b2PolygonShape&>(r.details->part(part));
      for (int32 i = 0; i < shape.m_count; ++i) {
        const b2Vec2& a = shape.m_vertices[i];
        const b2Vec2& b = shape.m_vertices[(i + 1) % shape.m_count];
        add(metres(a.x), metres(a.y), metres(b.x), metres(b.y), r.details->height_m);
      }
    }
    for (const Superstructure& part : r.details->superstructures) {
      for (std::size_t i = 0; i < part.outline.size(); ++i) {
        const Vec2& a = part.outline[i];
        const Vec2& b = part.outline[(i + 1) % part.outline.size()];
        add(a.x(), a.y(), b.x(), b.y(), part.height_m, part.bottom_m);
      }
    }
    outline.first_load = further_edges_.edges.size();
    for (std::size_t i = 0; i < r.details->load.edges.size(); ++i) {
      const Edge& e = r.details->load.edges[i];
      add(e.x0, e.y0, e.x1, e.y1, r.details->load.heights_m[i]);
    }
    outline.end_load = further_edges_.edges.size();
    outline.first_cylinder = load_cylinders_.size();
    for (Cylinder cylinder : r.details->round_load) {
      cylinder.center = cylinder.center.isZero(0.0) ? r.X_WB.position() : r.X_WB * cylinder.center;
      load_cylinders_.push_back(cylinder);
    }
    outline.end_cylinder = load_cylinders_.size();
  }
  robot_discs_.group();
  outlines_fresh_ = true;
}

// The least fraction of the line from A to C at which it enters a superstructure at a height, or at
// any; 1 if it enters none. Exact.
double SensorView::entry_of_superstructures(const Body& r, const Vec2& p_WA, const Vec2& p_WC,
                                            std::optional<double> height_m) {
  const Pose X_BW = r.X_WB.inverse();
  const Vec2 p_BA = X_BW * p_WA;
  const Vec2 line = X_BW * p_WC - p_BA;
  const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
  double least = 1.0;
  for (const Superstructure& part : r.details->superstructures) {
    if (height_m && !spans_height(part.bottom_m, part.height_m, *height_m)) continue;
    for (std::size_t i = 0; i < part.outline.size(); ++i) {
      const Vec2& start = part.outline[i];
      const Vec2 side = part.outline[(i + 1) % part.outline.size()] - start;
      const double turn = cross(side, line);
      if (turn <= 0.0) continue;  // leaves the part, or runs along its side
      const Vec2 to_start = start - p_BA;
      const double share = cross(side, to_start) / turn;
      const double along = cross(line, to_start) / turn;
      if (share >= 0.0 && along >= 0.0 && along <= 1.0) least = std::min(least, share);
    }
  }
  return least;
}

// Casts a ray from A to C at the robots for which may(robot) is true. Calls visit(fraction of the
// line) for each robot that it hits from outside, until visit returns false.
template <typename Filter, typename Visitor>
void SensorView::cast_at_robots(const Vec2& p_WA, const Vec2& p_WC, Filter may, Visitor visit) {
  const Vec2 line = p_WC - p_WA;
  b2RayCastInput input;
  input.p1 = to_box2d(p_WA);
  input.p2 = to_box2d(p_WC);
  input.maxFraction = 1.0F;
  bool more = true;
  bodies_.for_robots_in(
      p_WA.cwiseMin(p_WC), p_WA.cwiseMax(p_WC), [&](const Bodies::Circle& circle) {
        if (!more) return;
        const Vec2 p_AB = Vec2(circle.x, circle.y) - p_WA;
        const double aside = line.x() * p_AB.y() - line.y() * p_AB.x();  // distance * |line|
        if (aside * aside > circle.radius * circle.radius * line.squaredNorm()) return;
        if (!may(circle.robot)) return;
        const Body& r = bodies_.at(circle.robot);
        if (r.details->round) {
          const double share = entry_of({p_WA + p_AB, circle.radius, 0.0, -1}, p_WA, p_WC);
          if (share < 1.0) more = visit(static_cast<float>(share));
          return;
        }
        float least = std::numeric_limits<float>::infinity();
        for (std::size_t k = 0; k < r.details->part_count(); ++k) {
          b2RayCastOutput output;
          if (!r.details->part(k).RayCast(&output, input, transform_of(r), 0)) continue;
          least = std::min(least, output.fraction);
        }
        if (least <= 1.0F) more = visit(least);
      });
}

// Calls visit(cylinder) for each round obstacle that exists now and may reach into a box.
template <typename Visitor>
void SensorView::visit_cylinders(const Vec2& low, const Vec2& high, Visitor visit) {
  if (sweep_) {
    std::for_each(fixed_cylinders_.begin(), fixed_cylinders_.end(), visit);
    return;
  }
  if (bodies_.cylinders().empty()) return;
  visit_fixed(bodies_.world(), low, high, [&](const b2Fixture& fixture) {
    const int cylinder = info_of(&fixture).cylinder;
    if (cylinder >= 0) visit(bodies_.cylinders()[static_cast<std::size_t>(cylinder)]);
  });
}

// The least fraction of the line from A to C at which it enters a round obstacle at a height, or at
// any; 1 if it enters none. Exact, while circles in Box2D have a skin.
double SensorView::cast_at_cylinders(const Vec2& p_WA, const Vec2& p_WC,
                                     std::optional<double> height_m, const Contact* ignored,
                                     bool solid_only) {
  if (bodies_.cylinders().empty()) return 1.0;
  const double length_m = (p_WC - p_WA).norm();
  const Vec2 along = (p_WC - p_WA) / length_m;
  double least_m = length_m;
  visit_cylinders(p_WA.cwiseMin(p_WC), p_WA.cwiseMax(p_WC), [&](const Cylinder& cylinder) {
    if (height_m && !spans_height(cylinder.bottom_m, cylinder.height_m, *height_m)) return;
    if (is_within(cylinder, p_WA)) return;
    if (solid_only && !cylinder.solid) return;
    if (ignored != nullptr && ignored->kind == Contact::Kind::kObstacle &&
        ignored->index == cylinder.obstacle) {
      return;
    }
    least_m = std::min(least_m, entry_m(cylinder, p_WA, along));
  });
  return least_m / length_m;
}

// Appends the edges of a robot's outline.
void SensorView::append_robot(const Outline& outline, const Vec2& p_WL, scan::EdgeBuffer& out) {
  static_assert(sizeof(Vec2) == 2 * sizeof(double));
  scan::Edge* const target = out.append(outline.count);
  const Four origin = {p_WL.x(), p_WL.y(), p_WL.x(), p_WL.y()};
  for (std::size_t i = 0; i < outline.count; ++i) {
    put_edge(target + i, outline.corners[i].data(), origin);
  }
}

void SensorView::collect_static_edges(const Vec2& p_WL, double radius_m, double sensor_height_m,
                                      scan::EdgeBuffer& edges) {
  edges.clear();
  if (sweep_) {
    append_edges(*fixed_edges_, 0, fixed_edges_->edges.size(), p_WL, sensor_height_m, edges);
    for (const Cylinder& cylinder : fixed_cylinders_) {
      append_cylinder(cylinder, p_WL, sensor_height_m, edges);
    }
    return;
  }
  const Vec2 reach(radius_m, radius_m);
  visit_fixed(bodies_.world(), p_WL - reach, p_WL + reach, [&](const b2Fixture& fixture) {
    const FixtureInfo& info = info_of(&fixture);
    append_edges(bodies_.edges(), info.first_edge, info.first_edge + info.edge_count, p_WL,
                 sensor_height_m, edges);
    if (info.cylinder < 0) return;
    append_cylinder(bodies_.cylinders()[static_cast<std::size_t>(info.cylinder)], p_WL,
                    sensor_height_m, edges);
  });
}

void SensorView::collect_edges(const Vec2& p_WL, double radius_m, double sensor_height_m,
                               int own_robot, bool test_inside, scan::EdgeBuffer& edges) {
  collect_static_edges(p_WL, radius_m, sensor_height_m, edges);
  if (!outlines_fresh_) rebuild_outlines();
  for (const Outline& outline : outlines_) {
    if (outline.robot == own_robot) continue;
    const double reach = radius_m + outline.seen_radius_m;
    if ((outline.p_WB - p_WL).squaredNorm() > reach * reach) continue;
    if (reaches_height(outline.height_m, sensor_height_m)) {
      for (std::size_t i = 0; i < outline.count; ++i) {
        const Edge e = outline.edge(i);
        edges.add(static_cast<float>(e.x0 - p_WL.x()), static_cast<float>(e.y0 - p_WL.y()),
                  static_cast<float>(e.x1 - p_WL.x()), static_cast<float>(e.y1 - p_WL.y()));
      }
    }
    append_edges(further_edges_, outline.first_upper, outline.end_load, p_WL, sensor_height_m,
                 edges);
    for (std::size_t i = outline.first_cylinder; i < outline.end_cylinder; ++i) {
      append_cylinder(load_cylinders_[i], p_WL, sensor_height_m, edges);
    }
  }
  if (test_inside) edges.inside = is_inside_solid(p_WL, sensor_height_m, own_robot);
}

template <typename Range>
void SensorView::scan_with(scan::ScanWorkspace& workspace, const scan::ScanGeometry& geometry,
                           const Pose& X_WL, double sensor_height_m, int own_robot,
                           bool test_inside, std::span<Range> ranges_m) {
  scan::ScanKernel& kernel = workspace.kernel_of(geometry);
  scan::EdgeBuffer& edges = workspace.edges();
  const Vec2 p_WL = X_WL.position();
  collect_static_edges(p_WL, geometry.range_max_m, sensor_height_m, edges);
  if (test_inside) edges.inside = is_inside_solid(p_WL, sensor_height_m, own_robot);
  kernel.begin(X_WL.yaw_rad);
  if (is_alone(own_robot)) {
    if (!outlines_fresh_) sort_by_hilbert_index();  // part of the state
    kernel.add(edges);
    kernel.finish(ranges_m);
    return;
  }
  if (!outlines_fresh_) rebuild_outlines();
  const auto append = [&](std::span<const std::int32_t> discs) {
    for (const std::int32_t disc : discs) {
      const Outline& outline = outlines_[static_cast<std::size_t>(disc)];
      if (outline.robot == own_robot) continue;
      if (reaches_height(outline.height_m, sensor_height_m)) append_robot(outline, p_WL, edges);
      for (std::size_t i = outline.first_cylinder; i < outline.end_cylinder; ++i) {
        append_cylinder(load_cylinders_[i], p_WL, sensor_height_m, edges);
      }
      if (outline.first_upper == outline.end_load) continue;
      append_edges(further_edges_, outline.first_upper, outline.end_load, p_WL, sensor_height_m,
                   edges);
    }
  };

  kernel.locate(robot_discs_, static_cast<float>(p_WL.x()), static_cast<float>(p_WL.y()));
  append(kernel.near());
  kernel.add(edges);
  edges.clear();
  append(kernel.visible());
  if (edges.size() > 0 || !edges.circles().empty()) kernel.add(edges);
  kernel.finish(ranges_m);
}

void SensorView::scan(const scan::ScanGeometry& geometry, const Pose& X_WL, double sensor_height_m,
                      int own_robot, bool test_inside, std::span<double> ranges_m) {
  scan_with(workspace_, geometry, X_WL, sensor_height_m, own_robot, test_inside, ranges_m);
}

void SensorView::scan(scan::ScanWorkspace& workspace, const scan::ScanGeometry& geometry,
                      const Pose& X_WL, double sensor_height_m, int own_robot, bool test_inside,
                      std::span<float> ranges_m) {
  scan_with(workspace, geometry, X_WL, sensor_height_m, own_robot, test_inside, ranges_m);
}

void SensorView::collect_faces(const Vec2& low, const Vec2& high, int own_robot,
                               std::vector<Face>& faces) {
  faces.clear();
  if (!outlines_fresh_) rebuild_outlines();
  const auto add = [&](const Edge& e, Contact::Kind kind, int index, double height_m) {
    if (std::max(e.x0, e.x1) < low.x() || std::min(e.x0, e.x1) > high.x()) return;
    if (std::max(e.y0, e.y1) < low.y() || std::min(e.y0, e.y1) > high.y()) return;
    faces.push_back({kind, index, height_m, {e.x0, e.y0}, {e.x1, e.y1}});
  };
  const auto add_round = [&](const Cylinder& c) {
    const Vec2 r(c.radius_m, c.radius_m);
    if (((c.center + r).array() < low.array()).any()) return;
    if (((c.center - r).array() > high.array()).any()) return;
    faces.push_back(
        {Contact::Kind::kObstacle, c.obstacle, c.height_m, c.center, c.center, c.radius_m});
  };
  visit_cylinders(low, high, add_round);
  visit_fixed(bodies_.world(), low, high, [&](const b2Fixture& fixture) {
    const FixtureInfo& info = info_of(&fixture);
    for (std::size_t i = 0; i < info.edge_count; ++i) {
      add(bodies_.edges().edges[info.first_edge + i], info.kind, info.index, info.height_m);
    }
  });
  for (const Outline& outline : outlines_) {
    if (outline.robot == own_robot) continue;
    for (std::size_t i = 0; i < outline.count; ++i) {
      add(outline.edge(i), outline.kind, outline.index, outline.height_m);
    }
    for (std::size_t i = outline.first_upper; i < outline.first_load; ++i) {
      add(further_edges_.edges[i], outline.kind, outline.index, further_edges_.heights_m[i]);
    }
    const Body& r = bodies_.at(outline.robot);
    for (std::size_t i = outline.first_load; i < outline.end_load; ++i) {
      add(further_edges_.edges[i], Contact::Kind::kObstacle,
          r.details->load_obstacles[i - outline.first_load], further_edges_.heights_m[i]);
    }
    for (std::size_t i = outline.first_cylinder; i < outline.end_cylinder; ++i) {
      add_round(load_cylinders_[i]);
    }
  }
}

bool SensorView::is_line_free(const Vec2& p_WA, const Vec2& p_WC, double height_m, int own_robot,
                              const Contact& target, bool solid_only) {
  struct Blocked : b2RayCastCallback {
    float ReportFixture(b2Fixture* fixture, const b2Vec2&, const b2Vec2&, float) override {
      const FixtureInfo& info = info_of(fixture);
      const bool wanted = info.kind == target_kind && info.index == target_index;
      if (info.cylinder >= 0 || (solid_only && !info.solid)) return -1.0F;
      if (info.body >= 0 || wanted) return -1.0F;
      if (!spans_height(info.bottom_m, info.height_m, height_m)) return -1.0F;
      blocked = true;
      return 0.0F;
    }
    double height_m = 0.0;
    Contact::Kind target_kind = Contact::Kind::kRobot;
    int target_index = -1;
    bool solid_only = false;
    bool blocked = false;
  } callback;
  callback.solid_only = solid_only;
  callback.height_m = height_m;
  callback.target_kind = target.kind;
  callback.target_index = target.index;
  // Box2D does not accept a line of length 0.
  if ((p_WC - p_WA).squaredNorm() <= 0.0) return true;
  // Robots first, since their test is cheaper.
  const int target_robot = bodies_.body_of(target);
  bool blocked = false;
  cast_at_robots(
      p_WA, p_WC,
      [&](int robot) {
        return robot != own_robot && robot != target_robot &&
               (!solid_only || bodies_.at(robot).details->info->solid) &&
               reaches_height(bodies_.at(robot).details->height_m, height_m);
      },
      [&](float) {
        blocked = true;
        return false;
      });
  if (blocked) return false;
  for (const int robot : bodies_.with_superstructures()) {
    if (robot == own_robot || robot == target_robot) continue;
    if (entry_of_superstructures(bodies_.at(robot), p_WA, p_WC, height_m) < 1.0) return false;
  }
  if (cast_at_cylinders(p_WA, p_WC, height_m, &target, solid_only) < 1.0) return false;
  bodies_.world().RayCast(&callback, to_box2d(p_WA), to_box2d(p_WC));
  return !callback.blocked;
}

bool SensorView::is_inside_solid(const Vec2& p_W, double height_m, int own_robot) {
  bool inside = false;
  visit_fixed(bodies_.world(), p_W, p_W, [&](const b2Fixture& fixture) {
    const FixtureInfo& info = info_of(&fixture);
    if (!info.solid || !spans_height(info.bottom_m, info.height_m, height_m)) return;
    inside = inside ||
             (info.cylinder < 0
                  ? fixture.TestPoint(to_box2d(p_W))
                  : is_within(bodies_.cylinders()[static_cast<std::size_t>(info.cylinder)], p_W));
  });
  inside = inside || bodies_.is_inside_edged(p_W, height_m);
  bodies_.for_robots_in(p_W, p_W, [&](const Bodies::Circle& circle) {
    const Body& r = bodies_.at(circle.robot);
    if (inside || circle.robot == own_robot || !r.details->info->solid) return;
    if (!reaches_height(r.details->height_m, height_m)) return;
    if (r.details->round) {
      inside = is_within({{circle.x, circle.y}, circle.radius, 0.0, -1}, p_W);
      return;
    }
    for (std::size_t k = 0; k < r.details->part_count() && !inside; ++k) {
      inside = r.details->part(k).TestPoint(transform_of(r), to_box2d(p_W));
    }
  });
  for (const int robot : bodies_.with_superstructures()) {
    if (inside || robot == own_robot) continue;
    const Body& r = bodies_.at(robot);
    const Vec2 p_B = r.X_WB.inverse() * p_W;
    inside = std::any_of(r.details->superstructures.begin(), r.details->superstructures.end(),
                         [&](const Superstructure& part) {
                           return spans_height(part.bottom_m, part.height_m, height_m) &&
                                  is_inside(part.outline, p_B);
                         });
  }
  if (inside || !bodies_.has_walls()) return inside;
  // Walls of a map are closed outlines. A point is inside if a ray to the far right crosses an odd
  // number of edges (half-open rule at vertices).
  int crossings = 0;
  visit_fixed(bodies_.world(), p_W, {bodies_.wall_right_m(), p_W.y()},
              [&](const b2Fixture& fixture) {
                const FixtureInfo& info = info_of(&fixture);
                if (info.kind != Contact::Kind::kWall || !info.solid) return;
                if (!reaches_height(info.height_m, height_m)) return;
                const Edge& e = bodies_.edges().edges[info.first_edge];
                if ((e.y0 > p_W.y()) == (e.y1 > p_W.y())) return;
                const double x = e.x0 + (p_W.y() - e.y0) / (e.y1 - e.y0) * (e.x1 - e.x0);
                if (x > p_W.x()) ++crossings;
              });
  return crossings % 2 == 1;
}

double SensorView::ray_cast_m(const Vec2& p_WL, double angle_rad, double range_max_m,
                              int own_robot) {
  struct Closest : b2RayCastCallback {
    float fraction = 1.0F;
    float ReportFixture(b2Fixture* fixture, const b2Vec2&, const b2Vec2&, float f) override {
      const FixtureInfo& info = info_of(fixture);
      if (info.body >= 0 || info.cylinder >= 0) return -1.0F;
      fraction = f;
      return f;
    }
  } closest;
  const Vec2 end = p_WL + range_max_m * unit_vector(angle_rad);
  bodies_.world().RayCast(&closest, to_box2d(p_WL), to_box2d(end));
  cast_at_robots(
      p_WL, end, [&](int robot) { return robot != own_robot; },
      [&](float fraction) {
        closest.fraction = std::min(closest.fraction, fraction);
        return true;
      });
  for (const int robot : bodies_.with_superstructures()) {
    if (robot == own_robot) continue;
    const double share = entry_of_superstructures(bodies_.at(robot), p_WL, end, std::nullopt);
    closest.fraction = std::min(closest.fraction, static_cast<float>(share));
  }
  return std::min(static_cast<double>(closest.fraction),
                  cast_at_cylinders(p_WL, end, std::nullopt, nullptr, false)) *
         range_max_m;
}

}  // namespace sim::physics
