// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "simulation/obstacle_motions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/core/assert.h"
#include "sim/core/math.h"
#include "sim/core/pose.h"
#include "sim/world/outline.h"
#include "simulation/social_force.h"

namespace sim {
namespace {

// Rounding of a pose that was reached.
constexpr double kReached_m = 1e-6;
constexpr double kReached_rad = 1e-6;

// A pedestrian has reached a waypoint at this distance: where others are in the way, nobody walks
// over a point exactly.
constexpr double kPedestrianReach_m = 0.2;

// An obstacle is off its path at this distance.
constexpr double kOffPath_m = 0.01;

// Fluctuations of a pedestrian's acceleration [m/s^1.5]. They are so small that they only decide to
// which side people step who meet head-on: the velocity's deviation is this times sqrt(tau / 2).
constexpr double kFluctuation = 0.01;

// Below this speed a pedestrian does not turn.
constexpr double kLeastWalk_mps = 0.01;

double radius_about_center(const ObstacleDescription& obstacle) {
  if (obstacle.shape == ObstacleShape::kCircle) return radius_m(obstacle);
  double radius = 0.0;
  for (const Vec2& p : corners_of(obstacle))
    radius = std::max(radius, (p - obstacle.center).norm());
  return radius;
}

double yaw_of(const Vec2& way) { return math::atan2(way.y(), way.x()); }

// The next angle of something that turns by at most `most_rad` towards another.
double turned(double yaw_rad, double wanted_rad, double most_rad) {
  const double turn = normalize_angle(wanted_rad - yaw_rad);
  if (std::abs(turn) <= most_rad * (1.0 + 1e-9)) return wanted_rad;
  return normalize_angle(yaw_rad + std::clamp(turn, -most_rad, most_rad));
}

// The point of a face that is nearest to p.
Vec2 nearest_on(const PhysicsWorld::Face& face, const Vec2& p) {
  if (face.radius_m <= 0.0) return nearest_on_segment(p, face.p_WA, face.p_WC);
  const Vec2 off = p - face.p_WA;
  const double distance_m = off.norm();
  if (distance_m <= 0.0) return p;
  return face.p_WA + face.radius_m / distance_m * off;
}

}  // namespace

Simulation::Impl::ObstacleMotions::ObstacleMotions(Impl& owner)
    : impl_(owner), is_pedestrian_(owner.world.arena.obstacles.size(), false) {
  for (std::size_t i = 0; i < owner.world.arena.obstacles.size(); ++i) {
    const ObstacleDescription& obstacle = owner.world.arena.obstacles[i];
    if (!is_movable(obstacle)) continue;
    const int index = static_cast<int>(i);
    Moving m{index, owner.physics->add_moving_obstacle(index, obstacle),
             radius_about_center(obstacle)};
    if (obstacle.motion) {
      m.motion = *obstacle.motion;
      m.random.emplace(owner.world.simulation.seed, "obstacles/" + obstacle.name);
      begin(m);
    }
    if (m.motion.law == MotionLaw::kPedestrian) {
      is_pedestrian_[i] = true;
      pedestrians_.push_back(moving_.size());
    }
    moving_.push_back(std::move(m));
  }
}

// --- Waypoints

void Simulation::Impl::ObstacleMotions::begin(Moving& m) {
  m.begin = m.from = m.goal = description(m).center;
  m.next = 0;
  m.backwards = m.turning = m.has_goal = m.blocked = m.off_path = false;
  m.resume_ns = impl_.now_ns;
  choose_next(m);
}

// Sets the next goal, or none.
void Simulation::Impl::ObstacleMotions::choose_next(Moving& m) {
  const std::size_t last = m.motion.points.size();
  const MotionLaw law = m.motion.law;
  m.has_goal = law != MotionLaw::kStand;
  if (law == MotionLaw::kRandomWalk) {
    choose_leg(m);
    return;
  }
  if (m.has_goal && last > 0) {
    switch (m.motion.repeat) {
      case PathRepeat::kOnce:
        m.has_goal = m.next < last;
        ++m.next;
        break;
      case PathRepeat::kRound:
        m.next = (m.next + 1) % (last + 1);
        break;
      case PathRepeat::kBackAndForth:
        if (m.next == last) m.backwards = true;
        if (m.next == 0) m.backwards = false;
        m.next = m.backwards ? m.next - 1 : m.next + 1;
        break;
      case PathRepeat::kRandom: {
        // Any other waypoint.
        const std::size_t others = last - (m.next > 0 && last > 1 ? 1 : 0);
        auto number =
            1 + static_cast<std::size_t>(m.random->uniform() * static_cast<double>(others));
        number = std::min(number, others);
        if (m.next > 0 && last > 1 && number >= m.next) ++number;
        m.next = number;
        break;
      }
    }
  }
  m.has_goal = m.has_goal && last > 0;
  if (m.has_goal) {
    m.goal = m.next == 0 ? m.begin : m.motion.points[m.next - 1];
    return;
  }
  m.next = last;
  m.turning = law == MotionLaw::kPath && m.motion.final_yaw_rad.has_value();
}

// Draws a leg of a random walk that stays in its area; if there is none, it leads to the middle.
void Simulation::Impl::ObstacleMotions::choose_leg(Moving& m) {
  constexpr int kTries = 100;
  const ArenaDescription& arena = impl_.world.arena;
  const std::optional<ObstacleMotion::Area>& area = m.motion.area;
  const Vec2 size = area ? area->size : arena.size;
  const Vec2 middle = area ? area->center : Vec2(arena.origin + 0.5 * arena.size);
  const Vec2 half = (0.5 * size.array() - m.radius_m).max(0.0);
  for (int i = 0; i < kTries; ++i) {
    const double yaw_rad = 2.0 * std::numbers::pi * m.random->uniform() - std::numbers::pi;
    const double length_m = m.motion.leg_m * (0.5 + m.random->uniform());
    m.goal = m.from + length_m * unit_vector(yaw_rad);
    if (((m.goal - middle).array().abs() <= half.array()).all()) return;
  }
  m.goal = middle;
}

void Simulation::Impl::ObstacleMotions::arrive(Moving& m) {
  m.from = m.goal;
  m.off_path = false;
  m.resume_ns = impl_.now_ns + from_seconds(m.motion.wait_s);
  choose_next(m);
  if (!m.has_goal && !m.turning) finish(m);
}

void Simulation::Impl::ObstacleMotions::finish(Moving& m) {
  m.turning = false;
  impl_.record(ArenaEventKind::kArrived, description(m).name);
}

// --- A step

void Simulation::Impl::ObstacleMotions::before_step(double dt_s) {
  for (Moving& m : moving_) {
    if (!description(m).motion || impl_.physics->suspended(m.body)) continue;
    const Pose X_WO = impl_.physics->obstacle_pose(m.body);
    const bool walks = m.motion.law == MotionLaw::kPedestrian;
    const Pose next = walks ? walk(m, X_WO, dt_s) : next_pose(m, X_WO, dt_s);
    impl_.physics->drive_obstacle(m.body, next, dt_s);
  }
}

// Where an obstacle that drives exactly to its goal is after a step.
Pose Simulation::Impl::ObstacleMotions::next_pose(const Moving& m, const Pose& X_WO,
                                                  double dt_s) const {
  const double most_rad = m.motion.turn_rate_radps * dt_s;
  if (impl_.now_ns < m.resume_ns) return X_WO;
  if (!m.has_goal) {
    if (!m.turning) return X_WO;
    return {X_WO.x_m, X_WO.y_m, turned(X_WO.yaw_rad, *m.motion.final_yaw_rad, most_rad)};
  }
  const Vec2 way = m.goal - X_WO.position();
  const double distance_m = way.norm();
  if (m.motion.faces_way && distance_m > kReached_m) {
    const double wanted_rad = yaw_of(way);
    if (std::abs(normalize_angle(wanted_rad - X_WO.yaw_rad)) > kReached_rad) {
      return {X_WO.x_m, X_WO.y_m, turned(X_WO.yaw_rad, wanted_rad, most_rad)};
    }
  }
  const double step_m = m.motion.speed_mps * dt_s;
  if (distance_m <= step_m * (1.0 + 1e-9)) return {m.goal.x(), m.goal.y(), X_WO.yaw_rad};
  const Vec2 p = X_WO.position() + step_m / distance_m * way;
  return {p.x(), p.y(), X_WO.yaw_rad};
}

// Where a pedestrian is after a step.
Pose Simulation::Impl::ObstacleMotions::walk(Moving& m, const Pose& X_WO, double dt_s) {
  const SocialForce& constants = m.motion.force;
  const Vec2 p_WO = X_WO.position();
  const Vec2 velocity = impl_.physics->obstacle_velocity(m.body);
  Vec2 direction = Vec2::Zero();
  if (m.has_goal && impl_.now_ns >= m.resume_ns && !(m.goal - p_WO).isZero(kReached_m)) {
    direction = (m.goal - p_WO).normalized();
  }
  Vec2 force = social_force::towards(direction, m.motion.speed_mps, velocity, constants);
  for (const std::size_t i : pedestrians_) {
    const Moving& other = moving_[i];
    if (other.body == m.body) continue;
    force +=
        social_force::repulsion(p_WO - impl_.physics->obstacle_pose(other.body).position(),
                                impl_.physics->obstacle_velocity(other.body), direction, constants);
  }
  for (int robot = 0; robot < impl_.physics->robot_count(); ++robot) {
    force += social_force::repulsion(p_WO - impl_.physics->body(robot).X_WB.position(),
                                     impl_.physics->obstacle_velocity(robot), direction, constants);
  }
  force += force_of_solids(m, p_WO);
  if (!direction.isZero(0.0)) {
    // White noise, so that its effect does not depend on the step.
    const double x = m.random->normal();
    const double y = m.random->normal();
    force += kFluctuation / std::sqrt(dt_s) * Vec2(x, y);
  }
  Vec2 next = velocity + dt_s * force;
  const double most_mps = social_force::kSpeedRatio * m.motion.speed_mps;
  if (next.norm() > most_mps) next *= most_mps / next.norm();
  double yaw_rad = X_WO.yaw_rad;
  if (m.motion.faces_way && next.norm() > kLeastWalk_mps) {
    yaw_rad = turned(yaw_rad, yaw_of(next), m.motion.turn_rate_radps * dt_s);
  }
  return {p_WO.x() + next.x() * dt_s, p_WO.y() + next.y() * dt_s, yaw_rad};
}

// Each solid repels with its nearest point: a robot, an obstacle, a separator, a side of the
// border, and the map's walls.
Vec2 Simulation::Impl::ObstacleMotions::force_of_solids(const Moving& m, const Vec2& p_WO) {
  using FaceKind = PhysicsWorld::Contact::Kind;
  struct Nearest {
    FaceKind kind;
    int index;
    Vec2 offset;
  };
  const double reach_m = social_force::wall_reach_m(m.motion.force);
  const Vec2 reach(reach_m, reach_m);
  impl_.physics->collect_faces(p_WO - reach, p_WO + reach, -1, faces_);
  std::vector<Nearest> solids;
  for (const PhysicsWorld::Face& face : faces_) {
    if (face.kind == FaceKind::kObstacle && is_pedestrian_[static_cast<std::size_t>(face.index)]) {
      continue;
    }
    const Vec2 offset = p_WO - nearest_on(face, p_WO);
    const auto known = std::find_if(solids.begin(), solids.end(), [&](const Nearest& solid) {
      return solid.kind == face.kind && solid.index == face.index && face.kind != FaceKind::kBorder;
    });
    if (known == solids.end()) {
      solids.push_back({face.kind, face.index, offset});
    } else if (offset.squaredNorm() < known->offset.squaredNorm()) {
      known->offset = offset;
    }
  }
  Vec2 force = Vec2::Zero();
  for (const Nearest& solid : solids) {
    force += social_force::wall_repulsion(solid.offset, m.motion.force);
  }
  return force;
}

void Simulation::Impl::ObstacleMotions::after_step() {
  for (Moving& m : moving_) {
    const Pose X_WO = impl_.physics->obstacle_pose(m.body);
    ObstacleDescription& now = description(m);
    now.center = X_WO.position();
    now.yaw_rad = X_WO.yaw_rad;
    if (!now.motion || impl_.physics->suspended(m.body)) continue;
    note_hindrance(m, now.center);
    if (m.turning) {
      const double left_rad = normalize_angle(*m.motion.final_yaw_rad - now.yaw_rad);
      if (std::abs(left_rad) <= kReached_rad) finish(m);
    } else if (m.has_goal) {
      const double reach_m =
          m.motion.law == MotionLaw::kPedestrian ? kPedestrianReach_m : kReached_m;
      if ((m.goal - now.center).norm() <= reach_m) arrive(m);
    }
  }
}

std::pair<std::string, std::string> Simulation::Impl::ObstacleMotions::partner_of(
    const Moving& m) const {
  std::pair<std::string, std::string> found;
  for (const PhysicsWorld::Contact& contact : impl_.physics->contacts_of(m.body)) {
    const std::string name = partner_name(contact, impl_.world);
    // The order of contacts is Box2D's; the least name does not depend on it.
    std::string& best =
        contact.kind == PhysicsWorld::Contact::Kind::kRobot ? found.first : found.second;
    if (best.empty() || name < best) best = name;
  }
  return found;
}

// Tells when an obstacle stalls and when it leaves its path.
void Simulation::Impl::ObstacleMotions::note_hindrance(Moving& m, const Vec2& p_WO) {
  const bool blocked = impl_.physics->body(m.body).stalled;
  if (blocked && !m.blocked) {
    auto [robot, other] = partner_of(m);
    impl_.record(ArenaEventKind::kBlocked, description(m).name, std::move(robot), std::move(other));
  }
  m.blocked = blocked;
  if (blocked && m.motion.law == MotionLaw::kRandomWalk) {
    m.from = p_WO;
    choose_leg(m);
  }
  if (m.motion.law != MotionLaw::kPath || m.off_path || !m.has_goal) return;
  if (distance_to_segment_m(p_WO, m.from, m.goal) <= kOffPath_m) return;
  m.off_path = true;
  auto [robot, other] = partner_of(m);
  impl_.record(ArenaEventKind::kPushed, description(m).name, std::move(robot), std::move(other));
}

// --- Orders and state

void Simulation::Impl::ObstacleMotions::move(int obstacle, const ObstacleMotion& motion) {
  const auto m = std::find_if(moving_.begin(), moving_.end(),
                              [&](const Moving& other) { return other.obstacle == obstacle; });
  SIM_ASSERT(m != moving_.end() && description(*m).motion);
  m->motion = motion;
  m->has_order = true;
  begin(*m);
  if (motion.law == MotionLaw::kStand) {
    finish(*m);
  } else {
    impl_.record(ArenaEventKind::kMoving, description(*m).name);
  }
}

void Simulation::Impl::ObstacleMotions::placed(int obstacle) {
  for (Moving& m : moving_) {
    if (m.obstacle != obstacle) continue;
    m.from = description(m).center;
    m.off_path = false;
    if (m.motion.law == MotionLaw::kRandomWalk) choose_leg(m);
  }
}

void Simulation::Impl::ObstacleMotions::show(SceneSnapshot& scene) const {
  for (const Moving& m : moving_) {
    if (m.motion.law != MotionLaw::kPath || m.motion.points.empty()) continue;
    ObstacleTrack track{m.obstacle, {m.begin}, m.motion.repeat == PathRepeat::kRound};
    track.points.insert(track.points.end(), m.motion.points.begin(), m.motion.points.end());
    scene.tracks.push_back(std::move(track));
  }
}

void Simulation::Impl::ObstacleMotions::shift_times(SimTime later_ns) {
  for (Moving& m : moving_) m.resume_ns += later_ns;
}

void Simulation::Impl::ObstacleMotions::archive(StateArchive& archive) {
  for (Moving& m : moving_) {
    if (!description(m).motion) continue;
    archive(m.has_order);
    if (m.has_order) {
      ObstacleMotion& o = m.motion;
      archive.choice(o.law, MotionLaw::kPath);  // an order is a path, or to stand
      archive.choice(o.repeat, PathRepeat::kRound);
      archive(o.speed_mps, o.turn_rate_radps, o.faces_way, o.wait_s, o.final_yaw_rad);
      archive.list(o.points, [&](Vec2& point) { archive(point); });
      archive.expect(o.speed_mps > 0.0 && o.speed_mps <= kMaxObstacleSpeed_mps &&
                         o.turn_rate_radps > 0.0 &&
                         o.turn_rate_radps <= kMaxObstacleTurnRate_radps && o.wait_s >= 0.0 &&
                         o.wait_s <= kLongestArenaTime_s,
                     "speeds of obstacles");
    }
    std::uint64_t next = m.next;
    archive(m.begin, m.from, m.goal, next, m.backwards, m.has_goal, m.turning, m.blocked,
            m.off_path);
    archive.time(m.resume_ns);
    archive.expect(next <= m.motion.points.size(), "waypoints that there are");
    archive.expect(!m.turning || m.motion.final_yaw_rad.has_value(), "angles to turn to");
    m.next = next;
    if (m.random) archive(*m.random);
  }
}

}  // namespace sim
