// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "why/story.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "playerlike/replay/happenings.h"
#include "sim/core/time.h"
#include "sim/devices/laser.h"
#include "sim/devices/rangers.h"

namespace playpen::why {
namespace {

/// Index of Story::sensor; nullopt: the robot has none.
std::optional<int> sensor_of_robot(const sim::Simulation& simulation, int robot) {
  std::optional<int> sonar;
  std::optional<int> infrared;
  for (int i = 0; i < simulation.device_count(robot); ++i) {
    const sim::Device& device = simulation.device(robot, i);
    const auto* laser = dynamic_cast<const sim::Laser*>(&device);
    if (laser != nullptr && laser->params().beam_count > 1) return i;
    const auto* ranger = dynamic_cast<const sim::Ranger*>(&device);
    if (ranger == nullptr || ranger->params().X_BS.empty()) continue;
    std::optional<int>& first = device.type() == "sonar" ? sonar : infrared;
    if (!first) first = i;
  }
  return sonar ? sonar : infrared;
}

Transducers transducers_of(const sim::Ranger& ranger) {
  const sim::RangerParams& params = ranger.params();
  Transducers all{ranger.type(), params.X_BS, params.ranges_max_m,
                  params.single_ray ? 0.0 : params.field_of_view_rad};
  all.ranges_max_m.resize(all.X_BS.size(), params.range_max_m);
  return all;
}

Scan scan_of(const sim::Ranger& ranger) {
  const sim::RangerReading& reading = ranger.reading();
  Scan scan;
  scan.time_s = sim::to_seconds(reading.time_ns);
  scan.X_WL = reading.X_WB;
  scan.range_max_m = reading.range_max_m;
  scan.ranges_m.assign(reading.ranges_m.begin(), reading.ranges_m.end());
  return scan;
}

Scan scan_of(const sim::Laser& laser) {
  const sim::LaserReading& reading = laser.reading();
  return {sim::to_seconds(reading.time_ns),
          reading.X_WB * laser.params().X_BL,
          reading.angle_min_rad,
          reading.resolution_rad,
          reading.range_max_m,
          {reading.ranges_m.begin(), reading.ranges_m.end()}};
}

/// Notes the newest scan, unless it is that of the number.
void note_scan(const sim::Device& device, std::uint64_t& number, Story& story) {
  const auto note = [&](const auto& sensor) {
    if (std::exchange(number, sensor.reading().sequence) != sensor.reading().sequence) {
      story.scans.push_back(scan_of(sensor));
    }
  };
  if (story.transducers) {
    note(static_cast<const sim::Ranger&>(device));
  } else {
    note(static_cast<const sim::Laser&>(device));
  }
}

void note_collision(const sim::Simulation& run, const sim::Collision& collision, Story& story) {
  if (story.collisions.empty()) {
    story.surface = grade::surface_of(run.world(), collision.partner);
    if (!story.surface.empty() && !grade::is_on(story.surface, collision.place)) {
      story.surface.clear();
    }
  }
  story.collisions.push_back(collision);
}

void note_commands(const playerlike::Rerun& rerun, int robot, double before_s, Story& story) {
  for (const playerlike::RecordedCommand& command : rerun.commands()) {
    if (command.device.robot != robot) continue;
    if (const auto* twist = std::get_if<sim::TwistCommand>(&command.command)) {
      story.told.push_back({before_s, twist->twist});
      continue;
    }
    ++story.other_commands;
    if (const auto* enable = std::get_if<sim::MotorEnableCommand>(&command.command)) {
      story.motors_switched_off = !enable->enabled;
    }
  }
}

Sample sample_of(const sim::Simulation& simulation, int robot) {
  const sim::BodyState& body = simulation.body(robot);
  return {sim::to_seconds(simulation.now_ns()), body.X_WB, body.twist, body.commanded,
          body.stalled};
}

}  // namespace

Story story_of(playerlike::Rerun& rerun, int robot) {
  const sim::Simulation& run = rerun.simulation();
  Story story;
  story.robot = run.world().robots[static_cast<std::size_t>(robot)].name;
  story.model = run.model(robot);
  const std::optional<int> sensor = sensor_of_robot(run, robot);
  if (sensor) {
    const sim::Device& device = run.device(robot, *sensor);
    story.sensor = device.name();
    const auto* ranger = dynamic_cast<const sim::Ranger*>(&device);
    if (ranger != nullptr) story.transducers = transducers_of(*ranger);
  }
  std::uint64_t scans = 0;
  playerlike::replay::HappeningsWatch watch;
  story.samples.push_back(sample_of(run, robot));
  for (;;) {
    const double before_s = sim::to_seconds(run.now_ns());
    if (!rerun.step()) break;
    note_commands(rerun, robot, before_s, story);
    for (const playerlike::RecordedRead& read : rerun.reads()) {
      story.reads.push_back({before_s, sim::to_seconds(read.age_ns)});
    }
    story.samples.push_back(sample_of(run, robot));
    if (sensor) note_scan(run.device(robot, *sensor), scans, story);
    const playerlike::replay::HappeningsWatch::Happenings happenings = watch.look(run);
    for (const sim::ArenaEvent& e : happenings.events) {
      if (e.who == story.robot || e.kind == sim::ArenaEventKind::kEnd) story.events.push_back(e);
    }
    for (const sim::Collision& collision : happenings.collisions) {
      if (collision.robot == robot) note_collision(run, collision, story);
    }
  }
  story.complete = rerun.complete();
  return story;
}

sim::SceneSnapshot scene_at(playerlike::Rerun& rerun, double time_s) {
  constexpr double kSpacing_m = 0.01;
  const sim::Simulation& run = rerun.simulation();
  std::vector<std::vector<sim::Vec2>> trails(static_cast<std::size_t>(run.robot_count()));
  const auto extend = [&] {
    for (std::size_t i = 0; i < trails.size(); ++i) {
      const sim::Vec2 p = run.body(static_cast<int>(i)).X_WB.position();
      if (trails[i].empty() || (p - trails[i].back()).norm() >= kSpacing_m) trails[i].push_back(p);
    }
  };
  extend();
  while (run.now_ns() < sim::from_seconds(time_s) && rerun.step()) extend();
  sim::SceneSnapshot scene = run.snapshot(/*with_canvas=*/false);
  for (std::size_t i = 0; i < trails.size(); ++i) scene.robots[i].trail = std::move(trails[i]);
  for (const sim::Collision& c : run.collisions()) {
    scene.collisions.push_back({c.robot, c.place, sim::to_seconds(c.time_ns)});
  }
  return scene;
}

const Sample& sample_at(const Story& story, double time_s) {
  constexpr double kRounding_s = 1e-9;
  const auto later =
      std::upper_bound(story.samples.begin(), story.samples.end(), time_s + kRounding_s,
                       [](double time, const Sample& sample) { return time < sample.time_s; });
  return later == story.samples.begin() ? story.samples.front() : *std::prev(later);
}

}  // namespace playpen::why
