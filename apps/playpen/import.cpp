// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cstring>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>

#include "command_line.h"
#include "sim/core/replace_file.h"
#include "sim/devices/builtin.h"
#include "sim/io/stage_import.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& content) {
  if (const int error = sim::replace_file(file.string(), content)) {
    throw std::runtime_error(file.string() + ": cannot be written: " + std::strerror(error));
  }
}

/// Translates a world of Stage and writes its files.
void import_world(const std::string& file, const std::string& config, const std::string& target) {
  const sim::io::ImportedWorld imported =
      sim::io::import_stage_world(file, config, sim::device_types());
  for (const std::string& note : imported.notes) std::cerr << "playpen: " << note << '\n';
  const fs::path folder(target);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder)) {
    throw std::runtime_error("the folder '" + target + "' cannot be made: " + error.message());
  }
  for (const auto& [name, content] : imported.files) write(folder / name, content);
  const fs::path world = folder / (fs::path(file).stem().string() + ".json");
  write(world, imported.world);
  std::cout << world.string() << '\n';
}

}  // namespace

void add_import(CommandLine& line) {
  struct Request {
    std::string file;
    std::string config;
    std::string folder;
  };
  const auto request = std::make_shared<Request>();
  CLI::App& command = line.add_command("import", "Translate a world of Stage into a world file");
  CLI::Option* const file = command.add_option(
      "file", request->file, "World file of Stage, or a Player configuration file that names one");
  line.takes(file->required()->type_name(""), ValueKind::Kind::kFile);
  CLI::Option* const config =
      command.add_option("config", request->config, "Player configuration file of the world");
  line.takes(config->type_name(""), ValueKind::Kind::kFile);
  CLI::Option* const folder =
      command.add_option("--out", request->folder, "Folder for the files; made if needed");
  line.takes(folder->required()->type_name("DIR"), ValueKind::Kind::kFolder);
  command.footer(
      "Writes the world, its robot models and its maps, and prints the name of the world.\n"
      "Other commands read files of Stage as they are: playpen run simple.world -- ./client");
  command.callback([request] { import_world(request->file, request->config, request->folder); });
}

}  // namespace playpen
