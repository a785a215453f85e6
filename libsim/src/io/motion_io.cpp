// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Formats of obstacles' motions.
#include <optional>

#include "io/obstacle_io.h"
#include "sim/io/field_reader.h"
#include "world/controller_fields.h"
#include "world/motion_fields.h"
#include "world/world_fields.h"

namespace sim::io {
namespace {

void read_motion(Reader& obstacle_reader, const Field& field, void* object) {
  std::optional<Reader> reader = obstacle_reader.object(field.name);
  if (!reader || !reader->require("type", "\"path\", \"random_walk\" or \"pedestrian\"")) return;
  auto& motion = static_cast<ObstacleDescription*>(object)->motion.emplace();
  read_typed(*reader, "type", motion_kinds(), &motion);
  reader->finish();
}

void read_friction(Reader& obstacle_reader, const Field& field, void* object) {
  read_as_usual(obstacle_reader, field, object);
  const auto& obstacle = *static_cast<const ObstacleDescription*>(object);
  if (!obstacle_reader.has(field.name) || is_pushable(obstacle)) return;
  const bool moves = obstacle.motion.has_value();
  obstacle_reader.issue("world/conflicting-keys",
                        "\"friction\" only with \"mass\" and without \"motion\"",
                        moves ? "\"motion\", too" : "no \"mass\"",
                        moves ? "an obstacle with a motion has a drive, which overcomes friction"
                              : "obstacles with a mass can be pushed",
                        field.name);
}

void read_move(Reader& reader, const Field& /*field*/, void* object) {
  ObstacleMotion& motion = static_cast<MoveAction*>(object)->motion;
  motion.law = MotionLaw::kPath;
  read_fields(reader, drive_fields(), &motion);
  const bool has_to = reader.has("to");
  const bool has_path = reader.has("path");
  const bool has_yaw = reader.has("yaw_deg");
  if (reader.boolean("stop", false)) {
    motion.law = MotionLaw::kStand;
    if (has_to || has_path || has_yaw) {
      reader.issue("world/conflicting-keys", "either \"stop\" or a way to move", "both",
                   "leave one of them out", "stop");
    }
    return;
  }
  if (has_to && has_path) {
    reader.issue("world/conflicting-keys", "either \"to\" or \"path\"", "both",
                 "\"path\" is a list of places, \"to\" is one", "to");
  } else if (!has_to && !has_path && !has_yaw) {
    reader.issue("world/missing-key",
                 "\"to\", \"path\", \"yaw_deg\" or \"stop\": where the obstacle moves", "none");
  }
  if (has_to) motion.points.push_back(reader.vec2("to", {0.0, 0.0}, kPositionInWorld));
  if (has_path && !has_to) read_as_usual(reader, field_named(move_fields(), "path"), &motion);
  read_fields(reader, path_fields(), &motion);
  if (has_yaw) motion.final_yaw_rad = reader.angle_deg("yaw_deg", 0.0);
  if (has_yaw && motion.repeat != PathRepeat::kOnce) {
    reader.issue("world/conflicting-keys", "\"yaw_deg\" only for a path that ends",
                 "\"repeat\", too", "it turns to that angle at the end", "yaw_deg");
  }
}

}  // namespace

const CustomField kMotionFormat{.read = read_motion, .kind_key = "type", .kinds = motion_kinds};
const CustomField kFrictionFormat{.read = read_friction,
                                  .rules = R"("dependentRequired": {"friction": ["mass"]})"};
const CustomField kMoveFormat{.read = read_move,
                              .rules = R"("oneOf": [{"required": ["to"]}, {"required": ["path"]},
      {"required": ["yaw_deg"], "properties": {"to": false, "path": false}},
      {"required": ["stop"]}])",
                              .keys = move_fields};

}  // namespace sim::io
