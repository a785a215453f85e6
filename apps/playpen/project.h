// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

/// Projects of client programs: their templates, and the package that they build with.
namespace playpen {

/// A kind of project that `playpen new` makes.
struct ProjectTemplate {
  const char* name;
  const char* what;           ///< for people
  const char* source_folder;  ///< of the template, from the root of the source tree
  const char* program;        ///< the name of its executable
  const char* task;           ///< that it is for; "": none
};

inline constexpr std::array<ProjectTemplate, 4> kProjectTemplates{{
    {"intro", "the introduction task", "apps/par_intro/template", "par_intro_template",
     "par_intro"},
    {"planning", "the planning task", "apps/par_planning/template", "par_planning_template",
     "par_planning"},
    {"exploration", "the exploration task", "apps/par_exploration/template",
     "par_exploration_template", "par_exploration"},
    {"client", "a Player client program", "apps/client/template", "my_robot", ""},
}};

/// The one of that name, which must be there.
[[nodiscard]] const ProjectTemplate& project_template(const std::string& name);

/// The folder of a template: share/playpen/templates/NAME of the prefix that this program is
/// installed in, or that of the source tree that the build folder lies in. nullopt: there is none.
[[nodiscard]] std::optional<std::filesystem::path> template_folder(const ProjectTemplate& kind);

/// The prefix below which CMake finds the package playpen that belongs to this program: that of the
/// installation, or the build folder. nullopt: there is none.
[[nodiscard]] std::optional<std::filesystem::path> package_prefix();

/// The folder below package_prefix() with playerc++.pc, for pkg-config. nullopt: there is none.
[[nodiscard]] std::optional<std::filesystem::path> pkgconfig_folder();

/// Copies a template (but for what was built in it) into a folder, and lets its build files find
/// package_prefix(), if there is one.
/// @throws std::runtime_error naming what is missing or cannot be written.
void copy_template(const ProjectTemplate& kind, const std::filesystem::path& folder);

}  // namespace playpen
