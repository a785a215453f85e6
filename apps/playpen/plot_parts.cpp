// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "plot_parts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "sim/core/replace_file.h"
#include "sim/world/robot_model.h"

namespace playpen {
namespace {

using page::kLeft;
using page::kMostEntries;
using page::kPageWidth;
using page::kText;
using sim::Colour;
using sim::Vec2;
using sim::render::Drawing;
using sim::render::page_palette::kFaintInk;
using sim::render::page_palette::kInk;

constexpr Colour kRed{0xe0, 0x1e, 0x37, 0xff};
constexpr Colour kGreen{0x1c, 0x8a, 0x3c, 0xff};

double difference(Colour a, Colour b) {
  const auto square = [](int x) { return static_cast<double>(x * x); };
  return std::sqrt(square(a.r - b.r) + square(a.g - b.g) + square(a.b - b.b));
}

const sim::RobotModel& model_of(const RunData& run, const std::string& robot) {
  if (run.world) {
    for (const sim::RobotDescription& described : run.world->robots) {
      if (described.name != robot) continue;
      if (const auto* own = sim::find_robot_model(*run.world, described.model)) return *own;
    }
  }
  return sim::default_robot_model();
}

// The last parts of a folder's path.
std::string last_parts(const std::string& folder, int parts) {
  namespace fs = std::filesystem;
  fs::path rest = fs::path(folder).lexically_normal();
  if (!rest.has_filename()) rest = rest.parent_path();
  fs::path name;
  for (; parts > 0 && rest.has_filename(); --parts) {
    name = name.empty() ? rest.filename() : rest.filename() / name;
    rest = rest.parent_path();
  }
  return name.string();
}

}  // namespace

std::vector<std::string> short_names(const std::vector<RunData>& runs) {
  constexpr int kMostParts = 4;
  std::vector<std::string> names;
  for (int parts = 1; parts <= kMostParts; ++parts) {
    names.clear();
    for (const RunData& run : runs) names.push_back(last_parts(run.folder, parts));
    std::vector<std::string> sorted = names;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end()) break;
  }
  return names;
}

std::vector<Series> series_of(const std::vector<RunData>& runs) {
  constexpr double kFarEnough = 70.0;
  const std::vector<std::string> names = short_names(runs);
  std::vector<Series> all;
  std::size_t next = 0;
  const auto is_free = [&all](Colour colour) {
    return std::none_of(all.begin(), all.end(), [&](const Series& series) {
      return difference(series.colour, colour) < kFarEnough;
    });
  };
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (const Track& track : runs[r].tracks) {
      std::optional<Colour> colour;
      if (runs[r].world) {
        for (const sim::RobotDescription& robot : runs[r].world->robots) {
          if (robot.name == track.robot) colour = robot.colour;
        }
      }
      constexpr std::size_t kColours = 20;
      if (!colour || !is_free(*colour)) {
        colour = sim::render::distinct_colour(next);
        while (next < kColours && !is_free(*colour)) {
          colour = sim::render::distinct_colour(++next);
        }
        ++next;
      }
      std::string name = track.robot;
      if (runs.size() > 1) name = names[r] + ": " + name;
      const auto robot = static_cast<int>(&track - runs[r].tracks.data());
      all.push_back({&track, &runs[r], r, robot, *colour, std::move(name)});
    }
  }
  return all;
}

void add_cross(Drawing& page, const Vec2& place) {
  for (const double side : {-1.0, 1.0}) {
    page.add_line({place + Vec2(-4.5, -4.5 * side), place + Vec2(4.5, 4.5 * side)}, kRed, 2.2);
  }
}

void add_diamond(Drawing& page, const Vec2& place) {
  page.add_area({place + Vec2(-6, 0), place + Vec2(0, -6), place + Vec2(6, 0), place + Vec2(0, 6)},
                kGreen);
}

sim::SceneSnapshot scene_of(const std::vector<RunData>& runs, const std::vector<std::size_t>& group,
                            const std::vector<Series>& all) {
  sim::SceneSnapshot scene;
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high = -low;
  for (const std::size_t r : group) {
    const RunData& run = runs[r];
    const auto first = static_cast<int>(scene.robots.size());
    for (const Series& series : all) {
      if (series.run != r) continue;
      sim::RobotSnapshot robot;
      robot.name = series.name;
      robot.colour = series.colour;
      robot.X_WB = series.track->X_WB.back();
      const sim::RobotModel& model = model_of(run, series.track->robot);
      robot.footprint = model.footprint;
      robot.parts = model.parts;
      for (const sim::Superstructure& part : model.superstructures) {
        robot.superstructures.push_back(part.outline);
      }
      for (const sim::Pose& X_WB : series.track->X_WB) {
        robot.trail.push_back(X_WB.position());
        low = low.cwiseMin(X_WB.position());
        high = high.cwiseMax(X_WB.position());
      }
      scene.robots.push_back(std::move(robot));
    }
    for (sim::CollisionMark mark : run.collisions) {
      mark.robot += first;
      scene.collisions.push_back(mark);
    }
    for (sim::GoalMark mark : run.goals) {
      mark.robot += first;
      scene.goals.push_back(mark);
    }
  }
  if (const auto& world = runs[group.front()].world) {
    scene.arena = world->arena;
  } else {
    const double room_m = 0.1 * std::max((high - low).maxCoeff(), 1.0);
    scene.arena.origin = low - Vec2::Constant(room_m);
    scene.arena.size = high - low + Vec2::Constant(2.0 * room_m);
    scene.arena.border = false;
  }
  return scene;
}

void draw_legend(Drawing& page, const std::vector<Series>& all) {
  constexpr double kFirstY = 52.0;
  constexpr double kLineHeight = 18.0;
  constexpr double kEnd = kPageWidth - 110.0;  // there must be room for how many more there are
  double x = kLeft;
  double y = kFirstY;
  std::size_t named = 0;
  for (; named < std::min(all.size(), kMostEntries); ++named) {
    const Series& series = all[named];
    const double width = 38.0 + Drawing::text_width_px(series.name, kText);
    if (x + width > kEnd && x > kLeft) {
      if (y > kFirstY) break;
      x = kLeft;
      y += kLineHeight;
    }
    page.add_line({{x, y - 4.0}, {x + 30.0, y - 4.0}}, series.colour, 3.0, series.run > 0);
    page.add_text(series.name, {x + 38.0, y}, kText, kInk);
    x += width + 26.0;
  }
  if (all.size() > named) {
    page.add_text("and " + std::to_string(all.size() - named) + " more", {x, y}, kText, kFaintInk);
  }
}

PlacedScene draw_scene(Drawing& page, const sim::SceneSnapshot& scene, const std::string& title,
                       bool with_names, const Vec2& corner, double side) {
  sim::render::RenderOptions options;
  options.size_px = static_cast<int>(side);
  options.legend = false;
  options.names = with_names;
  sim::render::Image image = sim::render::draw_scene(scene, options);
  const double left = corner.x() + 0.5 * (side - image.width);
  const double key = corner.y() + image.height + 24.0;
  page.add_text(title, {left + 4.0, corner.y() - 9.0}, kText, kInk);
  PlacedScene placed{{left, corner.y()}, Vec2(image.width, image.height), options};
  page.add_picture(std::move(image), placed.corner);
  double x = left + 11.0;
  if (!scene.collisions.empty()) {
    add_cross(page, {x, key - 4.5});
    const std::string text = std::to_string(scene.collisions.size()) +
                             (scene.collisions.size() == 1 ? " collision" : " collisions");
    page.add_text(text, {x + 14.0, key}, kText, kInk);
    x += 14.0 + Drawing::text_width_px(text, kText) + 26.0;
  }
  if (!scene.goals.empty()) {
    const auto reached = std::count_if(scene.goals.begin(), scene.goals.end(),
                                       [](const sim::GoalMark& goal) { return goal.reached; });
    if (reached > 0) add_diamond(page, {x, key - 4.5});
    page.add_text(std::to_string(reached) + " of " + std::to_string(scene.goals.size()) +
                      (scene.goals.size() == 1 ? " goal reached" : " goals reached"),
                  {x + (reached > 0 ? 14.0 : 0.0), key}, kText, kInk);
  }
  return placed;
}

void write_page(const Drawing& page, const std::string& file, const char* what) {
  if (!file.ends_with(".svg")) {
    sim::render::write_png(page.image(), file);
  } else if (const int error = sim::replace_file(file, page.svg())) {
    throw std::runtime_error(file + ": cannot write the " + what + ": " + std::strerror(error));
  }
}

}  // namespace playpen
