// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/replay/replay_builder.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "playerlike/replay/columns.h"
#include "playerlike/replay/field_values.h"
#include "sim/core/utf8.h"
#include "sim/devices/builtin.h"
#include "sim/devices/laser.h"
#include "sim/devices/rangers.h"
#include "sim/devices/waypoint.h"

namespace playerlike::replay {
namespace {

constexpr sim::SimTime kFramePeriod_ns = sim::kNanosecondsPerSecond / 20;
constexpr std::size_t kMostSeries = 64;  // of a device
constexpr std::int64_t kGreatestRange = 65535;

std::int64_t packed(sim::Colour colour) {
  return (std::int64_t{colour.r} << 24) | (std::int64_t{colour.g} << 16) |
         (std::int64_t{colour.b} << 8) | std::int64_t{colour.a};
}

std::int64_t place_units(double metres) { return quantised(metres, kPlaceUnit_m); }

// What moves on a robot, as whole numbers: how many bumpers, and whether each is pressed; how many
// lights, and the colour of each that is lit, or -1; how many paddles and arms, and for each the
// number of its points and their coordinates in B.
std::vector<std::int64_t> look_of(const sim::RobotSnapshot& robot) {
  std::vector<std::int64_t> record;
  record.push_back(static_cast<std::int64_t>(robot.bumpers.size()));
  for (const sim::BumperSnapshot& bumper : robot.bumpers) record.push_back(bumper.pressed ? 1 : 0);
  record.push_back(static_cast<std::int64_t>(robot.lights.size()));
  for (const sim::LightSnapshot& light : robot.lights) {
    record.push_back(light.lit ? packed(light.colour) : -1);
  }
  for (const auto* const shapes : {&robot.paddles, &robot.arms}) {
    record.push_back(static_cast<std::int64_t>(shapes->size()));
    for (const std::vector<sim::Vec2>& points : *shapes) {
      record.push_back(static_cast<std::int64_t>(points.size()));
      for (const sim::Vec2& p_B : points) {
        record.push_back(place_units(p_B.x()));
        record.push_back(place_units(p_B.y()));
      }
    }
  }
  return record;
}

// States of obstacles: 0 standing, 1 retracted, 2 rising, 3 sinking, 4 waiting to rise.
std::int64_t state_code(const sim::ObstacleDescription& obstacle, const sim::MovingBlock* moving) {
  if (moving != nullptr) {
    if (moving->phase == sim::BlockPhase::kRising) return 2;
    if (moving->phase == sim::BlockPhase::kSinking) return 3;
    if (moving->phase == sim::BlockPhase::kRetracted) return 4;
  }
  const bool retracted = obstacle.type == sim::ObstacleType::kDynamic &&
                         obstacle.state == sim::ObstacleState::kRetracted;
  return retracted ? 1 : 0;
}

// Place and heading, size, height above the floor, state, the robot that carries it, and colour.
std::vector<std::int64_t> obstacle_record(const sim::ObstacleDescription& obstacle,
                                          const sim::MovingBlock* moving) {
  return {place_units(obstacle.center.x()),
          place_units(obstacle.center.y()),
          quantised(obstacle.yaw_rad, kAngleUnit_rad),
          place_units(obstacle.size.x()),
          place_units(obstacle.size.y()),
          quantised(moving != nullptr ? moving->height_m : obstacle.height_m, kRangeUnit),
          state_code(obstacle, moving),
          obstacle.carried_by,
          obstacle.colour ? packed(*obstacle.colour) : -1};
}

std::vector<sim::Pose> places_of(const sim::Simulation& simulation) {
  std::vector<sim::Pose> places;
  for (int robot = 0; robot < simulation.robot_count(); ++robot) {
    places.push_back(simulation.body(robot).X_WB);
  }
  return places;
}

std::optional<BeamGeometry> beams_of(const sim::Device& device) {
  if (const auto* const laser = dynamic_cast<const sim::Laser*>(&device)) {
    const sim::LaserReading& reading = laser->reading();
    return BeamGeometry{.X_BS = {laser->params().X_BL},
                        .angle_min_rad = reading.angle_min_rad,
                        .resolution_rad = reading.resolution_rad,
                        .field_of_view_rad = 0.0,
                        .range_max_m = {reading.range_max_m}};
  }
  if (const auto* const ranger = dynamic_cast<const sim::Ranger*>(&device)) {
    const sim::RangerParams& params = ranger->params();
    return BeamGeometry{.X_BS = params.X_BS,
                        .angle_min_rad = 0.0,
                        .resolution_rad = 0.0,
                        .field_of_view_rad = params.field_of_view_rad,
                        .range_max_m = params.ranges_max_m.empty()
                                           ? std::vector<double>{params.range_max_m}
                                           : params.ranges_max_m};
  }
  return std::nullopt;
}

// Adds the ranges of a range sensor and the pose from where it has measured them.
void add_beams(const sim::Reading& reading, DeviceLog& log) {
  const std::vector<double>* ranges_m = nullptr;
  if (const auto* const scan = dynamic_cast<const sim::LaserReading*>(&reading)) {
    log.X_WB.push_back(scan->X_WB);
    log.beams->angle_min_rad = scan->angle_min_rad;
    log.beams->resolution_rad = scan->resolution_rad;
    log.beams->range_max_m = {scan->range_max_m};
    ranges_m = &scan->ranges_m;
  } else if (const auto* const round = dynamic_cast<const sim::RangerReading*>(&reading)) {
    log.X_WB.push_back(round->X_WB);
    log.beams->X_BS = round->X_BS;
    ranges_m = &round->ranges_m;
  }
  ListSeries& list = log.lists.front();
  list.counts.push_back(static_cast<std::int64_t>(ranges_m->size()));
  for (const double range_m : *ranges_m) {
    list.values.push_back(
        std::clamp(quantised(range_m, kRangeUnit), std::int64_t{0}, kGreatestRange));
  }
}

void add_number(const FieldValue& value, DeviceLog& log) {
  const std::size_t before = log.times_ns.size() - 1;  // readings before this one
  auto found = std::ranges::find(log.series, value.name, &Series::name);
  if (found == log.series.end()) {
    if (log.series.size() == kMostSeries) return;
    log.series.push_back({value.name,
                          value.unit,
                          {value.words.begin(), value.words.end()},
                          std::vector<double>(before, std::nan(""))});
    found = log.series.end() - 1;
  }
  if (found->values.size() == before) found->values.push_back(value.value);
}

}  // namespace

void ChangeLog::note(sim::SimTime time_ns, std::vector<std::int64_t> record) {
  if (!times_ns_.empty() && lengths_.back() == static_cast<std::int64_t>(record.size()) &&
      std::equal(record.begin(), record.end(),
                 values_.end() - static_cast<std::ptrdiff_t>(record.size()))) {
    return;
  }
  times_ns_.push_back(time_ns);
  lengths_.push_back(static_cast<std::int64_t>(record.size()));
  values_.insert(values_.end(), record.begin(), record.end());
}

ChangeLog ChangeLog::from(std::size_t first) const {
  ChangeLog log;
  const auto at = static_cast<std::ptrdiff_t>(first);
  log.times_ns_.assign(times_ns_.begin() + at, times_ns_.end());
  log.lengths_.assign(lengths_.begin() + at, lengths_.end());
  const auto begin = std::accumulate(lengths_.begin(), lengths_.begin() + at, std::ptrdiff_t{0});
  log.values_.assign(values_.begin() + begin, values_.end());
  return log;
}

ChangeLog ChangeLog::take() {
  ChangeLog taken = from(taken_);
  if (!taken.times_ns_.empty()) {
    *this = newest();
    taken_ = 1;
  }
  return taken;
}

std::optional<std::size_t> ChangeLog::common_length() const {
  if (lengths_.empty() ||
      std::ranges::adjacent_find(lengths_, std::not_equal_to<>()) != lengths_.end()) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(lengths_.front());
}

ReplayBuilder::ReplayBuilder(const sim::Simulation& simulation, ReplayOptions options)
    : options_(std::move(options)) {
  const sim::WorldDescription& world = simulation.world();
  run_.name = options_.name.empty() ? world.name : options_.name;
  run_.world = world.name;
  run_.arena = world.arena;
  run_.canvas = canvas_ = simulation.layers().description();
  run_.obstacles.resize(world.arena.obstacles.size());
  const sim::SceneSnapshot scene = simulation.snapshot(false);
  run_.tracks = scene.tracks;
  run_.traps = scene.traps;
  for (const sim::TimerMark& timer : scene.timers) run_.timers.push_back(timer.name);
  for (int robot = 0; robot < simulation.robot_count(); ++robot) {
    RobotLog& log = run_.robots.emplace_back();
    log.start = simulation.robot_snapshot(robot);
    first_device_.push_back(run_.devices.size());
    for (int device = 0; device < simulation.device_count(robot); ++device) {
      const sim::Device& found = simulation.device(robot, device);
      DeviceLog& own = run_.devices.emplace_back();
      own.robot = robot;
      own.name = found.name();
      own.type = found.type();
      own.beams = beams_of(found);
      if (own.beams) own.lists.push_back({"ranges", "m", {}, {}});
    }
  }
  newest_reading_.resize(run_.devices.size(), 0);
  taken_readings_.resize(run_.devices.size(), 0);
  known_.resize(run_.devices.size());
  history_.resize(run_.robots.size());
  goal_of_.resize(run_.robots.size(), sim::Vec2::Zero());
  newest_goal_.resize(run_.robots.size(), -1);
  tolerance_m_.resize(run_.robots.size(), 0.0);
}

void ReplayBuilder::observe(const sim::Simulation& simulation) {
  if (static_cast<std::size_t>(simulation.robot_count()) != run_.robots.size()) {
    throw std::invalid_argument("a replay of " + std::to_string(run_.robots.size()) +
                                " robots observed a simulation of " +
                                std::to_string(simulation.robot_count()));
  }
  const sim::SimTime now_ns = simulation.now_ns();
  if (observed_ && now_ns < last_ns_) {
    throw std::invalid_argument("a replay observed the time " + std::to_string(now_ns) +
                                " ns after " + std::to_string(last_ns_) + " ns");
  }
  if (options_.live) {
    for (int robot = 0; robot < simulation.robot_count(); ++robot) {
      for (int i = 0; i < simulation.device_count(robot); ++i) add_reading(simulation, {robot, i});
    }
  } else {
    for (const sim::Simulation::DeviceId id : simulation.updated()) add_reading(simulation, id);
  }
  add_happenings(simulation);
  add_goals(simulation);
  // A frame is due at the first step at or after each multiple of the period, and at the end.
  const bool due = options_.live || !last_frame_ns_ ||
                   now_ns / kFramePeriod_ns > *last_frame_ns_ / kFramePeriod_ns;
  if (due || simulation.finished()) add_frame(simulation);
  observed_ = true;
  last_ns_ = now_ns;
}

void ReplayBuilder::add_frame(const sim::Simulation& simulation) {
  const sim::SimTime now_ns = simulation.now_ns();
  // While a run is paused, people can still move robots and blocks, and draw.
  const bool again = last_frame_ns_ == now_ns;
  if (again && !options_.live) return;
  last_frame_ns_ = now_ns;
  if (!again || places_ != places_of(simulation)) add_poses(simulation);
  for (int robot = 0; robot < simulation.robot_count(); ++robot) {
    run_.robots[static_cast<std::size_t>(robot)].looks.note(
        now_ns, look_of(simulation.robot_snapshot(robot)));
  }
  add_obstacles(simulation);
  if (simulation.records_arena_events()) add_controller(simulation);
  if (!layers_ended_) add_layers(layers_ != nullptr ? *layers_ : simulation.layers());
}

void ReplayBuilder::add_poses(const sim::Simulation& simulation) {
  run_.frames_ns.push_back(simulation.now_ns());
  for (int robot = 0; robot < simulation.robot_count(); ++robot) {
    RobotLog& log = run_.robots[static_cast<std::size_t>(robot)];
    const sim::BodyState& body = simulation.body(robot);
    log.X_WB.push_back(body.X_WB);
    log.twists.push_back(body.twist);
    log.stalled.push_back(body.stalled ? 1 : 0);
  }
  if (options_.live) places_ = places_of(simulation);
}

void ReplayBuilder::add_obstacles(const sim::Simulation& simulation) {
  const std::vector<sim::ObstacleDescription>& obstacles = simulation.world().arena.obstacles;
  const std::vector<sim::MovingBlock> moving = simulation.moving_blocks();
  for (std::size_t i = 0; i < std::min(obstacles.size(), run_.obstacles.size()); ++i) {
    const auto found = std::ranges::find(moving, static_cast<int>(i), &sim::MovingBlock::obstacle);
    run_.obstacles[i].note(
        simulation.now_ns(),
        obstacle_record(obstacles[i], found == moving.end() ? nullptr : &*found));
  }
}

void ReplayBuilder::add_controller(const sim::Simulation& simulation) {
  const sim::SimTime now_ns = simulation.now_ns();
  const sim::SceneSnapshot scene = simulation.snapshot(false);
  std::vector<std::int64_t> states;
  for (const sim::TrapMark& trap : scene.traps) {
    states.push_back(!trap.enabled ? 0 : trap.robots.empty() ? 1 : 2);
  }
  if (!states.empty()) run_.trap_states.note(now_ns, states);
  std::vector<std::int64_t> dues;
  for (const sim::TimerMark& timer : scene.timers) {
    const double due_s = sim::to_seconds(now_ns) + timer.time_left_s.value_or(0.0);
    dues.push_back(timer.time_left_s ? quantised(due_s, 1e-3) : -1);
  }
  if (!dues.empty()) run_.timer_dues.note(now_ns, dues);
  std::vector<std::int64_t> points;
  for (const double score : scene.scores) points.push_back(quantised(score, 1e-3));
  if (!points.empty()) run_.scores.note(now_ns, points);
  // A text is over when the scene no longer has it.
  const auto is_same = [](const sim::SceneText& a, const sim::SceneText& b) {
    return a.text == b.text && a.place == b.place && a.colour == b.colour;
  };
  for (TextNote& note : run_.texts) {
    const bool shown = std::ranges::any_of(
        scene.texts, [&](const sim::SceneText& text) { return is_same(text, note.text); });
    if (!note.gone_ns && !shown) note.gone_ns = now_ns;
  }
  for (const sim::SceneText& text : scene.texts) {
    const bool known = std::ranges::any_of(run_.texts, [&](const TextNote& note) {
      return !note.gone_ns && is_same(note.text, text);
    });
    if (!known) run_.texts.push_back({text, now_ns, std::nullopt});
  }
}

void ReplayBuilder::add_reading(const sim::Simulation& simulation, sim::Simulation::DeviceId id) {
  const sim::Device& device = simulation.device(id.robot, id.device);
  const sim::DeviceKind* const kind = sim::find_device_kind(device.type());
  if (device.sensor() == nullptr || kind == nullptr || kind->reading.fields == nullptr) return;
  const sim::Reading& reading = device.sensor()->reading();
  const std::size_t index =
      first_device_[static_cast<std::size_t>(id.robot)] + static_cast<std::size_t>(id.device);
  DeviceLog& log = run_.devices[index];
  if (options_.live &&
      std::exchange(newest_reading_[index], reading.sequence) == reading.sequence) {
    return;
  }
  // A reset can make the time of a late reading jump back; the replay shows readings in order.
  if (!log.times_ns.empty() && reading.time_ns < log.times_ns.back()) return;
  log.times_ns.push_back(reading.time_ns);
  if (log.beams) return add_beams(reading, log);
  visit_values(
      *kind->reading.fields, kind->reading.object(reading),
      [&](const FieldValue& value) { add_number(value, log); },
      [&](const std::string& name, const char* unit, std::span<const double> numbers) {
        auto found = std::ranges::find(log.lists, name, &ListSeries::name);
        if (found == log.lists.end()) {
          log.lists.push_back(
              {name, unit, std::vector<std::int64_t>(log.times_ns.size() - 1, 0), {}});
          found = log.lists.end() - 1;
        }
        found->counts.push_back(static_cast<std::int64_t>(numbers.size()));
        for (const double number : numbers) found->values.push_back(quantised(number, kRangeUnit));
      });
  for (Series& series : log.series) series.values.resize(log.times_ns.size(), std::nan(""));
  for (ListSeries& list : log.lists) list.counts.resize(log.times_ns.size(), 0);
}

void ReplayBuilder::add_happenings(const sim::Simulation& simulation) {
  const HappeningsWatch::Happenings fresh = happenings_.look(simulation);
  run_.collisions.insert(run_.collisions.end(), fresh.collisions.begin(), fresh.collisions.end());
  run_.events.insert(run_.events.end(), fresh.events.begin(), fresh.events.end());
  run_.spoken.insert(run_.spoken.end(), fresh.spoken.begin(), fresh.spoken.end());
  run_.verdict = simulation.verdict();
}

void ReplayBuilder::add_goals(const sim::Simulation& simulation) {
  const sim::SimTime now_ns = simulation.now_ns();
  for (std::size_t device = 0; device < run_.devices.size(); ++device) {
    const DeviceLog& log = run_.devices[device];
    const auto robot = static_cast<std::size_t>(log.robot);
    const auto index = static_cast<int>(device - first_device_[robot]);
    const auto* const waypoint =
        dynamic_cast<const sim::Waypoint*>(&simulation.device(log.robot, index));
    if (waypoint == nullptr || waypoint->status() != sim::WaypointStatus::kTransit) continue;
    if (newest_goal_[robot] >= 0 && goal_of_[robot] == waypoint->goal()) continue;
    goal_of_[robot] = waypoint->goal();
    tolerance_m_[robot] = waypoint->tolerance_m();
    newest_goal_[robot] = static_cast<std::ptrdiff_t>(run_.goals.size());
    run_.goals.push_back({log.robot, waypoint->goal(), now_ns, std::nullopt});
  }
  for (std::size_t robot = 0; robot < newest_goal_.size(); ++robot) {
    if (newest_goal_[robot] < 0) continue;
    GoalNote& goal = run_.goals[static_cast<std::size_t>(newest_goal_[robot])];
    const sim::Vec2 p_W = simulation.body(static_cast<int>(robot)).X_WB.position();
    if (!goal.reached_ns && (p_W - goal.place).norm() <= tolerance_m_[robot]) {
      goal.reached_ns = now_ns;
    }
  }
}

void ReplayBuilder::note_command(sim::SimTime time_ns, sim::Simulation::DeviceId device,
                                 const sim::Command& command) {
  const auto robot = static_cast<std::size_t>(device.robot);
  const std::size_t log = robot < first_device_.size()
                              ? first_device_[robot] + static_cast<std::size_t>(device.device)
                              : run_.devices.size();
  if (log >= run_.devices.size() || run_.devices[log].robot != device.robot) {
    throw std::invalid_argument("a replay has no device " + std::to_string(device.device) +
                                " of a robot " + std::to_string(device.robot));
  }
  const std::string text = sim::escape_invalid_utf8(text_of(command));
  std::string& last = last_text_[log];
  if (last == text) return;
  last = text;
  if (++command_count_ > options_.most_commands) return;
  const auto [found, is_new] = text_index_.try_emplace(text, run_.command_texts.size());
  if (is_new) run_.command_texts.push_back(text);
  run_.commands.push_back({time_ns, device.robot, device.device, found->second});
}

void ReplayBuilder::note_output(sim::SimTime time_ns, std::string_view text, bool is_error) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    output_bytes_ += end + 1;
    if (output_bytes_ <= options_.most_output_bytes) {
      run_.output.push_back({time_ns, sim::escape_invalid_utf8(text.substr(0, end)), is_error});
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

void ReplayBuilder::note_goal(const GoalNote& goal) { run_.goals.push_back(goal); }

ReplayRun ReplayBuilder::finish(const sim::Simulation& simulation) {
  if (!observed_ || simulation.now_ns() != last_ns_) observe(simulation);
  add_frame(simulation);
  run_.end_ns = last_ns_;
  if (command_count_ > options_.most_commands) {
    run_.notes.push_back("Commands after the first " + std::to_string(options_.most_commands) +
                         " are left out.");
  }
  if (output_bytes_ > options_.most_output_bytes) {
    run_.notes.push_back("Printed text after the first " +
                         std::to_string(options_.most_output_bytes >> 10) + " KB is left out.");
  }
  std::ranges::stable_sort(run_.commands, {}, &CommandNote::time_ns);
  std::ranges::stable_sort(run_.output, {}, &OutputLine::time_ns);
  std::ranges::stable_sort(run_.goals, {}, &GoalNote::given_ns);
  return std::move(run_);
}

}  // namespace playerlike::replay
