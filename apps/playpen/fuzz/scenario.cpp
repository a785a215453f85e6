// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/scenario.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "grade/map_score.h"
#include "sim/core/degrees.h"
#include "sim/core/error.h"
#include "sim/core/math.h"
#include "sim/core/number_text.h"
#include "sim/simulation/simulation.h"
#include "sim/world/robot_model.h"

namespace playpen::fuzz {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMostElements = 8;

double rounded(double value, double unit) { return std::round(value / unit) * unit; }
double centimetres(double value) { return std::round(value * 100.0) / 100.0; }

double between(sim::RandomStream& random, double low, double high) {
  return low + (high - low) * random.uniform();
}
std::size_t index_below(sim::RandomStream& random, std::size_t count) {
  return std::min(static_cast<std::size_t>(random.uniform() * static_cast<double>(count)),
                  count - 1);
}
bool chance(sim::RandomStream& random, double probability) {
  return random.uniform() < probability;
}

ordered_json number(double value) { return centimetres(value); }
ordered_json point(const sim::Vec2& p) { return {number(p.x()), number(p.y())}; }

ordered_json box_json(const std::string& name, const sim::Vec2& center, const sim::Vec2& size,
                      int yaw_deg) {
  ordered_json box = {{"name", name}, {"center", point(center)}, {"size", point(size)}};
  if (yaw_deg != 0) box["yaw_deg"] = yaw_deg;
  return box;
}

// A door is two boxes.
void add_door(ordered_json& list, const Element& door, const std::string& name) {
  const double part_m = std::max(0.5 * (door.size.x() - door.opening_m), 0.02);
  const double yaw_rad = door.yaw_deg * sim::kDegrees;
  const sim::Vec2 along(sim::math::cos(yaw_rad), sim::math::sin(yaw_rad));
  for (const int side : {-1, 1}) {
    const sim::Vec2 center = door.center + side * 0.5 * (door.opening_m + part_m) * along;
    list.push_back(
        box_json(name + (side < 0 ? "a" : "b"), center, {part_m, door.size.y()}, door.yaw_deg));
  }
}

void add_element(ordered_json& list, const Element& element, const std::string& name) {
  if (element.shape == Element::Shape::kDoor) return add_door(list, element, name);
  ordered_json one = box_json(name, element.center, element.size, element.yaw_deg);
  if (element.shape == Element::Shape::kCircle) {
    one.erase("size");
    one.erase("yaw_deg");
    one["shape"] = "circle";
    one["radius"] = centimetres(0.5 * element.size.x());
  }
  if (element.shape == Element::Shape::kTriangle) {
    one.erase("size");
    const double w = 0.5 * element.size.x();
    const double h = 0.5 * element.size.y();
    one["shape"] = "polygon";
    one["outline"] = {{-w, -h}, {w, -h}, {0.0, h}};
  }
  if (element.moves) {
    one["motion"] = {{"type", "path"},
                     {"speed", number(element.speed_mps)},
                     {"repeat", "back_and_forth"},
                     {"points", ordered_json::array({point(element.goes_to)})}};
  }
  list.push_back(std::move(one));
}

double radius_of(const sim::RobotModel& model) {
  double radius_m = 0.0;
  for (const sim::Polygon& part : sim::body_parts(model)) {
    for (const sim::Vec2& p_B : part) radius_m = std::max(radius_m, p_B.norm());
  }
  return radius_m;
}

std::string place_text(const sim::Vec2& p) {
  return '(' + sim::shortest_text(centimetres(p.x())) + ", " +
         sim::shortest_text(centimetres(p.y())) + ')';
}

std::string text_of(const Element& element) {
  const auto length = [](double metres) { return sim::shortest_text(centimetres(metres)) + " m"; };
  std::string text;
  switch (element.shape) {
    case Element::Shape::kBox:
      text = "a box of " + length(element.size.x()) + " x " + length(element.size.y());
      break;
    case Element::Shape::kCircle:
      text = "a round obstacle of " + length(element.size.x());
      break;
    case Element::Shape::kTriangle:
      text = "a triangle of " + length(element.size.x()) + " x " + length(element.size.y());
      break;
    case Element::Shape::kDoor:
      text =
          "a wall of " + length(element.size.x()) + " with a door of " + length(element.opening_m);
      break;
  }
  text += " at " + place_text(element.center);
  if (element.moves) {
    text += " that moves to " + place_text(element.goes_to) + " and back at " +
            sim::shortest_text(centimetres(element.speed_mps)) + " m/s";
  }
  return text;
}

}  // namespace

Base::Base(const std::string& file, const std::string& robot, const Freedom& freedom)
    : freedom_(freedom), json_(grade::read_json_world(file, "playpen fuzz adds to it")) {
  const std::vector<sim::RobotDescription>& robots = world().robots;
  const auto found = robot.empty() ? robots.begin()
                                   : std::ranges::find(robots, robot, &sim::RobotDescription::name);
  if (found == robots.end()) {
    throw std::invalid_argument(robot.empty() ? "the world has no robot"
                                              : "the world has no robot '" + robot + "'");
  }
  robot_ = static_cast<std::size_t>(found - robots.begin());
  robot_radius_m_ = radius_of(*sim::find_robot_model(world(), found->model));
  const ordered_json root = ordered_json::parse(json_.text, nullptr, true, true);
  const ordered_json::json_pointer list("/arena/obstacles");
  if (root.contains(list)) obstacles_ = root[list].dump();
  for (const sim::DeviceDescription& device : found->devices) {
    const std::string pointer = "/robots/" + std::to_string(robot_) + "/devices/" + device.name;
    if (freedom_.noise && device.type == "laser" &&
        root.contains(ordered_json::json_pointer(pointer))) {
      laser_ = pointer;
    }
  }
  for (const sim::ObstacleDescription& obstacle : world().arena.obstacles) {
    const bool is_block = obstacle.type == sim::ObstacleType::kDynamic;
    if (freedom_.blocks && is_block) blocks_.push_back(obstacle.name);
  }
}

std::optional<Base::World> Base::world_of(const Scenario& scenario) const {
  grade::WorldPatch patch;
  patch.robot = robot_;
  patch.start = scenario.start;
  patch.extended = scenario.extended;
  patch.values.push_back({"/simulation/seed", std::to_string(scenario.seed)});
  if (scenario.real) patch.values.push_back({"/simulation/realism", "\"real\""});
  if (scenario.latency_s > 0.0) {
    patch.values.push_back({laser_ + "/latency", sim::shortest_text(scenario.latency_s)});
  }
  if (scenario.dropouts > 0.0) {
    patch.values.push_back({laser_ + "/dropouts", sim::shortest_text(scenario.dropouts)});
  }
  if (!scenario.elements.empty()) {
    ordered_json list =
        obstacles_.empty() ? ordered_json::array() : ordered_json::parse(obstacles_);
    for (std::size_t i = 0; i < scenario.elements.size(); ++i) {
      add_element(list, scenario.elements[i], "found" + std::to_string(i + 1));
    }
    patch.values.push_back({"/arena/obstacles", list.dump()});
  }
  World made;
  try {
    made.text = grade::patched_world(json_.text, world(), patch);
    made.description = sim::load_world_text(made.text);
  } catch (const sim::ConfigError&) {
    return std::nullopt;
  }
  made.room = sim::distance_field(grade::make_truth(made.description.arena), kFarthestRoom_m);
  const bool has_room = !scenario.start || room_at(made.room, scenario.start->position()) >=
                                               robot_radius_m_ + kStartRoom_m;
  return has_room ? std::optional(std::move(made)) : std::nullopt;
}

double room_at(const sim::DistanceField& room, const sim::Vec2& place) {
  const sim::Vec2 p = place - room.origin;
  const auto column = static_cast<int>(std::floor(p.x() / room.cell_size_m));
  const int row = room.height - 1 - static_cast<int>(std::floor(p.y() / room.cell_size_m));
  const bool is_inside = column >= 0 && row >= 0 && column < room.width && row < room.height;
  return is_inside ? static_cast<double>(room.at(column, row)) : 0.0;
}

sim::Vec2 Base::random_place(sim::RandomStream& random, double margin_m) const {
  const sim::ArenaDescription& arena = world().arena;
  const auto along = [&](int axis) {
    const double low = arena.origin[axis] + margin_m;
    const double high = std::max(arena.origin[axis] + arena.size[axis] - margin_m, low);
    return centimetres(between(random, low, high));
  };
  const double x_m = along(0);
  return {x_m, along(1)};
}

grade::StartPose Base::random_start(sim::RandomStream& random) const {
  const sim::Vec2 place = random_place(random, robot_radius_m_ + 0.05);
  return {place.x(), place.y(), static_cast<int>(15 * index_below(random, 24)) - 180};
}

sim::Vec2 Base::start_of(const Scenario& scenario) const {
  return scenario.start ? scenario.start->position() : robot_description().pose.position();
}

Element Base::random_element(const Scenario& scenario, sim::RandomStream& random) const {
  Element element;
  constexpr int kTries = 20;
  for (int i = 0; i < kTries; ++i) {
    element = {};
    const double kind = random.uniform();
    // Doors do not move.
    element.shape = !freedom_.obstacles
                        ? (kind < 0.5 ? Element::Shape::kBox : Element::Shape::kCircle)
                    : kind < 0.3  ? Element::Shape::kBox
                    : kind < 0.6  ? Element::Shape::kCircle
                    : kind < 0.75 ? Element::Shape::kTriangle
                                  : Element::Shape::kDoor;
    // Small things are as likely as large ones: sizes are uniform in their logarithm.
    const auto size = [&](double low, double high) {
      return centimetres(low * sim::math::pow(high / low, random.uniform()));
    };
    element.center = random_place(random, 0.02);
    element.yaw_deg = static_cast<int>(5 * index_below(random, 36));
    element.size = {size(0.03, 0.6), size(0.03, 0.4)};
    if (element.shape == Element::Shape::kCircle) element.size.y() = element.size.x();
    if (element.shape == Element::Shape::kDoor) {
      element.opening_m = centimetres(between(random, 1.6, 5.0) * robot_radius_m_);
      element.size = {centimetres(element.opening_m + size(0.2, 1.6)), 0.05};
    } else if (freedom_.moving && (!freedom_.obstacles || chance(random, 0.2))) {
      element.moves = true;
      element.goes_to = random_place(random, 0.1);
      element.speed_mps = centimetres(between(random, 0.05, 0.4));
    }
    const double room_m = element.radius_m() + robot_radius_m_ + kStartRoom_m;
    if ((element.center - start_of(scenario)).norm() > room_m) break;
  }
  return element;
}

Scenario Base::random(sim::RandomStream& random) const {
  Scenario scenario;
  scenario.seed = 1 + index_below(random, 1000);
  if (freedom_.starts && chance(random, 0.6)) scenario.start = random_start(random);
  const std::size_t count = freedom_.obstacles || freedom_.moving ? index_below(random, 5) : 0;
  for (std::size_t i = 0; i < count; ++i) {
    scenario.elements.push_back(random_element(scenario, random));
  }
  if (!blocks_.empty() && chance(random, 0.4)) {
    scenario.extended.emplace();
    for (const std::string& block : blocks_) {
      if (chance(random, 0.4)) scenario.extended->insert(block);
    }
  }
  scenario.real = freedom_.noise && chance(random, 0.2);
  if (has_laser_settings() && chance(random, 0.15)) {
    scenario.latency_s = centimetres(between(random, 0.05, 0.3));
  }
  if (has_laser_settings() && chance(random, 0.1)) {
    scenario.dropouts = centimetres(between(random, 0.01, 0.2));
  }
  return scenario;
}

Scenario Base::mutated(Scenario scenario, sim::RandomStream& random) const {
  const std::size_t changes = 1 + index_below(random, 3);
  for (std::size_t i = 0; i < changes; ++i) {
    const double kind = random.uniform();
    const bool has_elements = !scenario.elements.empty();
    const bool may_add = freedom_.obstacles || freedom_.moving;
    if (kind < 0.25 && may_add && scenario.elements.size() < kMostElements) {
      scenario.elements.push_back(random_element(scenario, random));
    } else if (kind < 0.35 && has_elements) {
      const std::size_t at = index_below(random, scenario.elements.size());
      scenario.elements.erase(scenario.elements.begin() + static_cast<std::ptrdiff_t>(at));
    } else if (kind < 0.7 && has_elements) {
      Element& element = scenario.elements[index_below(random, scenario.elements.size())];
      element.center += sim::Vec2(random.gaussian(0.15), random.gaussian(0.15));
      element.center = {centimetres(element.center.x()), centimetres(element.center.y())};
      element.yaw_deg = (element.yaw_deg + static_cast<int>(5 * index_below(random, 36))) % 180;
    } else if (kind < 0.85 && freedom_.starts) {
      grade::StartPose start = scenario.start.value_or(grade::StartPose{
          robot_description().pose.x_m, robot_description().pose.y_m,
          static_cast<int>(std::lround(robot_description().pose.yaw_rad / sim::kDegrees))});
      start.x_m = centimetres(start.x_m + random.gaussian(0.15));
      start.y_m = centimetres(start.y_m + random.gaussian(0.15));
      start.yaw_deg += static_cast<int>(15 * index_below(random, 7)) - 45;
      scenario.start = start;
    } else if (kind < 0.92 && !blocks_.empty()) {
      if (!scenario.extended) scenario.extended.emplace();
      const std::string& block = blocks_[index_below(random, blocks_.size())];
      if (scenario.extended->erase(block) == 0) scenario.extended->insert(block);
    } else {
      scenario.seed = 1 + index_below(random, 1000);
    }
  }
  return scenario;
}

std::vector<Scenario> simpler(const Scenario& scenario) {
  std::vector<Scenario> all;
  const auto add = [&](const auto& change) {
    Scenario one = scenario;
    change(one);
    all.push_back(std::move(one));
  };
  const std::size_t count = scenario.elements.size();
  if (count > 1) add([](Scenario& s) { s.elements.clear(); });
  for (std::size_t i = 0; i < count; ++i) {
    add([i](Scenario& s) {
      s.elements.erase(s.elements.begin() + static_cast<std::ptrdiff_t>(i));
    });
  }
  if (scenario.extended) add([](Scenario& s) { s.extended.reset(); });
  if (scenario.start) add([](Scenario& s) { s.start.reset(); });
  if (scenario.real) add([](Scenario& s) { s.real = false; });
  if (scenario.latency_s > 0.0) add([](Scenario& s) { s.latency_s = 0.0; });
  if (scenario.dropouts > 0.0) add([](Scenario& s) { s.dropouts = 0.0; });
  if (scenario.seed != 1) add([](Scenario& s) { s.seed = 1; });
  for (std::size_t i = 0; i < count; ++i) {
    const Element& element = scenario.elements[i];
    if (element.moves) add([i](Scenario& s) { s.elements[i].moves = false; });
    for (const double unit : {0.1, 0.05}) {
      const auto round_all = [unit](Element& e) {
        e.center = {rounded(e.center.x(), unit), rounded(e.center.y(), unit)};
        e.size = {std::max(rounded(e.size.x(), unit), unit),
                  std::max(rounded(e.size.y(), unit), unit)};
      };
      Element round = element;
      round_all(round);
      if (round.center != element.center || round.size != element.size) {
        add([&](Scenario& s) { s.elements[i] = round; });
      }
    }
    if (element.yaw_deg % 45 != 0) {
      add([i](Scenario& s) { s.elements[i].yaw_deg = 45 * ((s.elements[i].yaw_deg + 22) / 45); });
    }
  }
  if (scenario.start) {
    grade::StartPose round = *scenario.start;
    round.x_m = rounded(round.x_m, 0.1);
    round.y_m = rounded(round.y_m, 0.1);
    round.yaw_deg = 45 * static_cast<int>(std::lround(round.yaw_deg / 45.0));
    if (round.x_m != scenario.start->x_m || round.y_m != scenario.start->y_m ||
        round.yaw_deg != scenario.start->yaw_deg) {
      add([&](Scenario& s) { s.start = round; });
    }
  }
  return all;
}

std::size_t weight_of(const Scenario& scenario) {
  // Each digit behind the decimal point is a unit, each thing a thousand.
  const auto digits = [](double value) -> std::size_t {
    if (std::abs(value - rounded(value, 0.1)) < 1e-9) return 1;
    return std::abs(value - rounded(value, 0.05)) < 1e-9 ? 2 : 3;
  };
  std::size_t weight = 0;
  for (const Element& element : scenario.elements) {
    weight += 1000 + digits(element.center.x()) + digits(element.center.y()) +
              digits(element.size.x()) + digits(element.size.y()) +
              (element.yaw_deg % 45 == 0 ? 0 : 2) + (element.moves ? 500 : 0);
  }
  if (scenario.extended) weight += 300;
  if (scenario.start) {
    weight += 200 + digits(scenario.start->x_m) + digits(scenario.start->y_m) +
              (scenario.start->yaw_deg % 45 == 0 ? 0 : 2);
  }
  weight += scenario.real ? 100 : 0;
  weight += scenario.latency_s > 0.0 ? 100 : 0;
  weight += scenario.dropouts > 0.0 ? 100 : 0;
  return weight + (scenario.seed != 1 ? 50 : 0);
}

std::string description_of(const Scenario& scenario) {
  std::vector<std::string> parts;
  for (const Element& element : scenario.elements) parts.push_back(text_of(element));
  if (scenario.start) {
    parts.push_back("the start " + place_text(scenario.start->position()) + ", " +
                    std::to_string(scenario.start->yaw_deg) + " degrees");
  }
  if (scenario.extended) {
    std::string names;
    for (const std::string& name : *scenario.extended) names += (names.empty() ? "" : ", ") + name;
    parts.push_back(names.empty() ? "no raised block" : "raised blocks " + names);
  }
  if (scenario.real) parts.push_back("real noise");
  if (scenario.latency_s > 0.0) {
    parts.push_back("a laser that is late by " + sim::shortest_text(scenario.latency_s) + " s");
  }
  if (scenario.dropouts > 0.0) {
    parts.push_back("a laser that loses " + sim::shortest_text(100.0 * scenario.dropouts) +
                    " % of its beams");
  }
  if (scenario.seed != 1) parts.push_back("seed " + std::to_string(scenario.seed));
  if (parts.empty()) return "the world as it is";
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += i + 1 == parts.size() ? " and " : ", ";
    text += parts[i];
  }
  return text;
}

}  // namespace playpen::fuzz
