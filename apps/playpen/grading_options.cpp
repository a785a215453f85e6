// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grading_options.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <thread>

#include "parsed_option.h"

namespace playpen {
namespace {

/// "1,7,9": these seeds; "5": the seeds 1 to 5.
bool parse_seeds(const std::string& text, std::vector<std::uint64_t>& seeds) {
  constexpr std::uint64_t kMost = 10'000;
  seeds.clear();
  if (text.find(',') == std::string::npos) {
    std::uint64_t count = 0;
    if (!parse_number(text, count) || count < 1 || count > kMost) return false;
    for (std::uint64_t seed = 1; seed <= count; ++seed) seeds.push_back(seed);
    return true;
  }
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    std::uint64_t seed = 0;
    if (!parse_number(part, seed) || seeds.size() == kMost) return false;
    if (std::find(seeds.begin(), seeds.end(), seed) != seeds.end()) return false;
    seeds.push_back(seed);
  }
  return !seeds.empty();
}

}  // namespace

void add_time_limit(CLI::App& command, const char* name, const char* description,
                    std::optional<double>& limit_s) {
  add_parsed(command, name, description, "S", "a number of seconds above 0",
             [&limit_s](const std::string& text) {
               double seconds = 0.0;
               const bool good =
                   parse_number(text, seconds) && std::isfinite(seconds) && seconds > 0.0;
               if (good) limit_s = seconds;
               return good;
             });
}

void add_jobs(CLI::App& command, int& jobs) {
  jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  add_parsed(command, "--jobs", "Programs that run side by side [the number of processors]", "N",
             "a whole number from 1 to 1000", [&jobs](const std::string& text) {
               return parse_number(text, jobs) && jobs >= 1 && jobs <= 1000;
             });
}

void add_grading_options(CLI::App& command, std::vector<std::uint64_t>& seeds, int& jobs,
                         std::optional<double>& timeout_s) {
  add_parsed(command, "--seeds", "N: the seeds 1 to N; or a list of seeds, '7,' for one", "N,N,...",
             "a number from 1 to 10000, or different seeds with commas between them",
             [&seeds](const std::string& text) { return parse_seeds(text, seeds); });
  add_jobs(command, jobs);
  add_time_limit(command, "--timeout", "Wall-clock limit of a run [the task's]", timeout_s);
}

}  // namespace playpen
