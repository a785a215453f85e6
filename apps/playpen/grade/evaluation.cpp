// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/evaluation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "grade/figures.h"
#include "grade/map_score.h"
#include "grade/shortest_path.h"
#include "grade/sight.h"
#include "grade/text.h"
#include "grade/trajectory.h"
#include "playerlike/host/report.h"
#include "sim/core/error.h"
#include "sim/core/file.h"
#include "sim/core/number_text.h"
#include "sim/io/map_file.h"
#include "sim/world/robot_model.h"

namespace playpen::grade {
namespace {

namespace fs = std::filesystem;
using playerlike::Report;

[[noreturn]] void refuse(const Task& task, const char* id, const char* pointer,
                         std::string expected, std::string found, std::string hint = "") {
  throw sim::ConfigError(sim::ConfigIssue{id, task.file, pointer, std::move(expected),
                                          std::move(found), std::move(hint)});
}

/// Copies the results of the world's controller from the report, if the world has one.
void read_verdict(const Report& report, const Reference& reference, Measures& measures) {
  if (report.scores) {
    const auto score = std::ranges::find(*report.scores, reference.robot, &Report::Score::robot);
    if (score == report.scores->end()) {
      throw std::runtime_error("it has no score of " + reference.robot);
    }
    measures.score = score->points;
  }
  if (report.verdict) {
    measures.verdict = report.verdict->passed;
    measures.verdict_reason = report.verdict->reason;
  }
}

/// The blocks of the arena, according to a report.
struct Blocks {
  std::map<std::string, bool> at_end;  ///< whether each dynamic block is in the way, by its name
  std::set<std::string> opened;        ///< those that were out of the way at some time of the run
};

/// Reads the blocks from a report; nullopt if it has none: then they do not change.
std::optional<Blocks> read_blocks(const Report& report, const Reference& reference) {
  if (!report.blocks) return std::nullopt;
  if (!report.events) throw std::runtime_error("it has blocks, but no events");
  Blocks blocks;
  for (const auto& [name, state] : *report.blocks) {
    blocks.at_end[name] = state == "extended" || state == "rising" || state == "sinking";
    if (!blocks.at_end[name]) blocks.opened.insert(name);
  }
  for (const sim::ObstacleDescription& block : reference.description.arena.obstacles) {
    if (block.state == sim::ObstacleState::kRetracted) blocks.opened.insert(block.name);
  }
  for (const Report::Event& event : *report.events) {
    if (event.kind == "retracted") blocks.opened.insert(event.what);
  }
  return blocks;
}

/// The arena in which some dynamic blocks have another state.
sim::ArenaDescription with_blocks(sim::ArenaDescription arena,
                                  const std::function<bool(const std::string&)>& is_extended) {
  for (sim::ObstacleDescription& block : arena.obstacles) {
    if (block.type != sim::ObstacleType::kDynamic) continue;
    block.state =
        is_extended(block.name) ? sim::ObstacleState::kExtended : sim::ObstacleState::kRetracted;
  }
  return arena;
}

/// Compares a map with the arena at the end of the run. Floor counts as reachable if the robot's
/// start leads to it through blocks that were out of the way at some time.
MapScore score_with_blocks(const sim::OccupancyMap& map, const Reference& reference,
                           const Blocks& blocks, const SeenFloor* seen) {
  const auto stands = [&blocks](const std::string& name) {
    const auto found = blocks.at_end.find(name);
    return found != blocks.at_end.end() && found->second;
  };
  const auto never_opened = [&blocks](const std::string& name) {
    return blocks.opened.count(name) == 0;
  };
  return score_map_within(
      map, make_truth(with_blocks(reference.description.arena, stands)),
      reachable_cells(make_truth(with_blocks(reference.description.arena, never_opened)),
                      reference.start),
      seen);
}

/// What of the arena a report tells, for the judgement of a map and of the first contact.
struct Floor {
  std::optional<Blocks> blocks;
  std::optional<SeenFloor> seen;
  bool is_unchanged = false;  ///< whether it is as it was at the start until the first contact
};

/// Reads the floor that a robot has seen from its entry in a report; nullopt if there is none.
std::optional<SeenFloor> read_seen(const Report::Robot& robot) {
  if (!robot.seen) return std::nullopt;
  const Report::Seen& entry = *robot.seen;
  const bool has_size = entry.cell_size_m > 0.0 && entry.width > 0 && entry.height > 0;
  if (!has_size || entry.cells.size() * 8 / static_cast<std::size_t>(entry.width) <
                       static_cast<std::size_t>(entry.height)) {
    return std::nullopt;
  }
  SeenFloor seen;
  seen.cell_size_m = entry.cell_size_m;
  seen.origin = entry.origin;
  seen.width = entry.width;
  seen.height = entry.height;
  seen.bits = entry.cells;
  return seen;
}

/// The first contact of a robot; nullopt if there was none, or if the report does not have it any
/// more.
std::optional<Contact> first_collision(const Report& report, const std::string& robot, int count) {
  const auto is_own = [&robot](const Report::Collision& c) { return c.robot == robot; };
  const auto& all = report.collisions;
  const auto first = std::ranges::find_if(all, is_own);
  if (first == all.end() || std::ranges::count_if(all, is_own) < count) return std::nullopt;
  return Contact{first->time_s, first->with, first->place};
}

/// Copies what was refused to the program.
std::vector<Refusal> read_refusals(const Report& report) {
  std::vector<Refusal> refused;
  for (const Report::Refusal& refusal : report.refused.value_or(std::vector<Report::Refusal>())) {
    refused.push_back({refusal.time_s, refusal.what});
  }
  return refused;
}

/// Copies which robots the program has commanded, and what was refused to it.
void read_use(const Report& report, Measures& measures) {
  for (const Report::Robot& robot : report.robots) {
    if (robot.commanded) measures.commanded.push_back(robot.name);
  }
  measures.refused = read_refusals(report);
}

/// Copies the results of the graded robot.
void read_robot(const Report& report, const Report::Robot& robot, const Reference& reference,
                Measures& found) {
  found.path_length_m = robot.path_length_m;
  found.collisions = robot.collisions;
  found.first_collision = first_collision(report, reference.robot, robot.collisions);
  found.distance_m = robot.distance_m;
  found.visited_area_m2 = robot.visited_area_m2;
  found.least_clearance_m = robot.least_clearance_m;
  found.stalled_time_s = robot.stalled_time_s;
  if (!reference.goal) return;
  const Goal& goal = *reference.goal;
  found.goal_distance_m = (robot.final_pose.position() - goal.position).norm();
  const bool looks_right =
      !goal.yaw_rad || std::abs(sim::normalize_angle(robot.final_pose.yaw_rad - *goal.yaw_rad)) <=
                           goal.yaw_tolerance_rad;
  found.reached = *found.goal_distance_m <= goal.tolerance_m && looks_right;
  if (*found.reached && found.shortest_path_m && *found.shortest_path_m > 0.0) {
    found.path_ratio = *found.path_length_m / *found.shortest_path_m;
  }
}

/// A report that may be another run's; nullopt if it is none.
std::optional<Report> any_report(const std::string& text) {
  try {
    return playerlike::report_from(text);
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

/// Whether a report says that its run has not ended.
bool is_unfinished(const std::string& text) {
  const nlohmann::json report = nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false);
  return report.is_object() && report.contains("ended") && report.at("ended").is_null();
}

/// Copies the graded robot's results from the report. @return an error, if there is one.
std::optional<std::string> read_report(const fs::path& file, const Reference& reference,
                                       const playerlike::Grading& asked, Measures& measures,
                                       Floor& floor) {
  std::string text;
  if (const auto problem = sim::read_whole_file(file.string(), {}, text)) {
    if (problem->fault == sim::FileFault::kMissing) {
      return "no report: the program never connected to the simulation, or was cut short";
    }
    return "the report can't be read: " + problem->found;
  }
  try {
    if (is_unfinished(text)) {
      return "the report is of a run that has not ended: the program was cut short";
    }
    if (auto fault = playerlike::fault_of_graded(text, asked)) {
      const std::optional<Report> other = any_report(text);
      // A program may have died of a refusal before the first step.
      const bool is_own = other && other->graded && other->graded->nonce == asked.nonce;
      if (is_own) measures.refused = read_refusals(*other);
      return fault;
    }
    const Report report = playerlike::report_from(text);
    Measures found = measures;
    found.sim_time_s = report.run.sim_time_s;
    for (const Report::Robot& robot : report.robots) {
      if (robot.name != reference.robot) continue;
      read_robot(report, robot, reference, found);
      floor.seen = read_seen(robot);
    }
    read_verdict(report, reference, found);
    read_use(report, found);
    floor.blocks = read_blocks(report, reference);
    floor.is_unchanged = found.first_collision && !may_have_changed(reference.description, report,
                                                                    found.first_collision->time_s);
    measures = found;
    if (!measures.path_length_m) return "the report has no robot " + reference.robot;
  } catch (const std::exception& error) {
    return std::string("the report is not as expected: ") + error.what();
  }
  return std::nullopt;
}

std::optional<std::string> read_drawn_map(const fs::path& folder, const Task& task,
                                          const Reference& reference, const Floor& floor,
                                          Measures& measures) {
  if (!floor.seen) return "no map: the report lacks the floor that the robot has seen";
  const std::string name = "layers/" + task.map_layer + ".yaml";
  std::error_code error;
  if (!fs::is_regular_file(folder / name, error)) return "no map: there is no " + name;
  try {
    const sim::OccupancyMap map = sim::io::read_map((folder / name).string());
    const MapScore score = floor.blocks
                               ? score_with_blocks(map, reference, *floor.blocks, &*floor.seen)
                               : score_map(map, reference.truth, reference.start, &*floor.seen);
    measures.coverage = score.coverage;
    measures.drawn = score.drawn;
    measures.seen = score.seen;
    measures.correctness = score.correctness;
  } catch (const sim::ConfigError& e) {
    return std::string("the map can't be read: ") + e.what();
  }
  return std::nullopt;
}

Ending ending_of(const playerlike::JobEnd& end, const Measures& measures,
                 const Reference& reference) {
  using Kind = playerlike::JobEnd::Kind;
  switch (end.kind) {
    case Kind::kNotStarted:
      return Ending::kNotRun;
    case Kind::kInterrupted:
      return Ending::kInterrupted;
    case Kind::kTimedOut:
      return Ending::kTimedOut;
    case Kind::kTooMuchOutput:
      return Ending::kTooMuchOutput;
    case Kind::kEnded:
      break;
  }
  if (end.program.signal) return Ending::kSignal;
  if (end.program.status != 0) return Ending::kBadStatus;
  if (measures.verdict) return Ending::kVerdict;
  constexpr double kRounding_s = 1e-6;  // tolerance for the report's times
  const bool over = reference.duration_s && measures.sim_time_s &&
                    *measures.sim_time_s >= *reference.duration_s - kRounding_s;
  return over ? Ending::kTimeOver : Ending::kBySelf;
}

/// The thresholds that what a program has not done any more cannot violate.
Thresholds upper_limits(const Thresholds& thresholds) {
  Thresholds upper;
  upper.max_collisions = thresholds.max_collisions;
  upper.min_clearance_m = thresholds.min_clearance_m;
  upper.max_path_length_m = thresholds.max_path_length_m;
  upper.max_sim_time_s = thresholds.max_sim_time_s;
  upper.max_stalled_time_s = thresholds.max_stalled_time_s;
  return upper;
}

/// " after 3.21 s of simulated time", if the results are those until then.
std::string time_text(bool completed, const Measures& measures) {
  if (!completed || !measures.sim_time_s) return "";
  return " after " + sim::fixed_text(*measures.sim_time_s, 2) + " s of simulated time";
}

/// The fault of an ending, independent of the thresholds; nullopt if there is none.
/// @param when  see time_text().
std::optional<std::string> fault_of(Ending ending, const playerlike::JobEnd& end, const Task& task,
                                    bool completed, const std::string& when) {
  switch (ending) {
    case Ending::kBySelf:
    case Ending::kTimeOver:
    case Ending::kVerdict:
      if (!completed) return std::nullopt;
      return "the program exited during the run (by _exit?)" + when;
    case Ending::kBadStatus:
    case Ending::kSignal:
      return "the program " + end.program.text() + when;
    case Ending::kTimedOut:
      return "timeout: still running after " + sim::shortest_text(task.timeout_s) + " s" +
             (when.empty() ? "" : "; it was ended" + when);
    case Ending::kTooMuchOutput:
      return "the program wrote more than " + std::to_string(kMostOutput / 1'000'000) +
             " MB into its output folder";
    case Ending::kInterrupted:
      return "the grader was interrupted";
    case Ending::kNotRun:
      return "not run: the grader was interrupted";
  }
  return std::nullopt;
}

/// A fault if the driven path to the goal is shorter than the shortest possible one; otherwise
/// nullopt.
std::optional<std::string> impossible_path(const Reference& reference, const Measures& measures) {
  if (!measures.path_ratio || !reference.goal || !measures.shortest_path_m) return std::nullopt;
  // The goal counts as reached within its tolerance, and the shortest path follows cells.
  const double slip_m = reference.goal->tolerance_m + 2.0 * kTruthCell_m;
  if (*measures.path_length_m >= *measures.shortest_path_m - slip_m) return std::nullopt;
  return "path of " + sim::fixed_text(*measures.path_length_m, 2) +
         " m, which is shorter than any way to the goal (" +
         sim::fixed_text(*measures.shortest_path_m, 2) +
         " m): the robot has not driven there; does the world lock its objects (lock_objects)?";
}

/// ": first hit border at (1.16, 3.72) after 10.6 s"; "" if it is not known.
std::string first_collision_text(const Measures& measures) {
  return measures.first_collision ? ": " + contact_text(*measures.first_collision) : "";
}

/// Says that a map shows floor that the robot has not seen; "" if that makes no difference.
std::string unseen_text(const Measures& measures) {
  if (!measures.coverage || !measures.drawn || !measures.seen) return "";
  constexpr double kDifference = 0.0005;  // not visible in the table
  if (*measures.drawn - *measures.coverage < kDifference) return "";
  return ": the map shows " + sim::fixed_text(*measures.drawn, 3) +
         " of the floor, but the robot's own sensors have seen only " +
         sim::fixed_text(*measures.seen, 3) + " of it";
}

/// Adds a fault if a measure violates its limit, or is missing.
class Judge {
 public:
  /// @param more  what to say beside the numbers.
  void at_least(const char* what, const std::optional<double>& value,
                const std::optional<double>& limit, int decimals, const char* unit = "",
                const std::string& more = "") {
    compare(what, value, limit, decimals, unit, true, more);
  }
  void at_most(const char* what, const std::optional<double>& value,
               const std::optional<double>& limit, int decimals, const char* unit = "",
               const std::string& more = "") {
    compare(what, value, limit, decimals, unit, false, more);
  }
  void add(std::string fault) { faults_.push_back(std::move(fault)); }
  [[nodiscard]] std::vector<std::string> take() { return std::move(faults_); }

 private:
  void compare(const char* what, const std::optional<double>& value,
               const std::optional<double>& limit, int decimals, const char* unit, bool least,
               const std::string& more) {
    if (!limit) return;
    const std::string bound = (least ? ", at least " : ", at most ") + sim::shortest_text(*limit) +
                              unit + (least ? " needed" : " allowed");
    if (!value) {
      add(std::string(what) + " not measured" + bound);
    } else if (least ? *value < *limit : *value > *limit) {
      add(std::string(what) + ' ' + telling_number(*value, *limit, decimals) + unit + bound + more);
    }
  }

  std::vector<std::string> faults_;
};

/// Refuses a task whose "may_use" names robots or devices that the world does not have.
void require_known_names(const Task& task, const Reference& reference,
                         const sim::WorldDescription& world) {
  if (!task.may_use) return;
  const std::vector<std::string> robots = rules_of(task, reference).may_use->robots;
  std::set<std::string> devices;
  for (const std::string& name : robots) {
    const auto robot =
        std::find_if(world.robots.begin(), world.robots.end(),
                     [&name](const sim::RobotDescription& r) { return r.name == name; });
    if (robot == world.robots.end()) {
      refuse(task, "task/unknown-robot", "/may_use/robots", "robots of \"" + reference.world + '"',
             name + ", which is not there");
    }
    for (const sim::DeviceDescription& device : robot->devices) {
      devices.insert(device.name);
      devices.insert(device.type);
    }
  }
  for (const std::string& name : task.may_use->devices.value_or(std::vector<std::string>())) {
    if (devices.contains(name)) continue;
    std::string known;
    for (const std::string& device : devices) known += (known.empty() ? "" : ", ") + device;
    refuse(task, "task/unknown-device", "/may_use/devices",
           "names or types of devices of " + robots.front() + " in \"" + reference.world + '"',
           name + ", which is none of them", "there are " + known);
  }
}

/// Refuses a world without a goal or a controller if the task's thresholds or points need it.
void require_needs(const Task& task, const Reference& reference,
                   const sim::WorldDescription& world) {
  const Thresholds& t = task.thresholds;
  const bool threshold_needs_goal = t.must_reach || t.max_path_ratio;
  if (!reference.goal && (threshold_needs_goal || rubric_needs(task, FigureNeed::kGoal))) {
    refuse(task, "task/missing-goal", "", "a \"goal\" that holds for every world",
           "none for \"" + reference.world + '"',
           threshold_needs_goal ? "the thresholds ask for one" : "the rubric asks for one");
  }
  const bool threshold_needs_controller = t.must_pass || t.min_score;
  if (world.controller.empty() &&
      (threshold_needs_controller || rubric_needs(task, FigureNeed::kController))) {
    refuse(task, "task/missing-controller", threshold_needs_controller ? "/thresholds" : "/rubric",
           "worlds with a \"controller\", which gives points and verdicts",
           "none in \"" + reference.world + '"',
           t.must_pass   ? "\"must_pass\" asks for one"
           : t.min_score ? "\"min_score\" asks for one"
                         : "an item asks for one");
  }
}

}  // namespace

playerlike::TaskRules rules_of(const Task& task, const Reference& reference) {
  playerlike::TaskRules rules;
  rules.may_use = task.may_use;
  if (rules.may_use && rules.may_use->robots.empty()) {
    rules.may_use->robots.push_back(reference.robot);
  }
  if (!task.map_layer.empty()) rules.seen_by = reference.robot;
  return rules;
}

Reference make_reference(const Task& task, const TaskWorld& task_world,
                         const sim::WorldDescription& world) {
  Reference reference;
  reference.world_file = task_world.file;
  reference.world = world_name(task_world.file);
  const auto robot =
      task.robot.empty()
          ? world.robots.begin()
          : std::find_if(world.robots.begin(), world.robots.end(),
                         [&task](const sim::RobotDescription& r) { return r.name == task.robot; });
  if (robot == world.robots.end()) {
    refuse(task, "task/unknown-robot", "/robot",
           task.robot.empty() ? "worlds with a robot" : "worlds with a robot " + task.robot,
           "none in \"" + reference.world + '"');
  }
  reference.robot = robot->name;
  require_known_names(task, reference, world);
  reference.start = robot->pose.position();
  reference.description = world;
  reference.duration_s = task.duration_s;
  if (!reference.duration_s && world.simulation.duration_ns) {
    reference.duration_s = sim::to_seconds(*world.simulation.duration_ns);
  }
  reference.goal = task_world.goal ? task_world.goal : task.goal;
  require_needs(task, reference, world);
  if (!task.map_layer.empty() || reference.goal) reference.truth = make_truth(world.arena);
  if (reference.goal) {
    const double radius_m = inscribed_radius(sim::find_robot_model(world, robot->model)->footprint);
    // The start and the goal may lie inside inflated obstacles: by up to a cell's diagonal beside a
    // wall, and a goal only has to be reached within its tolerance.
    const double slip_m = std::max(2.0 * kTruthCell_m, reference.goal->tolerance_m);
    const std::optional<Way> way = shortest_way(inflate(reference.truth, radius_m), reference.start,
                                                reference.goal->position, slip_m);
    if (!way) {
      refuse(task, "task/unreachable-goal", "",
             "a goal that robot " + reference.robot + " can reach",
             '(' + sim::shortest_text(reference.goal->position.x()) + ", " +
                 sim::shortest_text(reference.goal->position.y()) + ") in \"" + reference.world +
                 "\", to which there is no way");
    }
    reference.shortest_path_m = way->length_m;
  }
  return reference;
}

std::string name_of(Ending ending) {
  switch (ending) {
    case Ending::kBySelf:
      return "by-itself";
    case Ending::kTimeOver:
      return "time-over";
    case Ending::kVerdict:
      return "verdict";
    case Ending::kBadStatus:
      return "bad-status";
    case Ending::kSignal:
      return "signal";
    case Ending::kTimedOut:
      return "timeout";
    case Ending::kTooMuchOutput:
      return "too-much-output";
    case Ending::kInterrupted:
      return "interrupted";
    case Ending::kNotRun:
      return "not-run";
  }
  return "";
}

std::vector<std::string> faults_of(const Thresholds& t, const Measures& m, Ending ending) {
  Judge judge;
  if (t.must_end && ending == Ending::kTimeOver) {
    judge.add("the simulated time was over before the program ended");
  }
  if (t.must_reach && !m.reached) judge.add("goal not known to be reached");
  if (t.must_reach && m.reached && !*m.reached) {
    judge.add("goal not reached: " + sim::fixed_text(*m.goal_distance_m, 2) +
              " m away from it at the end");
  }
  if (t.must_pass && !m.verdict) {
    judge.add("no verdict: the world's controller did not end the run");
  } else if (t.must_pass && !*m.verdict) {
    judge.add("verdict: failed" + (m.verdict_reason.empty() ? "" : ": " + m.verdict_reason));
  }
  judge.at_least("score", m.score, t.min_score, 0);
  judge.at_least("coverage", m.coverage, t.min_coverage, 3, "", unseen_text(m));
  judge.at_least("map correctness", m.correctness, t.min_correctness, 3);
  judge.at_most("collisions", m.collisions ? std::optional<double>(*m.collisions) : std::nullopt,
                t.max_collisions ? std::optional<double>(*t.max_collisions) : std::nullopt, 0, "",
                first_collision_text(m));
  judge.at_least("least clearance", m.least_clearance_m, t.min_clearance_m, 3, " m");
  judge.at_least("path", m.path_length_m, t.min_path_length_m, 2, " m");
  judge.at_most("path", m.path_length_m, t.max_path_length_m, 2, " m");
  judge.at_least("distance driven (movements on the spot excluded)", m.distance_m, t.min_distance_m,
                 2, " m");
  judge.at_least("visited floor", m.visited_area_m2, t.min_visited_area_m2, 2, " m^2");
  judge.at_most("path ratio", m.path_ratio, t.max_path_ratio, 2);
  judge.at_most("simulated time", m.sim_time_s, t.max_sim_time_s, 1, " s");
  judge.at_most("stalled time", m.stalled_time_s, t.max_stalled_time_s, 2, " s");
  return judge.take();
}

namespace {

/// The faults of a run whose report is known.
std::vector<std::string> judge(const Task& task, const Reference& reference, bool completed,
                               const GradedRun& run) {
  std::vector<std::string> faults = faults_of(
      completed ? upper_limits(task.thresholds) : task.thresholds, run.measures, run.ending);
  if (auto fault = impossible_path(reference, run.measures)) {
    faults.insert(faults.begin(), *std::move(fault));
  }
  return faults;
}

/// The sight of a run's first contact in an arena that has not changed; nullopt if it is not known.
std::optional<Sight> find_sight(const Task& task, const Reference& reference,
                                const fs::path& folder, const Contact& contact) {
  try {
    return sight_of(reference.description, reference.robot,
                    read_trajectories(folder / "trajectory.csv"), contact,
                    task.may_use ? task.may_use->devices : std::nullopt);
  } catch (const std::exception&) {
    return std::nullopt;  // it only explains a fault
  }
}

}  // namespace

void evaluate(const Task& task, const Reference& reference, const playerlike::JobEnd& end,
              const fs::path& folder, bool completed, GradedRun& run) {
  std::optional<std::string> problem;
  Floor floor;
  if (end.kind != playerlike::JobEnd::Kind::kNotStarted) {
    run.measures.shortest_path_m = reference.shortest_path_m;
    problem = read_report(folder / "report.json", reference, run.asked, run.measures, floor);
    if (!problem && !task.map_layer.empty()) {
      problem = read_drawn_map(folder, task, reference, floor, run.measures);
      // A missing map is no problem if no threshold needs it.
      if (!task.thresholds.min_coverage && !task.thresholds.min_correctness) problem.reset();
    }
  }
  run.ending = ending_of(end, run.measures, reference);
  run.wall_time_s = end.wall_time_s;
  if (run.ending == Ending::kBadStatus) run.status = end.program.status;
  if (run.ending == Ending::kSignal) run.signal = end.program.signal;

  run.faults.clear();
  const std::string when = time_text(completed, run.measures);
  if (auto fault = fault_of(run.ending, end, task, completed, when)) {
    // After a bad ending, do not report what is missing because of it.
    run.faults.push_back(*std::move(fault));
  } else if (problem) {
    run.faults.push_back(*std::move(problem));
  }
  // Without a report there is nothing to grade; the missing report is already a fault.
  if (run.measures.sim_time_s) {
    std::vector<std::string> more = judge(task, reference, completed, run);
    if (floor.is_unchanged && !(run.faults.empty() && more.empty())) {
      Contact& contact = *run.measures.first_collision;
      contact.sight = find_sight(task, reference, folder, contact);
      more = judge(task, reference, completed, run);  // the sentences contain the sight
    }
    run.faults.insert(run.faults.end(), more.begin(), more.end());
  }
  if (run.faults.empty()) return;
  // A refusal alone is no fault, but it may be the reason of one.
  for (const Refusal& refusal : run.measures.refused) {
    run.faults.push_back("the program asked for " + refusal.what +
                         ", which the task does not let it use; the first time after " +
                         sim::fixed_text(refusal.time_s, 2) + " s");
  }
}

}  // namespace playpen::grade
