// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "physics/neighbours.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <span>
#include <utility>

namespace sim::physics {
namespace {

// Additional range of a candidate list of clearance_m: bodies may move this far in total before the
// list must be rebuilt.
constexpr double kCandidateMargin_m = 0.1;

// Robots are listed as a pair if the gap between their bounding circles is below this.
constexpr double kPairReach_m = 0.2;

// Range of the search for walls around a robot, and the distance of its bounding circle from which
// on a coarse distance suffices.
constexpr double kWallSearch_m = 0.25;
constexpr double kCoarseWallDistance_m = 0.05;

template <typename Plain>
bool same_bits(const Plain& a, const Plain& b) {
  using Bytes = std::array<std::byte, sizeof(Plain)>;
  return std::bit_cast<Bytes>(a) == std::bit_cast<Bytes>(b);
}

}  // namespace

void Neighbours::invalidate() {
  placed_ = true;
  pairs_until_m_ = cumulative_max_travel_m_;
  for (Body& r : bodies_.all()) {
    r.wall_until_m = kUnknown;
    r.wall_at_travel_m = kUnknown;
    r.details->walls_until_m = kUnknown;
    r.details->candidates_reach_m = -1.0;
    r.details->clearance_settled = false;
  }
}

bool Neighbours::comes_before(const Pair& a, const Pair& b) {
  return a.first != b.first ? a.first < b.first : a.second < b.second;
}

// Lists the pairs of robots that may come near each other before all have travelled some distance
// (Verlet neighbour lists, Phys. Rev. 159, 98, 1967), by a sweep in order of x.
void Neighbours::list_pairs() {
  pairs_before_.swap(pairs_);
  pairs_.clear();
  pairs_until_m_ = cumulative_max_travel_m_ + 0.5 * (kPairReach_m - 3.0 * kMaxTravel_m);
  const std::vector<Bodies::Circle>& by_x = bodies_.by_x();
  for (std::size_t i = 0; i < by_x.size(); ++i) {
    const Bodies::Circle& a = by_x[i];
    const double farthest_x = a.x + a.radius + bodies_.largest_radius_m() + kPairReach_m;
    for (std::size_t j = i + 1; j < by_x.size() && by_x[j].x <= farthest_x; ++j) {
      const Bodies::Circle& b = by_x[j];
      const double reach = a.radius + b.radius + kPairReach_m;
      const double dx = b.x - a.x;
      const double dy = b.y - a.y;
      if (dx * dx + dy * dy >= reach * reach) continue;
      if (!is_solid(a.robot) || !is_solid(b.robot)) continue;
      pairs_.push_back(
          {std::min(a.robot, b.robot), std::max(a.robot, b.robot), 0.0, kUnknown, {1.0F, 0.0F}});
    }
  }
  std::sort(pairs_.begin(), pairs_.end(), comes_before);
  meet_before_.swap(meet_at_travel_m_);
  meet_at_travel_m_.assign(pairs_.size(), kUnknown);
  if (placed_) return;
  // The bounds of pairs that were listed before still hold.
  std::size_t before = 0;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    while (before < pairs_before_.size() && comes_before(pairs_before_[before], pairs_[i])) {
      ++before;
    }
    if (before == pairs_before_.size() || comes_before(pairs_[i], pairs_before_[before])) continue;
    pairs_[i] = pairs_before_[before];
    meet_at_travel_m_[i] = meet_before_[before];
  }
}

// Lower bound of the distance between the outlines of a pair, exact if it is below `enough_m`;
// updates the pair's direction.
double Neighbours::distance_m(const Body& a, const Body& b, double enough_m, Pair& pair) {
  // Two cheap lower bounds usually suffice: the distance of the bounding circles, and the gap along
  // the direction of the last nearest points.
  const double circles_m = circles_apart_m(a, b);
  if (circles_m > enough_m) {
    const Vec2 way = (b.X_WB.position() - a.X_WB.position()).normalized();
    pair.direction = {static_cast<float>(way.x()), static_cast<float>(way.y())};
    return circles_m;
  }
  const b2Transform xf_a = transform_of(a);
  const b2Transform xf_b = transform_of(b);
  const double along_m = metres(least_along(pair.direction, *b.details, xf_b) +
                                least_along(-pair.direction, *a.details, xf_a));
  if (along_m > enough_m) return along_m;
  const ShapeDistance found = distance_between(*a.details, xf_a, *b.details, xf_b);
  if (found.distance > 0.0F) {
    pair.direction = (1.0F / found.distance) * (found.pointB - found.pointA);
  }
  return metres(found.distance);
}

void Neighbours::find(double dt_s) {
  if (cumulative_max_travel_m_ >= pairs_until_m_) list_pairs();
  near_to_.resize(bodies_.all().size());
  for (const NearPair& pair : near_pairs_) {
    near_to_[static_cast<std::size_t>(pair.first)].clear();
    near_to_[static_cast<std::size_t>(pair.second)].clear();
  }
  near_pairs_.clear();
  find_near_pairs(dt_s);
  for (const NearPair& pair : near_pairs_) {
    near_to_[static_cast<std::size_t>(pair.first)].push_back(
        {pair.second, pair.apart_m, pair.direction});
    near_to_[static_cast<std::size_t>(pair.second)].push_back(
        {pair.first, pair.apart_m, -pair.direction});
  }
  for (Body& r : bodies_.all()) look_for_walls(r, dt_s);
}

// Appends the pairs whose robots may hinder each other to near_pairs_.
void Neighbours::find_near_pairs(double dt_s) {
  const double interaction_range_m = 3.0 * travel_m_;
  // This condition is unpredictable, so listing the pairs first, without a branch, is faster.
  candidate_pairs_.resize(pairs_.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    candidate_pairs_[count] = i;
    count += meet_at_travel_m_[i] - cumulative_max_travel_m_ <= 0.5 * interaction_range_m ? 1 : 0;
  }
  for (const std::size_t i : std::span(candidate_pairs_).first(count)) {
    Pair& pair = pairs_[i];
    Body& a = bodies_.at(pair.first);
    Body& b = bodies_.at(pair.second);
    double apart_m = pair.apart_m - (a.cumulative_max_travel_m + b.cumulative_max_travel_m -
                                     pair.pair_at_travel_m);
    if (apart_m > interaction_range_m) continue;
    // The exact distance is not needed while both robots can follow their targets.
    const double way_m = std::max(most_travel_m(a, dt_s), most_travel_m(b, dt_s));
    const double touch_m = 2.0 * way_m + kTouchingGap_m;
    if (pair.apart_m > interaction_range_m || a.in_contact_group || b.in_contact_group ||
        apart_m <= touch_m) {
      apart_m = distance_m(a, b, pair.apart_m > interaction_range_m ? interaction_range_m : touch_m,
                           pair);
      pair.apart_m = apart_m;
      meet_at_travel_m_[i] = cumulative_max_travel_m_ + 0.5 * apart_m;
      pair.pair_at_travel_m = a.cumulative_max_travel_m + b.cumulative_max_travel_m;
      if (apart_m > interaction_range_m) continue;
    }
    if (placed_) bodies_.ensure_box2d_body(a);
    if (placed_) bodies_.ensure_box2d_body(b);
    near_pairs_.push_back({pair.first, pair.second, apart_m, pair.direction});
  }
}

// Updates the distance from a robot to the nearest static solid.
void Neighbours::look_for_walls(Body& r, double dt_s) {
  const double reach_m = wall_reach_m();
  double apart_m = r.wall_until_m - r.cumulative_max_travel_m;
  if (apart_m > reach_m) return;
  if (!r.details->info->solid) {
    r.wall_until_m = std::numeric_limits<double>::infinity();
    return;
  }
  const bool was_near = r.wall_until_m - r.wall_at_travel_m <= reach_m;
  // The exact distance is not needed while the robot can follow its target.
  const double way_m = most_travel_m(r, dt_s) + kTouchingGap_m;
  if (apart_m <= (was_near ? way_m : reach_m) && r.cumulative_max_travel_m != r.wall_at_travel_m) {
    apart_m = distance_to_walls_m(r);
    r.wall_until_m = r.cumulative_max_travel_m + apart_m;
    r.wall_at_travel_m = r.cumulative_max_travel_m;
  }
  if (placed_ && apart_m <= reach_m) bodies_.ensure_box2d_body(r);
}

// Distance below which a static solid may hinder a robot.
double Neighbours::wall_reach_m() const { return 1.5 * travel_m_ + kRestingGap_m; }

// Lists everything that may come within reach_m of a robot with the bounding box `box`.
void Neighbours::collect_candidates(Body& r, const b2AABB& box, double reach_m) {
  r.details->candidates.clear();
  r.details->candidates_reach_m = reach_m;
  r.details->candidates_at_travel_m = cumulative_max_travel_m_;
  visit_fixed(bodies_.world(), expanded(box, reach_m), [&](const b2Fixture& fixture) {
    if (!info_of(&fixture).solid) return;
    r.details->candidates.push_back(
        {fixture.GetShape(), -1 - static_cast<int>(info_of(&fixture).id), fixture.GetAABB(0)});
  });
  const Vec2 p_WB = r.X_WB.position();
  const Vec2 reach(r.radius_m + reach_m, r.radius_m + reach_m);
  bodies_.for_robots_in(p_WB - reach, p_WB + reach, [&](const Bodies::Circle& circle) {
    const Body& other = bodies_.at(circle.robot);
    if (&other == &r || !other.details->info->solid) return;
    r.details->candidates.push_back({&other.details->solid(), circle.robot, {}});
  });
}

Wall Neighbours::wall_of(const b2Fixture& fixture) const {
  Wall wall;
  wall.shape = fixture.GetShape();
  const FixtureInfo& info = info_of(&fixture);
  wall.fixture = static_cast<int>(info.id);
  if (fixture.GetType() != b2Shape::e_edge) return wall;
  const Edge& edge = bodies_.edges().edges[info.first_edge];
  const Vec2 way(edge.x1 - edge.x0, edge.y1 - edge.y0);
  wall.length_m = way.norm();
  if (wall.length_m <= 0.0) return wall;
  wall.is_edge = true;
  wall.start = {edge.x0, edge.y0};
  wall.along = way / wall.length_m;
  return wall;
}

// Lower bound of the distance from a robot's outline to the nearest static solid, exact where it
// matters; at most kWallSearch_m [m].
double Neighbours::distance_to_walls_m(Body& r) {
  const b2Transform xf = transform_of(r);
  if (!(r.cumulative_max_travel_m < r.details->walls_until_m)) {
    const b2AABB box = box_of(*r.details, xf);
    r.details->walls.clear();
    r.details->walls_until_m = r.cumulative_max_travel_m + kWallSearch_m;
    visit_fixed(bodies_.world(), expanded(box, 2.0 * kWallSearch_m), [&](const b2Fixture& fixture) {
      if (info_of(&fixture).solid) r.details->walls.push_back(wall_of(fixture));
    });
  }
  double least_m = kWallSearch_m;
  for (Wall& wall : r.details->walls) {
    // Two cheap lower bounds usually suffice: the distance of the robot's bounding circle, and the
    // robot's distance from the line.
    if (!may_reach(r, wall, least_m)) continue;
    if (wall.is_edge) {
      const LineDistance line = distance_to_line(r, wall, xf);
      if (line.exact || line.apart_m >= std::min(least_m, kCoarseWallDistance_m)) {
        least_m = std::min(least_m, line.apart_m);
        continue;
      }
      if (!may_reach(r, wall, kCoarseWallDistance_m)) {
        least_m = std::min(least_m, kCoarseWallDistance_m);
        continue;
      }
    }
    const ShapeDistance found = distance_between(*r.details, xf, *wall.shape, identity_transform());
    least_m = std::min(least_m, metres(found.distance));
  }
  return least_m;
}

bool Neighbours::is_free(std::size_t index, double dt_s) const {
  const Body& r = bodies_.all()[index];
  const double way_m = most_travel_m(r, dt_s);
  if (r.wall_until_m - r.cumulative_max_travel_m <= way_m + kTouchingGap_m) return false;
  return std::all_of(near_to_[index].begin(), near_to_[index].end(), [&](const Neighbour& near) {
    const double share = bodies_.at(near.robot).suspended ? 1.0 : 0.5;
    return share * (near.apart_m - kTouchingGap_m) > way_m;
  });
}

// Whether a contact is with a static solid within reach.
bool Neighbours::is_near_wall(const Body& r, const b2Contact& contact) const {
  const b2Fixture* other = contact.GetFixtureA();
  if (other->GetBody() == r.body) other = contact.GetFixtureB();
  if (info_of(other).body >= 0) return false;
  const b2Transform& xf = r.body->GetTransform();
  const double apart_m =
      metres(distance_between(*r.details, xf, *other->GetShape(), identity_transform()).distance);
  return apart_m <= wall_reach_m();
}

bool Neighbours::may_be_pushed_into_others(std::size_t index) const {
  const Body& r = bodies_.all()[index];
  for (const Neighbour& near : near_to_[index]) {
    if (!touches(r.body, bodies_.at(near.robot).body)) return true;
  }
  for (const b2ContactEdge* e = r.body->GetContactList(); e != nullptr; e = e->next) {
    if (!e->contact->IsTouching() && is_near_wall(r, *e->contact)) return true;
  }
  return false;
}

double Neighbours::clearance_m(Body& r, double limit_m, double exact_below_m) {
  const b2Transform xf = transform_of(r);
  const b2AABB box = box_of(*r.details, xf);
  // The candidates for the nearest solid are kept in a list that stays valid for some distance
  // (Verlet neighbour lists, Phys. Rev. 159, 98, 1967). The nearest is usually the first of the
  // list. A list for a far larger limit is too long.
  const double reach_m = r.details->candidates_reach_m -
                         2.0 * (cumulative_max_travel_m_ - r.details->candidates_at_travel_m);
  const bool collects = limit_m > reach_m || reach_m > limit_m + 2.0 * kCandidateMargin_m;
  if (collects) collect_candidates(r, box, limit_m + kCandidateMargin_m);
  r.details->clearance_settled = !collects;
  double least_m = limit_m;
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < r.details->candidates.size(); ++i) {
    // Two cheap lower bounds usually suffice: the distance of the bounding boxes or circles, and
    // the gap along the direction of the last nearest points.
    Candidate& candidate = r.details->candidates[i];
    const Body* other = candidate.robot < 0 ? nullptr : &bodies_.at(candidate.robot);
    const double boxes_apart_m =
        other == nullptr ? metres(gap_between(box, candidate.box)) : circles_apart_m(r, *other);
    if (boxes_apart_m >= least_m) continue;
    const b2Transform their_xf = other == nullptr ? identity_transform() : transform_of(*other);
    const b2Vec2& way = r.details->nearest_direction;
    const float apart = (other == nullptr ? least_along(way, *candidate.shape, their_xf)
                                          : least_along(way, *other->details, their_xf)) +
                        least_along(-way, *r.details, xf);
    const double bound_m = std::max(boxes_apart_m, metres(apart));
    if (bound_m >= least_m) continue;
    if (bound_m >= exact_below_m) {
      least_m = bound_m;
      continue;
    }
    const ShapeDistance found = other == nullptr
                                    ? distance_between(*r.details, xf, *candidate.shape, their_xf)
                                    : distance_between(*r.details, xf, *other->details, their_xf);
    if (metres(found.distance) >= least_m) continue;
    if (found.distance > 0.0F) {
      const b2Vec2 direction = (1.0F / found.distance) * (found.pointB - found.pointA);
      if (!same_bits(direction, way)) r.details->clearance_settled = false;
      r.details->nearest_direction = direction;
    }
    least_m = metres(found.distance);
    nearest = i;
  }
  if (nearest > 0) {
    std::swap(r.details->candidates[0], r.details->candidates[nearest]);
    r.details->clearance_settled = false;
  }
  return least_m;
}

}  // namespace sim::physics
