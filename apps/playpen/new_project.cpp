// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "command_line.h"
#include "editor_files.h"
#include "project.h"
#include "sim/core/error.h"
#include "terminal.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;

void print_next_steps(const ProjectTemplate& kind, const std::string& folder,
                      const std::string& invocation) {
  const std::string dir = shell_word(folder);
  const std::string build = shell_word((fs::path(folder) / "build").string());
  const std::string program = shell_word((fs::path(folder) / "build" / kind.program).string());
  const std::string playpen = shell_word(invocation);
  const std::string world = *kind.task == '\0' ? "cave --duration 60" : kind.task;
  std::cout << "'" << folder << "' holds a template of " << kind.what << ". Next:\n"
            << "  cmake -S " << dir << " -B " << build << '\n'
            << "  cmake --build " << build << '\n';
  if (kind.has_tests) {
    std::cout << "  ctest --test-dir " << build << " --output-on-failure\n";
  } else {
    std::cout << "  " << playpen << " run " << world << " -- " << program << '\n';
  }
  if (*kind.task != '\0') {
    std::cout << "  " << playpen << " grade " << kind.task << " -- " << program << '\n';
  }
  std::cout << (fs::path(folder) / "README.md").string() << " says what to fill in.\n";
}

void make_project(const ProjectTemplate& kind, const std::string& target,
                  const std::string& invocation) {
  const fs::path folder(target);
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error)) {
    throw std::runtime_error("'" + target + "' is a file; name a new or empty folder");
  }
  if (fs::is_directory(folder, error) && !fs::is_empty(folder, error)) {
    throw std::runtime_error("the folder '" + target +
                             "' is not empty; name a new or empty one, so that nothing of yours is "
                             "overwritten");
  }
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder)) {
    throw std::runtime_error("the folder '" + target + "' cannot be made: " + error.message());
  }
  copy_template(kind, folder);
  write_editor_files(kind, folder);
  print_next_steps(kind, target, invocation);
  if (!package_prefix()) {
    std::cout << "The CMake package of Playpen is not beside this program. Add to the first "
                 "command:\n  -DCMAKE_PREFIX_PATH=WHERE_PLAYPEN_IS_INSTALLED\n";
  }
}

}  // namespace

void add_new(CommandLine& line) {
  struct Request {
    std::string kind;
    std::string folder;
  };
  const auto request = std::make_shared<Request>();
  CLI::App& command = line.add_command("new", "Start a client program from a template");
  std::vector<std::string> names;
  std::string list;
  for (const ProjectTemplate& one : kProjectTemplates) {
    names.emplace_back(one.name);
    list += (list.empty() ? "" : ", ") + std::string(one.name);
  }
  CLI::Option* const kind =
      command.add_option("template", request->kind, "A task of the course, client or test");
  line.takes(kind->required()->type_name(""), names);
  kind->check([names, list](const std::string& text) {
    for (const std::string& name : names) {
      if (name == text) return std::string();
    }
    const std::string near = sim::nearest_word(text, names);
    return "there is no template '" + text + "', only " + list +
           (near.empty() ? "" : "; did you mean '" + near + "'?");
  });
  CLI::Option* const folder =
      command.add_option("dir", request->folder, "New folder, or an empty one");
  line.takes(folder->required()->type_name(""), ValueKind::Kind::kFolder);
  command.footer(
      "intro, planning, exploration, traps, exploration_changing, chase and\n"
      "localization are the course's tasks ('playpen doc course_guide'), client is\n"
      "the smallest client program, with CMakeLists.txt and Makefile, test is a\n"
      "program with tests for ctest and for CI ('playpen doc testing').\n"
      "For example:\n"
      "  playpen new intro my_robot");
  command.callback([request, &line] {
    make_project(project_template(request->kind), request->folder, line.invocation);
  });
}

}  // namespace playpen
