// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <span>
#include <string>

#include "sim/core/fields.h"
#include "sim/devices/coordinates.h"
#include "sim/io/field_reader.h"
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
  /// Called if the device has the modifier; nullptr: the parameters are all.
  void (*use)(void* params) = nullptr;
  /// Called if the modifier has "_2D": false: z, roll and pitch get noise, too.
  void (*in_space)(void* params) = nullptr;
};

/// Reads the list "modifiers", and sets the settings that its elements stand for. Unknown names, a
/// modifier that appears twice, and a setting that the device also states by its own key are
/// issues.
/// @param params  the device's settings; those that modifiers depend on were read before.
void read_modifiers(io::Reader& settings, std::span<const Modifier> modifiers, void* params);

/// @name MORSE's modifiers of coordinates, for settings that derive from CoordinateParams
/// @{
template <typename Params>
[[nodiscard]] CoordinateParams& coordinates_in(void* params) {
  return *static_cast<Params*>(params);
}
inline constexpr const char* kUtmNames[] = {"UTM"};
inline constexpr const char* kNedNames[] = {"NED"};
inline constexpr const char* kFeetNames[] = {"feet"};
inline constexpr const char* kEcefNames[] = {"ECEF"};
inline constexpr const char* kGeodeticNames[] = {"geodetic", "Geodetic"};
inline constexpr NumberRange kUtmOffset{-1e9, 1e9, false, "m"};
template <typename Params>
inline constexpr ModifierParameter kUtm[] = {
    {"x_offset", 0.0, kUtmOffset, "",
     [](void* params, double value) { coordinates_in<Params>(params).utm_offset_m[0] = value; }},
    {"y_offset", 0.0, kUtmOffset, "",
     [](void* params, double value) { coordinates_in<Params>(params).utm_offset_m[1] = value; }},
    {"z_offset", 0.0, kUtmOffset, "",
     [](void* params, double value) { coordinates_in<Params>(params).utm_offset_m[2] = value; }},
};
template <typename Params>
inline constexpr ModifierParameter kPlaceOnEarth[] = {
    {"latitude",
     0.0,
     {-90.0, 90.0, false, "degrees"},
     "",
     [](void* params, double value) { coordinates_in<Params>(params).latitude_deg = value; }},
    {"longitude",
     0.0,
     {-180.0, 180.0, false, "degrees"},
     "",
     [](void* params, double value) { coordinates_in<Params>(params).longitude_deg = value; }},
    {"altitude",
     0.0,
     {-1e4, 1e6, false, "m"},
     "",
     [](void* params, double value) { coordinates_in<Params>(params).altitude_m = value; }},
    {"angle_against_north",
     90.0,
     {-360.0, 360.0, false, "degrees"},
     "",
     [](void* params, double value) { coordinates_in<Params>(params).north_deg = value; }},
};
template <typename Params>
inline constexpr Modifier kUtmModifier{
    kUtmNames, kUtm<Params>, [](void* params) { coordinates_in<Params>(params).utm = true; }};
template <typename Params>
inline constexpr Modifier kNedModifier{
    kNedNames, {}, [](void* params) { coordinates_in<Params>(params).ned = true; }};
template <typename Params>
inline constexpr Modifier kFeetModifier{
    kFeetNames, {}, [](void* params) { coordinates_in<Params>(params).feet = true; }};
template <typename Params>
inline constexpr Modifier kEcefModifier{kEcefNames, kPlaceOnEarth<Params>, [](void* params) {
                                          coordinates_in<Params>(params).ecef = true;
                                        }};
template <typename Params>
inline constexpr Modifier kGeodeticModifier{
    kGeodeticNames, kPlaceOnEarth<Params>,
    [](void* params) { coordinates_in<Params>(params).geodetic = true; }};
/// @}

/// The field "modifiers" of a device.
/// @tparam kModifiers  its modifiers.
template <const auto& kModifiers>
inline constexpr CustomField kModifiersField{
    [](io::Reader& settings, const Field&, void* params) {
      read_modifiers(settings, kModifiers, params);
    },
    [](const void*) { return std::string("[]"); },
    R"("type": "array", "maxItems": 16, "items": {"type": "object", "required": ["name"], "properties": {"name": {"type": "string"}}, "additionalProperties": {"type": ["number", "boolean"]}})"};

template <const auto& kModifiers>
[[nodiscard]] constexpr Field modifiers_field() {
  return custom(
      "modifiers", kModifiersField<kModifiers>, [](const void*, std::map<std::string, double>&) {},
      "", "list of MORSE's modifiers, see docs/realism.md");
}

}  // namespace sim
