// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/stage/tokens.h"

namespace sim::io::stage {

class Report;

/// A number or a text of a property.
struct Value {
  bool is_text = false;
  double number = 0.0;
  std::string text;  ///< of a number its notation
  Place place;
};

/// `name value` or `name [value value ...]`.
struct Property {
  std::string name;
  std::vector<Value> values;
  bool is_tuple = false;
  Place place;                ///< of its name
  mutable bool used = false;  ///< whether the translation has asked for it
};

/// `type ( properties and entities )`, with everything that it inherits from its definitions.
struct Entity {
  std::string type;                ///< after all definitions, e.g. "position"
  std::vector<std::string> kinds;  ///< names of its definitions, its own first, e.g. "pioneer2dx"
  Place place;
  std::vector<Property> properties;  ///< one for each name: the last one counts
  std::vector<Entity> children;      ///< inherited ones first

  /// The property of that name, marked as used; nullptr if there is none.
  [[nodiscard]] const Property* find(std::string_view name) const;
  /// Sets a property, replacing one of the same name.
  void set(Property property);
};

/// A file of Stage models that comes with Playpen: the text of worlds/stage/NAME, compiled in.
struct ShippedInclude {
  const char* name;  ///< e.g. "pioneer.inc"
  const char* text;
};

/// What the names of shipped files begin with in messages.
inline constexpr const char* kShippedFolder = "playpen:stage/";

/// All shipped files of models, in alphabetical order.
[[nodiscard]] const std::vector<ShippedInclude>& shipped_includes();

/// Reads a world file of Stage: resolves includes, definitions and inheritance.
///
/// A file that is included is looked for beside the file that names it, beside the world file, in
/// stage_folders(), and by its last part among the shipped ones. As in Stage, the first definition
/// of a name counts.
/// @param path  of the world file; the text is what it contains.
/// @param report  gets notes about definitions without effect, odd numbers, and files of other
///     folders.
/// @return the entity of the whole file, of type "": its properties and models.
/// @throws ConfigError for the first syntax error, an include that is not found, and definitions
///     that contain themselves.
[[nodiscard]] Entity read_world_file(std::string_view text, const std::string& path,
                                     Report& report);

/// Reads a configuration file of Player: the same syntax, without shipped files. Entities of type
/// "driver" are what matters.
/// @throws ConfigError as read_world_file().
[[nodiscard]] Entity read_player_file(std::string_view text, const std::string& path,
                                      Report& report);

}  // namespace sim::io::stage
