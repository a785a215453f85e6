// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/sight.h"

#include <algorithm>
#include <any>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "grade/surface.h"
#include "sim/core/math.h"
#include "sim/core/number_text.h"
#include "sim/core/pose.h"
#include "sim/devices/laser.h"
#include "sim/devices/rangers.h"
#include "sim/simulation/arena_event.h"
#include "sim/simulation/simulation.h"
#include "sim/world/limits.h"
#include "sim/world/outline.h"
#include "sim/world/robot_model.h"

namespace playpen::grade {
namespace {

using sim::Pose;
using sim::Vec2;

/// Differences of places that do not count: a robot touches within the tolerances of the physics.
constexpr double kSamePlace_m = 0.02;
constexpr double kLeastPeriod_s = 0.1;

/// Distance of a robot's outline from a point in B [m]; 0 inside.
double outline_distance_m(const sim::RobotModel& model, const Vec2& p_B) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const sim::Polygon& part : sim::body_parts(model)) {
    if (sim::is_inside(part, p_B)) return 0.0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      least_m =
          std::min(least_m, sim::distance_to_segment_m(p_B, part[i], part[(i + 1) % part.size()]));
    }
  }
  return least_m;
}

/// A sensor of distances.
struct RangeSensor {
  std::string name;
  double frequency_hz = 10.0;
  bool has_cones = false;  ///< the echo from the nearest point in a cone counts
  /// What it sees: a laser sees what a laser sees, a transducer what a laser at its place does.
  std::vector<sim::LaserParams> eyes;
};

double view_of(const sim::LaserParams& eye) { return eye.resolution_rad * (eye.beam_count - 1); }

RangeSensor sensor_of(const std::string& name, const sim::RangerParams& sonar) {
  constexpr double kAbout_rad = std::numbers::pi / 180.0;
  RangeSensor sensor{name, sonar.frequency_hz, true, {}};
  for (std::size_t i = 0; i < sonar.X_BS.size(); ++i) {
    sim::LaserParams eye;
    const int gaps = static_cast<int>(std::ceil(sonar.field_of_view_rad / kAbout_rad));
    eye.beam_count = gaps + 1;
    eye.resolution_rad = sonar.field_of_view_rad / gaps;
    eye.range_max_m = sonar.ranges_max_m.empty() ? sonar.range_max_m : sonar.ranges_max_m[i];
    eye.height_m = sonar.heights_m.empty() ? sonar.height_m : sonar.heights_m[i];
    eye.X_BL = sonar.X_BS[i];
    sensor.eyes.push_back(eye);
  }
  return sensor;
}

/// The lasers of a robot that have more than one beam and that its program may use; if there is
/// none, its sonars with cones.
std::vector<RangeSensor> sensors_of(const sim::RobotDescription& robot,
                                    const std::optional<std::vector<std::string>>& devices) {
  std::vector<RangeSensor> lasers;
  std::vector<RangeSensor> sonars;
  for (const sim::DeviceDescription& device : robot.devices) {
    const auto is_device = [&device](const std::string& name) {
      return name == device.name || name == device.type;
    };
    if (devices && std::ranges::none_of(*devices, is_device)) continue;
    if (const auto* laser = std::any_cast<sim::LaserParams>(&device.params)) {
      if (laser->beam_count < 2) continue;
      lasers.push_back({device.name, laser->frequency_hz, false, {*laser}});
    } else if (const auto* sonar = std::any_cast<sim::SonarParams>(&device.params)) {
      if (sonar->single_ray || sonar->X_BS.empty()) continue;
      sonars.push_back(sensor_of(device.name, *sonar));
    }
  }
  return lasers.empty() ? sonars : lasers;
}

/// Pose of a robot at a time; nullopt if its trajectory does not say it: it does not reach so far,
/// or the robot was put elsewhere.
/// @param max_speed_mps  of the robot.
std::optional<Pose> pose_at(const Trajectory& path, double time_s, double max_speed_mps) {
  constexpr double kRowPeriod_s = 0.1;
  constexpr double kSlack_s = 0.01;
  constexpr double kJump_m = 0.3;
  const auto after = std::ranges::upper_bound(path.time_s, time_s);
  if (after == path.time_s.begin()) return std::nullopt;
  const auto i = static_cast<std::size_t>(after - path.time_s.begin());
  if (after == path.time_s.end()) {
    if (time_s > path.time_s.back() + kRowPeriod_s + kSlack_s) return std::nullopt;
    return path.X_WB.back();
  }
  const Pose& a = path.X_WB[i - 1];
  const Pose& b = path.X_WB[i];
  const double period_s = path.time_s[i] - path.time_s[i - 1];
  const Vec2 move = b.position() - a.position();
  if (move.norm() > 2.0 * max_speed_mps * period_s + kJump_m) return std::nullopt;
  const double share = (time_s - path.time_s[i - 1]) / period_s;
  const double turn_rad = sim::normalize_angle(b.yaw_rad - a.yaw_rad);
  return Pose{a.x_m + share * move.x(), a.y_m + share * move.y(),
              sim::normalize_angle(a.yaw_rad + share * turn_rad)};
}

/// Whether a robot stands where its world puts it, until a time.
bool stands_still(const sim::RobotDescription& robot, const Trajectory& path, double until_s) {
  constexpr double kMove_m = 0.001;
  constexpr double kTurn_rad = 0.01;
  for (std::size_t i = 0; i < path.time_s.size(); ++i) {
    if (i > 0 && path.time_s[i - 1] > until_s) return true;
    if ((path.X_WB[i].position() - robot.pose.position()).norm() > kMove_m) return false;
    const double turn_rad = sim::normalize_angle(path.X_WB[i].yaw_rad - robot.pose.yaw_rad);
    if (std::abs(turn_rad) > kTurn_rad) return false;
  }
  return true;
}

const Trajectory* path_of(const std::vector<Trajectory>& paths, std::string_view robot) {
  const auto path = std::ranges::find(paths, robot, &Trajectory::robot);
  return path == paths.end() ? nullptr : &*path;
}

/// Where the robots of a world were in a run.
class Replay {
 public:
  /// Robots that stood still until a time count as standing until the end.
  Replay(const sim::WorldDescription& world, const std::vector<Trajectory>& paths, double until_s)
      : world_(world) {
    for (const sim::RobotDescription& robot : world.robots) {
      const sim::RobotModel* model = sim::find_robot_model(world, robot.model);
      Robot& one = robots_.emplace_back();
      one.path = path_of(paths, robot.name);
      is_complete_ &= one.path != nullptr && model != nullptr && !robot.real;
      if (!is_complete_) return;
      one.max_speed_mps = model->max_speed_mps;
      one.moves = !stands_still(robot, *one.path, until_s);
    }
  }

  /// Whether the trajectories of all robots are known, and none mirrors a real one.
  [[nodiscard]] bool is_complete() const { return is_complete_; }
  [[nodiscard]] bool moves(std::size_t robot) const { return robots_[robot].moves; }
  /// The poses of all robots at a time; nullopt if one of them is not known.
  [[nodiscard]] std::optional<std::vector<Pose>> poses(double time_s) const {
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      const Robot& one = robots_[i];
      const std::optional<Pose> X_WB = pose_at(*one.path, time_s, one.max_speed_mps);
      if (!X_WB) return std::nullopt;
      poses.push_back(one.moves ? *X_WB : world_.robots[i].pose);
    }
    return poses;
  }

 private:
  struct Robot {
    const Trajectory* path = nullptr;
    double max_speed_mps = 0.0;
    bool moves = false;
  };

  const sim::WorldDescription& world_;
  std::vector<Robot> robots_;
  bool is_complete_ = true;
};

/// The world with robots that have no devices but the eyes of a sensor of one of them. This robot,
/// and those that move, can be put anywhere, as robots that mirror real ones can.
sim::WorldDescription with_eyes(sim::WorldDescription world, std::size_t robot,
                                const RangeSensor& sensor, const Replay& replay) {
  world.controller = {};
  world.canvas = {};
  world.simulation.realism = sim::Realism::kIdeal;
  world.robots_on_port = 0;
  for (std::size_t i = 0; i < world.robots.size(); ++i) {
    sim::RobotDescription& one = world.robots[i];
    one.devices.clear();
    one.proxies.clear();
    one.interfaces.clear();
    one.drivers.clear();
    one.port = 0;
    if (i != robot && !replay.moves(i)) continue;
    one.real.emplace();
    one.real->server = "player://none";
  }
  for (std::size_t i = 0; i < sensor.eyes.size(); ++i) {
    world.robots[robot].devices.push_back(
        {"eye" + std::to_string(1000 + i), "laser", sensor.eyes[i]});
  }
  return world;
}

/// What a sensor of a robot sees of a place.
class PlaceView {
 public:
  PlaceView(const sim::WorldDescription& world, std::size_t robot, const RangeSensor& sensor,
            const Replay& replay, const std::vector<SolidSide>& surface, const Vec2& p_WQ)
      : simulation_(with_eyes(world, robot, sensor, replay)),
        robot_(static_cast<int>(robot)),
        sensor_(sensor),
        surface_(surface),
        p_WQ_(p_WQ) {}

  /// Whether the sensor shows the place; otherwise why not. Nullopt: it is out of range.
  /// @param poses  X_WB of all robots.
  [[nodiscard]] std::optional<Sight::State> state(const std::vector<Pose>& poses) {
    const SolidSide& side = nearest_side(surface_, p_WQ_);
    for (int i = 0; i < simulation_.robot_count(); ++i) {
      // Robots that stand still refuse it.
      static_cast<void>(simulation_.follow_real(i, poses[static_cast<std::size_t>(i)]));
    }
    const Pose& X_WB = poses[static_cast<std::size_t>(robot_)];
    std::optional<Sight::State> state = Sight::State::kOutside;
    for (std::size_t i = 0; i < sensor_.eyes.size(); ++i) {
      const sim::LaserParams& eye = sensor_.eyes[i];
      const Vec2 p_LQ = (X_WB * eye.X_BL).inverse() * p_WQ_;
      if (!sim::reaches_height(side.top_m, eye.height_m)) {
        state = Sight::State::kTooLow;
      } else if (!sim::spans_height(side.bottom_m, side.top_m, eye.height_m)) {
        state = Sight::State::kTooHigh;
      } else if (!is_within_view(eye, p_LQ)) {
        continue;
      } else if (p_LQ.norm() > eye.range_max_m) {
        state.reset();
      } else if (is_shown(i, X_WB, p_LQ)) {
        return Sight::State::kShown;
      } else {
        state = Sight::State::kHidden;
      }
    }
    return state;
  }

  /// Distance of the robot's outline from the place [m].
  [[nodiscard]] double distance_m(const Pose& X_WB) const {
    return outline_distance_m(simulation_.model(robot_), X_WB.inverse() * p_WQ_);
  }

  /// Direction of the place from the eye that looks towards it best, from the robot's heading.
  [[nodiscard]] double bearing_rad(const Pose& X_WB) const {
    double best_rad = std::numeric_limits<double>::infinity();
    double bearing_rad = 0.0;
    for (const sim::LaserParams& eye : sensor_.eyes) {
      const double angle_rad = angle_of((X_WB * eye.X_BL).inverse() * p_WQ_);
      if (std::abs(angle_rad) >= best_rad) continue;
      best_rad = std::abs(angle_rad);
      bearing_rad = sim::normalize_angle(angle_rad + eye.X_BL.yaw_rad);
    }
    return bearing_rad;
  }

 private:
  static double angle_of(const Vec2& p_LQ) { return sim::math::atan2(p_LQ.y(), p_LQ.x()); }
  static bool is_within_view(const sim::LaserParams& eye, const Vec2& p_LQ) {
    return std::abs(angle_of(p_LQ)) <= 0.5 * view_of(eye);
  }

  [[nodiscard]] bool is_shown(std::size_t eye, const Pose& X_WB, const Vec2& p_LQ) const {
    const std::optional<sim::LaserReading> scan =
        simulation_.ideal_scan({robot_, static_cast<int>(eye)});
    if (!scan) return false;
    // The beams on both sides: one of them may pass beside a corner, or meet a nearer part of a
    // wall that is seen at a flat angle.
    const double beam = (angle_of(p_LQ) - scan->angle_min_rad) / scan->resolution_rad;
    const auto last = static_cast<double>(scan->ranges_m.size() - 1);
    const auto range_m = [&](double index) {
      return scan->ranges_m[static_cast<std::size_t>(std::clamp(index, 0.0, last))];
    };
    const double free_m = std::max(range_m(std::floor(beam)), range_m(std::ceil(beam)));
    if (free_m < p_LQ.norm() - kSamePlace_m) return false;
    if (!sensor_.has_cones) return true;
    const double angle_rad = scan->least_angle_rad();
    const Vec2 p_LE = scan->least_range_m() * sim::unit_vector(angle_rad);
    return is_on(surface_, X_WB * sensor_.eyes[eye].X_BL * p_LE);
  }

  sim::Simulation simulation_;
  int robot_;
  const RangeSensor& sensor_;
  const std::vector<SolidSide>& surface_;
  Vec2 p_WQ_;
};

/// The sight of a robot's sensor, from the contact backwards.
std::optional<Sight> sight_by(const RangeSensor& sensor, PlaceView& view, const Replay& replay,
                              std::size_t robot, const Contact& contact) {
  constexpr double kRounding = 1e-6;
  const double period_s = std::max(1.0 / sensor.frequency_hz, kLeastPeriod_s);
  double number = std::ceil(contact.time_s / period_s - kRounding) - 1.0;
  if (number < 1.0) return std::nullopt;
  std::optional<std::vector<Pose>> poses = replay.poses(number * period_s);
  const std::optional<Sight::State> state = poses ? view.state(*poses) : std::nullopt;
  if (!state) return std::nullopt;
  Sight sight;
  sight.sensor = sensor.name;
  sight.state = *state;
  if (sensor.eyes.size() == 1) sight.field_of_view_rad = view_of(sensor.eyes.front());
  const bool is_shown = sight.state == Sight::State::kShown;
  if (is_shown) sight.shown_for_s = contact.time_s - number * period_s;
  Pose X_WB = (*poses)[robot];
  const bool may_have_been_shown =
      sight.state == Sight::State::kOutside || sight.state == Sight::State::kHidden;
  while (is_shown || may_have_been_shown) {
    number -= 1.0;
    const double before_s = contact.time_s - number * period_s;
    if (number < 1.0 || before_s > kLongestSight_s + kRounding) break;
    poses = replay.poses(number * period_s);
    if (!poses) break;
    const bool was_shown = view.state(*poses) == Sight::State::kShown;
    if (was_shown && is_shown) {
      sight.shown_for_s = before_s;
      X_WB = (*poses)[robot];
    } else if (was_shown) {
      sight.last_shown_s = before_s;
    }
    if (was_shown != is_shown) break;
  }
  sight.distance_m = view.distance_m(X_WB);
  sight.bearing_rad = view.bearing_rad(X_WB);
  return sight;
}

std::string degrees_text(double angle_rad) {
  return sim::fixed_text(std::abs(angle_rad) * 180.0 / std::numbers::pi, 0) + " degrees";
}

/// "ahead", "ahead to the left", "to the right", "behind": eight sectors of 45 degrees.
std::string direction_text(double bearing_rad) {
  constexpr std::array kWords = {"ahead", "ahead to the ", "to the ", "behind to the ", "behind"};
  const auto sector = static_cast<std::size_t>(
      std::lround(std::min(std::abs(bearing_rad) / (std::numbers::pi / 4.0), 4.0)));
  const bool has_side = sector > 0 && sector < 4;
  return std::string(kWords.at(sector)) + (has_side ? (bearing_rad > 0.0 ? "left" : "right") : "");
}

/// "113 degrees to the left", "behind".
std::string angle_text(double bearing_rad) {
  std::string direction = direction_text(bearing_rad);
  if (direction == "ahead" || direction == "behind") return direction;
  return degrees_text(bearing_rad) + (bearing_rad > 0.0 ? " to the left" : " to the right");
}

/// Why a sensor does not show a place.
std::string reason_text(const Sight& sight) {
  switch (sight.state) {
    case Sight::State::kShown:
      return "";
    case Sight::State::kOutside:
      return "it was " + angle_text(sight.bearing_rad) +
             (sight.field_of_view_rad > 0.0
                  ? ", outside of its " + degrees_text(sight.field_of_view_rad)
                  : ", where no transducer looks");
    case Sight::State::kTooLow:
      return "it is too low";
    case Sight::State::kTooHigh:
      return "it is too high above the floor";
    case Sight::State::kHidden:
      return "something was in front of it";
  }
  return "";
}

}  // namespace

std::string name_of(Sight::State state) {
  switch (state) {
    case Sight::State::kShown:
      return "shown";
    case Sight::State::kOutside:
      return "outside";
    case Sight::State::kTooLow:
      return "too-low";
    case Sight::State::kTooHigh:
      return "too-high";
    case Sight::State::kHidden:
      return "hidden";
  }
  return "";
}

bool may_have_changed(const sim::WorldDescription& world, const playerlike::Report& report,
                      double until_s) {
  using Kind = sim::ArenaEventKind;
  const auto may_move = [](const sim::ObstacleDescription& obstacle) {
    return is_movable(obstacle) || obstacle.portable;
  };
  if (std::ranges::any_of(world.arena.obstacles, may_move)) return true;
  if (!report.events) {
    const auto is_dynamic = [](const sim::ObstacleDescription& obstacle) {
      return obstacle.type == sim::ObstacleType::kDynamic;
    };
    return !world.simulation.objects_locked &&
           std::ranges::any_of(world.arena.obstacles, is_dynamic);
  }
  if (!report.events->empty() && report.events->front().number != 1) return true;
  return std::ranges::any_of(*report.events, [until_s](const playerlike::Report::Event& event) {
    if (event.time_s > until_s) return false;
    const auto changes = {Kind::kRising, Kind::kExtended, Kind::kSinking, Kind::kRetracted,
                          Kind::kPlaced, Kind::kMoving,   Kind::kPushed};
    return std::ranges::any_of(changes,
                               [&event](Kind kind) { return event.kind == sim::to_string(kind); });
  });
}

std::optional<Sight> sight_of(const sim::WorldDescription& world, std::string_view robot,
                              const std::vector<Trajectory>& paths, const Contact& contact,
                              const std::optional<std::vector<std::string>>& devices) {
  const auto own = std::ranges::find(world.robots, robot, &sim::RobotDescription::name);
  if (own == world.robots.end()) return std::nullopt;
  const auto index = static_cast<std::size_t>(own - world.robots.begin());
  const Replay replay(world, paths, contact.time_s);
  if (!replay.is_complete()) return std::nullopt;
  const auto hit = std::ranges::find(world.robots, contact.partner, &sim::RobotDescription::name);
  const bool hit_robot = hit != world.robots.end();
  if (hit_robot && replay.moves(static_cast<std::size_t>(hit - world.robots.begin()))) {
    return std::nullopt;
  }
  const std::vector<SolidSide> surface = surface_of(world, contact.partner);
  if (surface.empty() || !is_on(surface, contact.place)) return std::nullopt;
  const std::vector<RangeSensor> sensors = sensors_of(*own, devices);
  std::optional<Sight> best;
  for (const RangeSensor& sensor : sensors) {
    PlaceView view(world, index, sensor, replay, surface, contact.place);
    const std::optional<Sight> sight = sight_by(sensor, view, replay, index, contact);
    if (!sight) return std::nullopt;
    if (!best || sight->shown_for_s > best->shown_for_s) best = sight;
  }
  // Each sensor of several has another reason not to show the place.
  if (best && best->state != Sight::State::kShown && sensors.size() > 1) return std::nullopt;
  return best;
}

std::string sight_text(const Sight& sight) {
  const std::string sensor = "the " + sight.sensor;
  if (sight.state != Sight::State::kShown) {
    return sensor +
           (sight.last_shown_s ? " had not shown that place for the last " +
                                     sim::fixed_text(*sight.last_shown_s, 1) + " s: "
                               : " could not see that place: ") +
           reason_text(sight);
  }
  constexpr double kAbout_s = 0.5;
  if (sight.shown_for_s > kLongestSight_s - kAbout_s) {
    return sensor + " had shown it for a minute or longer";
  }
  return sensor + " had shown it for " + sim::fixed_text(sight.shown_for_s, 1) + " s, at first " +
         sim::fixed_text(sight.distance_m, 2) + " m " + direction_text(sight.bearing_rad);
}

std::string contact_text(const Contact& contact) {
  return "first hit " + contact.partner + " at (" + sim::fixed_text(contact.place.x(), 2) + ", " +
         sim::fixed_text(contact.place.y(), 2) + ") after " + sim::fixed_text(contact.time_s, 1) +
         " s" + (contact.sight ? "; " + sight_text(*contact.sight) : "");
}

}  // namespace playpen::grade
