// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Makes a replay to look at and to test: `replay_sample WORLD SECONDS FOLDER` drives
// all robots of a world around by their range sensors, and writes into FOLDER
//   replay.html   the replay
//   two.html      the same run, and one with another seed of the driving
//   scene.png     the picture of the end, as the renderer draws it
//   scene.json    where that picture shows the world: its size, scale, and middle
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "playerlike/replay/replay_builder.h"
#include "replay/replay_page.h"
#include "sim/core/number_text.h"
#include "sim/devices/laser.h"
#include "sim/devices/motion.h"
#include "sim/render/render.h"
#include "sim/simulation/simulation.h"

namespace {

using playerlike::replay::ReplayBuilder;
using playerlike::replay::ReplayRun;
using sim::Simulation;

// A robot's devices that the driver uses; -1: it has none.
struct Driven {
  int motion = -1;
  int laser = -1;
};

std::vector<Driven> driven_robots(const Simulation& simulation) {
  std::vector<Driven> robots;
  for (int robot = 0; robot < simulation.robot_count(); ++robot) {
    Driven& own = robots.emplace_back();
    for (int device = 0; device < simulation.device_count(robot); ++device) {
      const sim::Device& one = simulation.device(robot, device);
      if (one.type() == "motion") own.motion = device;
      if (dynamic_cast<const sim::Laser*>(&one) != nullptr) own.laser = device;
    }
  }
  return robots;
}

// Forward where there is room, else a turn; a slow sine makes the way less straight.
sim::TwistCommand command_of(const Simulation& simulation, int robot, const Driven& own,
                             double phase) {
  const double time_s = sim::to_seconds(simulation.now_ns());
  double ahead_m = 1.0;
  if (own.laser >= 0) {
    const auto& reading =
        static_cast<const sim::Laser&>(simulation.device(robot, own.laser)).reading();
    for (std::size_t i = 0; i < reading.ranges_m.size(); ++i) {
      const double angle = reading.angle_min_rad + reading.resolution_rad * static_cast<double>(i);
      if (std::abs(angle) < 0.7) ahead_m = std::min(ahead_m, reading.ranges_m[i]);
    }
  }
  const bool blocked = ahead_m < 0.24;
  return {{.v_mps = blocked ? 0.0 : 0.18,
           .omega_radps = blocked ? 0.9 : 0.7 * std::sin(0.4 * time_s + phase + robot)}};
}

// Draws the cell under each robot in the layer's colour.
void draw_path(Simulation& simulation, sim::LayerId layer) {
  const sim::CanvasDescription canvas = simulation.layers().description();
  std::vector<sim::DrawOperation> drawings;
  for (int robot = 0; robot < simulation.robot_count(); ++robot) {
    const sim::Vec2 cell =
        (simulation.body(robot).X_WB.position() - canvas.origin) / canvas.cell_size_m;
    sim::DrawOperation drawing;
    drawing.layer = layer;
    drawing.x0 = static_cast<int>(std::floor(cell.x()));
    drawing.y0 = canvas.height - 1 - static_cast<int>(std::floor(cell.y()));
    drawing.value = sim::CellValue::of(true);
    drawings.push_back(drawing);
  }
  simulation.layers().draw(drawings);
}

struct Recorded {
  ReplayRun run;
  sim::SceneSnapshot scene;
};

Recorded drive(const std::string& world, double seconds, double phase, const std::string& name) {
  Simulation simulation(sim::load_world(world));
  const std::vector<Driven> robots = driven_robots(simulation);
  const sim::LayerId layer = simulation.layers().add(
      sim::LayerKind::kBinary, {.name = "visited", .colour = {0x2b, 0x8f, 0x57, 0xff}}, 1);
  ReplayBuilder builder(simulation, {.name = name});
  builder.observe(simulation);
  std::vector<std::vector<sim::Vec2>> trails(robots.size());
  std::vector<sim::CollisionMark> collisions;
  while (sim::to_seconds(simulation.now_ns()) < seconds && !simulation.finished()) {
    if (simulation.steps() % 10 == 0) {
      for (std::size_t i = 0; i < robots.size(); ++i) {
        if (robots[i].motion < 0) continue;
        const auto robot = static_cast<int>(i);
        const sim::Command command = command_of(simulation, robot, robots[i], phase);
        const Simulation::DeviceId id{robot, robots[i].motion};
        builder.note_command(simulation.now_ns(), id, command);
        simulation.apply(id, command);
        trails[i].push_back(simulation.body(robot).X_WB.position());
      }
    }
    if (simulation.steps() % 500 == 0) {
      builder.note_output(simulation.now_ns(),
                          "step " + std::to_string(simulation.steps()) + " <b>of</b> the sample\n",
                          simulation.steps() % 1000 == 0);
    }
    simulation.step();
    draw_path(simulation, layer);
    builder.observe(simulation);
  }
  Recorded made{builder.finish(simulation), simulation.snapshot()};
  for (std::size_t i = 0; i < robots.size(); ++i) made.scene.robots[i].trail = trails[i];
  for (const sim::Collision& one : made.run.collisions) {
    made.scene.collisions.push_back({one.robot, one.place, sim::to_seconds(one.time_ns)});
  }
  for (const playerlike::replay::GoalNote& goal : made.run.goals) {
    made.scene.goals.push_back({goal.robot, goal.place, goal.reached_ns.has_value(), true});
  }
  return made;
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
  std::cout << path.string() << ": " << text.size() << " bytes\n";
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) {
    std::cerr << "usage: replay_sample WORLD SECONDS FOLDER\n";
    return 2;
  }
  const std::string world = arguments[1];
  const double seconds = std::atof(arguments[2]);
  const std::filesystem::path folder = arguments[3];
  std::filesystem::create_directories(folder);
  const Recorded first = drive(world, seconds, 0.0, "first run");
  write(folder / "replay.html", playpen::replay::html({first.run}));
  const Recorded second = drive(world, seconds, 2.0, "second run");
  write(folder / "two.html", playpen::replay::html({first.run, second.run}));
  constexpr int kSize = 800;
  const sim::render::RenderOptions options{.width_px = kSize, .height_px = kSize, .legend = false};
  sim::render::write_png(sim::render::draw_scene(first.scene, options),
                         (folder / "scene.png").string());
  const sim::Vec2 zero = sim::render::place_in_picture(first.scene, options, sim::Vec2(0.0, 0.0));
  const sim::Vec2 one = sim::render::place_in_picture(first.scene, options, sim::Vec2(1.0, 0.0));
  const double scale = one.x() - zero.x();
  write(folder / "scene.json",
        "{\"size\": " + std::to_string(kSize) + ", \"scale\": " + sim::shortest_text(scale) +
            ", \"x\": " + sim::shortest_text((0.5 * kSize - zero.x()) / scale) +
            ", \"y\": " + sim::shortest_text((zero.y() - 0.5 * kSize) / scale) +
            ", \"end\": " + sim::shortest_text(first.scene.time_s) + "}\n");
  return 0;
}
