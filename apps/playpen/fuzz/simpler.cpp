// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Simpler scenarios, and what scenarios are in words.
#include <algorithm>
#include <cmath>

#include "fuzz/scenario.h"
#include "sim/core/number_text.h"

namespace playpen::fuzz {
namespace {

double rounded(double value, double unit) { return std::round(value / unit) * unit; }

using Scenarios = std::vector<Scenario>;

template <typename Change>
void add(Scenarios& all, const Scenario& scenario, const Change& change) {
  all.push_back(scenario);
  change(all.back());
}

// Without halves of the elements, quarters, ... and single ones.
void add_with_fewer_elements(Scenarios& all, const Scenario& scenario) {
  const std::size_t count = scenario.elements.size();
  for (std::size_t part = count; part > 0; part = part > 1 ? (part + 1) / 2 : 0) {
    for (std::size_t begin = 0; begin < count; begin += part) {
      add(all, scenario, [&](Scenario& s) {
        const auto first = s.elements.begin() + static_cast<std::ptrdiff_t>(begin);
        const std::size_t length = std::min(part, count - begin);
        s.elements.erase(first, first + static_cast<std::ptrdiff_t>(length));
      });
    }
  }
}

// An element with all lengths in multiples of a unit.
Element round_element(Element element, double unit) {
  const auto length = [unit](double value) { return std::max(rounded(value, unit), unit); };
  element.center = {rounded(element.center.x(), unit), rounded(element.center.y(), unit)};
  element.size = {length(element.size.x()), length(element.size.y())};
  if (element.has_opening()) element.opening_m = length(element.opening_m);
  if (element.moves) {
    element.goes_to = {rounded(element.goes_to.x(), unit), rounded(element.goes_to.y(), unit)};
  }
  return element;
}

void add_with_simpler_element(Scenarios& all, const Scenario& scenario, std::size_t i) {
  const Element& element = scenario.elements[i];
  if (element.moves) add(all, scenario, [i](Scenario& s) { s.elements[i].moves = false; });
  for (const double unit : {0.1, 0.05}) {
    add(all, scenario, [&](Scenario& s) { s.elements[i] = round_element(s.elements[i], unit); });
  }
  if (element.yaw_deg % 45 == 0) return;
  add(all, scenario,
      [i](Scenario& s) { s.elements[i].yaw_deg = 45 * ((s.elements[i].yaw_deg + 22) / 45); });
}

void add_with_simpler_fault(Scenarios& all, const Scenario& scenario, std::size_t i) {
  add(all, scenario,
      [i](Scenario& s) { s.faults.erase(s.faults.begin() + static_cast<std::ptrdiff_t>(i)); });
  add(all, scenario, [i](Scenario& s) {
    DeviceFault& fault = s.faults[i];
    fault.at_s = std::round(fault.at_s);
    fault.for_s = std::ceil(fault.for_s);
    fault.x_m = rounded(fault.x_m, 0.1);
    fault.yaw_deg = 45 * static_cast<int>(std::lround(fault.yaw_deg / 45.0));
    fault.scale = rounded(fault.scale, 0.1);
  });
}

}  // namespace

std::vector<Scenario> simpler(const Scenario& scenario) {
  Scenarios all;
  add_with_fewer_elements(all, scenario);
  const auto change = [&](const auto& how) { add(all, scenario, how); };
  if (scenario.extended) change([](Scenario& s) { s.extended.reset(); });
  if (scenario.start) change([](Scenario& s) { s.start.reset(); });
  if (scenario.real) change([](Scenario& s) { s.real = false; });
  if (scenario.latency_s > 0.0) change([](Scenario& s) { s.latency_s = 0.0; });
  if (scenario.dropouts > 0.0) change([](Scenario& s) { s.dropouts = 0.0; });
  if (scenario.seed != 1) change([](Scenario& s) { s.seed = 1; });
  for (std::size_t i = 0; i < scenario.faults.size(); ++i) {
    add_with_simpler_fault(all, scenario, i);
  }
  for (std::size_t i = 0; i < scenario.elements.size(); ++i) {
    add_with_simpler_element(all, scenario, i);
  }
  if (scenario.start) {
    change([](Scenario& s) {
      s.start->x_m = rounded(s.start->x_m, 0.1);
      s.start->y_m = rounded(s.start->y_m, 0.1);
      s.start->yaw_deg = 45 * static_cast<int>(std::lround(s.start->yaw_deg / 45.0));
    });
  }
  std::erase_if(all, [weight = weight_of(scenario)](const Scenario& one) {
    return weight_of(one) >= weight;
  });
  return all;
}

std::size_t weight_of(const Scenario& scenario) {
  // Each digit behind the decimal point is a unit, each thing a thousand.
  const auto digits = [](double value) -> std::size_t {
    if (std::abs(value - rounded(value, 0.1)) < 1e-9) return 1;
    return std::abs(value - rounded(value, 0.05)) < 1e-9 ? 2 : 3;
  };
  const auto digits_of = [&digits](const sim::Vec2& p) { return digits(p.x()) + digits(p.y()); };
  const auto turn = [](int yaw_deg) -> std::size_t { return yaw_deg % 45 == 0 ? 0 : 2; };
  std::size_t weight = 0;
  for (const Element& element : scenario.elements) {
    weight += 1000 + digits_of(element.center) + digits_of(element.size) + turn(element.yaw_deg);
    if (element.has_opening()) weight += digits(element.opening_m);
    if (element.moves) weight += 500 + digits_of(element.goes_to);
  }
  for (const DeviceFault& fault : scenario.faults) {
    // Whole seconds are rounder than tenths.
    weight += 400 + digits(0.1 * fault.at_s) + digits(0.1 * fault.for_s) + digits(fault.x_m) +
              turn(fault.yaw_deg) + digits(fault.scale);
  }
  if (scenario.extended) weight += 300;
  if (scenario.start) {
    weight += 200 + digits_of(scenario.start->position()) + turn(scenario.start->yaw_deg);
  }
  weight += scenario.real ? 100 : 0;
  weight += scenario.latency_s > 0.0 ? 100 : 0;
  weight += scenario.dropouts > 0.0 ? 100 : 0;
  return weight + (scenario.seed != 1 ? 50 : 0);
}

std::string description_of(const Scenario& scenario) {
  std::vector<std::string> parts;
  constexpr std::ptrdiff_t kMostWalls = 5;  // that are named one by one
  const std::ptrdiff_t walls = std::ranges::count_if(scenario.elements, &Element::of_map);
  if (walls > kMostWalls) parts.push_back("a map of " + std::to_string(walls) + " walls");
  for (const Element& element : scenario.elements) {
    if (!element.of_map || walls <= kMostWalls) parts.push_back(text_of(element));
  }
  for (const DeviceFault& fault : scenario.faults) parts.push_back(text_of(fault));
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
    parts.push_back("a laser that loses " +
                    sim::shortest_text(std::round(100.0 * scenario.dropouts)) + " % of its beams");
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
