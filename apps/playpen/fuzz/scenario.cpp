// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/scenario.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "fuzz/choice.h"
#include "fuzz/maps.h"
#include "grade/map_score.h"
#include "grade/task.h"
#include "sim/core/degrees.h"
#include "sim/core/error.h"
#include "sim/core/number_text.h"
#include "sim/simulation/simulation.h"
#include "sim/world/robot_model.h"

namespace playpen::fuzz {
namespace {

using nlohmann::ordered_json;
using Shape = Element::Shape;
using Fault = DeviceFault::Kind;

// The words of the section "fuzz", and how often each is taken.
struct ShapeWord {
  const char* word;
  Shape shape;
  int weight;
};
constexpr ShapeWord kShapes[] = {{"box", Shape::kBox, 6},
                                 {"circle", Shape::kCircle, 6},
                                 {"triangle", Shape::kTriangle, 3},
                                 {"door", Shape::kDoor, 3},
                                 {"corridor", Shape::kCorridor, 2}};
constexpr std::pair<const char*, bool Freedom::*> kChanges[] = {
    {"starts", &Freedom::starts}, {"obstacles", &Freedom::obstacles}, {"moving", &Freedom::moving},
    {"maps", &Freedom::maps},     {"blocks", &Freedom::blocks},       {"noise", &Freedom::noise}};

constexpr double kBody_m = 0.05;     // thickness of the walls of doors and corridors
constexpr double kOpenShare = 0.75;  // of the floor, for generated maps; the SyRoTek arena has less
constexpr double kDefaultWidth[] = {1.6, 5.0};  // of passages, in radii of the robot
// Sensors whose readings programs use.
constexpr const char* kRangers[] = {"laser", "sonar", "infrared"};
constexpr const char* kLocators[] = {"odometry", "pose"};

bool contains(const auto& list, const std::string& word) {
  return std::ranges::find(list, word) != std::end(list);
}

double radius_of(const sim::RobotModel& model) {
  double radius_m = 0.0;
  for (const sim::Polygon& part : sim::body_parts(model)) {
    for (const sim::Vec2& p_B : part) radius_m = std::max(radius_m, p_B.norm());
  }
  return radius_m;
}

// The list at a place of a file as text; "": there is none.
std::string list_at(const ordered_json& root, const char* pointer) {
  const ordered_json::json_pointer place(pointer);
  return root.contains(place) ? root[place].dump() : "";
}
ordered_json list_of(const std::string& text) {
  return text.empty() ? ordered_json::array() : ordered_json::parse(text);
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
  const sim::DistanceField room =
      sim::distance_field(grade::make_truth(world().arena), kFarthestRoom_m);
  own_room_m_ = std::min(room_at(room, found->pose.position()), robot_radius_m_ + kStartRoom_m);
  read_bounds();
  const ordered_json root = ordered_json::parse(json_.text, nullptr, true, true);
  obstacles_ = list_at(root, "/arena/obstacles");
  timers_ = list_at(root, "/controller/timers");
  const std::string pointer = "/robots/" + std::to_string(robot_);
  const bool is_in_file = root.contains(ordered_json::json_pointer(pointer));
  find_devices(*found, is_in_file ? pointer : "");
  if (laser_.empty() || !root.contains(ordered_json::json_pointer(laser_))) laser_.clear();
  for (const sim::ObstacleDescription& obstacle : world().arena.obstacles) {
    const bool is_block = obstacle.type == sim::ObstacleType::kDynamic;
    if (freedom_.blocks && is_block) blocks_.push_back(obstacle.name);
  }
  freedom_.maps = freedom_.maps && is_open(room);
}

// Takes the section "fuzz" of the world and of the task into account.
void Base::read_bounds() {
  bounds_ = world().fuzz;
  if (!freedom_.task_file.empty()) grade::read_fuzz(freedom_.task_file, bounds_);
  for (const auto& [word, member] : kChanges) {
    if (contains(bounds_.without, word)) freedom_.*member = false;
  }
  if (!freedom_.faults) freedom_.faults = contains(bounds_.with, "faults");
  for (const ShapeWord& one : kShapes) {
    if (!contains(bounds_.obstacles.shapes, one.word)) continue;
    shapes_.insert(shapes_.end(), static_cast<std::size_t>(one.weight), one.shape);
  }
  const sim::ArenaDescription& arena = world().arena;
  low_ = arena.origin;
  high_ = arena.origin + arena.size;
  if (!bounds_.area) return;
  low_ = low_.cwiseMax(bounds_.area->center - 0.5 * bounds_.area->size);
  high_ = high_.cwiseMin(bounds_.area->center + 0.5 * bounds_.area->size);
  if ((high_ - low_).minCoeff() < 2.0 * robot_radius_m_) {
    throw std::invalid_argument(
        "the \"area\" of the section \"fuzz\" has no place for the robot on the floor of the "
        "world");
  }
}

// Finds the faults that the devices of a robot may have, and where its settings are in the file.
void Base::find_devices(const sim::RobotDescription& robot, const std::string& pointer) {
  const auto add = [this](const char* word, Fault kind, const std::string& device) {
    if (contains(bounds_.faults.kinds, word)) faults_.push_back({.kind = kind, .device = device});
  };
  for (const sim::DeviceDescription& device : robot.devices) {
    const bool is_ranger = contains(kRangers, device.type);
    const bool is_locator = contains(kLocators, device.type);
    if (is_ranger || is_locator) {
      add("dead", Fault::kDead, device.name);
      add("gap", Fault::kGap, device.name);
    }
    if (is_ranger) add("blind", Fault::kBlind, device.name);
    if (is_locator) add("jump", Fault::kJump, device.name);
    if (pointer.empty()) continue;
    if (device.type == "odometry") {
      odometry_ = pointer + "/devices/" + device.name;
      add("drift", Fault::kDrift, device.name);
    }
    if (device.type == "laser" && freedom_.noise) laser_ = pointer + "/devices/" + device.name;
  }
}

// Whether there is enough free floor for a generated map.
bool Base::is_open(const sim::DistanceField& room) const {
  constexpr double kStep_m = 0.1;
  int places = 0;
  int open = 0;
  for (double x_m = low_.x() + 0.5 * kStep_m; x_m < high_.x(); x_m += kStep_m) {
    for (double y_m = low_.y() + 0.5 * kStep_m; y_m < high_.y(); y_m += kStep_m) {
      ++places;
      if (room_at(room, {x_m, y_m}) > robot_radius_m_) ++open;
    }
  }
  return open > kOpenShare * places;
}

std::optional<Base::World> Base::world_of(const Scenario& scenario) const {
  grade::WorldPatch patch;
  patch.robot = robot_;
  patch.start = scenario.start;
  patch.extended = scenario.extended;
  const auto set = [&patch](const std::string& pointer, std::string value) {
    patch.values.push_back({pointer, std::move(value)});
  };
  set("/simulation/seed", std::to_string(scenario.seed));
  if (scenario.real) set("/simulation/realism", "\"real\"");
  if (scenario.latency_s > 0.0) set(laser_ + "/latency", sim::shortest_text(scenario.latency_s));
  if (scenario.dropouts > 0.0) set(laser_ + "/dropouts", sim::shortest_text(scenario.dropouts));
  if (!scenario.elements.empty()) {
    ordered_json list = list_of(obstacles_);
    for (std::size_t i = 0; i < scenario.elements.size(); ++i) {
      add_element(list, scenario.elements[i], "found" + std::to_string(i + 1));
    }
    set("/arena/obstacles", list.dump());
  }
  ordered_json timers = list_of(timers_);
  const std::size_t own_timers = timers.size();
  for (std::size_t i = 0; i < scenario.faults.size(); ++i) {
    const DeviceFault& fault = scenario.faults[i];
    add_timers(timers, fault, robot_description().name, "fault" + std::to_string(i + 1));
    if (fault.kind == Fault::kDrift) set(odometry_ + "/scale", sim::shortest_text(fault.scale));
  }
  if (timers.size() > own_timers) set("/controller/timers", timers.dump());
  World made;
  try {
    made.text = grade::patched_world(json_.text, world(), patch);
    made.description = sim::load_world_text(made.text);
  } catch (const sim::ConfigError&) {
    return std::nullopt;
  }
  made.room = sim::distance_field(grade::make_truth(made.description.arena), kFarthestRoom_m);
  const double needed_m = scenario.start ? robot_radius_m_ + kStartRoom_m : own_room_m_;
  const bool has_room = room_at(made.room, start_of(scenario)) >= needed_m;
  return has_room ? std::optional(std::move(made)) : std::nullopt;
}

bool Base::allows_element(const Element& element) const {
  if (element.of_map) return true;
  const auto is_inside = [](double value, const sim::Vec2& range) {
    return value > range.x() - 1e-9 && value < range.y() + 1e-9;
  };
  if (!(element.moves ? freedom_.moving : freedom_.obstacles)) return false;
  if (!element.moves && std::ranges::find(shapes_, element.shape) == shapes_.end()) return false;
  if (!element.has_opening()) {
    return is_inside(element.size.x(), bounds_.obstacles.size_m) &&
           is_inside(element.size.y(), bounds_.obstacles.size_m);
  }
  const bool is_door = element.shape == Shape::kDoor;
  const auto& width_m = is_door ? bounds_.doors.width_m : bounds_.corridors.width_m;
  return !width_m || is_inside(element.opening_m, *width_m);
}

bool Base::allows(const Scenario& scenario) const {
  const auto is_in_area = [this](const sim::Vec2& place) {
    return !bounds_.area ||
           ((place - low_).minCoeff() > -1e-9 && (high_ - place).minCoeff() > -1e-9);
  };
  if (scenario.start && !is_in_area(scenario.start->position())) return false;
  return std::ranges::all_of(scenario.elements, [&](const Element& element) {
    return allows_element(element) && is_in_area(element.center) &&
           (!element.moves || is_in_area(element.goes_to));
  });
}

double room_at(const sim::DistanceField& room, const sim::Vec2& place) {
  const sim::Vec2 p = place - room.origin;
  const auto column = static_cast<int>(std::floor(p.x() / room.cell_size_m));
  const int row = room.height - 1 - static_cast<int>(std::floor(p.y() / room.cell_size_m));
  const bool is_inside = column >= 0 && row >= 0 && column < room.width && row < room.height;
  return is_inside ? static_cast<double>(room.at(column, row)) : 0.0;
}

// --- Random parts

sim::Vec2 Base::random_place(sim::RandomStream& random, double margin_m) const {
  const auto along = [&](int axis) {
    const double low = low_[axis] + margin_m;
    return centimetres(between(random, low, std::max(high_[axis] - margin_m, low)));
  };
  const double x_m = along(0);
  return {x_m, along(1)};
}

sim::Vec2 Base::within_area(const sim::Vec2& place) const {
  const sim::Vec2 inside = place.cwiseMax(low_).cwiseMin(high_);
  return {centimetres(inside.x()), centimetres(inside.y())};
}

grade::StartPose Base::random_start(sim::RandomStream& random) const {
  const sim::Vec2 place = random_place(random, robot_radius_m_ + 0.05);
  return {place.x(), place.y(), static_cast<int>(15 * index_below(random, 24)) - 180};
}

sim::Vec2 Base::start_of(const Scenario& scenario) const {
  return scenario.start ? scenario.start->position() : robot_description().pose.position();
}

sim::Vec2 Base::widths(const std::optional<sim::Vec2>& width_m) const {
  return width_m.value_or(
      sim::Vec2(kDefaultWidth[0] * robot_radius_m_, kDefaultWidth[1] * robot_radius_m_));
}

double Base::random_width(const std::optional<sim::Vec2>& width_m,
                          sim::RandomStream& random) const {
  const sim::Vec2 range_m = widths(width_m);
  return centimetres(between(random, range_m.x(), range_m.y()));
}

Shape Base::random_shape(bool moves, sim::RandomStream& random) const {
  std::vector<Shape> shapes = shapes_;
  if (moves) {
    std::erase_if(shapes, [](Shape s) { return s == Shape::kDoor || s == Shape::kCorridor; });
    if (shapes.empty()) return Shape::kCircle;
  }
  return shapes[index_below(random, shapes.size())];
}

Element Base::random_element(const Scenario& scenario, sim::RandomStream& random) const {
  const sim::Vec2 size_m = bounds_.obstacles.size_m;
  const auto size = [&] { return centimetres(scale_between(random, size_m.x(), size_m.y())); };
  Element element;
  constexpr int kTries = 20;
  for (int i = 0; i < kTries; ++i) {
    element = {};
    element.moves = freedom_.moving && (!freedom_.obstacles || chance(random, 0.15));
    element.shape = random_shape(element.moves, random);
    element.center = random_place(random, 0.02);
    element.yaw_deg = static_cast<int>(5 * index_below(random, 36));
    element.size = {size(), size()};
    if (element.shape == Shape::kCircle) element.size.y() = element.size.x();
    if (element.shape == Shape::kDoor) {
      element.opening_m = random_width(bounds_.doors.width_m, random);
      const double walls_m = scale_between(random, 0.2, 1.6);
      element.size = {centimetres(element.opening_m + walls_m), kBody_m};
    } else if (element.shape == Shape::kCorridor) {
      element.opening_m = random_width(bounds_.corridors.width_m, random);
      element.size = {centimetres(scale_between(random, 0.3, 1.5)), kBody_m};
    }
    if (element.moves) {
      element.goes_to = random_place(random, 0.1);
      const sim::Vec2 speed_mps = bounds_.moving.speed_mps;
      element.speed_mps = centimetres(between(random, speed_mps.x(), speed_mps.y()));
    }
    const double room_m = element.radius_m() + robot_radius_m_ + kStartRoom_m;
    if ((element.center - start_of(scenario)).norm() > room_m) break;
  }
  return element;
}

std::vector<Element> Base::random_map(const Scenario& scenario, sim::RandomStream& random) const {
  MapPlan plan;
  plan.low = low_;
  plan.high = high_;
  plan.away_m = robot_radius_m_ + kStartRoom_m + 0.03;
  for (const sim::RobotDescription& robot : world().robots) {
    if (robot.name != robot_description().name) plan.places.push_back(robot.pose.position());
  }
  plan.places.push_back(start_of(scenario));
  const std::vector<std::string>& kinds = bounds_.maps.kinds;
  // Corridors that are too narrow for the robot are of no interest in a whole maze of them.
  const double least_m = 2.5 * robot_radius_m_;
  if (kinds[index_below(random, kinds.size())] == "maze") {
    plan.width_m = bounds_.corridors.width_m.value_or(sim::Vec2(least_m, 6.0 * robot_radius_m_));
    return maze_walls(plan, random);
  }
  plan.width_m = bounds_.doors.width_m.value_or(sim::Vec2(least_m, 5.0 * robot_radius_m_));
  plan.least_room_m = std::max(6.0 * robot_radius_m_, plan.width_m.x() + 0.1);
  return room_walls(plan, random);
}

DeviceFault Base::random_fault(sim::RandomStream& random) const {
  DeviceFault fault = faults_[index_below(random, faults_.size())];
  const sim::Vec2 at_s = bounds_.faults.at_s;
  const auto whole_tenths = [](double value) { return std::round(10.0 * value) / 10.0; };
  fault.at_s = whole_tenths(between(random, at_s.x(), at_s.y()));
  if (fault.kind == Fault::kGap) fault.for_s = whole_tenths(scale_between(random, 0.2, 5.0));
  if (fault.kind == Fault::kJump) {
    fault.x_m = centimetres(between(random, -0.5, 0.5));
    fault.yaw_deg = static_cast<int>(5 * index_below(random, 37)) - 90;
  }
  if (fault.kind == Fault::kDrift) fault.scale = centimetres(between(random, 0.8, 1.2));
  return fault;
}

void Base::add_noise(Scenario& scenario, sim::RandomStream& random) const {
  scenario.real = freedom_.noise && bounds_.noise.real && chance(random, 0.2);
  if (!has_laser_settings()) return;
  const auto part = [&random](const sim::Vec2& range) {
    return centimetres(between(random, range.x(), range.y()));
  };
  if (chance(random, 0.15)) scenario.latency_s = part(bounds_.noise.latency_s);
  if (chance(random, 0.1)) scenario.dropouts = part(bounds_.noise.dropouts);
}

// --- Scenarios

Scenario Base::random(sim::RandomStream& random) const {
  Scenario scenario;
  scenario.seed = 1 + index_below(random, 1000);
  if (freedom_.starts && chance(random, 0.6)) scenario.start = random_start(random);
  const auto most = static_cast<std::size_t>(bounds_.obstacles.most);
  const bool may_add = freedom_.obstacles || freedom_.moving;
  const std::size_t count = may_add ? index_below(random, std::min<std::size_t>(most, 4) + 1) : 0;
  for (std::size_t i = 0; i < count; ++i) {
    scenario.elements.push_back(random_element(scenario, random));
  }
  if (freedom_.maps && chance(random, 0.2)) {
    const std::vector<Element> walls = random_map(scenario, random);
    scenario.elements.insert(scenario.elements.begin(), walls.begin(), walls.end());
  }
  if (!blocks_.empty() && chance(random, 0.4)) {
    scenario.extended.emplace();
    for (const std::string& block : blocks_) {
      if (chance(random, 0.4)) scenario.extended->insert(block);
    }
  }
  add_noise(scenario, random);
  if (*freedom_.faults && !faults_.empty()) {
    const auto faults = static_cast<std::size_t>(bounds_.faults.most);
    const std::size_t number = index_below(random, faults + 1);
    for (std::size_t i = 0; i < number; ++i) scenario.faults.push_back(random_fault(random));
  }
  return scenario;
}

// Moves and turns an element, or changes its size.
void Base::change_element(Element& element, sim::RandomStream& random) const {
  if (!element.of_map && chance(random, 0.25)) {
    const double factor = scale_between(random, 0.5, 2.0);
    if (element.has_opening()) {
      const bool is_door = element.shape == Shape::kDoor;
      const sim::Vec2 range_m = widths(is_door ? bounds_.doors.width_m : bounds_.corridors.width_m);
      const double before_m = element.opening_m;
      element.opening_m = centimetres(std::clamp(factor * before_m, range_m.x(), range_m.y()));
      if (is_door) element.size.x() += element.opening_m - before_m;
    } else {
      const sim::Vec2 range_m = bounds_.obstacles.size_m;
      element.size.x() =
          centimetres(std::clamp(factor * element.size.x(), range_m.x(), range_m.y()));
      if (element.shape == Shape::kCircle) element.size.y() = element.size.x();
    }
    return;
  }
  element.center =
      within_area(element.center + sim::Vec2(random.gaussian(0.15), random.gaussian(0.15)));
  if (element.of_map) return;
  element.yaw_deg = (element.yaw_deg + static_cast<int>(5 * index_below(random, 36))) % 180;
  if (element.moves && chance(random, 0.5)) element.goes_to = random_place(random, 0.1);
}

void Base::change_start(Scenario& scenario, sim::RandomStream& random) const {
  const sim::Pose& own = robot_description().pose;
  grade::StartPose start = scenario.start.value_or(grade::StartPose{
      own.x_m, own.y_m, static_cast<int>(std::lround(own.yaw_rad / sim::kDegrees))});
  const sim::Vec2 place =
      within_area(start.position() + sim::Vec2(random.gaussian(0.15), random.gaussian(0.15)));
  start.x_m = place.x();
  start.y_m = place.y();
  start.yaw_deg += static_cast<int>(15 * index_below(random, 7)) - 45;
  scenario.start = start;
}

void Base::change_fault(Scenario& scenario, sim::RandomStream& random) const {
  const std::size_t count = scenario.faults.size();
  const bool is_full = count >= static_cast<std::size_t>(bounds_.faults.most);
  if (!is_full && chance(random, 0.5)) {
    scenario.faults.push_back(random_fault(random));
  } else if (count > 0) {
    scenario.faults[index_below(random, count)] = random_fault(random);
  }
}

Scenario Base::mutated(Scenario scenario, sim::RandomStream& random) const {
  const std::size_t changes = 1 + index_below(random, 3);
  const auto is_thing = [](const Element& element) { return !element.of_map; };
  for (std::size_t i = 0; i < changes; ++i) {
    const double kind = random.uniform();
    std::vector<Element>& elements = scenario.elements;
    const bool has_elements = !elements.empty();
    const bool may_add = freedom_.obstacles || freedom_.moving;
    const auto most = static_cast<std::ptrdiff_t>(bounds_.obstacles.most);
    if (kind < 0.25 && may_add && std::ranges::count_if(elements, is_thing) < most) {
      elements.push_back(random_element(scenario, random));
    } else if (kind < 0.35 && has_elements) {
      const std::size_t at = index_below(random, elements.size());
      elements.erase(elements.begin() + static_cast<std::ptrdiff_t>(at));
    } else if (kind < 0.7 && has_elements) {
      change_element(elements[index_below(random, elements.size())], random);
    } else if (kind < 0.82 && freedom_.starts) {
      change_start(scenario, random);
    } else if (kind < 0.86 && freedom_.maps) {
      std::erase_if(elements, [](const Element& element) { return element.of_map; });
      const std::vector<Element> walls = random_map(scenario, random);
      elements.insert(elements.begin(), walls.begin(), walls.end());
    } else if (kind < 0.92 && !blocks_.empty()) {
      if (!scenario.extended) scenario.extended.emplace();
      const std::string& block = blocks_[index_below(random, blocks_.size())];
      if (scenario.extended->erase(block) == 0) scenario.extended->insert(block);
    } else if (kind < 0.97 && *freedom_.faults && !faults_.empty()) {
      change_fault(scenario, random);
    } else {
      scenario.seed = 1 + index_below(random, 1000);
    }
  }
  return scenario;
}

}  // namespace playpen::fuzz
