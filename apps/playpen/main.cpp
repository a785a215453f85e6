// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "commands.h"
#include "grade_options.h"
#include "parsed_option.h"
#include "run_options.h"
#include "serve_options.h"
#include "sim/core/error.h"

namespace {

using playpen::add_parsed;
using playpen::parse_number;

void add_run(CLI::App& app, const std::vector<std::string>& program, int& status) {
  const auto request = std::make_shared<playpen::RunRequest>();
  request->command = program;
  CLI::App& command = *app.add_subcommand("run", "Run a client program on a world");
  command.footer(
      "After '--' come the client program and its arguments, for example\n"
      "playpen run tasks/par_intro --duration 60 -- ./robot --port 6665");
  command
      .add_option("world", request->world,
                  "World file, or the name of a shipped world (tasks/par_intro), or 'default'")
      ->required()
      ->type_name("");
  playpen::add_run_settings(command, request->settings, "the world's, else lockstep");
  command.add_flag("--view", request->view,
                   "Watch and steer in a window, in real time unless --time gives a factor");
  command.add_flag("--real-sleep", request->real_sleep,
                   "In lockstep: the program's sleeps and clocks are real, not simulated time");
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
  const auto request = std::make_shared<playpen::RenderRequest>();
  CLI::App& command = *app.add_subcommand("render", "Draw a world as it is at its start");
  command
      .add_option("world", request->world,
                  "World file or name of a shipped world, or a map (a map_server file, .yaml)")
      ->required()
      ->type_name("");
  add_parsed(command, "--out", "Picture, or with --map also the map's .yaml", "FILE.png",
             "a file ending in .png (or .yaml)",
             [request](const std::string& text) {
               request->file = text;
               return text.size() > 4 && (text.ends_with(".png") || text.ends_with(".yaml"));
             })
      ->required();
  add_parsed(command, "--size", "Pixels along the longer side [1000]", "PX",
             "a whole number from 64 to 8192", [request](const std::string& text) {
               int& size_px = request->size_px;
               return parse_number(text, size_px) && size_px >= 64 && size_px <= 8192;
             });
  playpen::add_view_mode(command, request->view_mode);
  CLI::Option* const canvas = command.add_flag("--canvas", request->canvas,
                                               "The canvas alone, a whole number of pixels a cell");
  command
      .add_flag("--map", request->map,
                "The true map, a cell of the canvas each: as a picture, or as a map_server pair")
      ->excludes(canvas);
  command.callback([request, &status] { status = playpen::render(*request); });
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
    // What follows `run ... --` or `grade ... --` is another program's: kept from the parser, which
    // would take "[a,b]" apart.
    char** const all_end = argv + argc;
    const std::string_view command = argc > 1 ? argv[1] : "";
    char** const end = command == "run" || command == "grade"
                           ? std::find(argv, all_end, std::string_view("--"))
                           : all_end;
    const std::vector<std::string> program(std::min(end + 1, all_end), all_end);
    add_run(app, program, status);
    playpen::add_serve(app, status);
    playpen::add_grade(app, program, status);
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
