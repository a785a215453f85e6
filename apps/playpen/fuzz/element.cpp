// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/element.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "sim/core/degrees.h"
#include "sim/core/number_text.h"

namespace playpen::fuzz {
namespace {

using nlohmann::ordered_json;

ordered_json number(double value) { return centimetres(value); }
ordered_json point(const sim::Vec2& p) { return {number(p.x()), number(p.y())}; }

ordered_json box_json(const std::string& name, const sim::Vec2& center, const sim::Vec2& size,
                      int yaw_deg) {
  ordered_json box = {{"name", name}, {"center", point(center)}, {"size", point(size)}};
  if (yaw_deg != 0) box["yaw_deg"] = yaw_deg;
  return box;
}

// A door is two boxes one behind the other, a corridor two boxes side by side.
void add_two(ordered_json& list, const Element& element, const std::string& name) {
  const double yaw_rad = element.yaw_deg * sim::kDegrees;
  sim::Vec2 towards = sim::unit_vector(yaw_rad);
  sim::Vec2 size = element.size;
  double apart_m = element.opening_m;
  if (element.shape == Element::Shape::kDoor) {
    size.x() = std::max(0.5 * (element.size.x() - element.opening_m), 0.02);
    apart_m += size.x();
  } else {
    towards = sim::Vec2(-towards.y(), towards.x());
    apart_m += size.y();
  }
  for (const int side : {-1, 1}) {
    list.push_back(box_json(name + (side < 0 ? "a" : "b"),
                            element.center + side * 0.5 * apart_m * towards, size,
                            element.yaw_deg));
  }
}

std::string length_text(double metres) { return sim::shortest_text(centimetres(metres)) + " m"; }

std::string shape_text(const Element& element) {
  const std::string both = length_text(element.size.x()) + " x " + length_text(element.size.y());
  switch (element.shape) {
    case Element::Shape::kCircle:
      return "a round obstacle of " + length_text(element.size.x());
    case Element::Shape::kTriangle:
      return "a triangle of " + both;
    case Element::Shape::kDoor:
      return "a wall of " + length_text(element.size.x()) + " with a door of " +
             length_text(element.opening_m);
    case Element::Shape::kCorridor:
      return "a corridor of " + length_text(element.size.x()) + " that is " +
             length_text(element.opening_m) + " wide";
    case Element::Shape::kBox:
      break;
  }
  return (element.of_map ? "a wall of " : "a box of ") + both;
}

}  // namespace

void add_element(ordered_json& list, const Element& element, const std::string& name) {
  if (element.has_opening()) return add_two(list, element, name);
  ordered_json one = box_json(name, element.center, element.size, element.yaw_deg);
  if (element.shape == Element::Shape::kCircle) {
    one.erase("size");
    one.erase("yaw_deg");
    one["shape"] = "circle";
    one["radius"] = 0.5 * centimetres(element.size.x());
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

std::string place_text(const sim::Vec2& place) {
  return '(' + sim::shortest_text(centimetres(place.x())) + ", " +
         sim::shortest_text(centimetres(place.y())) + ')';
}

std::string text_of(const Element& element) {
  std::string text = shape_text(element) + " at " + place_text(element.center);
  if (element.moves) {
    text += " that moves to " + place_text(element.goes_to) + " and back at " +
            sim::shortest_text(centimetres(element.speed_mps)) + " m/s";
  }
  return text;
}

}  // namespace playpen::fuzz
