// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "playerlike/testing/check.h"
#include "sim/core/number_text.h"
#include "sim/render/render.h"
#include "testing/run_content.h"

namespace playpen::testing {
namespace {

namespace fs = std::filesystem;

constexpr double kTrailSpacing_m = 0.01;
constexpr sim::Colour kMarkColour{0xb0, 0x00, 0x20, 0xff};

std::vector<sim::Vec2> trail_of(const std::vector<Sample>& path) {
  std::vector<sim::Vec2> trail;
  for (const Sample& sample : path) {
    const sim::Vec2 place(sample.pose.x_m, sample.pose.y_m);
    if (trail.empty() || (place - trail.back()).norm() >= kTrailSpacing_m) trail.push_back(place);
  }
  if (!path.empty()) trail.emplace_back(path.back().pose.x_m, path.back().pose.y_m);
  return trail;
}

void add_mark(sim::SceneSnapshot& scene, const TestRun::Mark& mark, int robot) {
  const Pose& pose = mark.at.pose;
  sim::RobotSnapshot ghost = scene.robots[static_cast<std::size_t>(robot)];
  ghost.X_WB = {pose.x_m, pose.y_m, pose.yaw_rad};
  ghost.trail.clear();
  ghost.scan_points.clear();
  ghost.cones.clear();
  ghost.name.clear();
  ghost.marked = true;
  scene.ghosts.push_back(std::move(ghost));
  // The text is above the robot, or below it near the upper border.
  constexpr double kAside = 0.07;
  const double aside_m = kAside * scene.arena.size.y();
  const double top_m = scene.arena.origin.y() + scene.arena.size.y();
  const double y_m = pose.y_m + 2.0 * aside_m > top_m ? pose.y_m - aside_m : pose.y_m + aside_m;
  scene.texts.push_back({{pose.x_m, y_m},
                         mark.text + " at " + sim::fixed_text(mark.at.time_s, 2) + " s",
                         kMarkColour,
                         std::nullopt});
}

// A file of the test that this process has not written yet.
std::string new_picture_file(const std::string& test) {
  static std::map<std::string, int>* const written = new std::map<std::string, int>;
  static std::mutex* const mutex = new std::mutex;
  const char* const folder = std::getenv("PLAYPEN_TEST_OUT");
  std::string name;
  for (const char c : test) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '.' || c == '-' || c == '_';
    name += plain ? c : '_';  // tests with parameters have slashes
  }
  int number = 0;
  {
    const std::lock_guard lock(*mutex);
    number = ++(*written)[name];
  }
  if (number > 1) name += '_' + std::to_string(number);
  const fs::path place = folder == nullptr || *folder == '\0' ? "playpen_test" : folder;
  std::error_code error;
  fs::create_directories(place, error);  // if it fails, so does the picture, with a reason
  return (place / (name + ".png")).string();
}

}  // namespace

void TestRun::SavePicture(const std::string& png_file, const std::optional<Mark>& mark) const {
  const int marked = mark ? content_->robot(mark->robot) : -1;
  sim::SceneSnapshot scene;
  content_->host->change_simulation([&](const sim::Simulation& simulation) {
    scene = simulation.snapshot();
    for (std::size_t i = 0; i < scene.robots.size(); ++i) {
      scene.robots[i].trail = trail_of(content_->record->paths[i]);
    }
    for (const Collision& one : content_->record->collisions) {
      scene.collisions.push_back({simulation.find_robot(one.robot).value_or(0),
                                  {one.place.x_m, one.place.y_m},
                                  one.time_s});
    }
    for (const GoalState& goal : content_->record->goals) {
      scene.goals.push_back({goal.robot, {goal.point.x_m, goal.point.y_m}, goal.reached, true});
    }
  });
  if (mark) add_mark(scene, *mark, marked);
  sim::render::RenderOptions options;
  options.size_px = 800;
  try {
    sim::render::write_png(sim::render::draw_scene(scene, options), png_file);
  } catch (const std::exception& e) {
    throw Error(std::string("TestRun::SavePicture: ") + e.what());
  }
}

std::string picture_of(const Subject& subject, const Verdict& verdict, const std::string& test) {
  const std::string file = new_picture_file(test);
  try {
    subject.run().SavePicture(file, verdict.mark);
  } catch (const Error& e) {
    return std::string("no picture: ") + e.what();
  }
  return "picture: " + file;
}

}  // namespace playpen::testing
