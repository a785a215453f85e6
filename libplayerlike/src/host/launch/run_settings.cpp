// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/run_settings.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include "playerlike/messages/messages.h"
#include "sim/core/error.h"
#include "sim/core/number_text.h"
#include "sim/core/time.h"
#include "sim/render/render.h"
#include "sim/world/realism.h"
#include "sim/world/view_mode.h"

namespace playerlike {
namespace {

template <typename T>
bool parse_whole(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && !text.empty();
}

// Longest run that simulated time can represent.
constexpr double kLongest_s = 1e9;

bool positive(double value) { return std::isfinite(value) && value > 0.0; }

// Parses a number in [least, most].
bool parse_within(const std::string& text, double least, double most, double& value) {
  double read = 0.0;
  if (!parse_whole(text, read) || !(read >= least && read <= most)) return false;
  value = read;
  return true;
}

std::string_view environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

bool is_set(const char* name) {
  const std::string_view value = environment(name);
  return !value.empty() && value != "0";
}

bool parse_positive_seconds(const std::string& text, double& value) {
  return parse_whole(text, value) && positive(value) && value <= kLongest_s;
}

// Splits a text at its commas.
std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

// The parts that pictures can omit.
struct HiddenPart {
  std::string_view word;
  bool sim::render::RenderOptions::*shown;
};
constexpr HiddenPart kHidden[] = {
    {"fans", &sim::render::RenderOptions::scans},
    {"trails", &sim::render::RenderOptions::trails},
    {"labels", &sim::render::RenderOptions::names},
    {"goals", &sim::render::RenderOptions::goals},
    {"collisions", &sim::render::RenderOptions::collisions},
    {"legend", &sim::render::RenderOptions::legend},
    {"canvas", &sim::render::RenderOptions::canvas},
    {"traps", &sim::render::RenderOptions::traps},
    {"timers", &sim::render::RenderOptions::timers},
    {"texts", &sim::render::RenderOptions::texts},
    {"scores", &sim::render::RenderOptions::scores},
};

// In the order of sim::render::ColourBy.
constexpr std::string_view kColourSources[] = {"world", "robot", "none"};

// A function that parses a text with parse(text, value) and stores the value in the target.
template <typename T, typename Target>
auto into(Target& target, bool (*parse)(const std::string&, T&)) {
  return [&target, parse](const std::string& text) {
    T value{};
    if (!parse(text, value)) return false;
    target = value;
    return true;
  };
}

constexpr const char* kInterfaceChoicesExpected =
    "choices of the form [ROBOT.]INTERFACE:INDEX=DEVICE, separated by commas";

constexpr const char* kRealRobotChoicesExpected =
    "choices of the form ROBOT=SERVER, separated by commas";

// Variables of the environment, and what is wrong with them.
class Variables {
 public:
  // @param read  takes the text of a variable that is set; returns false if it expected something
  //              else.
  template <typename Read>
  void read(const char* name, const char* expected, Read read) {
    const std::string text(environment(name));
    if (!text.empty() && !read(text)) refuse(name, expected);
  }
  void refuse(const char* name, const char* expected) {
    issues_.push_back(
        {"run/environment", name, "", expected, '"' + std::string(environment(name)) + '"', ""});
  }
  // @throws sim::ConfigError if there were errors.
  void check() {
    if (!issues_.empty()) throw sim::ConfigError(std::move(issues_));
  }

 private:
  std::vector<sim::ConfigIssue> issues_;
};

void read_rules(Variables& variables, TaskRules& rules) {
  variables.read("PLAYPEN_TASK", kTaskRulesExpected, [&rules](const std::string& text) {
    const std::optional<TaskRules> read = parse_task_rules(text);
    rules = read.value_or(TaskRules{});
    return read.has_value();
  });
}

// The sockets to the processes that show the run.
void read_sockets(Variables& variables, RunSettings& settings) {
  const auto parse_descriptor = [](const std::string& text, int& descriptor) {
    return parse_whole(text, descriptor) && descriptor > 2;
  };
  variables.read("PLAYPEN_VIEW",
                 "the number of a descriptor above 2, as playpen run --view sets it",
                 into<int>(settings.view_socket, parse_descriptor));
  variables.read("PLAYPEN_PAGE",
                 "the number of a descriptor above 2, as playpen run --page sets it",
                 into<int>(settings.page_socket, parse_descriptor));
}

/// Reads at which state a run begins, and at which time it stops. @pre The grading is known.
void read_start_and_stop(Variables& variables, RunSettings& settings) {
  settings.start_state = environment("PLAYPEN_START");
  if (!settings.start_state.empty() && !settings.grading.nonce.empty()) {
    variables.refuse("PLAYPEN_START", "no state: a run that is graded begins at the beginning");
  }
  std::optional<RunStop>& stop = settings.stop;
  variables.read("PLAYPEN_UNTIL", kStopTimeExpected, [&stop](const std::string& text) {
    return parse_stop_time(text, stop.emplace().time_s);
  });
  variables.read("PLAYPEN_THEN", "\"debug\" or \"view\", with PLAYPEN_UNTIL beside it",
                 [&stop](const std::string& text) {
                   if (!stop || (text != "debug" && text != "view")) return false;
                   stop->then = text == "view" ? RunStop::Then::kView : RunStop::Then::kDebug;
                   return true;
                 });
}

// Reads choices that are separated by commas.
template <typename Choice>
void read_choices(Variables& variables, const char* name, const char* expected,
                  bool (*parse)(const std::string&, Choice&), std::vector<Choice>& choices) {
  variables.read(name, expected, [&](const std::string& text) {
    for (const std::string_view word : words_of(text)) {
      Choice choice;
      if (!parse(std::string(word), choice)) return false;
      choices.push_back(std::move(choice));
    }
    return true;
  });
}

}  // namespace

bool parse_time_mode(const std::string& text, sim::TimeMode& mode, double& factor) {
  if (text == "lockstep") {
    mode = sim::TimeMode::kLockstep;
    factor = 1.0;
    return true;
  }
  double value = 1.0;
  if (text != "real" && !(parse_whole(text, value) && positive(value) && value <= 1e6)) {
    return false;
  }
  mode = sim::TimeMode::kPaced;
  factor = value;
  return true;
}

bool parse_clients(const std::string& text, int& clients) {
  int read = 0;
  if (!parse_whole(text, read) || read < 1 || read > 1000) return false;
  clients = read;
  return true;
}

bool parse_robot_port(const std::string& text, int& port) {
  int read = 0;
  if (!parse_tcp_port(text, read) || read == 0 || read == kMorsePort) return false;
  port = read;
  return true;
}

bool parse_tcp_port(const std::string& text, int& port) {
  int read = 0;
  if (!parse_whole(text, read) || read < 0 || read > 65535) return false;
  port = read;
  return true;
}

bool parse_real_robot(const std::string& text, RealRobotChoice& choice) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos) return false;
  choice = {text.substr(0, equals), text.substr(equals + 1)};
  return sim::is_real_server(choice.server) && choice.server.find(',') == std::string::npos;
}

bool parse_film_fps(const std::string& text, double& frames_per_second) {
  return parse_within(text, 1.0, 240.0, frames_per_second);
}

bool parse_film_speed(const std::string& text, double& speed) {
  return parse_within(text, 0.01, 1000.0, speed);
}

bool parse_film_start(const std::string& text, double& from_s) {
  return parse_within(text, 0.0, kLongest_s, from_s);
}

bool parse_stop_time(const std::string& text, double& time_s) {
  return parse_within(text, 0.0, kLongest_s, time_s);
}

bool parse_film_size(const std::string& text, sim::render::RenderOptions& options) {
  constexpr int kLeast = 64;
  constexpr int kMost = 4096;
  const auto side = [](std::string_view word, int& px) {
    return parse_whole(word, px) && px >= kLeast && px <= kMost;
  };
  const std::size_t cross = text.find('x');
  int width = 0;
  int height = 0;
  if (!side(std::string_view(text).substr(0, cross), width)) return false;
  if (cross == std::string::npos) {
    options.size_px = width;
    options.width_px = options.height_px = 0;
    return true;
  }
  if (!side(std::string_view(text).substr(cross + 1), height)) return false;
  options.width_px = width;
  options.height_px = height;
  return true;
}

bool parse_crop(const std::string& text, sim::render::RenderOptions& options) {
  constexpr double kFarthest_m = 1e6;
  std::array<double, 4> numbers{};
  const std::vector<std::string_view> words = words_of(text);
  if (words.size() != numbers.size()) return false;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!parse_whole(words[i], numbers[i]) || !(std::abs(numbers[i]) <= kFarthest_m)) return false;
  }
  const sim::render::ScenePart part{{numbers[0], numbers[1]}, {numbers[2], numbers[3]}, false};
  if (!(part.size.minCoeff() >= 1e-3)) return false;
  options.part = part;
  return true;
}

bool parse_follow(const std::string& text, sim::render::RenderOptions& options) {
  const std::vector<std::string_view> words = words_of(text);
  double width_m = 0.0;
  if (words.empty() || words.size() > 2 || words[0].empty()) return false;
  if (words.size() == 2 &&
      (!parse_whole(words[1], width_m) || !(width_m >= 1e-3) || !(width_m <= 1e6))) {
    return false;
  }
  options.follow = words[0];
  options.follow_width_m = width_m;
  return true;
}

bool parse_hide(const std::string& text, sim::render::RenderOptions& options) {
  sim::render::RenderOptions read = options;
  for (const std::string_view word : words_of(text)) {
    const auto known = std::find_if(std::begin(kHidden), std::end(kHidden),
                                    [&](const HiddenPart& hidden) { return hidden.word == word; });
    if (known == std::end(kHidden)) return false;
    read.*known->shown = false;
  }
  options = read;
  return true;
}

bool parse_colour_by(const std::string& text, sim::render::RenderOptions& options) {
  for (std::size_t i = 0; i < std::size(kColourSources); ++i) {
    if (text != kColourSources[i]) continue;
    options.colour_by = static_cast<sim::render::ColourBy>(i);
    return true;
  }
  return false;
}

std::string film_size_text(const sim::render::RenderOptions& options) {
  if (options.width_px > 0) {
    return std::to_string(options.width_px) + 'x' + std::to_string(options.height_px);
  }
  return options.size_px == RunSettings{}.pictures.size_px ? "" : std::to_string(options.size_px);
}

std::string crop_text(const sim::render::RenderOptions& options) {
  if (!options.part) return "";
  const sim::render::ScenePart& part = *options.part;
  std::string text;
  for (const double number : {part.low.x(), part.low.y(), part.size.x(), part.size.y()}) {
    text += (text.empty() ? "" : ",") + sim::shortest_text(number);
  }
  return text;
}

std::string follow_text(const sim::render::RenderOptions& options) {
  if (options.follow.empty() || options.follow_width_m == 0.0) return options.follow;
  return options.follow + ',' + sim::shortest_text(options.follow_width_m);
}

std::string hide_text(const sim::render::RenderOptions& options) {
  std::string text;
  for (const HiddenPart& hidden : kHidden) {
    if (!(options.*hidden.shown)) text += (text.empty() ? "" : ",") + std::string(hidden.word);
  }
  return text;
}

std::string colour_by_text(const sim::render::RenderOptions& options) {
  const auto source = static_cast<std::size_t>(options.colour_by);
  return source == 0 ? "" : std::string(kColourSources[source]);
}

bool parse_snapshot_period(const std::string& text, double& period_s) {
  return parse_within(text, 0.001, kLongest_s, period_s);
}

double silence_limit_s_of_environment() {
  double limit_s = RunSettings{}.silence_limit_s;
  const std::string text(environment("PLAYPEN_SILENCE_LIMIT"));
  double given_s = 0.0;
  if (!text.empty() && parse_positive_seconds(text, given_s)) limit_s = given_s;
  return limit_s;
}

RunSettings RunSettings::from_environment() {
  RunSettings settings;
  Variables variables;
  variables.read(
      "PLAYPEN_SEED", "a whole number from 0 to 2^64 - 1",
      into<std::uint64_t>(settings.seed, [](const std::string& text, std::uint64_t& value) {
        return parse_whole(text, value);
      }));
  variables.read("PLAYPEN_DURATION", "a number of seconds in (0, 1e9]",
                 into<double>(settings.duration_s, parse_positive_seconds));
  variables.read("PLAYPEN_TIME", "\"lockstep\", \"real\" or a factor in (0, 1e6]",
                 [&](const std::string& text) {
                   sim::TimeMode mode = sim::TimeMode::kLockstep;
                   if (!parse_time_mode(text, mode, settings.time_factor)) return false;
                   settings.time_mode = mode;
                   return true;
                 });
  variables.read("PLAYPEN_SILENCE_LIMIT", "a number of seconds in (0, 1e9]",
                 into<double>(settings.silence_limit_s, parse_positive_seconds));
  read_sockets(variables, settings);
  variables.read("PLAYPEN_RESULTS", "figures", [&settings](const std::string& text) {
    settings.figures_only = text == "figures";
    return settings.figures_only;
  });
  settings.output_folder = environment("PLAYPEN_OUT");
  settings.kept_run = environment("PLAYPEN_STATE");
  settings.film = environment("PLAYPEN_RECORD");
  if (!settings.film.empty() && !sim::render::FilmWriter::is_film_name(settings.film)) {
    variables.refuse("PLAYPEN_RECORD", kFilmExpected);
  }
  variables.read("PLAYPEN_RECORD_FPS", kFilmFpsExpected,
                 into<double>(settings.film_fps, parse_film_fps));
  variables.read("PLAYPEN_RECORD_SPEED", kFilmSpeedExpected,
                 into<double>(settings.film_speed, parse_film_speed));
  variables.read("PLAYPEN_RECORD_FROM", kFilmStartExpected,
                 into<double>(settings.film_from_s, parse_film_start));
  using PictureParser = bool (*)(const std::string&, sim::render::RenderOptions&);
  const auto read_picture = [&](const char* name, const char* expected, PictureParser parse) {
    variables.read(name, expected,
                   [&](const std::string& text) { return parse(text, settings.pictures); });
  };
  read_picture("PLAYPEN_RECORD_SIZE", kFilmSizeExpected, parse_film_size);
  read_picture("PLAYPEN_FOLLOW", kFollowExpected, parse_follow);
  read_picture("PLAYPEN_CROP", kCropExpected, parse_crop);
  read_picture("PLAYPEN_HIDE", kHideExpected, parse_hide);
  read_picture("PLAYPEN_COLOUR_BY", kColourByExpected, parse_colour_by);
  variables.read("PLAYPEN_SNAPSHOT_EVERY", kSnapshotPeriodExpected,
                 into<double>(settings.snapshot_period_s, parse_snapshot_period));
  if (settings.snapshot_period_s && settings.output_folder.empty()) {
    settings.snapshot_period_s.reset();
    variables.refuse("PLAYPEN_SNAPSHOT_EVERY",
                     "PLAYPEN_OUT beside it, the folder for the pictures");
  }
  variables.read("PLAYPEN_VIEW_MODE", kViewModeExpected, [&](const std::string& text) {
    settings.view_mode = sim::parse_view_mode(text);
    return settings.view_mode.has_value();
  });
  variables.read("PLAYPEN_REALISM", kRealismExpected, [&](const std::string& text) {
    settings.realism = sim::parse_realism(text);
    return settings.realism.has_value();
  });
  settings.grading.nonce = environment("PLAYPEN_GRADE");
  read_rules(variables, settings.grading.rules);
  variables.read("PLAYPEN_CLIENTS", kClientsExpected, into<int>(settings.clients, parse_clients));
  read_choices(variables, "PLAYPEN_INTERFACES", kInterfaceChoicesExpected, parse_interface_choice,
               settings.interfaces);
  read_choices(variables, "PLAYPEN_REAL", kRealRobotChoicesExpected, parse_real_robot,
               settings.real_robots);
  variables.read("PLAYPEN_PORT", kRobotPortExpected,
                 into<int>(settings.robot_port, parse_robot_port));
  variables.read("PLAYPEN_PLAYER_PORT", kTcpPortExpected,
                 into<int>(settings.player_port, parse_tcp_port));
  read_start_and_stop(variables, settings);
  settings.take_over = is_set("PLAYPEN_TAKE_OVER");
  settings.progress = is_set("PLAYPEN_PROGRESS");
  settings.quiet_end = is_set("PLAYPEN_RUN");
  settings.virtual_time = is_set("PLAYPEN_VIRTUAL_TIME");
  variables.check();
  return settings;
}

namespace {

// @throws sim::ConfigError if the world does not contain the robot or the part that pictures show.
void check_pictures(const sim::render::RenderOptions& pictures,
                    const sim::WorldDescription& world) {
  const std::string place = world.file.empty() ? world.name : world.file;
  if (!pictures.follow.empty()) {
    std::vector<std::string> names;
    std::string list;
    for (const sim::RobotDescription& robot : world.robots) {
      if (robot.name == pictures.follow) return;
      names.push_back(robot.name);
      list += (list.empty() ? "" : ", ") + robot.name;
    }
    const std::string near = sim::nearest_word(pictures.follow, names);
    throw sim::ConfigError(std::vector<sim::ConfigIssue>{
        {"run/follow", place, "/robots", "a robot to follow: " + (list.empty() ? "none" : list),
         '"' + pictures.follow + '"', near.empty() ? "" : "did you mean \"" + near + "\"?"}});
  }
  if (!pictures.part) return;
  const sim::Vec2 low = pictures.part->low.cwiseMax(world.arena.origin);
  const sim::Vec2 high =
      (pictures.part->low + pictures.part->size).cwiseMin(world.arena.origin + world.arena.size);
  if ((high - low).minCoeff() > 0.0) return;
  const auto number = [](double value) { return sim::rounded_text(value, 4); };
  const sim::Vec2 end = world.arena.origin + world.arena.size;
  throw sim::ConfigError(std::vector<sim::ConfigIssue>{
      {"run/crop", place, "/arena",
       "a part of the floor, which reaches from " + number(world.arena.origin.x()) + ", " +
           number(world.arena.origin.y()) + " to " + number(end.x()) + ", " + number(end.y()),
       crop_text(pictures), ""}});
}

// @throws sim::ConfigError run/real for each robot that the world lacks.
void bind_real_robots(sim::WorldDescription& world, const std::vector<RealRobotChoice>& choices) {
  std::vector<sim::ConfigIssue> issues;
  for (const RealRobotChoice& choice : choices) {
    std::vector<std::string> names;
    std::string list;
    bool found = false;
    for (sim::RobotDescription& robot : world.robots) {
      names.push_back(robot.name);
      list += (list.empty() ? "" : ", ") + robot.name;
      if (robot.name != choice.robot) continue;
      found = true;
      if (!robot.real) robot.real.emplace();
      robot.real->server = choice.server;
    }
    if (found) continue;
    const std::string near = sim::nearest_word(choice.robot, names);
    issues.push_back({"run/real", "--real " + choice.text(), "",
                      "a robot of the world: " + (list.empty() ? "none" : list),
                      '"' + choice.robot + '"',
                      near.empty() ? "" : "did you mean \"" + near + "\"?"});
  }
  if (!issues.empty()) throw sim::ConfigError(std::move(issues));
}

// Moves the ports of all robots, so that the lowest one becomes the given one.
// @throws sim::ConfigError run/port.
void move_ports(sim::WorldDescription& world, int lowest) {
  if (world.robots.empty()) return;
  const auto by_port = [](const sim::RobotDescription& a, const sim::RobotDescription& b) {
    return a.port < b.port;
  };
  const auto [first, last] = std::minmax_element(world.robots.begin(), world.robots.end(), by_port);
  const int shift = lowest - first->port;
  const int highest = 65535 - (last->port - first->port);
  std::string forbidden;
  for (const sim::RobotDescription& robot : world.robots) {
    if (robot.port + shift == kMorsePort) forbidden = robot.name;
  }
  if (lowest > highest || !forbidden.empty()) {
    throw sim::ConfigError(std::vector<sim::ConfigIssue>{
        {"run/port", "--port " + std::to_string(lowest), "",
         forbidden.empty()
             ? "a port up to " + std::to_string(highest) + ", since other robots have higher ones"
             : "ports without 4000, the port of all robots, which robot " + forbidden +
                   " would get",
         std::to_string(lowest), ""}});
  }
  if (world.robots_on_port != 0) world.robots_on_port += shift;
  for (sim::RobotDescription& robot : world.robots) {
    // The real one at its server keeps its port.
    if (robot.real && robot.real->port == 0) robot.real->port = robot.port;
    robot.port += shift;
  }
}

// A real robot lives in real time.
// @throws sim::ConfigError run/real-time.
void require_real_time(sim::WorldDescription& world) {
  const auto mirroring = std::find_if(world.robots.begin(), world.robots.end(),
                                      [](const sim::RobotDescription& r) { return r.real; });
  if (mirroring == world.robots.end()) return;
  sim::SimulationDescription& simulation = world.simulation;
  if (!simulation.time_mode_given) {
    simulation.time_mode = sim::TimeMode::kPaced;
    simulation.time_factor = 1.0;
    simulation.time_mode_given = true;
  }
  const bool lockstep = simulation.time_mode == sim::TimeMode::kLockstep;
  if (!lockstep && simulation.time_factor == 1.0) return;
  throw sim::ConfigError(std::vector<sim::ConfigIssue>{
      {"run/real-time", world.file.empty() ? world.name : world.file, "/simulation/time",
       "real time, since robot " + mirroring->name + " mirrors a real one",
       lockstep ? "lockstep" : sim::rounded_text(simulation.time_factor, 6) + " times real time",
       "leave out --time and \"time\", or choose \"real\""}});
}

}  // namespace

void RunSettings::apply_to(sim::WorldDescription& world) const {
  check_pictures(pictures, world);
  if (seed) world.simulation.seed = *seed;
  if (duration_s) world.simulation.duration_ns = sim::from_seconds(*duration_s);
  if (time_mode) {
    world.simulation.time_mode = *time_mode;
    world.simulation.time_mode_given = true;
    world.simulation.time_factor = time_factor;
  }
  if (clients) world.simulation.start_gate_clients = *clients;
  if (realism) world.simulation.realism = *realism;
  if (view_mode) {
    if (world.canvas.view_mode_locked && *view_mode != world.canvas.view_mode) {
      sim::ConfigIssue issue{"run/view_mode_locked",
                             world.file.empty() ? world.name : world.file,
                             "/canvas/lock_view_mode",
                             "the view mode that the world locks, \"" +
                                 std::string(sim::to_string(world.canvas.view_mode)) + '"',
                             '"' + std::string(sim::to_string(*view_mode)) + '"',
                             ""};
      throw sim::ConfigError(std::vector<sim::ConfigIssue>{std::move(issue)});
    }
    world.canvas.view_mode = *view_mode;
  }
  apply_interface_choices(world, interfaces);
  bind_real_robots(world, real_robots);
  for (sim::RobotDescription& robot : world.robots) {
    if (robot.real && take_over) robot.real->take_over = true;
  }
  if (robot_port) move_ports(world, *robot_port);
  require_real_time(world);
}

}  // namespace playerlike
