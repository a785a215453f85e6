// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/gripper.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "devices/device_kind.h"
#include "physics/physics_world.h"
#include "sim/devices/robot_snapshot.h"
#include "sim/world/description.h"
#include "sim/world/limits.h"
#include "sim/world/outline.h"

namespace sim {
namespace {

// Positions of the beams as fractions of the paddles' length. As in Stage, they are a quarter from
// either end.
constexpr double kInnerBeam = 0.25;
constexpr double kOuterBeam = 0.75;

// An object that extends beyond the open paddles by at most this still fits.
constexpr double kFits_m = 1e-9;

// The extent of a circle along G's y axis between two x coordinates; see reach_across().
std::optional<std::pair<double, double>> circle_across(const Vec2& p_GT, double radius_m,
                                                       double from_m, double to_m) {
  const double aside_m = std::clamp(p_GT.x(), from_m, to_m) - p_GT.x();
  if (std::abs(aside_m) > radius_m) return std::nullopt;
  const double half_m = std::sqrt((radius_m - aside_m) * (radius_m + aside_m));
  return std::pair(p_GT.y() - half_m, p_GT.y() + half_m);
}

// The extent of a polygon along G's y axis between two x coordinates; see reach_across().
std::optional<std::pair<double, double>> polygon_across(const Polygon& corners, double from_m,
                                                        double to_m) {
  double least = std::numeric_limits<double>::infinity();
  double greatest = -least;
  const auto note = [&](double y) {
    least = std::min(least, y);
    greatest = std::max(greatest, y);
  };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2& a = corners[i];
    const Vec2& b = corners[(i + 1) % corners.size()];
    if (a.x() >= from_m && a.x() <= to_m) note(a.y());
    for (const double x : {from_m, to_m}) {
      if ((a.x() < x) == (b.x() < x)) continue;
      note(a.y() + (x - a.x()) / (b.x() - a.x()) * (b.y() - a.y()));
    }
  }
  if (least > greatest) return std::nullopt;
  return std::pair(least, greatest);
}

// For line-of-sight tests that exclude no solid.
PhysicsWorld::Contact nothing() { return {-1, PhysicsWorld::Contact::Kind::kObstacle, -1}; }

}  // namespace

std::optional<std::pair<double, double>> reach_across(const Pose& X_GT, const Vec2& size_m,
                                                      double from_m, double to_m) {
  const Vec2 half = 0.5 * size_m;
  return polygon_across({X_GT * Vec2(half.x(), half.y()), X_GT * Vec2(-half.x(), half.y()),
                         X_GT * Vec2(-half.x(), -half.y()), X_GT * Vec2(half.x(), -half.y())},
                        from_m, to_m);
}

std::optional<std::pair<double, double>> reach_across(const Pose& X_GT,
                                                      const ObstacleDescription& thing,
                                                      double from_m, double to_m) {
  switch (thing.shape) {
    case ObstacleShape::kCircle:
      return circle_across(X_GT.position(), radius_m(thing), from_m, to_m);
    case ObstacleShape::kPolygon: {
      Polygon outline_G;
      for (const Vec2& p_T : thing.outline) outline_G.push_back(X_GT * p_T);
      return polygon_across(outline_G, from_m, to_m);
    }
    case ObstacleShape::kBox:
      break;
  }
  return reach_across(X_GT, thing.size, from_m, to_m);
}

Gripper::Gripper(std::string name, const GripperParams& params, const Pose& X_BG)
    : SensorOf(std::move(name), "gripper", params.frequency_hz),
      params_(params),
      X_BG_(X_BG),
      travel_ns_(std::max<SimTime>(1, from_seconds(params.travel_time_s))) {}

double Gripper::gap_at(SimTime closed_ns) const noexcept {
  const double open = static_cast<double>(travel_ns_ - closed_ns) / static_cast<double>(travel_ns_);
  return params_.opening_m * open;
}

double Gripper::gap_m() const noexcept { return gap_at(closed_ns_); }

std::vector<std::vector<Vec2>> Gripper::paddles() const {
  const double inner = 0.5 * gap_m();
  const double outer = inner + params_.thickness_m;
  std::vector<std::vector<Vec2>> outlines;
  for (const double side : {1.0, -1.0}) {
    outlines.push_back(
        {X_BG_ * Vec2(0.0, side * inner), X_BG_ * Vec2(params_.length_m, side * inner),
         X_BG_ * Vec2(params_.length_m, side * outer), X_BG_ * Vec2(0.0, side * outer)});
  }
  return outlines;
}

GripperState Gripper::state() const noexcept {
  if (fault_) return GripperState::kError;
  if (motion_ != Motion::kStill) return GripperState::kMoving;
  const bool closed = held_.has_value() || closed_ns_ == travel_ns_;
  return closed ? GripperState::kClosed : GripperState::kOpen;
}

std::optional<std::string> Gripper::execute(const Command& command, RobotControl& robot) {
  const auto* grip = std::get_if<GripCommand>(&command);
  if (grip == nullptr) return apply(command);
  drop_missing(robot.context());
  switch (grip->action) {
    case GripCommand::Action::kOpen:
      return open(robot);
    case GripCommand::Action::kClose:
      fault_ = false;
      if (!held_) motion_ = Motion::kClosing;
      return std::nullopt;
    case GripCommand::Action::kStop:
      motion_ = Motion::kStill;
      return std::nullopt;
    case GripCommand::Action::kStore:
      return store(robot);
    case GripCommand::Action::kRetrieve:
      break;
  }
  return retrieve(robot);
}

std::optional<std::string> Gripper::open(RobotControl& robot) {
  if (held_) {
    if (auto refusal = robot.put_down(held_->obstacle)) {
      fault_ = true;
      return "gripper " + name() + " cannot open: " + *refusal;
    }
    held_.reset();
  }
  fault_ = false;
  motion_ = Motion::kOpening;
  return std::nullopt;
}

std::optional<std::string> Gripper::store(RobotControl& robot) {
  if (!held_) return "gripper " + name() + " holds nothing that it could store";
  if (stored_.size() >= static_cast<std::size_t>(params_.capacity)) {
    return "the store of gripper " + name() + " holds " + std::to_string(params_.capacity) +
           " things at most";
  }
  robot.carry_at(held_->obstacle, Pose{}, true);
  stored_.push_back(*held_);
  held_.reset();
  fault_ = false;
  motion_ = Motion::kOpening;
  return std::nullopt;
}

std::optional<std::string> Gripper::retrieve(RobotControl& robot) {
  if (stored_.empty()) return "the store of gripper " + name() + " is empty";
  if (held_) return "gripper " + name() + " holds something, so it can take nothing from its store";
  held_ = stored_.back();
  stored_.pop_back();
  closed_ns_ = held_->closed_ns;
  fault_ = false;
  motion_ = Motion::kStill;
  robot.carry_at(held_->obstacle, held_->X_BT, false);
  return std::nullopt;
}

// Drops held and stored objects that another client has moved elsewhere.
void Gripper::drop_missing(const StepContext& now) {
  const auto is_missing = [&](const Held& held) {
    const auto index = static_cast<std::size_t>(held.obstacle);
    return index >= now.world.arena.obstacles.size() ||
           now.world.arena.obstacles[index].carried_by != now.robot;
  };
  if (held_ && is_missing(*held_)) held_.reset();
  std::erase_if(stored_, is_missing);
}

void Gripper::act(RobotControl& robot) {
  if (motion_ == Motion::kStill) return;
  const StepContext now = robot.context();
  if (motion_ == Motion::kClosing) {
    close_further(robot, now);
    return;
  }
  closed_ns_ = std::max<SimTime>(0, closed_ns_ - now.world.simulation.step_ns);
  if (closed_ns_ == 0) motion_ = Motion::kStill;
}

void Gripper::close_further(RobotControl& robot, const StepContext& now) {
  const SimTime next_ns = std::min(travel_ns_, closed_ns_ + now.world.simulation.step_ns);
  const double before_m = 0.5 * gap_m() + kFits_m;  // from the centre line
  const double after_m = 0.5 * gap_at(next_ns);
  const Pose X_GW = (now.body.X_WB * X_BG_).inverse();
  // Of all objects that a paddle touches in this step, the one that extends farthest from the
  // centre line.
  int touched = -1;
  double farthest_m = 0.0;
  bool fits = true;
  const auto& things = now.world.arena.obstacles;
  for (std::size_t i = 0; i < things.size(); ++i) {
    const ObstacleDescription& thing = things[i];
    if (!thing.portable || thing.carried_by >= 0 || thing.state != ObstacleState::kExtended ||
        !reaches_height(thing.height_m, params_.height_m)) {
      continue;
    }
    const auto reach = reach_across(X_GW * pose_of(thing), thing, 0.0, params_.length_m);
    if (!reach) continue;
    const auto& [right_m, left_m] = *reach;
    if (right_m > before_m || left_m < -before_m) continue;  // beyond a paddle
    const double out_m = std::max(left_m, -right_m);
    if (out_m < after_m || out_m < farthest_m) continue;
    touched = static_cast<int>(i);
    farthest_m = out_m;
    fits = out_m <= before_m;
  }
  if (touched < 0 && !is_stopped_at(now, 2.0 * after_m)) {
    closed_ns_ = next_ns;
    if (closed_ns_ == travel_ns_) motion_ = Motion::kStill;
    return;
  }
  motion_ = Motion::kStill;
  if (touched < 0 || !fits || robot.pick_up(touched)) {
    fault_ = true;
    return;
  }
  const double share = std::clamp(1.0 - 2.0 * farthest_m / params_.opening_m, 0.0, 1.0);
  closed_ns_ = std::max(
      closed_ns_, static_cast<SimTime>(std::llround(share * static_cast<double>(travel_ns_))));
  held_ =
      Held{touched, now.body.X_WB.inverse() * pose_of(things[static_cast<std::size_t>(touched)]),
           closed_ns_};
}

// Whether a solid keeps the inner side of a paddle from its position at that gap.
bool Gripper::is_stopped_at(const StepContext& now, double gap_m) const {
  const Pose X_WG = now.body.X_WB * X_BG_;
  for (const double side : {0.5, -0.5}) {
    const Vec2 p_WA = X_WG * Vec2(0.0, side * gap_m);
    const Vec2 p_WC = X_WG * Vec2(params_.length_m, side * gap_m);
    if (now.physics.is_inside_solid(p_WA, params_.height_m, now.robot) ||
        !now.physics.is_line_free(p_WA, p_WC, params_.height_m, now.robot, nothing(), true)) {
      return true;
    }
  }
  return false;
}

// Whether an object breaks the beam across the gap at x in G. Of what is not solid only objects do
// that grippers take.
bool Gripper::is_broken(const StepContext& now, double x_m) const {
  const double half_m = 0.5 * gap_m();
  const Pose X_WG = now.body.X_WB * X_BG_;
  if (held_) {
    const auto& thing = now.world.arena.obstacles[static_cast<std::size_t>(held_->obstacle)];
    const auto reach = reach_across(X_BG_.inverse() * held_->X_BT, thing, x_m, x_m);
    if (reach && reach->first <= half_m && reach->second >= -half_m) return true;
  }
  const Pose X_GW = X_WG.inverse();
  for (const ObstacleDescription& thing : now.world.arena.obstacles) {
    if (thing.solid || !thing.portable || thing.carried_by >= 0 ||
        thing.state != ObstacleState::kExtended ||
        !reaches_height(thing.height_m, params_.height_m)) {
      continue;
    }
    const auto reach = reach_across(X_GW * pose_of(thing), thing, x_m, x_m);
    if (reach && reach->first <= half_m && reach->second >= -half_m) return true;
  }
  const Vec2 p_WA = X_WG * Vec2(x_m, half_m);
  const Vec2 p_WC = X_WG * Vec2(x_m, -half_m);
  return now.physics.is_inside_solid(p_WA, params_.height_m, now.robot) ||
         !now.physics.is_line_free(p_WA, p_WC, params_.height_m, now.robot, nothing(), true);
}

void Gripper::measure(const StepContext& context) {
  drop_missing(context);
  auto& reading = next(context);
  reading.state = state();
  reading.outer_beam = is_broken(context, kOuterBeam * params_.length_m);
  reading.inner_beam = is_broken(context, kInnerBeam * params_.length_m);
  reading.holding = held_.has_value();
  reading.stored = static_cast<int>(stored_.size());
  reading.gap_m = gap_m();
}

void Gripper::show(SimTime, RobotSnapshot& shot) const {
  for (Polygon& paddle : paddles()) shot.paddles.push_back(std::move(paddle));
}

void Gripper::Held::archive(StateArchive& archive) { archive(obstacle, X_BT, closed_ns); }

void Gripper::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(closed_ns_, fault_);
  archive.choice(motion_, Motion::kClosing);
  archive.expect(closed_ns_ >= 0 && closed_ns_ <= travel_ns_, "paddles between open and closed");
  archive(held_, stored_);
}

namespace {

/// The middle of the robot's front side.
Pose front_of(const RobotModel& model) {
  double front_m = 0.0;
  for (const Vec2& v : model.footprint) front_m = std::max(front_m, v.x());
  return {front_m, 0.0, 0.0};
}

}  // namespace

constexpr const char* kStateWords[] = {"open", "closed", "moving", "error"};

constexpr Field kGripperSettings[] = {
    frequency_field<&GripperParams::frequency_hz>(),
    mount_field<&GripperParams::X_BG>(
        "pose on the body of the point half-way between the paddles' bases; they point along its x "
        "axis. None: the middle of the robot's front"),
    field<&GripperParams::length_m>("length", "m", "of a paddle").within(kLeastLength_m, 10.0),
    field<&GripperParams::thickness_m>("thickness", "m", "of a paddle").within(0.0, 10.0),
    field<&GripperParams::opening_m>("opening", "m", "distance between the open paddles")
        .within(kLeastLength_m, 10.0),
    height_field<&GripperParams::height_m>("of paddles and beams above the floor; objects that are "
                                           "not higher are neither detected nor taken"),
    field<&GripperParams::travel_time_s>("travel_time", "s", "time from open to closed, and back")
        .above(0.0, 3600.0),
    field<&GripperParams::capacity>("capacity", "", "number of objects that the store can hold")
        .within(0, GripperParams::kMaxStored),
};
SIM_FIELDS(GripperParams, kGripperSettings)

constexpr Field kGripperReading[] = {
    field<&GripperReading::state>("state", "", "of the paddles").one_of(kStateWords),
    field<&GripperReading::outer_beam>("outer_beam", "", "whether it is broken"),
    field<&GripperReading::inner_beam>("inner_beam", "", "whether it is broken"),
    field<&GripperReading::holding>("holding", "", "whether something is held"),
    field<&GripperReading::stored>("stored", "", "number of things in the store")
        .within(0, GripperParams::kMaxStored),
    field<&GripperReading::gap_m>("gap", "m", "between the paddles"),
};
SIM_FIELDS(GripperReading, kGripperReading)

std::string_view to_string(GripperState state) noexcept {
  return kStateWords[static_cast<std::size_t>(state)];
}

DeviceKind gripper_kind() {
  DeviceKind row = device_kind<GripperParams, GripperReading>(
      "gripper", {{"gripper"}},
      [](const DeviceConstruction& construction, const GripperParams& params) {
        return std::make_unique<Gripper>(construction.name(), params,
                                         params.X_BG.value_or(front_of(construction.model)));
      });
  return with_model<GripperParams>(std::move(row),
                                   [](GripperParams& params, const RobotModel& model) {
                                     if (!params.X_BG) params.X_BG = front_of(model);
                                   });
}

}  // namespace sim
