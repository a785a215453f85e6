// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/results/make_report.h"

#include <cmath>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "host/mirror/mirror.h"
#include "host/requests/arena.h"
#include "host/results/recorder.h"
#include "sim/core/math.h"
#include "sim/core/time.h"
#include "sim/world/realism.h"

namespace playerlike {
namespace {

namespace fs = std::filesystem;

// Box2D comes compiled: its last bits are those of its processor family, and the functions of the
// C library that it calls are ours where math::bound().
const char* machines_of(bool used_box2d) {
  if (!used_box2d && sim::math::bound()) return "any machine";
  if (!sim::math::bound()) return "this machine";
#if defined(__x86_64__)
  return "any x86-64 machine";
#else
  return "any aarch64 machine";
#endif
}

Report::Run run_of(const sim::Simulation& simulation, const TimeStatistics& time) {
  const sim::WorldDescription& world = simulation.world();
  Report::Run run;
  run.world = world.name;
  run.seed = world.simulation.seed;
  run.realism = sim::to_string(world.simulation.realism);
  run.steps = simulation.steps();
  run.sim_time_s = sim::to_seconds(simulation.now_ns());
  run.wall_time_s = time.wall_time_s;
  run.real_time_factor = time.real_time_factor;
  // `playpen plot` reads the scene from this file.
  std::error_code error;
  const fs::path file = fs::absolute(world.file, error);
  if (!error && fs::is_regular_file(file, error)) run.world_file = file.string();
  run.repeatable = time.unrepeatable.empty();
  if (!run.repeatable) run.repeatable_why = time.unrepeatable;
  const std::optional<sim::SimTime> box2d_since_ns = simulation.box2d_since_ns();
  if (box2d_since_ns) run.box2d_from_s = sim::to_seconds(*box2d_since_ns);
  if (run.repeatable) run.repeatable_on = machines_of(box2d_since_ns.has_value());
  return run;
}

std::optional<Report::Seen> seen_by(const Recorder& recorder, std::size_t robot) {
  const SeenFloor* const seen = recorder.seen_floor();
  if (seen == nullptr || static_cast<std::size_t>(seen->robot()) != robot) return std::nullopt;
  return Report::Seen{seen->area_m2(), seen->cell_size_m(), seen->origin(),
                      seen->width(),   seen->height(),      seen->bits()};
}

std::optional<Report::Commanded> commanded(const CommandBook::Entry& commands) {
  if (!commands.first_ns) return std::nullopt;
  return Report::Commanded{sim::to_seconds(*commands.first_ns),
                           commands.count,
                           {commands.ports.begin(), commands.ports.end()}};
}

Report::Robot robot_of(const sim::Simulation& simulation, const Recorder& recorder,
                       std::size_t index) {
  const sim::RobotStatistics& statistics = simulation.statistics(static_cast<int>(index));
  Report::Robot robot;
  robot.name = simulation.world().robots[index].name;
  robot.path_length_m = statistics.path_length_m;
  robot.collisions = statistics.collisions;
  if (std::isfinite(statistics.least_clearance_m)) {
    robot.least_clearance_m = statistics.least_clearance_m;
  }
  robot.stalled_time_s = statistics.stalled_time_s;
  robot.final_pose = simulation.body(static_cast<int>(index)).X_WB;
  robot.driven_time_s = recorder.driven_time_s(index);
  if (const TravelMeter* const travel = recorder.travel(index)) {
    robot.distance_m = travel->distance_m();
    robot.visited_area_m2 = travel->visited_area_m2();
  }
  robot.seen = seen_by(recorder, index);
  if (recorder.commands() != nullptr) robot.commanded = commanded(recorder.commands()->of(index));
  return robot;
}

/// Adds the texts, collisions and goals of the robots.
void add_moments(const sim::Simulation& simulation, const std::vector<Goal>& goals,
                 Report& report) {
  const auto name_of = [&](int robot) {
    return simulation.world().robots[static_cast<std::size_t>(robot)].name;
  };
  for (const sim::SpokenText& u : simulation.spoken_texts()) {
    report.said.push_back({sim::to_seconds(u.time_ns), name_of(u.robot), u.text});
  }
  for (const sim::Collision& c : simulation.collisions()) {
    report.collisions.push_back({sim::to_seconds(c.time_ns), name_of(c.robot), c.partner, c.place});
  }
  for (const Goal& g : goals) {
    report.goals.push_back({sim::to_seconds(g.set_ns), name_of(g.robot), g.place, std::nullopt});
    if (g.reached_ns) report.goals.back().reached_s = sim::to_seconds(*g.reached_ns);
  }
}

std::optional<std::string> unless_empty(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

/// Adds the events of the arena, its blocks, and the scores and the verdict of its controller.
void add_arena(const sim::Simulation& simulation, Report& report) {
  if (!simulation.records_arena_events()) return;
  report.events.emplace();
  for (const sim::ArenaEvent& e : simulation.arena_events().newest) {
    Report::Event event{e.number, sim::to_seconds(e.time_ns), std::string(to_string(e.kind)),
                        e.what,   unless_empty(e.who),        unless_empty(e.text),
                        {}};
    if (e.value != 0.0 || e.kind == sim::ArenaEventKind::kEnd) event.value = e.value;
    report.events->push_back(std::move(event));
  }
  report.blocks.emplace();
  for (const ArenaBlock& block : arena_blocks(simulation)) {
    report.blocks->push_back({block.name, block.state});
  }
  if (simulation.world().controller.empty()) return;
  report.scores.emplace();
  for (std::size_t i = 0; i < simulation.scores().size(); ++i) {
    report.scores->push_back({simulation.world().robots[i].name, simulation.scores()[i]});
  }
  if (const auto& verdict = simulation.verdict()) {
    report.verdict = {verdict->passed, verdict->reason, sim::to_seconds(verdict->time_ns)};
  }
}

}  // namespace

Report make_report(const sim::Simulation& simulation, const Recorder& recorder,
                   const TimeStatistics& time, std::optional<RunEnd> end) {
  Report report;
  report.run = run_of(simulation, time);
  for (std::size_t i = 0; i < static_cast<std::size_t>(simulation.robot_count()); ++i) {
    report.robots.push_back(robot_of(simulation, recorder, i));
  }
  add_moments(simulation, recorder.goals().goals(), report);
  add_arena(simulation, report);
  for (const RefusalBook::Refusal& r : recorder.refusals().refusals()) {
    if (!report.refused) report.refused.emplace();
    report.refused->push_back({sim::to_seconds(r.time_ns), r.what});
  }
  if (recorder.mirror() != nullptr) report.mirror = recorder.mirror()->report();
  report.ended = std::move(end);
  return report;
}

}  // namespace playerlike
