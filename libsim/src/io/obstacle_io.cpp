// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/obstacle_io.h"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "io/document.h"
#include "sim/io/field_reader.h"
#include "sim/world/outline.h"
#include "world/world_fields.h"

namespace sim::io {
namespace {

/// A shape, and the key of its dimensions.
struct ShapeKey {
  const char* shape;
  const char* key;
};
constexpr std::array<ShapeKey, 3> kShapeKeys{
    {{"box", "size"}, {"circle", "radius"}, {"polygon", "outline"}}};

/// The points of an outline; nullopt if they cannot be read.
std::optional<Polygon> read_outline(Reader& reader) {
  const Vec2 not_read = Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
  Polygon outline;
  for (Reader& vertex : reader.array("outline")) {
    outline.push_back(vertex.as_vec2(not_read, kPositionInWorld));
    if (!outline.back().allFinite()) return std::nullopt;
  }
  if (!reader.child("outline")->is_array()) return std::nullopt;
  return outline;
}

void read_shape(Reader& reader, const Field& /*field*/, void* object) {
  auto& block = *static_cast<ObstacleDescription*>(object);
  const std::string shape = reader.choice("shape", "box", {"box", "circle", "polygon"});
  const std::optional<Reader> given = reader.child("shape");
  const bool known = !given || given->scalar_text() == shape;
  for (const ShapeKey& other : kShapeKeys) {
    if (other.shape == shape || !reader.has(other.key) || !known) continue;
    reader.issue("world/conflicting-keys",
                 std::string("no ") + in_quotes(other.key) + " with \"shape\": " + in_quotes(shape),
                 "both", in_quotes(other.key) + " belongs to \"shape\": " + in_quotes(other.shape),
                 other.key);
  }
  if (!known) return;
  if (shape == "box") read_some(reader, block, {"size"});
  if (shape == "circle" && reader.require("radius", "the radius of the circle, in m")) {
    const Field& radius = field_named(fields_of<ObstacleDescription>(), "radius");
    make_circle(block, reader.number(radius.name, radius_m(block), radius.range));
  }
  if (shape == "polygon" &&
      reader.require("outline", "the outline: a list of points [x, y] round the obstacle, in m")) {
    if (std::optional<Polygon> outline = read_outline(reader)) {
      make_polygon(block, *std::move(outline));
    }
  }
}

void read_state(Reader& reader, const Field& field, void* object) {
  read_as_usual(reader, field, object);
  const auto& block = *static_cast<const ObstacleDescription*>(object);
  if (block.state != ObstacleState::kRetracted || block.type != ObstacleType::kStatic) return;
  reader.issue("world/static-obstacle", "\"extended\" (or no state) for a static obstacle",
               "\"retracted\"", "only an obstacle of type \"dynamic\" can be retracted",
               field.name);
}

void read_of_dynamic(Reader& reader, const Field& field, void* object) {
  read_as_usual(reader, field, object);
  const auto type = static_cast<const ObstacleDescription*>(object)->type;
  if (type == ObstacleType::kDynamic || !reader.has(field.name)) return;
  reader.issue("world/static-obstacle", "a dynamic obstacle",
               in_quotes(field.name) + " of a static one", "add \"type\": \"dynamic\"", field.name);
}

void read_bottom(Reader& reader, const Field& field, void* object) {
  read_as_usual(reader, field, object);
  const auto& block = *static_cast<const ObstacleDescription*>(object);
  if (block.bottom_m == 0.0) return;
  if (block.type == ObstacleType::kDynamic || is_movable(block) || block.portable) {
    reader.issue("world/bottom", "an obstacle that neither moves, nor rises, nor is carried",
                 "\"bottom\" of one that does", "leave it out", "bottom");
  } else if (block.bottom_m >= block.height_m) {
    reader.issue("world/bottom", "less than \"height\", " + number_text(block.height_m) + " m",
                 number_text(block.bottom_m) + " m", "", "bottom");
  }
}

}  // namespace

const CustomField kShapeFormat{.read = read_shape, .rules = R"("allOf": [
      {"if": {"properties": {"shape": {"const": "box"}}},
       "then": {"properties": {"radius": false, "outline": false}}},
      {"if": {"properties": {"shape": {"const": "circle"}}, "required": ["shape"]},
       "then": {"required": ["radius"], "properties": {"size": false, "outline": false}}},
      {"if": {"properties": {"shape": {"const": "polygon"}}, "required": ["shape"]},
       "then": {"required": ["outline"], "properties": {"size": false, "radius": false}}}])"};
const CustomField kStateFormat{read_state};
const CustomField kDynamicFormat{read_of_dynamic};
const CustomField kBottomFormat{read_bottom};

namespace {

constexpr const char* kSeparatorKeys[] = {"name", "center", "size", "yaw_deg", "height"};

}  // namespace

const CustomField kSeparatorsFormat{.only_keys = kSeparatorKeys};

std::string free_name(const std::string& prefix, std::size_t number, std::set<std::string>& taken) {
  for (;; ++number) {
    std::string name = prefix + std::to_string(number);
    if (taken.insert(name).second) return name;
  }
}

void read_blocks(Reader& arena, const char* key, const char* prefix, bool separators,
                 std::vector<ObstacleDescription>& blocks) {
  std::vector<std::size_t> unnamed;
  for (Reader& reader : arena.array(key, kMaxObstacles)) {
    ObstacleDescription block;
    if (reader.expect_object()) {
      if (separators) {
        for (const char* of_separator : kSeparatorKeys) read_some(reader, block, {of_separator});
      } else {
        read_fields(reader, fields_of<ObstacleDescription>(), &block);
      }
      reader.finish();
    }
    if (block.name.empty()) unnamed.push_back(blocks.size());
    blocks.push_back(std::move(block));
  }
  std::set<std::string> taken;
  for (const ObstacleDescription& block : blocks) taken.insert(block.name);
  std::size_t number = 0;
  for (const std::size_t i : unnamed) blocks[i].name = free_name(prefix, ++number, taken);
}

}  // namespace sim::io
