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
  const char* what;           ///< description for users
  const char* source_folder;  ///< path of the template from the root of the source tree
  const char* program;        ///< the name of its executable
  const char* task;           ///< the task that it is for; "": none
  bool has_tests = false;     ///< for ctest
};

inline constexpr std::array<ProjectTemplate, 9> kProjectTemplates{{
    {"intro", "the introduction task", "apps/par_intro/template", "par_intro_template",
     "par_intro"},
    {"planning", "the planning task", "apps/par_planning/template", "par_planning_template",
     "par_planning"},
    {"exploration", "the exploration task", "apps/par_exploration/template",
     "par_exploration_template", "par_exploration"},
    {"traps", "the traps task", "apps/par_traps/template", "par_traps_template", "par_traps"},
    {"exploration_changing", "the task of exploring an arena that changes",
     "apps/par_exploration_changing/template", "par_exploration_changing_template",
     "par_exploration_changing"},
    {"chase", "the chase task", "apps/par_chase/template", "par_chase_template", "par_chase"},
    {"localization", "the localization task", "apps/par_localization/template",
     "par_localization_template", "par_localization"},
    {"client", "a Player client program", "apps/client/template", "my_robot", ""},
    {"test", "a robot program with tests", "apps/test/template", "robot", "", true},
}};

/// The template with that name, which must exist.
[[nodiscard]] const ProjectTemplate& project_template(const std::string& name);

/// The folder of a template: share/playpen/templates/NAME of this program's installation prefix, or
/// the template in the source tree that contains the build folder. nullopt: there is none.
[[nodiscard]] std::optional<std::filesystem::path> template_folder(const ProjectTemplate& kind);

/// The prefix below which CMake finds the package playpen of this program: the installation prefix,
/// or the build folder. nullopt: there is none.
[[nodiscard]] std::optional<std::filesystem::path> package_prefix();

/// The folder of playerc++.pc below package_prefix(), for pkg-config. nullopt: there is none.
[[nodiscard]] std::optional<std::filesystem::path> pkgconfig_folder();

/// Copies a template (without build folders) into a folder, and makes its build files find
/// package_prefix(), if there is one.
/// @throws std::runtime_error that names what is missing or cannot be written.
void copy_template(const ProjectTemplate& kind, const std::filesystem::path& folder);

}  // namespace playpen
