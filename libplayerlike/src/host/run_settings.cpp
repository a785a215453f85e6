// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/run_settings.h"

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

// Longest run that simulated time can count.
constexpr double kLongest_s = 1e9;

bool positive(double value) { return std::isfinite(value) && value > 0.0; }

// Reads a number in [least, most].
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
  std::vector<sim::ConfigIssue> issues;
  const auto wrong = [&issues](const char* name, std::string expected) {
    issues.push_back({"run/environment", name, "", std::move(expected),
                      '"' + std::string(environment(name)) + '"', ""});
  };
  if (const auto text = environment("PLAYPEN_SEED"); !text.empty()) {
    std::uint64_t seed = 0;
    if (parse_whole(text, seed)) {
      settings.seed = seed;
    } else {
      wrong("PLAYPEN_SEED", "a whole number from 0 to 2^64 - 1");
    }
  }
  if (const auto text = environment("PLAYPEN_DURATION"); !text.empty()) {
    double duration_s = 0.0;
    if (parse_whole(text, duration_s) && positive(duration_s) && duration_s <= kLongest_s) {
      settings.duration_s = duration_s;
    } else {
      wrong("PLAYPEN_DURATION", "a number of seconds in (0, 1e9]");
    }
  }
  if (const auto text = environment("PLAYPEN_TIME"); !text.empty()) {
    sim::TimeMode mode = sim::TimeMode::kLockstep;
    if (parse_time_mode(std::string(text), mode, settings.time_factor)) {
      settings.time_mode = mode;
    } else {
      wrong("PLAYPEN_TIME", "\"lockstep\", \"real\" or a factor in (0, 1e6]");
    }
  }
  if (const auto text = environment("PLAYPEN_SILENCE_LIMIT"); !text.empty()) {
    double limit_s = 0.0;
    if (parse_whole(text, limit_s) && positive(limit_s) && limit_s <= kLongest_s) {
      settings.silence_limit_s = limit_s;
    } else {
      wrong("PLAYPEN_SILENCE_LIMIT", "a number of seconds in (0, 1e9]");
    }
  }
  if (const auto text = environment("PLAYPEN_VIEW"); !text.empty()) {
    int descriptor = 0;
    if (parse_whole(text, descriptor) && descriptor > 2) {
      settings.view_socket = descriptor;
    } else {
      wrong("PLAYPEN_VIEW", "the number of a descriptor above 2, as playpen run --view sets it");
    }
  }
  settings.output_folder = environment("PLAYPEN_OUT");
  settings.kept_run = environment("PLAYPEN_STATE");
  settings.film = environment("PLAYPEN_RECORD");
  if (!settings.film.empty() && !sim::render::FilmWriter::is_film_name(settings.film)) {
    wrong("PLAYPEN_RECORD", kFilmExpected);
  }
  const auto text_of = [](const char* name) { return std::string(environment(name)); };
  if (const std::string text = text_of("PLAYPEN_RECORD_FPS");
      !text.empty() && !parse_film_fps(text, settings.film_fps)) {
    wrong("PLAYPEN_RECORD_FPS", kFilmFpsExpected);
  }
  if (const std::string text = text_of("PLAYPEN_RECORD_SPEED");
      !text.empty() && !parse_film_speed(text, settings.film_speed)) {
    wrong("PLAYPEN_RECORD_SPEED", kFilmSpeedExpected);
  }
  if (const std::string text = text_of("PLAYPEN_SNAPSHOT_EVERY"); !text.empty()) {
    double period_s = 0.0;
    if (!parse_snapshot_period(text, period_s)) {
      wrong("PLAYPEN_SNAPSHOT_EVERY", kSnapshotPeriodExpected);
    } else if (settings.output_folder.empty()) {
      wrong("PLAYPEN_SNAPSHOT_EVERY", "PLAYPEN_OUT beside it, the folder for the pictures");
    } else {
      settings.snapshot_period_s = period_s;
    }
  }
  if (const std::string text = text_of("PLAYPEN_VIEW_MODE"); !text.empty()) {
    settings.view_mode = sim::parse_view_mode(text);
    if (!settings.view_mode) wrong("PLAYPEN_VIEW_MODE", kViewModeExpected);
  }
  settings.grading.nonce = environment("PLAYPEN_GRADE");
  if (const std::string text = text_of("PLAYPEN_CLIENTS"); !text.empty()) {
    int clients = 0;
    if (parse_clients(text, clients)) {
      settings.clients = clients;
    } else {
      wrong("PLAYPEN_CLIENTS", kClientsExpected);
    }
  }
  settings.progress = is_set("PLAYPEN_PROGRESS");
  settings.quiet_end = is_set("PLAYPEN_RUN");
  settings.virtual_time = is_set("PLAYPEN_VIRTUAL_TIME");
  if (!issues.empty()) throw sim::ConfigError(std::move(issues));
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
}

}  // namespace playerlike
