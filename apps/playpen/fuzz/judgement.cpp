// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/judgement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "grade/map_score.h"
#include "grade/shortest_path.h"
#include "sim/core/number_text.h"
#include "sim/world/robot_model.h"

namespace playpen::fuzz {
namespace {

using playerlike::Report;

constexpr double kStall_s = 3.0;
constexpr double kStuck_s = 15.0;
constexpr double kStuck_m = 0.15;
constexpr double kStanding_mps = 0.01;
// A way to the goal counts if it has this much room beside the robot.
constexpr double kWayRoom_m = 0.06;

constexpr std::array<std::pair<Kind, std::string_view>, 10> kNames{
    {{Kind::kCrash, "crash"},
     {Kind::kSanitizer, "sanitizer"},
     {Kind::kBadStatus, "bad-status"},
     {Kind::kHang, "hang"},
     {Kind::kCollision, "collision"},
     {Kind::kVerdict, "verdict"},
     {Kind::kGoal, "goal"},
     {Kind::kStall, "stall"},
     {Kind::kStuck, "stuck"},
     {Kind::kExpectation, "expectation"}}};

std::string at_text(double time_s, const sim::Vec2& place) {
  return " at " + sim::fixed_text(time_s, 2) + " s, (" + sim::fixed_text(place.x(), 2) + ", " +
         sim::fixed_text(place.y(), 2) + ')';
}

const grade::Trajectory* trajectory_of(const RunResult& result, const Base& base) {
  const auto found = std::ranges::find(result.trajectories, base.robot_description().name,
                                       &grade::Trajectory::robot);
  return found == result.trajectories.end() || found->time_s.empty() ? nullptr : &*found;
}

const Report::Robot* robot_of(const RunResult& result, const Base& base) {
  if (!result.report) return nullptr;
  const auto found =
      std::ranges::find(result.report->robots, base.robot_description().name, &Report::Robot::name);
  return found == result.report->robots.end() ? nullptr : &*found;
}

// The first line of a sanitizer's report; "": there is none.
std::string sanitizer_line(const std::string& printed) {
  for (const std::string_view words :
       {"ERROR: AddressSanitizer", "ERROR: LeakSanitizer", "WARNING: ThreadSanitizer",
        "WARNING: MemorySanitizer", ": runtime error: "}) {
    const std::size_t at = printed.find(words);
    if (at == std::string::npos) continue;
    const std::size_t begin = printed.rfind('\n', at) + 1;
    return printed.substr(begin, std::min(printed.find('\n', at), printed.size()) - begin);
  }
  return "";
}

// The speed of the robot before a time.
double speed_before_mps(const grade::Trajectory& trajectory, double time_s) {
  const auto after = std::ranges::lower_bound(trajectory.time_s, time_s);
  if (after == trajectory.time_s.begin()) return 0.0;
  return std::abs(
      trajectory.v_mps[static_cast<std::size_t>(after - trajectory.time_s.begin()) - 1]);
}

// Whether a thing moves by itself: a robot, or an obstacle with a drive.
bool moves(const std::string& name, const sim::WorldDescription& world) {
  const auto& obstacles = world.arena.obstacles;
  const auto found = std::ranges::find(obstacles, name, &sim::ObstacleDescription::name);
  if (found != obstacles.end()) return found->motion.has_value();
  return std::ranges::find(world.robots, name, &sim::RobotDescription::name) != world.robots.end();
}

std::optional<Failure> collision_of(const RunResult& result, const Base& base,
                                    const Base::World& world) {
  const grade::Trajectory* const trajectory = trajectory_of(result, base);
  for (const Report::Collision& one : result.report->collisions) {
    if (one.robot != base.robot_description().name) continue;
    const bool stood =
        trajectory != nullptr && speed_before_mps(*trajectory, one.time_s) < kStanding_mps;
    // A thing that moves has driven against a robot that stands.
    if (stood && moves(one.with, world.description)) continue;
    return Failure{Kind::kCollision, "hits " + one.with + at_text(one.time_s, one.place), one.with,
                   one.time_s};
  }
  return std::nullopt;
}

bool reaches(const grade::Goal& goal, const sim::Pose& end) {
  if ((end.position() - goal.position).norm() > goal.tolerance_m) return false;
  return !goal.yaw_rad || std::abs(std::remainder(end.yaw_rad - *goal.yaw_rad, 2.0 * M_PI)) <=
                              goal.yaw_tolerance_rad;
}

bool has_way(const grade::Goal& goal, const Base& base, const Base::World& world) {
  const sim::Vec2 start = world.description.robots[base.robot()].pose.position();
  const sim::OccupancyMap space = grade::inflate(grade::make_truth(world.description.arena),
                                                 base.robot_radius_m() + kWayRoom_m);
  return grade::shortest_way(space, start, goal.position, goal.tolerance_m).has_value();
}

std::optional<Failure> goal_missed(const RunResult& result, const Rules& rules, const Base& base,
                                   const Base::World& world) {
  const Report::Robot* const robot = robot_of(result, base);
  if (!rules.goal || robot == nullptr || reaches(*rules.goal, robot->final_pose) ||
      !has_way(*rules.goal, base, world)) {
    return std::nullopt;
  }
  const double away_m = (robot->final_pose.position() - rules.goal->position).norm();
  const double end_s = result.report->run.sim_time_s;
  return Failure{Kind::kGoal,
                 "is " + sim::fixed_text(away_m, 2) + " m from its goal" +
                     at_text(end_s, robot->final_pose.position()),
                 "", end_s};
}

// Whether the robot stayed at one place until the end, from which time on.
std::optional<Failure> stuck(const RunResult& result, const Base& base) {
  const grade::Trajectory* const way = trajectory_of(result, base);
  if (way == nullptr || !result.report->ended ||
      result.report->ended->by != playerlike::RunEnd::By::kDuration) {
    return std::nullopt;
  }
  const sim::Vec2 last = way->X_WB.back().position();
  std::size_t since = way->X_WB.size();
  while (since > 0 && (way->X_WB[since - 1].position() - last).norm() < kStuck_m) --since;
  const double begin_s = since == 0 ? 0.0 : way->time_s[since - 1];
  if (way->time_s.back() - begin_s < kStuck_s) return std::nullopt;
  return Failure{Kind::kStuck,
                 "stays within " + sim::fixed_text(kStuck_m, 2) + " m from " +
                     sim::fixed_text(begin_s, 1) + " s on" + at_text(way->time_s.back(), last),
                 "", way->time_s.back()};
}

// Whether the run was over before the program ended: what it says then is about that.
bool was_over(const RunResult& result) {
  return result.report && result.report->ended &&
         (result.report->ended->by == playerlike::RunEnd::By::kDuration ||
          result.report->ended->by == playerlike::RunEnd::By::kVerdict);
}

std::optional<Failure> failure_of_kind(Kind kind, const RunResult& result, const Rules& rules,
                                       const Base& base, const Base::World& world) {
  switch (kind) {
    case Kind::kCrash:
      if (!result.end.signal || result.hangs) return std::nullopt;
      return Failure{kind, result.end.text(), "", 0.0};
    case Kind::kSanitizer: {
      const std::string line = sanitizer_line(result.printed);
      return line.empty() ? std::nullopt : std::optional(Failure{kind, line, "", 0.0});
    }
    case Kind::kBadStatus:
      if (result.end.signal || result.end.status == 0 || was_over(result)) return std::nullopt;
      // A program that finds no way says so by its status.
      if (rules.goal && !has_way(*rules.goal, base, world)) return std::nullopt;
      return Failure{kind, result.end.text(), "", 0.0};
    case Kind::kHang:
      if (!result.hangs) return std::nullopt;
      return Failure{kind, "does not end within the limit of time", "", 0.0};
    default:
      break;
  }
  if (!result.report) return std::nullopt;
  const Report& report = *result.report;
  switch (kind) {
    case Kind::kCollision:
      return collision_of(result, base, world);
    case Kind::kVerdict:
      if (!report.verdict || report.verdict->passed) return std::nullopt;
      return Failure{kind, "fails: " + report.verdict->reason, "", report.verdict->time_s};
    case Kind::kGoal:
      return goal_missed(result, rules, base, world);
    case Kind::kStall: {
      const Report::Robot* const robot = robot_of(result, base);
      if (robot == nullptr || robot->stalled_time_s < kStall_s) return std::nullopt;
      return Failure{
          kind, "pushes against something for " + sim::fixed_text(robot->stalled_time_s, 1) + " s",
          "", report.run.sim_time_s};
    }
    case Kind::kStuck:
      return rules.must_move ? stuck(result, base) : std::nullopt;
    case Kind::kExpectation:
      for (const expect::Expectation& expectation : rules.expectations) {
        const std::vector<std::string> faults = expectation.faults_of(report);
        if (faults.empty()) continue;
        return Failure{kind, "does not meet " + expectation.text() + ": " + faults.front(),
                       expectation.text(), report.run.sim_time_s};
      }
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

}  // namespace

std::string_view name_of(Kind kind) {
  return std::ranges::find(kNames, kind, &std::pair<Kind, std::string_view>::first)->second;
}

const std::vector<Kind>& all_kinds() {
  static const std::vector<Kind> kAll = [] {
    std::vector<Kind> all;
    for (const auto& [kind, name] : kNames) all.push_back(kind);
    return all;
  }();
  return kAll;
}

std::optional<Failure> failure_of(const RunResult& result, const Rules& rules, const Base& base,
                                  const Base::World& world) {
  for (const Kind kind : rules.kinds) {
    if (auto failure = failure_of_kind(kind, result, rules, base, world)) return failure;
  }
  return std::nullopt;
}

double least_clearance_m(const RunResult& result, const Base& base) {
  const Report::Robot* const robot = robot_of(result, base);
  if (robot == nullptr || !robot->least_clearance_m) return std::numeric_limits<double>::infinity();
  return *robot->least_clearance_m;
}

}  // namespace playpen::fuzz
