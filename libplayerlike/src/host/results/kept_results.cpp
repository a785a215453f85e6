// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/kept_results.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "host/results/file_limit_errors.h"
#include "host/results/kept_layout.h"
#include "host/results/kept_memory.h"
#include "host/results/outputs.h"
#include "playerlike/host/report.h"
#include "sim/core/pose.h"
#include "sim/core/replace_file.h"
#include "sim/core/time.h"
#include "sim/simulation/simulation.h"
#include "sim/world/outline.h"
#include "sim/world/view_mode.h"

namespace playerlike {
namespace {

using nlohmann::json;

/// The data of the newest step.
struct LastStep {
  KeptStep step;
  std::vector<KeptRobot> robots;
};

std::optional<LastStep> last_step(const KeptMemory& memory, const KeptHeader& header) {
  const std::uint32_t robots = header.robots;
  const std::uint32_t newest = header.step;
  if (robots == 0 || newest > 1) return std::nullopt;
  const std::uint64_t place = header.steps.at(newest);
  const auto* const step = memory.at<KeptStep>(place);
  const auto* const kept = memory.at<KeptRobot>(place + sizeof(KeptStep), robots);
  if (step == nullptr || kept == nullptr) return std::nullopt;
  LastStep last{*step, {kept, kept + robots}};
  const bool sound = std::all_of(last.robots.begin(), last.robots.end(), [](const KeptRobot& r) {
    return std::isfinite(r.x_m) && std::isfinite(r.y_m) && std::isfinite(r.yaw_rad);
  });
  return sound ? std::optional(std::move(last)) : std::nullopt;
}

/// How the run of a program with this end has ended.
RunEnd run_end(const ProgramEnd& end) {
  if (end.request) return {.by = RunEnd::By::kRequest, .signal = signal_name(*end.request)};
  if (end.signal) return {.by = RunEnd::By::kSignal, .signal = signal_name(*end.signal)};
  return {.by = RunEnd::By::kProgram, .status = end.status};
}

/// Updates the report's numbers to the last step.
/// @param conflict  see KeptRun::note_conflict().
std::string completed_report(Report report, const LastStep& last, const ProgramEnd& end,
                             bool conflict) {
  if (conflict) {
    report.run.repeatable = false;
    report.run.repeatable_why = {kConflictWhy};
  }
  report.run.steps = last.step.steps;
  report.run.sim_time_s = sim::to_seconds(last.step.now_ns);
  report.run.wall_time_s = last.step.wall_time_s;
  report.run.real_time_factor = last.step.real_time_factor;
  for (std::size_t i = 0; i < last.robots.size(); ++i) {
    const KeptRobot& kept = last.robots[i];
    Report::Robot& robot = report.robots.at(i);
    robot.path_length_m = kept.path_length_m;
    robot.collisions = kept.collisions;
    robot.least_clearance_m.reset();
    if (std::isfinite(kept.least_clearance_m)) robot.least_clearance_m = kept.least_clearance_m;
    robot.stalled_time_s = kept.stalled_time_s;
    robot.driven_time_s = kept.driven_time_s;
    robot.distance_m = kept.distance_m;
    robot.visited_area_m2 = kept.visited_area_m2;
    if (kept.commands > 0) {
      Report::Commanded& commanded = robot.commanded.emplace(Report::Commanded{});
      commanded.first_s = sim::to_seconds(kept.first_command_ns);
      commanded.commands = kept.commands;
      std::copy_if(kept.ports.begin(), kept.ports.end(), std::back_inserter(commanded.ports),
                   [](std::int32_t port) { return port != 0; });
    }
    robot.final_pose = {kept.x_m, kept.y_m, kept.yaw_rad};
  }
  if (!report.ended) report.ended = run_end(end);
  return text_of_report(report);
}

double number(const json& value) {
  const double x = value.get<double>();
  if (!std::isfinite(x)) throw std::runtime_error("a number is not finite");
  return x;
}
sim::Vec2 point(const json& value) { return {number(value.at(0)), number(value.at(1))}; }
sim::Pose pose(const json& value) {
  return {number(value.at(0)), number(value.at(1)), number(value.at(2))};
}
std::vector<sim::Vec2> points(const json& value) {
  std::vector<sim::Vec2> all;
  for (const json& p : value) all.push_back(point(p));
  return all;
}
sim::Colour colour(const json& value) {
  return {value.at(0).get<std::uint8_t>(), value.at(1).get<std::uint8_t>(),
          value.at(2).get<std::uint8_t>(), value.at(3).get<std::uint8_t>()};
}
std::optional<sim::Colour> maybe_colour(const json& value) {
  return value.is_null() ? std::nullopt : std::optional(colour(value));
}
template <typename Enum>
Enum choice(const json& value, Enum last) {
  const int number = value.get<int>();
  if (number < 0 || number > static_cast<int>(last)) throw std::runtime_error("no such kind");
  return static_cast<Enum>(number);
}

/// Restores the layers. @throws std::exception for invalid data.
sim::LayerStack layers_of(const json& scene, const sim::CanvasDescription& canvas,
                          const KeptMemory& memory) {
  sim::CanvasDescription place = canvas;
  place.width = scene.at("width").get<int>();
  place.height = scene.at("height").get<int>();
  if (place.width < 1 || place.width > sim::kMaxCanvasSide || place.height < 1 ||
      place.height > sim::kMaxCanvasSide) {
    throw std::runtime_error("the canvas has no size");
  }
  sim::LayerStack stack(place);
  std::vector<json> layers = scene.at("layers").get<std::vector<json>>();
  // Sorted by age, which decides between layers of equal priority.
  std::sort(layers.begin(), layers.end(), [](const json& a, const json& b) {
    return a.at("id").get<int>() < b.at("id").get<int>();
  });
  for (const json& layer : layers) {
    sim::LayerStyle style;
    style.name = layer.at("name").get<std::string>();
    style.colour = colour(layer.at("colour"));
    style.transparency = number(layer.at("transparency"));
    style.transparent_colour = maybe_colour(layer.at("transparent_colour"));
    style.priority = layer.at("priority").get<int>();
    style.visible = layer.at("visible").get<bool>();
    sim::LayerId id = sim::kBaseLayer;
    if (layer.at("id").get<int>() == sim::kBaseLayer) {
      stack.set_style(sim::kBaseLayer, style);
    } else {
      id = stack.add(choice(layer.at("kind"), sim::LayerKind::kGrey), style,
                     layer.at("owner").get<int>());
    }
    const auto count =
        static_cast<std::size_t>(place.width) * static_cast<std::size_t>(place.height);
    const auto where = layer.at("cells").get<std::uint64_t>();
    if (where == 0) throw std::runtime_error("the canvas was too large to be kept");
    const auto* const cells = memory.at<sim::CellValue>(where, count);
    if (cells == nullptr) throw std::runtime_error("cells lie nowhere");
    stack.set_cells(id, {0, 0, place.width, place.height}, std::span(cells, count));
  }
  return stack;
}

/// Restores the appearance of a robot's devices.
void take_looks(const json& looks, sim::RobotSnapshot& robot) {
  robot.says = looks.at("says").get<std::string>();
  const auto each = [&looks](const char* key, auto action) {
    for (const json& item : looks.value(key, json::array())) action(item);
  };
  robot.lights.clear();
  each("lights", [&](const json& l) {
    robot.lights.push_back({point(l.at(0)), colour(l.at(1)), l.at(2).get<bool>()});
  });
  each("cones", [&](const json& c) {
    robot.cones.push_back({pose(c.at(0)), number(c.at(1)), number(c.at(2)), c.at(3).get<bool>()});
  });
  robot.bumpers.clear();
  each("bumpers", [&](const json& b) {
    robot.bumpers.push_back({points(b.at(0)), b.at(1).get<bool>()});
  });
  each("sights", [&](const json& s) { robot.sights.emplace_back(point(s.at(0)), point(s.at(1))); });
  robot.paddles.clear();
  each("paddles", [&](const json& p) { robot.paddles.push_back(points(p)); });
  robot.arms.clear();
  each("arms", [&](const json& arm) { robot.arms.push_back(points(arm)); });
}

void take_scan(const KeptScan& kept, sim::RobotSnapshot& robot) {
  const sim::Pose X_WL{kept.x_m, kept.y_m, kept.yaw_rad};
  robot.scan_origin = X_WL.position();
  robot.scan_points.clear();
  for (std::size_t beam = 0; beam < std::min<std::uint64_t>(kept.count, kMostKeptBeams); ++beam) {
    const double angle = kept.angle_min_rad + kept.resolution_rad * static_cast<double>(beam);
    const double range = kept.ranges_m[beam];
    const sim::Vec2 hit = X_WL * (range * sim::unit_vector(angle));
    if (!hit.allFinite()) throw std::runtime_error("a scan is not finite");
    robot.scan_points.push_back(hit);
  }
}

void take_obstacles(const json& kept, std::vector<sim::ObstacleDescription>& obstacles) {
  for (std::size_t i = 0; i < std::min(kept.size(), obstacles.size()); ++i) {
    sim::ObstacleDescription& o = obstacles[i];
    o.center = point(kept[i].at(0));
    sim::resize(o, point(kept[i].at(1)));
    o.yaw_rad = number(kept[i].at(2));
    o.height_m = number(kept[i].at(3));
    o.state = choice(kept[i].at(4), sim::ObstacleState::kRetracted);
    o.colour = maybe_colour(kept[i].at(5));
    o.carried_by = kept[i].at(6).get<int>();
  }
}

/// Adds the collisions and goals of the report as marks.
void take_marks(const Report& report, sim::SceneSnapshot& scene) {
  const auto robot_of = [&scene](const std::string& name) {
    for (std::size_t i = 0; i < scene.robots.size(); ++i) {
      if (scene.robots[i].name == name) return static_cast<int>(i);
    }
    throw std::runtime_error("there is no robot " + name);
  };
  for (const Report::Collision& c : report.collisions) {
    scene.collisions.push_back({robot_of(c.robot), c.place, c.time_s});
  }
  for (const Report::Goal& g : report.goals) {
    const int robot = robot_of(g.robot);
    for (sim::GoalMark& earlier : scene.goals) {
      if (earlier.robot == robot) earlier.newest = false;
    }
    scene.goals.push_back({robot, g.place, g.reached_s.has_value(), true});
  }
}

/// Draws the pictures from the memory. @throws std::exception for invalid data.
void complete_pictures(const KeptMemory& memory, const KeptHeader& header, const LastStep& last,
                       const Report& report, const sim::WorldDescription& world,
                       const RunSettings& settings) {
  const json kept = memory.json(header.scene);
  sim::Simulation simulation(world, {});
  sim::SceneSnapshot scene = simulation.snapshot();
  if (scene.robots.size() != last.robots.size()) {
    throw std::runtime_error("the program has run another world");
  }
  sim::LayerStack stack = layers_of(kept, scene.canvas_description, memory);
  scene.canvas_description = stack.description();
  scene.canvas = stack.composed();
  scene.layers = stack.layers();
  scene.view_mode = choice(kept.at("view_mode"), sim::kViewModes.back());
  scene.time_s = sim::to_seconds(last.step.now_ns);
  take_obstacles(kept.at("obstacles"), scene.arena.obstacles);
  for (std::size_t i = 0; i < last.robots.size(); ++i) {
    const KeptRobot& from = last.robots[i];
    sim::RobotSnapshot& robot = scene.robots[i];
    robot.X_WB = {from.x_m, from.y_m, from.yaw_rad};
    robot.stalled = from.stalled != 0;
    take_looks(kept.at("robots").at(i), robot);
    const std::size_t trail = std::min<std::size_t>(from.trail_points, kMostTrailPoints);
    const auto* const coordinates = memory.at<double>(
        header.trails + i * kMostTrailPoints * 2 * sizeof(double), kMostTrailPoints * 2);
    for (std::size_t k = 0; coordinates != nullptr && k < trail; ++k) {
      const sim::Vec2 p(coordinates[2 * k], coordinates[2 * k + 1]);
      if (!p.allFinite()) throw std::runtime_error("a trail is not finite");
      robot.trail.push_back(p);
    }
    if (trail > 0) robot.trail.push_back(robot.X_WB.position());
    if (from.scan != 1 && from.scan != 2) continue;
    const auto* const scan =
        memory.at<KeptScan>(header.scans + (i * 2 + from.scan - 1) * sizeof(KeptScan));
    if (scan != nullptr) take_scan(*scan, robot);
  }
  take_marks(report, scene);
  write_pictures(settings.output_folder, stack, scene, settings.pictures);
}

}  // namespace

bool complete_results(const KeptRun& kept, const sim::WorldDescription& world,
                      const RunSettings& settings, const ProgramEnd& end) {
  const KeptRun::Phase phase = kept.phase();
  if (!KeptRun::lacks_results(phase)) return false;
  const FileLimitErrors limit_errors;
  if (!settings.film.empty()) std::remove(sim::part_file_name(settings.film).c_str());
  const KeptMemory memory(kept.descriptor());
  const auto* const header = memory.at<KeptHeader>(0);
  const std::optional<LastStep> last =
      header == nullptr ? std::nullopt : last_step(memory, *header);
  if (!last) throw std::runtime_error("the program has left no results of its run");
  const std::string report(memory.text(header->report));
  std::string problem;
  const auto attempt = [&problem](const char* what, const auto& action) {
    try {
      action();
    } catch (const std::exception& e) {
      if (!problem.empty()) problem += "; ";
      problem += what + std::string(e.what());
    }
  };
  if (!KeptRun::has_reported(phase)) {
    attempt("no report: ", [&] {
      write_report(settings.output_folder,
                   completed_report(report_from(report), *last, end, header->conflict != 0));
    });
  }
  attempt("no pictures: ",
          [&] { complete_pictures(memory, *header, *last, report_from(report), world, settings); });
  if (!problem.empty()) throw std::runtime_error(problem);
  return true;
}

}  // namespace playerlike
