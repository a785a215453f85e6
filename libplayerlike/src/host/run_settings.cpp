// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/run_settings.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "sim/core/error.h"
#include "sim/core/time.h"

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
  settings.output_folder = environment("PLAYPEN_OUT");
  settings.film = environment("PLAYPEN_RECORD");
  settings.progress = is_set("PLAYPEN_PROGRESS");
  settings.quiet_end = is_set("PLAYPEN_RUN");
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
}

}  // namespace playerlike
