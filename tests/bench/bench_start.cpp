// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Cost of starting: the libraries that a plain client loads, the processor time from exec to the
// end of its first Read(), and the processor time of a whole run of a minute with its pictures and
// of one with a film; and the parts of a graded run. The times are user and kernel time of the
// child processes, as getrusage() reports them, not wall-clock time.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "figures.h"

namespace {

namespace fs = std::filesystem;

constexpr int kRuns = 50;
constexpr int kFilms = 3;
constexpr int kGrades = 10;
constexpr int kFilm_s = 20;

double milliseconds(const timeval& time) {
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_usec);
}

struct Cost {
  double processor_ms = 0.0;
  double memory_mb = 0.0;  ///< largest resident set of a process
};

/// Runs a program and discards its output. @return the cost of it and its children.
Cost cost_of(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& part : command) arguments.push_back(const_cast<char*>(part.c_str()));
  arguments.push_back(nullptr);
  std::fflush(stdout);  // or the child prints it again
  const pid_t child = fork();
  if (child == 0) {
    if (std::freopen("/dev/null", "w", stdout) == nullptr) _exit(127);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  if (child < 0 || wait4(child, &status, 0, &usage) != child || status != 0) {
    throw std::runtime_error(command[0] + " failed");
  }
  return {milliseconds(usage.ru_utime) + milliseconds(usage.ru_stime),
          static_cast<double>(usage.ru_maxrss) / 1e3};
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The median processor times of several commands [ms]. The commands take turns, so that a
/// disturbance affects all.
std::vector<double> medians_ms(const std::vector<std::vector<std::string>>& commands,
                               int runs = kRuns) {
  std::vector<std::vector<double>> times(commands.size());
  for (int run = 0; run < runs; ++run) {
    for (std::size_t i = 0; i < commands.size(); ++i) {
      times[i].push_back(cost_of(commands[i]).processor_ms);
    }
  }
  std::vector<double> result;
  result.reserve(times.size());
  for (auto& values : times) result.push_back(median(std::move(values)));
  return result;
}

#ifdef SOLUTION
/// A graded run of the introduction, 120 s long, and its parts.
void grade_figures(const std::string& out) {
  const std::string task = PLAYPEN_SOURCE_DIR "/worlds/tasks/par_intro";
  const auto run = [&](const std::string& seconds) {
    return std::vector<std::string>{
        PLAYPEN_COMMAND, "run",   task + ".json", "--quiet", "--out", out,
        "--duration",    seconds, "--",           SOLUTION};
  };
  const std::vector<double> ms =
      medians_ms({{PLAYPEN_COMMAND, "grade", task + ".task.json", "--seeds", "1,", "--jobs", "1",
                   "--out", out, "--", SOLUTION},
                  run("120"),
                  run("0.1")},
                 kGrades);
  std::printf(
      "processor time, medians of %d: a graded run of 120 s %.0f ms, of which start and pictures\n"
      "%.0f ms, the program and the simulation %.0f ms, the grade %.0f ms\n",
      kGrades, ms[0], ms[2], ms[1] - ms[2], ms[0] - ms[1]);
  sim::bench::figure("graded_120s_cpu_ms", ms[0]);
  sim::bench::figure("graded_start_and_pictures_cpu_ms", ms[2]);
  sim::bench::figure("graded_driving_cpu_ms", ms[1] - ms[2]);
  sim::bench::figure("graded_judging_cpu_ms", ms[0] - ms[1]);
}
#endif

/// The number after the last blank of the last line that a command prints.
double last_number(const std::string& command) {
  std::FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error(command + " failed");
  std::array<char, 1024> line{};
  std::string last;
  while (std::fgets(line.data(), line.size(), pipe) != nullptr) last = line.data();
  if (pclose(pipe) != 0) throw std::runtime_error(command + " failed");
  return std::stod(last.substr(last.find_last_of(' ') + 1));
}

}  // namespace

int main() {
  try {
    const fs::path out = fs::temp_directory_path() / ("bench_start_" + std::to_string(getpid()));
    // The user's settings must not affect the measured start.
    for (const char* name : {"PLAYPEN_WORLD", "PLAYPEN_OUT", "PLAYPEN_VIEW", "PLAYPEN_RECORD"}) {
      unsetenv(name);
    }
    const std::vector<double> ms =
        medians_ms({{EMPTY_PROGRAM},
                    {PLAIN_CLIENT},
                    {PLAYPEN_COMMAND, "--version"},
                    {PLAYPEN_COMMAND, "run", PLAYPEN_SOURCE_DIR "/worlds/cave.json", "--duration",
                     "60", "--quiet", "--out", out.string(), "--", SONAR_WANDERER}});
    std::printf(
        "processor time, medians of %d: empty program %.2f ms, plain client %.2f ms,\n"
        "playpen --version %.2f ms, a minute in the cave with its pictures %.1f ms\n",
        kRuns, ms[0], ms[1], ms[2], ms[3]);
    sim::bench::figure("libraries_loaded", last_number(PLAIN_CLIENT));
    sim::bench::figure("start_cpu_ms", ms[1] - ms[0]);
    sim::bench::figure("version_cpu_ms", ms[2] - ms[0]);
    sim::bench::figure("run_60s_cpu_ms", ms[3]);
    const std::vector<std::string> run = {PLAYPEN_COMMAND,
                                          "run",
                                          PLAYPEN_SOURCE_DIR "/worlds/cave.json",
                                          "--quiet",
                                          "--out",
                                          out.string(),
                                          "--duration",
                                          std::to_string(kFilm_s),
                                          "--",
                                          SONAR_WANDERER};
    std::vector<std::string> film = run;
    film.insert(film.begin() + 3, {"--record", (out.string() + ".mp4")});
    const std::vector<double> films = medians_ms({run, film}, kFilms);
    const double film_memory_mb = cost_of(film).memory_mb;
    std::printf("a film of %d s: %.0f ms and %.0f MB\n", kFilm_s, films[1] - films[0],
                film_memory_mb);
    sim::bench::figure("film_cpu_ms_per_s", (films[1] - films[0]) / kFilm_s);
    sim::bench::figure("film_memory_mb", film_memory_mb);
#ifdef SOLUTION
    grade_figures(out.string());
#endif
    fs::remove_all(out);
    fs::remove(out.string() + ".mp4");
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_start: %s\n", error.what());
    return 1;
  }
}
