// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/outputs.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "sim/render/render.h"

namespace playerlike {
namespace {

constexpr int kSceneSize_px = 1200;
constexpr int kCanvasScale = 4;

std::string hex(std::uint64_t value) {
  std::array<char, 20> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(value));
  return text.data();
}

nlohmann::ordered_json report(const sim::Simulation& simulation, const TimeStatistics& time) {
  nlohmann::ordered_json robots = nlohmann::ordered_json::array();
  for (int i = 0; i < simulation.robot_count(); ++i) {
    const sim::RobotStatistics& s = simulation.statistics(i);
    const sim::Pose& X_WB = simulation.body(i).X_WB;
    robots.push_back({{"name", simulation.world().robots[static_cast<std::size_t>(i)].name},
                      {"path_length", s.path_length_m},
                      {"collisions", s.collisions},
                      {"least_clearance", s.least_clearance_m},
                      {"stalled_time", s.stalled_time_s},
                      {"final_pose", {{"x", X_WB.x_m}, {"y", X_WB.y_m}, {"yaw", X_WB.yaw_rad}}}});
  }
  return {{"run",
           {{"world", simulation.world().name},
            {"seed", simulation.world().simulation.seed},
            {"steps", simulation.steps()},
            {"sim_time", sim::to_seconds(simulation.now_ns())},
            {"wall_time", time.wall_time_s},
            {"real_time_factor", time.real_time_factor},
            {"state_hash", hex(simulation.state_hash())}}},
          {"robots", robots}};
}

}  // namespace

void write_outputs(const std::string& folder, const sim::Simulation& simulation,
                   const sim::SceneSnapshot& scene, const TimeStatistics& time) {
  const std::filesystem::path out(folder);
  sim::render::write_png(sim::render::draw_scene(scene, {.size_px = kSceneSize_px}),
                         (out / "scene.png").string());
  sim::render::write_png(
      sim::render::draw_canvas(scene.canvas_description, scene.canvas, kCanvasScale),
      (out / "canvas.png").string());
  // Last, so that a report means that all is there.
  const std::string file = (out / "report.json").string();
  std::ofstream stream(file, std::ios::trunc);
  stream << report(simulation, time).dump(2) << '\n';
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + file);
}

}  // namespace playerlike
