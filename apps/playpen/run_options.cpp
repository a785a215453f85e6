// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "run_options.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "page_options.h"
#include "parsed_option.h"
#include "sim/render/render.h"
#include "sim/world/realism.h"
#include "sim/world/view_mode.h"

namespace playpen {
namespace {

// Adds an option that can be repeated; each value is one choice.
template <typename Choice>
void add_choices(CLI::App& command, const char* name, const char* help, const char* form,
                 const char* expected, bool (*parse)(const std::string&, Choice&),
                 std::vector<Choice>& choices) {
  add_parsed(command, name, help, form, expected,
             [parse, &choices](const std::string& text) {
               Choice choice;
               const bool good = parse(text, choice);
               if (good) choices.push_back(std::move(choice));
               return good;
             })
      ->expected(1)
      ->take_all()
      ->trigger_on_parse();
}

/// Adds the options about robots that mirror real ones.
void add_real_robots(CLI::App& command, playerlike::RunSettings& settings) {
  add_choices(command, "--real",
              "Let a robot of the world mirror the real one at this server [the world's]; can be "
              "repeated",
              "ROBOT=SERVER", playerlike::kRealRobotChoiceExpected, playerlike::parse_real_robot,
              settings.real_robots);
  command.add_flag("--take-over", settings.take_over,
                   "Take over real robots from other clients that are in charge of them");
}

/// @throws CLI::ParseError if an option was given that a server decides about.
void refuse_settings_of_server(const CLI::App& command) {
  for (const char* name : {"--from", "--until", "--then"}) {
    if (command.get_option(name)->count() == 0) continue;
    throw CLI::ValidationError(name,
                               "the world is that of a server: only a run whose world this command "
                               "starts can begin or stop at a time");
  }
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || option->get_positional() || name == "--real-sleep" ||
        name == "--debug" || name == "--quiet") {
      continue;
    }
    throw CLI::ValidationError(name,
                               "the world is that of a server, which decides about this: "
                               "give it to playpen serve");
  }
}

/// @throws CLI::ParseError if an option was given that a recorded run decides about.
void refuse_settings_of_recording(const CLI::App& command) {
  for (const char* name : {"--seed", "--realism", "--view-mode", "--interface", "--port",
                           "--clients", "--real", "--take-over"}) {
    if (command.get_option(name)->count() == 0) continue;
    throw CLI::ValidationError(name, "with --from, the recorded run decides about this");
  }
}

/// @throws CLI::ParseError if a program is to be isolated.
void refuse_isolated_debugging(const IsolationSettings& isolation) {
  if (isolation.level == Isolation::kOff) return;
  throw CLI::ValidationError("--debug",
                             "a debugger cannot reach an isolated program: leave out --isolated");
}

/// @throws CLI::ParseError if a program is to be isolated.
void refuse_isolated_page(const IsolationSettings& isolation) {
  if (isolation.level == Isolation::kOff) return;
  throw CLI::ValidationError("--page",
                             "an isolated program cannot reach the page: leave out --isolated");
}

/// Adds --until and --then.
void add_until(CommandLine& line, CLI::App& command, std::optional<RunUntil>& until) {
  const auto asked = [&until]() -> RunUntil& { return until ? *until : until.emplace(RunUntil{}); };
  CLI::Option* const time =
      add_parsed(command, "--until", "Simulated time at which --then happens, after full speed",
                 "S", playerlike::kStopTimeExpected, [asked](const std::string& text) {
                   return playerlike::parse_stop_time(text, asked().time_s);
                 });
  CLI::Option* const then =
      add_parsed(command, "--then",
                 "At --until: debug (stop in gdb), view (pause in a window) or save (end the run, "
                 "for --from)",
                 "WHAT", "debug, view or save", [asked](const std::string& text) {
                   using Then = RunUntil::Then;
                   if (text == "debug") asked().then = Then::kDebug;
                   if (text == "view") asked().then = Then::kView;
                   if (text == "save") asked().then = Then::kSave;
                   return text == "debug" || text == "view" || text == "save";
                 });
  line.takes(then, {"debug", "view", "save"});
  time->needs(then);
  then->needs(time);
}

/// Makes the settings of the run what --until and --then mean.
/// @throws CLI::ParseError if other options contradict.
void apply_until(RunRequest& request) {
  if (!request.until) return;
  playerlike::RunSettings& settings = request.settings;
  const double time_s = request.until->time_s;
  if (request.until->then == RunUntil::Then::kSave) {
    if (settings.duration_s) {
      throw CLI::ValidationError("--then save",
                                 "the run ends at the time of --until: leave out --duration");
    }
    if (time_s <= 0.0) throw CLI::ValidationError("--then save", "--until must be above 0");
    settings.duration_s = time_s;
    return;
  }
  if (settings.time_mode == sim::TimeMode::kPaced) {
    throw CLI::ValidationError("--until",
                               "the run has full speed until then: leave out --time, or write "
                               "--time lockstep");
  }
  settings.time_mode = sim::TimeMode::kLockstep;
  const bool views = request.until->then == RunUntil::Then::kView;
  settings.stop = {time_s,
                   views ? playerlike::RunStop::Then::kView : playerlike::RunStop::Then::kDebug};
  (views ? request.view : request.debug) = true;
}

}  // namespace

void add_view_mode(CommandLine& line, CLI::App& command, std::optional<sim::ViewMode>& mode) {
  CLI::Option* const option =
      add_parsed(command, "--view-mode",
                 "How the canvas is shown: ground, mini-map or full-screen [the world's]", "MODE",
                 playerlike::kViewModeExpected, [&mode](const std::string& text) {
                   mode = sim::parse_view_mode(text);
                   return mode.has_value();
                 });
  line.takes(option, {"ground", "mini-map", "full-screen"});
}

void add_realism(CommandLine& line, CLI::App& command, std::optional<sim::Realism>& level) {
  CLI::Option* const option = add_parsed(
      command, "--realism",
      "Noise, drift, slip and latency: ideal (none), course (as the world says) or real [the "
      "world's, else course]",
      "LEVEL", playerlike::kRealismExpected, [&level](const std::string& text) {
        level = sim::parse_realism(text);
        return level.has_value();
      });
  line.takes(option, {"ideal", "course", "real"});
}

void add_picture_options(CommandLine& line, CLI::App& command,
                         sim::render::RenderOptions& pictures) {
  CLI::Option* const follow = add_parsed(
      command, "--follow", "Pictures and film show the surroundings of this robot, METRES wide",
      "NAME[,METRES]", playerlike::kFollowExpected,
      [&pictures](const std::string& text) { return playerlike::parse_follow(text, pictures); });
  add_parsed(
      command, "--crop", "Pictures and film show this part of the world [m]", "X,Y,W,H",
      playerlike::kCropExpected,
      [&pictures](const std::string& text) { return playerlike::parse_crop(text, pictures); })
      ->excludes(follow);
  add_parsed(command, "--hide",
             "Leave out of pictures: fans, trails, labels, goals, collisions, legend, canvas, "
             "traps, timers, texts, scores",
             "LIST", playerlike::kHideExpected, [&pictures](const std::string& text) {
               return playerlike::parse_hide(text, pictures);
             });
  CLI::Option* const colour_by = add_parsed(
      command, "--colour-by", "Colours of robots: the world's, one for each robot, or none [world]",
      "SOURCE", playerlike::kColourByExpected,
      [&pictures](const std::string& text) { return playerlike::parse_colour_by(text, pictures); });
  line.takes(colour_by, {"world", "robot", "none"});
}

void add_robot_port(CLI::App& command, playerlike::RunSettings& settings,
                    const std::string& expected, std::optional<int>* free_port) {
  add_parsed(command, "--port",
             "Player port of the first robot, the one with the lowest port; others keep their "
             "distance to it [the world's]",
             "PORT", expected, [&settings, free_port](const std::string& text) {
               int port = 0;
               if (free_port != nullptr && text == "0") {
                 *free_port = 0;
                 return true;
               }
               const bool good = playerlike::parse_robot_port(text, port);
               if (good) settings.robot_port = port;
               return good;
             });
}

void add_run_settings(CommandLine& line, CLI::App& command, playerlike::RunSettings& settings,
                      const std::string& default_time) {
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
  CLI::Option* const time = add_parsed(
      command, "--time", "lockstep, real, or a factor of real time [" + default_time + "]", "MODE",
      "lockstep, real, or a factor above 0", [&settings](const std::string& text) {
        sim::TimeMode mode = sim::TimeMode::kLockstep;
        const bool good = playerlike::parse_time_mode(text, mode, settings.time_factor);
        if (good) settings.time_mode = mode;
        return good;
      });
  line.takes(time, {"lockstep", "real"});
  CLI::Option* const out = command.add_option(
      "--out", settings.output_folder, "Folder for results [out/<name of the world's file>]");
  line.takes(out->type_name("DIR"), ValueKind::Kind::kFolder);
  CLI::Option* const record =
      add_parsed(command, "--record", "Record a film: .mp4, .avi, or a folder for pictures", "FILM",
                 playerlike::kFilmExpected, [&settings](const std::string& text) {
                   settings.film = text;
                   return sim::render::FilmWriter::is_film_name(text);
                 });
  line.takes(record, ValueKind::Kind::kFile);
  add_parsed(command, "--record-fps", "Frames per second of the film [25]", "N",
             playerlike::kFilmFpsExpected,
             [&settings](const std::string& text) {
               return playerlike::parse_film_fps(text, settings.film_fps);
             })
      ->needs(record);
  add_parsed(command, "--record-speed", "Simulated seconds per second of the film [1]", "X",
             playerlike::kFilmSpeedExpected,
             [&settings](const std::string& text) {
               return playerlike::parse_film_speed(text, settings.film_speed);
             })
      ->needs(record);
  add_parsed(
      command, "--record-from",
      "Simulated time at which the film begins, and with --view --time lockstep the view [0]", "S",
      playerlike::kFilmStartExpected, [&settings](const std::string& text) {
        return playerlike::parse_film_start(text, settings.film_from_s);
      });
  add_parsed(command, "--film-size", "Size of the film [longer side 800]", "WxH",
             playerlike::kFilmSizeExpected,
             [&settings](const std::string& text) {
               return playerlike::parse_film_size(text, settings.pictures);
             })
      ->needs(record);
  add_picture_options(line, command, settings.pictures);
  add_parsed(command, "--snapshot-every", "Simulated seconds between pictures in DIR/snapshots",
             "S", playerlike::kSnapshotPeriodExpected, [&settings](const std::string& text) {
               double period_s = 0.0;
               const bool good = playerlike::parse_snapshot_period(text, period_s);
               if (good) settings.snapshot_period_s = period_s;
               return good;
             });
  add_view_mode(line, command, settings.view_mode);
  add_realism(line, command, settings.realism);
  add_choices(command, "--interface",
              "Which device answers as INTERFACE:INDEX, of each robot that has it or of ROBOT "
              "[the world's order]; can be repeated",
              "[ROBOT.]INTERFACE:INDEX=DEVICE", playerlike::kInterfaceChoiceExpected,
              playerlike::parse_interface_choice, settings.interfaces);
  add_real_robots(command, settings);
}

void require_something_to_show(const playerlike::RunSettings& settings, bool view) {
  if (settings.film_from_s > 0.0 && settings.film.empty() && !view) {
    throw CLI::RequiresError("--record-from", "--record or --view");
  }
}

CLI::Option* add_world(CommandLine& line, CLI::App& command, std::string& world) {
  CLI::Option* const option = command.add_option(
      "world", world,
      "World file (Stage's .world and .cfg, too), name of a shipped world, or 'default'");
  return line.takes(option->required()->type_name(""), ValueKind::Kind::kWorld);
}

void add_run(CommandLine& line) {
  const auto request = std::make_shared<RunRequest>();
  CLI::App& command = line.add_command("run", "Run a client program on a world");
  line.with_program.insert(&command);
  command.footer(
      "After '--' come the client program and its arguments, for example\n"
      "  playpen run par_intro --duration 60 -- ./robot --port 6665\n"
      "'playpen list worlds' shows the names of worlds. For the world of a server,\n"
      "write its address: tcp://HOST[:PORT], unix:PATH or player://HOST[:PORT].\n"
      "Exit status: 0 success, 1 the program failed, 2 bad input.");
  const CLI::Option* const world = add_world(line, command, request->world)->required(false);
  add_run_settings(line, command, request->settings, "the world's, else lockstep");
  add_parsed(command, "--from",
             "Begin with the world as it was in the finished run with the results OUT after S "
             "simulated seconds",
             "OUT@S", kRunMomentExpected, [request](const std::string& text) {
               return parse_run_moment(text, request->from.emplace());
             });
  add_parsed(command, "--clients", "Hold time until N clients have joined [the world's]", "N",
             playerlike::kClientsExpected, [request](const std::string& text) {
               int clients = 0;
               const bool good = playerlike::parse_clients(text, clients);
               if (good) request->settings.clients = clients;
               return good;
             });
  add_robot_port(command, request->settings, playerlike::kRobotPortExpected);
  add_port(command, "--player-port",
           "Let Player's clients watch: first port of Player's protocol, one for each robot; 0: "
           "any [none]",
           request->settings.player_port);
  command.add_flag("--view", request->view,
                   "Watch and steer in a window, in real time unless --time says otherwise");
  add_page(line, command, request->page);
  command.add_flag("--real-sleep", request->real_sleep,
                   "In lockstep: the program's sleeps and clocks are real, not simulated time");
  add_isolation(line, command, request->isolation);
  command.add_flag("--debug", request->debug,
                   "Start the program in gdb; simulated time stands still at its breakpoints");
  line.takes(add_parsed(command, "--html", "Write the replay of the run as a page [none]", "FILE",
                        "a file ending in .html",
                        [request](const std::string& text) {
                          request->replay_file = text;
                          return is_page_name(text);
                        }),
             ValueKind::Kind::kFile);
  add_replay_size(command, request->replay_megabytes);
  add_until(line, command, request->until);
  const auto expectations = std::make_shared<std::vector<std::string>>();
  command
      .add_option("--expect", *expectations,
                  "Fail unless a figure of the results is so, such as \"collisions == 0\" (see "
                  "'playpen expect'); can be repeated")
      ->expected(1)
      ->take_all()
      ->type_name("EXPECTATION");
  command.add_flag("--quiet", request->quiet, "No progress, no summary");
  command.callback([request, expectations, &line, &command, world] {
    for (const std::string& text : *expectations) {
      request->expectations.push_back(parsed_expectation("--expect", text));
    }
    if (world->count() == 0 && !request->from) throw CLI::RequiredError("world");
    if (line.program.empty()) throw CLI::RequiredError("-- PROGRAM");
    request->command = line.program;
    apply_until(*request);
    if (request->debug) refuse_isolated_debugging(request->isolation);
    if (request->page.wanted) refuse_isolated_page(request->isolation);
    if (request->from) refuse_settings_of_recording(command);
    if (names_server(request->world)) {
      refuse_settings_of_server(command);
      line.status = run_at_server(*request);
      return;
    }
    require_something_to_show(request->settings, request->view);
    request->call = line.call;
    line.status = run(*request);
  });
}

}  // namespace playpen
