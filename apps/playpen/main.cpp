// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "commands.h"
#include "parsed_option.h"
#include "playerlike/host/run_settings.h"
#include "sim/core/error.h"

namespace {

using playpen::add_parsed;
using playpen::parse_number;

void add_run(CLI::App& app, const std::vector<std::string>& program, int& status) {
  const auto request = std::make_shared<playpen::RunRequest>();
  request->command = program;
  playerlike::RunSettings& settings = request->settings;
  CLI::App& command = *app.add_subcommand("run", "Run a client program on a world");
  command.footer(
      "After '--' come the client program and its arguments, for example\n"
      "playpen run tasks/par_intro --duration 60 -- ./robot --port 6665");
  command
      .add_option("world", request->world,
                  "World file, or the name of a shipped world (tasks/par_intro), or 'default'")
      ->required()
      ->type_name("");
  add_parsed(command, "--duration", "Simulated seconds after which the run ends", "S",
             "a number of seconds above 0", [&settings](const std::string& text) {
               double seconds = 0.0;
               const bool good =
                   parse_number(text, seconds) && std::isfinite(seconds) && seconds > 0.0;
               if (good) settings.duration_s = seconds;
               return good;
             });
  add_parsed(command, "--seed", "Seed of all noise", "N", "a whole number from 0 to 2^64 - 1",
             [&settings](const std::string& text) {
               std::uint64_t seed = 0;
               const bool good = parse_number(text, seed);
               if (good) settings.seed = seed;
               return good;
             });
  add_parsed(command, "--time", "lockstep, real, or a factor of real time", "MODE",
             "lockstep, real, or a factor above 0", [&settings](const std::string& text) {
               sim::TimeMode mode = sim::TimeMode::kLockstep;
               const bool good = playerlike::parse_time_mode(text, mode, settings.time_factor);
               if (good) settings.time_mode = mode;
               return good;
             });
  command.add_option("--out", settings.output_folder, "Folder for results [out/<world's name>]")
      ->type_name("DIR");
  add_parsed(command, "--record", "Record a film", "FILE.mp4", "a file ending in .mp4 or .avi",
             [&settings](const std::string& text) {
               settings.film = text;
               return text.size() > 4 && (text.ends_with(".mp4") || text.ends_with(".avi"));
             });
  command.add_flag("--quiet", request->quiet, "No progress, no summary");
  command.callback([request, &status] {
    if (request->command.empty()) throw CLI::RequiredError("-- PROGRAM");
    status = playpen::run(*request);
  });
}

void add_check(CLI::App& app, int& status) {
  const auto worlds = std::make_shared<std::vector<std::string>>();
  CLI::App& command = *app.add_subcommand("check", "Validate world files");
  command.add_option("world", *worlds, "World files")->required()->type_name("");
  command.callback([worlds, &status] { status = playpen::check(*worlds); });
}

void add_render(CLI::App& app, int& status) {
  struct Arguments {
    std::string world;
    std::string file;
    int size_px = 1000;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& command = *app.add_subcommand("render", "Draw a world as it is at its start");
  command.add_option("world", arguments->world, "World file")->required()->type_name("");
  add_parsed(command, "--out", "Picture to write", "FILE.png", "a file ending in .png",
             [arguments](const std::string& text) {
               arguments->file = text;
               return text.size() > 4 && text.ends_with(".png");
             })
      ->required();
  add_parsed(command, "--size", "Pixels along the longer side [1000]", "PX",
             "a whole number from 64 to 8192", [arguments](const std::string& text) {
               int& size_px = arguments->size_px;
               return parse_number(text, size_px) && size_px >= 64 && size_px <= 8192;
             });
  command.callback([arguments, &status] {
    status = playpen::render(arguments->world, arguments->file, arguments->size_px);
  });
}

}  // namespace

int main(int argc, char** argv) {
  try {
    CLI::App app("Playpen: a 2D robot arena for Player and CCMorse client programs", "playpen");
    app.set_version_flag("--version", "playpen " PLAYPEN_VERSION);
    app.require_subcommand(0, 1);
    app.footer(
        "Exit status: 0 fine, 1 the program failed, 2 bad input.\n"
        "'playpen COMMAND --help' tells more.");
    int status = playpen::kOk;
    // What follows `run ... --` is another program's: kept from the parser, which would take
    // "[a,b]" apart.
    char** const all_end = argv + argc;
    char** const end = argc > 1 && argv[1] == std::string_view("run")
                           ? std::find(argv, all_end, std::string_view("--"))
                           : all_end;
    add_run(app, std::vector<std::string>(std::min(end + 1, all_end), all_end), status);
    add_check(app, status);
    add_render(app, status);
    try {
      app.parse(static_cast<int>(end - argv), argv);
    } catch (const CLI::ParseError& error) {
      return app.exit(error) == 0 ? playpen::kOk : playpen::kBadInput;
    }
    if (app.get_subcommands().empty()) std::cout << app.help();
    return status;
  } catch (const sim::ConfigError& error) {
    std::cerr << error.what() << '\n';
    return playpen::kBadInput;
  } catch (const std::exception& error) {
    std::cerr << "playpen: " << error.what() << '\n';
    return playpen::kBadInput;
  }
}
