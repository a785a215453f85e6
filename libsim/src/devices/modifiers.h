// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <span>
#include <string>

#include "sim/core/fields.h"
#include "sim/io/reader.h"

/// MORSE's noise modifiers in world files (docs/realism.md): each is another spelling of a device's
/// own settings.
namespace sim {

/// A parameter of a modifier, with MORSE's name, unit and default.
struct ModifierParameter {
  const char* name;
  double fallback;  ///< if the modifier does not name the parameter
  NumberRange range;
  const char* settings;  ///< keys of the settings that it sets, separated by blanks
  void (*set)(void* params, double value);
};

/// The modifiers of a kind of device that have these names.
struct Modifier {
  std::span<const char* const> names;
  std::span<const ModifierParameter> parameters;
};

/// Reads the list "modifiers", and sets the settings that its elements stand for. Unknown names, a
/// modifier that appears twice, and a setting that the device also states by its own key are
/// issues.
/// @param params  the device's settings; those that modifiers depend on were read before.
void read_modifiers(io::Reader& settings, std::span<const Modifier> modifiers, void* params);

/// The field "modifiers" of a device.
/// @tparam kModifiers  its modifiers.
template <const auto& kModifiers>
inline constexpr CustomField kModifiersField{
    [](io::Reader& settings, const Field&, void* params) {
      read_modifiers(settings, kModifiers, params);
    },
    [](const void*) { return std::string("[]"); },
    [](const void*, std::map<std::string, double>&) {},
    R"("type": "array", "maxItems": 16, "items": {"type": "object", "required": ["name"], "properties": {"name": {"type": "string"}}, "additionalProperties": {"type": ["number", "boolean"]}})"};

template <const auto& kModifiers>
[[nodiscard]] constexpr Field modifiers_field() {
  return custom("modifiers", kModifiersField<kModifiers>, "",
                "list of MORSE's noise modifiers, see docs/realism.md");
}

}  // namespace sim
