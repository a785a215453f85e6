// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "plot_data.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "sim/core/file.h"
#include "sim/simulation/simulation.h"
#include "sim/world/outline.h"
#include "sim/world/robot_model.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using sim::Vec2;

constexpr const char* kPlottedFile = "trajectory.csv";
constexpr const char* kReport = "report.json";
constexpr const char* kGrade = "grade.json";
constexpr const char* kUnitRecord = "unit.json";
constexpr std::size_t kMostBytes = std::size_t{1} << 30U;

std::string text_of(const fs::path& file) {
  sim::FileLimits limits;
  limits.most_bytes = kMostBytes;
  std::string text;
  if (const auto problem = sim::read_whole_file(file.string(), limits, text)) {
    throw std::runtime_error("cannot read " + file.string() + ": found " + problem->found);
  }
  return text;
}

Track track_of(grade::Trajectory trajectory) {
  Track track;
  static_cast<grade::Trajectory&>(track) = std::move(trajectory);
  for (std::size_t i = 0; i < track.X_WB.size(); ++i) {
    track.path_m.push_back(
        i == 0 ? 0.0
               : track.path_m.back() +
                     (track.X_WB[i].position() - track.X_WB[i - 1].position()).norm());
  }
  return track;
}

// Returns the index of a robot's track, or none if the robot has no track.
std::optional<int> index_of(const RunData& run, const std::string& robot) {
  for (std::size_t i = 0; i < run.tracks.size(); ++i) {
    if (run.tracks[i].robot == robot) return static_cast<int>(i);
  }
  return std::nullopt;
}

void read_marks(const playerlike::Report& report, RunData& run) {
  for (const playerlike::Report::Collision& c : report.collisions) {
    if (const auto robot = index_of(run, c.robot)) {
      run.collisions.push_back({*robot, c.place, c.time_s});
    }
  }
  for (const playerlike::Report::Goal& g : report.goals) {
    const auto robot = index_of(run, g.robot);
    if (!robot) continue;
    for (sim::GoalMark& earlier : run.goals) {
      if (earlier.robot == *robot) earlier.newest = false;
    }
    run.goals.push_back({*robot, g.place, g.reached_s.has_value(), true});
    if (g.reached_s) run.reached.push_back({*robot, *g.reached_s});
  }
}

// Adds the verdict of a graded run.
void add_judgement(const json& graded, RunData& run) {
  const json passed = graded.value("passed", json());
  if (!passed.is_boolean()) return;
  run.passed = passed.get<bool>();
  for (const json& fault : graded.value("faults", json::array())) {
    if (fault.is_string()) run.faults.push_back(fault.get<std::string>());
  }
}

// Adds the goal of a graded run's task. It is reached when the robot is first within the tolerance.
void add_goal_of_task(const json& graded, RunData& run) {
  const json goal = graded.value("goal", json());
  const auto robot = index_of(run, graded.value("robot", ""));
  if (goal.is_null() || !robot) return;
  sim::GoalMark mark;
  mark.robot = *robot;
  mark.place = {goal.at("x").get<double>(), goal.at("y").get<double>()};
  const Track& track = run.tracks[static_cast<std::size_t>(*robot)];
  for (std::size_t i = 0; i < track.time_s.size() && !mark.reached; ++i) {
    const double distance_m = (track.X_WB[i].position() - mark.place).norm();
    if (distance_m > goal.at("tolerance").get<double>()) continue;
    mark.reached = true;
    run.reached.push_back({*robot, track.time_s[i]});
  }
  run.goals.push_back(mark);
}

// The runs in a grade.json.
json graded_runs(const fs::path& file) {
  try {
    return json::parse(text_of(file)).at("runs");
  } catch (const json::exception& error) {
    throw std::runtime_error(
        file.string() + ": expected the grade of a program, found something else: " + error.what());
  }
}

// Adds what a file with the record of a run knows of it.
// @param name  the member that contains the record; "": the file itself is the record.
void add_record(const fs::path& file, const char* name, RunData& run) {
  try {
    const json content = json::parse(text_of(file));
    const json& graded = *name == '\0' ? content : content.at(name);
    add_judgement(graded, run);
    add_goal_of_task(graded, run);
  } catch (const json::exception& e) {
    throw std::runtime_error(file.string() + ": expected the record of a run: " + e.what());
  }
}

// If a run belongs to a batch or a class, adds what its record knows of it. The record of a unit of
// a batch is in its folder. In the folder of a submission the record of TASK/RUN is
// records/TASK/RUN.json.
void read_record(const fs::path& whole, RunData& run) {
  std::error_code error;
  if (fs::is_regular_file(whole / kUnitRecord, error))
    return add_record(whole / kUnitRecord, "", run);
  const fs::path task = whole.parent_path();
  fs::path file = task.parent_path() / "records" / task.filename() / whole.filename();
  file += ".json";
  if (fs::is_regular_file(file, error)) add_record(file, "value", run);
}

// If a run belongs to a grade, adds what the grade knows of it.
void read_grade(const fs::path& folder, RunData& run) {
  const fs::path whole = fs::absolute(folder / "").parent_path();
  const fs::path file = whole.parent_path() / kGrade;
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return read_record(whole, run);
  try {
    for (const json& graded : graded_runs(file)) {
      if (graded.at("folder").get<std::string>() == whole.filename().string()) {
        add_judgement(graded, run);
        add_goal_of_task(graded, run);
      }
    }
  } catch (const json::exception& e) {
    throw std::runtime_error(file.string() + ": expected the grade of a program: " + e.what());
  }
}

bool has_run(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / kPlottedFile, error) &&
         fs::is_regular_file(folder / kReport, error);
}

void read_report(const fs::path& file, RunData& run) {
  const std::string text = text_of(file);
  std::string world_file;
  try {
    run.report = playerlike::report_from(text);
    run.world_name = run.report.run.world;
    world_file = run.report.run.world_file.value_or("");
    read_marks(run.report, run);
  } catch (const std::exception& error) {
    throw std::runtime_error(
        file.string() + ": expected the report of a run, found something else: " + error.what());
  }
  try {
    // The default world has no file.
    sim::WorldDescription world = sim::load_world(world_file);
    if (world_file.empty() && world.name != run.world_name) {
      run.world_problem = "the report names no file of the world";
      return;
    }
    run.world = std::move(world);
  } catch (const std::exception& error) {
    run.world_problem = error.what();
  }
}

// --- Clearance

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

// Distance between two line segments; 0 if they cross.
double distance_m(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const bool cross_ab = cross(b - a, c - a) * cross(b - a, d - a) < 0.0;
  const bool cross_cd = cross(d - c, a - c) * cross(d - c, b - c) < 0.0;
  if (cross_ab && cross_cd) return 0.0;
  return std::min({sim::distance_to_segment_m(a, c, d), sim::distance_to_segment_m(b, c, d),
                   sim::distance_to_segment_m(c, a, b), sim::distance_to_segment_m(d, a, b)});
}

// A closed outline and its bounding circle.
struct Outline {
  explicit Outline(std::vector<Vec2> vertices) : points(std::move(vertices)) {
    for (const Vec2& p : points) center += p / static_cast<double>(points.size());
    for (const Vec2& p : points) radius_m = std::max(radius_m, (p - center).norm());
  }
  std::vector<Vec2> points;
  Vec2 center = Vec2::Zero();
  double radius_m = 0.0;
};

double distance_m(const Outline& body, const Outline& other, double least_m) {
  const double gap_m = (body.center - other.center).norm() - body.radius_m;
  // An outline such as the border may surround the body.
  if (gap_m - other.radius_m >= least_m) return least_m;
  for (std::size_t k = 0; k < other.points.size(); ++k) {
    const Vec2& c = other.points[k];
    const Vec2& d = other.points[(k + 1) % other.points.size()];
    if (sim::distance_to_segment_m(body.center, c, d) - body.radius_m >= least_m) continue;
    for (std::size_t i = 0; i < body.points.size(); ++i) {
      const Vec2& a = body.points[i];
      const Vec2& b = body.points[(i + 1) % body.points.size()];
      least_m = std::min(least_m, distance_m(a, b, c, d));
    }
  }
  return least_m;
}

// Tolerance of the outlines of round obstacles.
constexpr double kRoundness_m = 1e-4;

std::vector<Outline> solids_of(const sim::ArenaDescription& arena) {
  std::vector<Outline> solids;
  if (arena.border) {
    const Vec2 low = arena.origin;
    const Vec2 high = arena.origin + arena.size;
    solids.emplace_back(std::vector<Vec2>{low, {high.x(), low.y()}, high, {low.x(), high.y()}});
  }
  for (const auto& box : arena.obstacles) {
    if (box.solid && box.state == sim::ObstacleState::kExtended) {
      solids.emplace_back(sim::outline_of(box, kRoundness_m));
    }
  }
  for (const auto& box : arena.dock_separators) solids.emplace_back(sim::box_corners(box));
  for (const sim::WallLoop& loop : arena.walls) {
    if (loop.solid) solids.emplace_back(loop.vertices);
  }
  return solids;
}

// The parts of a robot's body; none if it is not solid.
std::vector<Outline> body_at(const sim::RobotModel& model, const sim::Pose& X_WB) {
  std::vector<Outline> parts;
  for (const sim::Polygon& part : sim::body_parts(model)) {
    std::vector<Vec2> outline;
    for (const Vec2& p_B : part) outline.push_back(X_WB * p_B);
    if (model.solid) parts.emplace_back(std::move(outline));
  }
  return parts;
}

}  // namespace

std::vector<std::string> run_folders(const std::string& folder, std::vector<std::string>& skipped) {
  const fs::path path(folder);
  std::error_code error;
  if (has_run(path) || !fs::is_regular_file(path / kGrade, error)) return {folder};
  std::vector<std::string> runs;
  for (const json& graded : graded_runs(path / kGrade)) {
    const fs::path run = path / graded.value("folder", "");
    (has_run(run) ? runs : skipped).push_back(run.string());
  }
  if (runs.empty()) {
    throw std::runtime_error("expected a grade with results, found none of a run in '" + folder +
                             "'");
  }
  return runs;
}

RunData read_run(const std::string& folder) {
  RunData run;
  run.folder = folder;
  const fs::path path(folder);
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    throw std::runtime_error("expected a folder of results, found no folder '" + folder + "'");
  }
  for (const char* const name : {kPlottedFile, kReport}) {
    if (fs::is_regular_file(path / name, error)) continue;
    throw std::runtime_error("expected a folder of results, found no " + std::string(name) +
                             " in '" + folder + "'; 'playpen run WORLD --out " + folder +
                             " -- PROGRAM' makes one, 'playpen grade TASK --out " + folder +
                             " -- PROGRAM' several");
  }
  for (grade::Trajectory& trajectory : grade::read_trajectories(path / kPlottedFile)) {
    run.tracks.push_back(track_of(std::move(trajectory)));
  }
  read_report(path / kReport, run);
  read_grade(path, run);
  return run;
}

void measure_clearances(RunData& run) {
  if (!run.world) return;
  const std::vector<Outline> solids = solids_of(run.world->arena);
  std::vector<const sim::RobotModel*> models(run.tracks.size(), nullptr);
  for (std::size_t i = 0; i < run.tracks.size(); ++i) {
    for (const sim::RobotDescription& robot : run.world->robots) {
      if (robot.name == run.tracks[i].robot) {
        models[i] = sim::find_robot_model(*run.world, robot.model);
      }
    }
  }
  for (std::size_t i = 0; i < run.tracks.size(); ++i) {
    Track& track = run.tracks[i];
    if (models[i] == nullptr) continue;
    for (std::size_t row = 0; row < track.X_WB.size(); ++row) {
      const std::vector<Outline> body = body_at(*models[i], track.X_WB[row]);
      double least_m = std::numeric_limits<double>::infinity();
      const auto note = [&](const Outline& solid) {
        for (const Outline& part : body) least_m = distance_m(part, solid, least_m);
      };
      for (const Outline& solid : solids) note(solid);
      for (std::size_t k = 0; k < run.tracks.size(); ++k) {
        const Track& other = run.tracks[k];
        if (k == i || models[k] == nullptr || row >= other.X_WB.size()) continue;
        for (const Outline& part : body_at(*models[k], other.X_WB[row])) note(part);
      }
      if (!std::isfinite(least_m)) {  // the world has no solid objects
        track.clearance_m.clear();
        break;
      }
      track.clearance_m.push_back(least_m);
    }
  }
}

}  // namespace playpen
