// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/testing/check.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "sim/core/math.h"
#include "sim/core/number_text.h"
#include "sim/devices/laser.h"
#include "testing/clearance.h"
#include "testing/run_content.h"

namespace playpen::testing {
namespace {

// Speeds are rounded by the physics to a float's accuracy.
constexpr double kSpeedRounding_mps = 1e-6;

std::string metres(double value_m) { return sim::fixed_text(value_m, 3) + " m"; }

std::string when_and_where(const Sample& at) {
  return "at " + sim::fixed_text(at.time_s, 2) + " s, x " + sim::fixed_text(at.pose.x_m, 2) +
         ", y " + sim::fixed_text(at.pose.y_m, 2);
}

std::vector<std::string> judged_robots(const Subject& subject) {
  if (subject.robot().empty()) return subject.run().robots();
  static_cast<void>(subject.run().pose(subject.robot()));  // must exist
  return {subject.robot()};
}

// The sample with the greatest value, and the robot that it belongs to.
struct Extreme {
  double value = -INFINITY;
  std::string robot;
  Sample at;
};

Extreme greatest(const Subject& subject, const std::function<double(const Sample&)>& value_of) {
  Extreme most;
  const TestRun::Content& content = Judge::content(subject.run());
  for (const std::string& robot : judged_robots(subject)) {
    const auto index = static_cast<std::size_t>(content.robot(robot));
    content.look([&](const sim::Simulation&, const Record& record) {
      for (const Sample& sample : record.paths[index]) {
        const double value = value_of(sample);
        if (value <= most.value && !most.robot.empty()) continue;
        most = {value, robot, sample};
      }
    });
  }
  return most;
}

double distance_m(const Sample& sample, const Point& point) {
  return sim::math::hypot(sample.pose.x_m - point.x_m, sample.pose.y_m - point.y_m);
}

// How near each robot has come to a point; the robot that stayed farthest decides.
Extreme least_near(const Subject& subject, const Point& point) {
  Extreme worst;
  for (const std::string& robot : judged_robots(subject)) {
    Extreme nearest = greatest(of(subject.run(), robot),
                               [&](const Sample& sample) { return -distance_m(sample, point); });
    nearest.value = -nearest.value;
    if (nearest.value > worst.value) worst = std::move(nearest);
  }
  return worst;
}

Verdict verdict_at(bool met, const Extreme& extreme, std::string text, const std::string& label) {
  return {met, std::move(text), TestRun::Mark{extreme.robot, extreme.at, label}};
}

}  // namespace

Verdict check_clearance(const Subject& subject, double least_m) {
  const Extreme nearest =
      greatest(subject, [](const Sample& sample) { return -sample.clearance_m; });
  const double clearance_m = nearest.at.clearance_m;
  const std::string solid = subject.run().solid_name(nearest.at.nearest);
  if (nearest.at.nearest < 0) return {true, "there is nothing solid", std::nullopt};
  return verdict_at(clearance_m >= least_m, nearest,
                    nearest.robot + " came within " + metres(clearance_m) + " of " + solid + ' ' +
                        when_and_where(nearest.at),
                    metres(clearance_m) + " to " + solid);
}

Verdict check_reaches(const Subject& subject, const Point& point, double tolerance_m) {
  const Extreme nearest = least_near(subject, point);
  const bool met = nearest.value <= tolerance_m;
  const std::string distance = metres(nearest.value);
  return verdict_at(
      met, nearest,
      nearest.robot +
          (met ? " was " + distance + " from there " : " came no nearer than " + distance + ", ") +
          when_and_where(nearest.at),
      "nearest: " + distance);
}

Verdict check_goals(const Subject& subject) {
  int goals = 0;
  for (const std::string& robot : judged_robots(subject)) {
    const TestRun::Content& content = Judge::content(subject.run());
    const int index = content.robot(robot);
    const auto all =
        content.look([](const sim::Simulation&, const Record& record) { return record.goals; });
    for (const GoalState& goal : all) {
      if (goal.robot != index) continue;
      ++goals;
      if (goal.reached) continue;
      Verdict verdict = check_reaches(of(subject.run(), robot), goal.point, goal.tolerance_m);
      verdict.met = false;
      verdict.text += " (goal at x " + sim::shortest_text(goal.point.x_m) + ", y " +
                      sim::shortest_text(goal.point.y_m) + ", tolerance " +
                      sim::shortest_text(goal.tolerance_m) + " m)";
      return verdict;
    }
  }
  if (goals == 0) throw Error("ReachesGoals: no robot has a goal; World::Goal adds one");
  return {true, "all " + std::to_string(goals) + " goals are reached", std::nullopt};
}

Verdict check_speed(const Subject& subject, double most_mps) {
  const Extreme fastest = greatest(subject, [](const Sample& sample) { return sample.speed_mps; });
  const std::string speed = sim::fixed_text(fastest.value, 3) + " m/s";
  return verdict_at(fastest.value <= most_mps + kSpeedRounding_mps, fastest,
                    fastest.robot + " drove " + speed + ' ' + when_and_where(fastest.at), speed);
}

Verdict check_sees(const Subject& subject, double most_m) {
  Verdict verdict;
  const TestRun::Content& content = Judge::content(subject.run());
  for (const std::string& robot : judged_robots(subject)) {
    const auto& info = content.host->robots()[static_cast<std::size_t>(content.robot(robot))];
    const auto laser = std::find_if(info.devices.begin(), info.devices.end(),
                                    [](const auto& device) { return device.type == "laser"; });
    if (laser == info.devices.end()) throw Error("SeesWallWithin: " + robot + " has no laser");
    Sample now;
    sim::LaserReading scan;
    content.look([&](const sim::Simulation& simulation, const Record& record) {
      now = record.paths[static_cast<std::size_t>(laser->id.robot)].back();
      const sim::Sensor* sensor = simulation.device(laser->id.robot, laser->id.device).sensor();
      scan = dynamic_cast<const sim::LaserReading&>(sensor->reading());
    });
    const std::string path = robot + '.' + laser->name;
    if (scan.sequence == 0) return {false, path + " has made no scan yet", std::nullopt};
    const double least_m = scan.least_range_m();
    Verdict one{least_m <= most_m,
                path + " measured " + metres(least_m) + " at the bearing " +
                    sim::fixed_text(scan.least_angle_rad(), 2) + " rad " + when_and_where(now),
                TestRun::Mark{robot, now, "sees " + metres(least_m)}};
    if (verdict.text.empty() || !one.met) verdict = std::move(one);
    if (!verdict.met) break;
  }
  return verdict;
}

Verdict check_collisions(const Subject& subject) {
  const std::vector<Collision> all = subject.run().collisions(subject.robot());
  if (all.empty()) return {true, "no collision", std::nullopt};
  const Collision& first = all.front();
  const std::vector<Sample> path = subject.run().path(first.robot);
  const auto at = std::find_if(path.begin(), path.end(),
                               [&](const Sample& sample) { return sample.time_s >= first.time_s; });
  const Sample moment = at == path.end() ? path.back() : *at;
  const std::string others = all.size() == 1 ? "" : "; collisions: " + std::to_string(all.size());
  return {false,
          first.robot + " hit " + first.partner + " at " + sim::fixed_text(first.time_s, 2) +
              " s, x " + sim::fixed_text(first.place.x_m, 2) + ", y " +
              sim::fixed_text(first.place.y_m, 2) + others,
          TestRun::Mark{first.robot, moment, "hit " + first.partner}};
}

}  // namespace playpen::testing
