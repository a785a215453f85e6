// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "command_line.h"
#include "grade/evaluation.h"
#include "playerlike/host/run_settings.h"
#include "playerlike/messages/driver_settings.h"
#include "playerlike/messages/messages.h"
#include "shipped.h"
#include "sim/core/error.h"
#include "sim/core/number_text.h"
#include "sim/simulation/simulation.h"
#include "sim/world/robot_model.h"

namespace playpen {
namespace {

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

/// "world: 1 robot, 20 obstacles (6 retracted), 6 docks, 3.42 m x 3.72 m".
std::string describe(const sim::WorldDescription& world) {
  std::size_t retracted = 0;
  for (const sim::ObstacleDescription& obstacle : world.arena.obstacles) {
    if (obstacle.state == sim::ObstacleState::kRetracted) ++retracted;
  }
  std::string text = "world: " + counted(world.robots.size(), "robot", "robots") + ", " +
                     counted(world.arena.obstacles.size(), "obstacle", "obstacles");
  if (retracted > 0) text += " (" + std::to_string(retracted) + " retracted)";
  if (!world.arena.docks.empty()) text += ", " + counted(world.arena.docks.size(), "dock", "docks");
  if (!world.arena.walls.empty()) {
    text += ", " + counted(world.arena.walls.size(), "wall outline", "wall outlines");
  }
  const std::string size = ", " + sim::fixed_text(world.arena.size.x(), 2) + " m x " +
                           sim::fixed_text(world.arena.size.y(), 2) + " m";
  return text + size;
}

/// "task: worlds a, b; 5 seeds, a goal".
std::string describe(const grade::Task& task) {
  std::string worlds;
  for (const grade::TaskWorld& world : task.worlds) {
    worlds += (worlds.empty() ? "" : ", ") + grade::world_name(world.file);
  }
  std::string text = "task: worlds " + worlds + "; " + counted(task.seeds.size(), "seed", "seeds");
  if (task.goal || task.worlds.front().goal) text += ", a goal";
  if (!task.map_layer.empty()) text += ", a map in the layer " + task.map_layer;
  return text;
}

/// "model: differential drive, 0.45 m x 0.38 m, devices bumper, laser".
std::string describe(const sim::RobotModel& model) {
  const char* drive = "differential";
  if (model.drive.kind == sim::DriveKind::kOmnidirectional) drive = "omnidirectional";
  if (model.drive.kind == sim::DriveKind::kCar) drive = "car-like";
  sim::Vec2 least = model.footprint.front();
  sim::Vec2 most = least;
  for (const sim::Vec2& corner : model.footprint) {
    least = least.cwiseMin(corner);
    most = most.cwiseMax(corner);
  }
  const std::string size = ", " + sim::fixed_text(most.x() - least.x(), 2) + " m x " +
                           sim::fixed_text(most.y() - least.y(), 2) + " m";
  std::string devices;
  for (const sim::DeviceDescription& device : model.devices) {
    devices += (devices.empty() ? "" : ", ") + device.name;
  }
  return std::string("model: ") + drive + " drive" + size +
         (devices.empty() ? ", no devices" : ", devices " + devices);
}

/// Reads a world in the way that a run does. The simulation resolves what devices are wired to.
sim::WorldDescription read_world(const std::string& file) {
  sim::WorldDescription world = sim::load_world(file);
  print_notes(world);
  playerlike::check_drivers(world);
  playerlike::check_interfaces(world);
  playerlike::RunSettings().apply_to(world);
  const sim::Simulation wired(world);
  return world;
}

/// Reads a task and its worlds in the way that grading does.
grade::Task read_task(const std::string& file) {
  grade::Task task = grade::read_task(file);
  for (const grade::TaskWorld& world : task.worlds) {
    static_cast<void>(grade::make_reference(task, world, read_world(world.file)));
  }
  return task;
}

/// Validates a file. @return a description of its content.
std::string checked(const NamedFile& named) {
  switch (named.kind) {
    case FileKind::kTask:
      return describe(read_task(named.file));
    case FileKind::kModel:
      return describe(sim::load_model(named.file));
    case FileKind::kWorld:
      break;
  }
  return describe(read_world(named.file));
}

}  // namespace

int check(const std::vector<std::string>& names) {
  int status = kOk;
  for (const std::string& name : names) {
    std::vector<NamedFile> files;
    try {
      files = find_files(name);
    } catch (const sim::ConfigError& error) {
      std::cerr << error.what() << '\n';
      status = kBadInput;
    }
    for (const NamedFile& file : files) {
      try {
        // everything that may throw comes before the output line
        const std::string what = checked(file);
        std::cout << name << ": ok (" << what << ")\n";
      } catch (const sim::ConfigError& error) {
        std::cerr << error.what() << '\n'
                  << name << ": invalid as a " << to_string(file.kind) << " file\n";
        status = kBadInput;
      }
    }
  }
  return status;
}

void add_check(CommandLine& line) {
  const auto names = std::make_shared<std::vector<std::string>>();
  CLI::App& command = line.add_command("check", "Validate files of worlds, tasks and robot models");
  CLI::Option* const files =
      command.add_option("file", *names, "Files, or names of shipped worlds, tasks and models");
  line.takes(files->required()->type_name(""), ValueKind::Kind::kNamedFile);
  command.footer("Exit status: 0 all files are valid, 2 some are not.");
  command.callback([names, &line] { line.status = check(*names); });
}

}  // namespace playpen
