// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "command_line.h"
#include "shipped.h"
#include "sim/world/robot_model.h"
#include "terminal.h"

namespace playpen {
namespace {

/// The entries under one heading.
struct ListedFolder {
  FileKind kind;
  const char* folder;
  const char* heading;
};

constexpr ListedFolder kListedFolders[] = {
    {FileKind::kWorld, "", "Worlds (playpen run NAME -- PROGRAM)"},
    {FileKind::kWorld, "tasks", "Worlds of the tasks"},
    {FileKind::kWorld, "examples", "Worlds that show what worlds can hold"},
    {FileKind::kWorld, "devices", "Worlds that show one device each"},
    {FileKind::kTask, "tasks", "Tasks (playpen grade NAME -- PROGRAM)"},
    {FileKind::kModel, "models", "Robot models (\"model\": \"NAME\" of a robot in a world)"},
};

/// The named files, and names without a file.
std::vector<ShippedFile> named_files() {
  std::vector<ShippedFile> files = shipped_files();
  if (files.empty()) {
    throw std::runtime_error(
        "the folder of worlds, share/playpen/worlds beside the folder of this program, is missing; "
        "install Playpen again ('playpen doctor' tells more)");
  }
  ShippedFile standard;
  standard.name = "default";
  standard.description = "The world of programs that name none: as syrotek.";
  files.insert(files.begin(), standard);
  ShippedFile s1r;
  s1r.kind = FileKind::kModel;
  s1r.name = sim::default_robot_model().name;
  s1r.folder = "models";
  s1r.description = sim::default_robot_model().description;
  const auto place = std::find_if(files.begin(), files.end(), [&s1r](const ShippedFile& file) {
    return file.kind == s1r.kind && file.name > s1r.name;
  });
  files.insert(place, s1r);
  return files;
}

bool is_asked_for(FileKind kind, const std::string& what) {
  return what.empty() || what == std::string(to_string(kind)) + 's';
}

void print_names(const std::vector<ShippedFile>& files, const std::string& what) {
  for (const ShippedFile& file : files) {
    if (is_asked_for(file.kind, what)) std::cout << file.name << '\n';
  }
}

void print_sections(const std::vector<ShippedFile>& files, const std::string& what) {
  constexpr std::size_t kIndent = 2;
  const std::size_t columns = terminal_columns(STDOUT_FILENO);
  const bool colour = shows_colour(STDOUT_FILENO);
  std::size_t longest = 0;
  for (const ShippedFile& file : files) longest = std::max(longest, file.name.size());
  const std::size_t description_at = kIndent + longest + 2;
  bool is_first = true;
  for (const ListedFolder& shown : kListedFolders) {
    if (!is_asked_for(shown.kind, what)) continue;
    if (!is_first) std::cout << '\n';
    is_first = false;
    std::cout << tinted(shown.heading, Tint::kStrong, colour) << '\n';
    for (const ShippedFile& file : files) {
      if (file.kind != shown.kind || file.folder != shown.folder) continue;
      std::string name = std::string(kIndent, ' ') + file.name;
      name.resize(description_at, ' ');
      std::cout << name
                << wrapped(file.description.empty() ? "(no description)" : file.description,
                           columns, description_at)
                << '\n';
    }
  }
}

}  // namespace

void add_list(CommandLine& line) {
  struct Request {
    std::string what;
    bool names = false;
  };
  const auto request = std::make_shared<Request>();
  CLI::App& command =
      line.add_command("list", "Show the worlds, tasks and robot models, and what each is for");
  CLI::Option* const what =
      command.add_option("what", request->what, "worlds, tasks or models [all of them]");
  line.takes(what->type_name(""), {"worlds", "tasks", "models"});
  what->check([](const std::string& text) {
    const bool good = text == "worlds" || text == "tasks" || text == "models";
    return good ? "" : "must be worlds, tasks or models, but is '" + text + "'";
  });
  command.add_flag("--names", request->names, "Only the names, one a line");
  command.callback([request] {
    const std::vector<ShippedFile> files = named_files();
    if (request->names) {
      print_names(files, request->what);
    } else {
      print_sections(files, request->what);
    }
  });
}

}  // namespace playpen
