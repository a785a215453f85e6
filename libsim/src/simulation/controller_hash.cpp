// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "simulation/controller_hash.h"

#include <string>
#include <variant>
#include <vector>

namespace sim {
namespace {

/// Adds members in order. Lists add their length, optional and variant members which one there is.
class Adder {
 public:
  explicit Adder(StateHash& hash) : hash_(hash) {}

  template <typename... Members>
  void operator()(const Members&... members) {
    (add(members), ...);
  }

 private:
  template <typename Number>
  requires std::is_arithmetic_v<Number>
  void add(const Number& number) { hash_.add(number); }
  template <typename Enum>
  requires std::is_enum_v<Enum>
  void add(const Enum& value) { hash_.add(static_cast<int>(value)); }
  void add(const std::string& text) { hash_.add(text); }
  void add(const Vec2& p) { (*this)(p.x(), p.y()); }
  void add(const Pose& pose) { (*this)(pose.x_m, pose.y_m, pose.yaw_rad); }
  void add(const Colour& colour) { (*this)(colour.r, colour.g, colour.b, colour.a); }
  template <typename A, typename B>
  void add(const std::pair<A, B>& pair) {
    (*this)(pair.first, pair.second);
  }
  template <typename T>
  void add(const std::optional<T>& value) {
    add(value.has_value());
    if (value) add(*value);
  }
  template <typename T>
  void add(const std::vector<T>& list) {
    hash_.add(list.size());
    for (const T& element : list) add(element);
  }
  template <typename... Kinds>
  void add(const std::variant<Kinds...>& value) {
    hash_.add(value.index());
    std::visit([this](const auto& kind) { this->add(kind); }, value);
  }

  void add(const ArenaLimits& l) { (*this)(l.at_least, l.at_most); }
  void add(const TimeCondition& c) { (*this)(c.from_s, c.to_s); }
  void add(const CountCondition& c) { (*this)(c.of, c.limits); }
  void add(const BlockCondition& c) { (*this)(c.block, c.phase); }
  void add(const QuantityCondition& c) { (*this)(c.quantity, c.robot, c.limits); }
  void add(const FiducialCondition& c) { (*this)(c.robot, c.number); }
  void add(const ConfigurationAction& a) { (*this)(a.configuration); }
  void add(const BlocksAction& a) { (*this)(a.change, a.blocks); }
  void add(const PlaceAction& a) { (*this)(a.obstacle, a.pose); }
  void add(const MessageAction& a) { (*this)(a.text); }
  void add(const TextAction& a) { (*this)(a.text, a.place, a.duration_s, a.colour); }
  void add(const CanvasAction::Area& a) { (*this)(a.center, a.size); }
  void add(const CanvasAction& a) { (*this)(a.area, a.colour); }
  void add(const RestartAction& a) { (*this)(a.robot, a.when_blocked); }
  void add(const ScoreAction& a) { (*this)(a.robot, a.points); }
  void add(const SwitchAction& a) { (*this)(a.on, a.names); }
  void add(const EndAction& a) { (*this)(a.passed, a.reason); }
  void add(const MoveAction& a) {
    add(a.obstacle);
    add_motion(hash_, a.motion);
  }
  void add(const BoxRegion& r) { (*this)(r.center, r.size, r.yaw_rad); }
  void add(const CircleRegion& r) { (*this)(r.center, r.radius_m); }
  void add(const PolygonRegion& r) { (*this)(r.corners); }
  void add(const NearRegion& r) { (*this)(r.object, r.distance_m); }
  void add(const ArenaConfiguration& c) {
    (*this)(c.name, c.extended, c.retracted, c.others, c.places);
  }
  void add(const TimerDescription& t) {
    (*this)(t.name, t.at_s, t.every_s, t.times, t.jitter_s, t.within_s, t.enabled, t.conditions,
            t.actions);
  }
  void add(const TrapDescription& t) {
    (*this)(t.name, t.region, t.robots, t.model, t.on, t.stay_s, t.once, t.enabled, t.conditions,
            t.actions);
  }

  StateHash& hash_;
};

}  // namespace

void add_motion(StateHash& hash, const ObstacleMotion& motion) {
  const ObstacleMotion& m = motion;
  const SocialForce& f = m.force;
  hash.add(static_cast<int>(m.law));
  hash.add(static_cast<int>(m.repeat));
  hash.add(m.faces_way ? 1 : 0);
  hash.add(m.final_yaw_rad.has_value() ? 1 : 0);
  for (const double value :
       {m.speed_mps, m.turn_rate_radps, m.wait_s, m.final_yaw_rad.value_or(0.0), m.leg_m,
        m.area_center.x(), m.area_center.y(), m.area_size.x(), m.area_size.y(), f.relaxation_s,
        f.repulsion_m2ps2, f.repulsion_range_m, f.wall_repulsion_m2ps2, f.wall_range_m}) {
    hash.add(value);
  }
  hash.add(m.points.size());
  for (const Vec2& point : m.points) {
    hash.add(point.x());
    hash.add(point.y());
  }
}

void add_controller(StateHash& hash, const ControllerDescription& controller) {
  Adder adder(hash);
  adder(controller.configurations, controller.timers, controller.traps);
}

}  // namespace sim
