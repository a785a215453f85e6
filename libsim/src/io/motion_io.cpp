// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/motion_io.h"

#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "io/document.h"
#include "io/obstacle_io.h"
#include "sim/world/limits.h"

namespace sim::io {
namespace {

constexpr std::size_t kMostPoints = 1000;

constexpr NumberRange kSpeed{0.0, kMaxObstacleSpeed_mps, true, "m/s"};
constexpr NumberRange kTurnRate_deg{0.0, kMaxObstacleTurnRate_radps * 180.0 / std::numbers::pi,
                                    true, "degrees/s"};
constexpr NumberRange kWait{0.0, kLongestArenaTime_s, false, "s"};
constexpr NumberRange kForce{0.0, 1000.0, false, "m^2/s^2"};
constexpr NumberRange kForceRange{kLeastLength_m, 100.0, false, "m"};
constexpr NumberRange kRelaxation{0.01, 100.0, false, "s"};
constexpr NumberRange kFriction{0.0, 10.0, false, ""};
constexpr NumberRange kMass{kLeastMass_kg, kGreatestMass_kg, false, "kg"};

void read_points(Reader& reader, std::string_view key, ObstacleMotion& motion) {
  for (Reader& point : reader.array(key, kMostPoints)) {
    motion.points.push_back(point.as_vec2({0.0, 0.0}, kPositionInWorld));
  }
  const std::optional<Reader> list = reader.child(key);
  if (!list || !list->is_array() || !motion.points.empty()) return;
  reader.issue("world/out-of-range", "at least one point [x, y]", "an empty list", "", key);
}

void read_needed_points(Reader& reader, ObstacleMotion& motion) {
  if (!reader.require("points", "a list of points [x, y] to go to, in m")) return;
  read_points(reader, "points", motion);
}

PathRepeat read_repeat(Reader& reader, PathRepeat fallback, bool random) {
  std::vector<std::string> words = {"once", "back_and_forth", "round"};
  if (random) words.emplace_back("random");
  const std::string word =
      reader.choice("repeat", words[static_cast<std::size_t>(fallback)], words);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == word) return static_cast<PathRepeat>(i);
  }
  return fallback;
}

// What all motions have.
void read_drive(Reader& reader, ObstacleMotion& motion) {
  motion.speed_mps = reader.number("speed", motion.speed_mps, kSpeed);
  motion.turn_rate_radps = reader.angle_deg("turn_rate_deg", motion.turn_rate_radps, kTurnRate_deg);
  motion.faces_way = reader.choice("facing", "fixed", {"fixed", "forward"}) == "forward";
}

void read_area(Reader& reader, ObstacleMotion& motion) {
  std::optional<Reader> area = reader.object("area");
  if (!area) return;
  if (area->require("center", "[x, y] of the middle of the area, in m")) {
    motion.area_center = area->vec2("center", motion.area_center, kPositionInWorld);
  }
  if (area->require("size", "[x, y]: the sides of the area, in m")) {
    motion.area_size = area->vec2("size", motion.area_size, kArenaLength);
  }
  area->finish();
}

void read_force(Reader& reader, SocialForce& force) {
  std::optional<Reader> object = reader.object("force");
  if (!object) return;
  force.relaxation_s = object->number("relaxation_time", force.relaxation_s, kRelaxation);
  force.repulsion_m2ps2 = object->number("repulsion", force.repulsion_m2ps2, kForce);
  force.repulsion_range_m = object->number("repulsion_range", force.repulsion_range_m, kForceRange);
  force.wall_repulsion_m2ps2 = object->number("wall_repulsion", force.wall_repulsion_m2ps2, kForce);
  force.wall_range_m = object->number("wall_range", force.wall_range_m, kForceRange);
  object->finish();
}

std::optional<ObstacleMotion> read_motion_of(Reader& reader) {
  ObstacleMotion motion;
  if (!reader.require("type", "\"path\", \"random_walk\" or \"pedestrian\"")) return std::nullopt;
  const std::string type = reader.choice("type", "path", {"path", "random_walk", "pedestrian"});
  // The mean desired speed of the paper.
  if (type == "pedestrian") motion.speed_mps = 1.34;
  read_drive(reader, motion);
  motion.wait_s = reader.number("wait", motion.wait_s, kWait);
  if (type == "random_walk") {
    motion.law = MotionLaw::kRandomWalk;
    motion.leg_m = reader.number("leg", motion.leg_m, kArenaLength);
    read_area(reader, motion);
    return motion;
  }
  const bool walks = type == "pedestrian";
  motion.law = walks ? MotionLaw::kPedestrian : MotionLaw::kPath;
  read_needed_points(reader, motion);
  motion.repeat = read_repeat(reader, PathRepeat::kOnce, walks);
  if (walks) read_force(reader, motion.force);
  return motion;
}

}  // namespace

void read_motion(Reader& obstacle, ObstacleDescription& into) {
  if (std::optional<Reader> reader = obstacle.object("motion")) {
    into.motion = read_motion_of(*reader);
    if (into.motion) reader->finish();
  }
  if (obstacle.has("mass")) into.mass_kg = obstacle.number("mass", 1.0, kMass);
  into.friction = obstacle.number("friction", into.friction, kFriction);
  if (obstacle.has("friction") && !is_pushable(into)) {
    obstacle.issue("world/conflicting-keys",
                   "\"friction\" only with \"mass\" and without \"motion\"",
                   into.motion ? "\"motion\", too" : "no \"mass\"",
                   into.motion ? "an obstacle with a motion has a drive, which overcomes friction"
                               : "obstacles with a mass can be pushed",
                   "friction");
  }
}

MoveAction read_move(Reader& reader) {
  MoveAction move;
  if (reader.require("obstacle", "the name of an obstacle")) {
    move.obstacle = reader.string("obstacle", "");
  }
  ObstacleMotion& motion = move.motion;
  motion.law = MotionLaw::kPath;
  read_drive(reader, motion);
  const bool has_to = reader.has("to");
  const bool has_path = reader.has("path");
  const bool has_yaw = reader.has("yaw_deg");
  if (reader.boolean("stop", false)) {
    motion.law = MotionLaw::kStand;
    if (has_to || has_path || has_yaw) {
      reader.issue("world/conflicting-keys", "either \"stop\" or a way to move", "both",
                   "leave one of them out", "stop");
    }
    return move;
  }
  if (has_to && has_path) {
    reader.issue("world/conflicting-keys", "either \"to\" or \"path\"", "both",
                 "\"path\" is a list of places, \"to\" is one", "to");
  } else if (!has_to && !has_path && !has_yaw) {
    reader.issue("world/missing-key",
                 "\"to\", \"path\", \"yaw_deg\" or \"stop\": where the obstacle moves", "none");
  }
  if (has_to) motion.points.push_back(reader.vec2("to", {0.0, 0.0}, kPositionInWorld));
  if (has_path && !has_to) read_points(reader, "path", motion);
  motion.repeat = read_repeat(reader, PathRepeat::kOnce, false);
  motion.wait_s = reader.number("wait", motion.wait_s, kWait);
  if (has_yaw) motion.final_yaw_rad = reader.angle_deg("yaw_deg", 0.0);
  if (has_yaw && motion.repeat != PathRepeat::kOnce) {
    reader.issue("world/conflicting-keys", "\"yaw_deg\" only for a path that ends",
                 "\"repeat\", too", "it turns to that angle at the end", "yaw_deg");
  }
  return move;
}

}  // namespace sim::io
