// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "devices/modifiers.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace sim {
namespace {

constexpr std::size_t kMostModifiers = 16;

const Modifier* find(std::span<const Modifier> modifiers, std::string_view name) {
  for (const Modifier& modifier : modifiers) {
    if (std::ranges::find(modifier.names, name) != modifier.names.end()) return &modifier;
  }
  return nullptr;
}

// The key, among those that a parameter sets, that the device states itself; empty if there is
// none.
std::string stated_key(io::Reader& settings, const ModifierParameter& parameter) {
  std::string_view keys = parameter.settings;
  while (!keys.empty()) {
    const std::string_view key = keys.substr(0, keys.find(' '));
    if (settings.has(key)) return std::string(key);
    keys.remove_prefix(std::min(keys.size(), key.size() + 1));
  }
  return {};
}

}  // namespace

void read_modifiers(io::Reader& settings, std::span<const Modifier> modifiers, void* params) {
  std::vector<std::string> names;
  for (const Modifier& modifier : modifiers) {
    names.insert(names.end(), modifier.names.begin(), modifier.names.end());
  }
  std::vector<const Modifier*> used;
  for (io::Reader& element : settings.array("modifiers", kMostModifiers)) {
    if (!element.expect_object()) continue;
    if (!element.require("name", "which modifier, by its name in MORSE")) continue;
    const Modifier* const modifier = find(modifiers, element.choice("name", "", names));
    if (modifier == nullptr) continue;
    if (std::ranges::find(used, modifier) != used.end()) {
      element.issue("world/duplicate-name", "each modifier once",
                    "a second one with the same parameters", "leave one of the two out", "name");
    }
    used.push_back(modifier);
    if (modifier->use != nullptr) modifier->use(params);
    // By default all noise is that of a flat world.
    const bool is_flat = element.boolean("_2D", true);
    if (!is_flat && modifier->in_space != nullptr) modifier->in_space(params);
    for (const ModifierParameter& parameter : modifier->parameters) {
      const double value = element.number(parameter.name, parameter.fallback, parameter.range);
      if (const std::string key = stated_key(settings, parameter); !key.empty()) {
        element.issue("world/conflicting-keys",
                      "either \"" + key + "\" or the modifier that sets it", "both",
                      "leave one of the two out");
      } else {
        parameter.set(params, value);
      }
    }
    element.finish();
  }
}

}  // namespace sim
