// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/run_settings.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/core/error.h"
#include "sim/core/time.h"
#include "sim/render/render.h"
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

bool parse_film_fps(const std::string& text, double& frames_per_second) {
  return parse_within(text, 1.0, 240.0, frames_per_second);
}

bool parse_film_speed(const std::string& text, double& speed) {
  return parse_within(text, 0.01, 1000.0, speed);
}

bool parse_snapshot_period(const std::string& text, double& period_s) {
  return parse_within(text, 0.001, kLongest_s, period_s);
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
  variables.read("PLAYPEN_VIEW",
                 "the number of a descriptor above 2, as playpen run --view sets it",
                 into<int>(settings.view_socket, [](const std::string& text, int& descriptor) {
                   return parse_whole(text, descriptor) && descriptor > 2;
                 }));
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
  settings.grading.nonce = environment("PLAYPEN_GRADE");
  variables.read("PLAYPEN_CLIENTS", kClientsExpected, into<int>(settings.clients, parse_clients));
  variables.read("PLAYPEN_INTERFACES", kInterfaceChoicesExpected, [&](const std::string& text) {
    std::size_t begin = 0;
    while (begin <= text.size()) {
      const std::size_t end = std::min(text.find(',', begin), text.size());
      InterfaceChoice choice;
      if (!parse_interface_choice(text.substr(begin, end - begin), choice)) return false;
      settings.interfaces.push_back(std::move(choice));
      begin = end + 1;
    }
    return true;
  });
  settings.progress = is_set("PLAYPEN_PROGRESS");
  settings.quiet_end = is_set("PLAYPEN_RUN");
  settings.virtual_time = is_set("PLAYPEN_VIRTUAL_TIME");
  variables.check();
  return settings;
}

void RunSettings::apply_to(sim::WorldDescription& world) const {
  if (seed) world.simulation.seed = *seed;
  if (duration_s) world.simulation.duration_ns = sim::from_seconds(*duration_s);
  if (time_mode) {
    world.simulation.time_mode = *time_mode;
    world.simulation.time_mode_given = true;
    world.simulation.time_factor = time_factor;
  }
  if (clients) world.simulation.start_gate_clients = *clients;
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
}

}  // namespace playerlike
