// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <system_error>

#include "commands.h"
#include "fuzz/search.h"
#include "grade/task.h"
#include "grade/text.h"
#include "playerlike/host/program.h"
#include "preload.h"
#include "shipped.h"
#include "sim/core/error.h"
#include "sim/core/number_text.h"
#include "terminal.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// A folder for the files of the runs, in memory if the system has such a place.
class RunFolder {
 public:
  RunFolder() {
    std::error_code error;
    const fs::path memory("/dev/shm");
    const fs::path base =
        access(memory.c_str(), W_OK) == 0 ? memory : fs::temp_directory_path(error);
    std::string name = (base / "playpen_fuzz_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw std::system_error(errno, std::generic_category(),
                              "no folder for runs in " + base.string());
    }
    path_ = name;
  }
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
  ~RunFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  [[nodiscard]] const fs::path& path() const noexcept { return path_; }

 private:
  fs::path path_;
};

volatile std::sig_atomic_t interrupted = 0;

/// Notes signals that ask this process to end, instead of ending at once: the processes and files
/// of the search are then removed.
class NotedSignals {
 public:
  NotedSignals() {
    struct sigaction noted {};
    noted.sa_handler = [](int /*signal*/) { interrupted = 1; };
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
      sigaction(kSignals[i], nullptr, &before_[i]);
      // Under nohup one stays ignored.
      if (before_[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &noted, nullptr);
    }
  }
  NotedSignals(const NotedSignals&) = delete;
  NotedSignals& operator=(const NotedSignals&) = delete;
  ~NotedSignals() {
    for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
  }

 private:
  static constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, kSignals.size()> before_{};
};

/// Ends a run of this process that takes too long: another process sends SIGTERM, which run() hands
/// on to the program. So the results of the run are written.
class Watchdog {
 public:
  explicit Watchdog(double after_s) : process_(fork()) {
    if (process_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (process_ > 0) return;
    usleep(static_cast<useconds_t>(1e6 * after_s));
    kill(getppid(), SIGTERM);
    _exit(kFired);
  }
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;
  ~Watchdog() { static_cast<void>(stop()); }

  /// Sends no signal from now on. @return whether it has sent it.
  [[nodiscard]] bool stop() {
    if (process_ > 0) {
      kill(process_, SIGKILL);
      int status = 0;
      waitpid(process_, &status, 0);
      fired_ = WIFEXITED(status) && WEXITSTATUS(status) == kFired;
    }
    process_ = -1;
    return fired_;
  }

 private:
  static constexpr int kFired = 1;
  pid_t process_;
  bool fired_ = false;
};

/// What is run, and what counts as a failure.
struct Subject {
  std::string name;        ///< of the world or task
  std::string world_file;  ///< "": the default world
  std::string robot;       ///< "": the first
  std::vector<std::string> program;
  fuzz::Rules rules;
  std::string task_file;  ///< "": it is no task
};

// A task, or otherwise a world.
Subject subject_of(const FuzzRequest& request) {
  Subject subject;
  subject.program = request.command;
  subject.robot = request.robot;
  subject.rules.expectations = request.expectations;
  std::optional<grade::Task> task;
  try {
    task = load_task(request.world);
  } catch (const sim::ConfigError&) {
    subject.world_file = find_world(request.world);
  }
  if (task) {
    const grade::TaskWorld& world = task->worlds.front();
    subject.world_file = world.file;
    subject.task_file = task->file;
    subject.rules.goal = world.goal ? world.goal : task->goal;
    if (subject.robot.empty()) subject.robot = task->robot;
    for (const std::string& word : task->arguments) subject.program.push_back(word);
    for (const std::string& word : world.arguments) subject.program.push_back(word);
    const bool allows_contacts = !task->thresholds.max_collisions;
    if (allows_contacts) std::erase(subject.rules.kinds, fuzz::Kind::kCollision);
    subject.name = task->name;
  } else {
    subject.name = grade::world_name(subject.world_file);
  }
  if (!request.kinds.empty()) subject.rules.kinds = request.kinds;
  return subject;
}

// The expectation that a test of a finding has; "": none but that the program ends well.
std::string expectation_of(const fuzz::Finding& finding, const std::string& robot) {
  switch (finding.failure.kind) {
    case fuzz::Kind::kCollision:
      return robot + ".collisions == 0";
    case fuzz::Kind::kStall:
      return robot + ".stalled_time < 3";
    case fuzz::Kind::kVerdict:
      return "passed == yes";
    case fuzz::Kind::kExpectation:
      return finding.failure.with;
    default:
      return "";
  }
}

/// Writes what was found.
class FoundWorlds {
 public:
  /// @param hang_limit_s  of a run that hangs [s].
  FoundWorlds(const FuzzRequest& request, const Subject& subject, const fuzz::Base& base,
              double hang_limit_s)
      : request_(request),
        subject_(subject),
        base_(base),
        hang_limit_s_(hang_limit_s),
        begin_(Clock::now()) {
    fs::create_directories(request.output_folder);
    if (!request.keep_folder.empty()) fs::create_directories(request.keep_folder);
  }

  void add(const fuzz::Finding& finding) {
    const std::string number = std::to_string(++count_);
    const fs::path file = fs::path(request_.output_folder) / (number + ".json");
    const std::string robot = base_.robot_description().name;
    const RunRequest run = run_of(finding, file);
    const std::string expectation = expectation_of(finding, robot);
    const std::string what = std::string(fuzz::name_of(finding.failure.kind)) + ": " + robot + ' ' +
                             finding.failure.text;
    const std::string call = call_of(finding, run, expectation);
    grade::write_text_file(file.string(), "// Found by playpen fuzz, " + what + "\n// In " +
                                              fuzz::description_of(finding.scenario) +
                                              "\n// Again: " + call + '\n' + finding.world.text +
                                              '\n');
    const auto spent = std::chrono::duration<double>(Clock::now() - begin_).count();
    std::cout << number << ". found after " << sim::fixed_text(spent, 0) << " s and "
              << finding.after_runs << " runs, " << what << '\n'
              << "   in " << fuzz::description_of(finding.scenario) << '\n'
              << "   world: " << file.string() << '\n'
              << "   again: " << call << std::endl;
    if (interrupted == 0) run_again(finding, run);
    if (!request_.keep_folder.empty()) keep(finding, file, expectation);
  }

  [[nodiscard]] std::size_t count() const noexcept { return count_; }

 private:
  [[nodiscard]] RunRequest run_of(const fuzz::Finding& finding, const fs::path& file) const {
    RunRequest run;
    run.world = file.string();
    run.settings.output_folder = (file.parent_path() / file.stem()).string();
    run.settings.time_mode = sim::TimeMode::kLockstep;
    run.settings.duration_s = duration_of(finding);
    run.command = subject_.program;
    return run;
  }
  // Runs the program in a process of its own, with pictures and a recording.
  void run_again(const fuzz::Finding& finding, RunRequest run) const {
    run.quiet = true;
    if (!happens_again(finding, run)) {
      std::cout << "   It did not happen again in a process of its own: the program depends on "
                   "more than its world.\n";
    }
    std::cout << "   picture: " << run.settings.output_folder << "/scene.png\n"
              << "   reasons: playpen why " << run.settings.output_folder << std::endl;
  }
  [[nodiscard]] bool happens_again(const fuzz::Finding& finding, const RunRequest& run) const {
    const fuzz::Kind kind = finding.failure.kind;
    if (kind == fuzz::Kind::kHang) {
      Watchdog watchdog(hang_limit_s_);
      static_cast<void>(playpen::run(run));
      const bool hangs = watchdog.stop();
      if (hangs) interrupted = 0;  // its signal may have come after the run
      return hangs;
    }
    const int status = playpen::run(run);
    if (kind == fuzz::Kind::kSanitizer) return true;  // its status depends on the sanitizer
    if (kind < fuzz::Kind::kCollision) return status != kOk;
    const auto again = fuzz::failure_of(fuzz::result_in(run.settings.output_folder), subject_.rules,
                                        base_, finding.world);
    return again && again->kind == kind;
  }
  // A second after the failure, if its time is known.
  [[nodiscard]] double duration_of(const fuzz::Finding& finding) const {
    if (finding.failure.kind != fuzz::Kind::kCollision) return request_.duration_s;
    return std::min(std::ceil(finding.failure.time_s) + 1.0, request_.duration_s);
  }
  [[nodiscard]] std::string call_of(const fuzz::Finding& finding, const RunRequest& run,
                                    const std::string& expectation) const {
    std::string call = finding.failure.kind == fuzz::Kind::kHang
                           ? "timeout " + sim::shortest_text(hang_limit_s_) + ' '
                           : std::string();
    call += "playpen run " + shell_word(run.world) + " --duration " +
            sim::shortest_text(*run.settings.duration_s);
    if (!expectation.empty()) call += " --expect " + shell_word(expectation);
    call += " --";
    for (const std::string& word : run.command) call += ' ' + shell_word(word);
    return call;
  }

  // Copies the world, and adds a test of it to found.cmake.
  void keep(const fuzz::Finding& finding, const fs::path& file,
            const std::string& expectation) const {
    const fs::path folder(request_.keep_folder);
    fs::create_directories(folder);
    std::string name;
    for (int i = 1;; ++i) {
      name = subject_.name + '_' + std::string(fuzz::name_of(finding.failure.kind)) + '_' +
             std::to_string(i);
      if (!fs::exists(folder / (name + ".json"))) break;
    }
    fs::copy_file(file, folder / (name + ".json"));
    std::string test = "playpen_add_test(NAME " + name + " COMMAND ${PLAYPEN_FOUND_PROGRAM}";
    for (std::size_t i = 1; i < subject_.program.size(); ++i) {
      test += " \"" + subject_.program[i] + '"';
    }
    test += "\n  WORLD \"${CMAKE_CURRENT_LIST_DIR}/" + name + ".json\" DURATION " +
            sim::shortest_text(duration_of(finding)) + " SEEDS " +
            std::to_string(finding.scenario.seed);
    if (!expectation.empty()) test += " EXPECT \"" + expectation + '"';
    std::ofstream tests(folder / "found.cmake", std::ios::app);
    tests << test << ")\n";
    tests.close();
    if (!tests) throw std::runtime_error((folder / "found.cmake").string() + " cannot be written");
    std::cout << "   kept: " << (folder / (name + ".json")).string() << std::endl;
  }

  const FuzzRequest& request_;
  const Subject& subject_;
  const fuzz::Base& base_;
  const double hang_limit_s_;
  const Clock::time_point begin_;
  std::size_t count_ = 0;
};

// A program that computes too long hangs: its run does not go on without it, as results would then
// depend on the wall clock.
constexpr double kNoSilenceLimit_s = 3600.0;

fuzz::RunnerSettings runner_settings(const FuzzRequest& request, const Subject& subject,
                                     const RunFolder& folder,
                                     const PreloadedLibrary& virtual_time) {
  playerlike::RunSettings settings;
  settings.figures_only = true;
  settings.quiet_end = true;
  settings.virtual_time = true;
  settings.time_mode = sim::TimeMode::kLockstep;
  settings.silence_limit_s = kNoSilenceLimit_s;
  fuzz::RunnerSettings runner;
  runner.program = subject.program;
  runner.environment = playerlike::run_environment("", settings);
  add_libraries_folder(runner.environment);
  virtual_time.add_to(runner.environment);
  runner.folder = folder.path();
  runner.jobs = static_cast<std::size_t>(request.jobs);
  runner.duration_s = request.duration_s;
  runner.is_interrupted = [] { return interrupted != 0; };
  runner.limit_s = request.timeout_s.value_or(runner.limit_s);
  return runner;
}

}  // namespace

int fuzz_program(FuzzRequest request) {
  Subject subject = subject_of(request);
  subject.program.front() = playerlike::find_program(subject.program.front());
  request.freedom.task_file = subject.task_file;
  const fuzz::Base base(subject.world_file, subject.robot, request.freedom);
  for (const expect::Expectation& one : request.expectations) one.require_robot_of(base.world());
  if (request.output_folder.empty()) request.output_folder = "out/fuzz/" + subject.name;
  const NotedSignals signals;
  const RunFolder folder;
  const PreloadedLibrary virtual_time;
  fuzz::Runner runner(runner_settings(request, subject, folder, virtual_time));
  FoundWorlds findings(request, subject, base, runner.settings().limit_s);
  const auto begin = Clock::now();
  fuzz::SearchSettings settings;
  settings.seed = request.seed;
  settings.guided = !request.random;
  settings.most_findings = request.most_findings;
  settings.most_runs = request.runs.value_or(std::numeric_limits<std::size_t>::max());
  const double budget_s =
      request.budget_s.value_or(request.runs ? std::numeric_limits<double>::infinity() : 60.0);
  settings.is_over = [begin, budget_s] {
    return interrupted != 0 ||
           std::chrono::duration<double>(Clock::now() - begin).count() > budget_s;
  };
  fuzz::Search search(base, subject.rules, runner, settings);
  search.run([&findings](const fuzz::Finding& finding) { findings.add(finding); });
  const double spent_s = std::chrono::duration<double>(Clock::now() - begin).count();
  if (!request.quiet) {
    std::cout << (interrupted != 0 ? "interrupted, " : "")
              << (findings.count() == 0 ? "nothing found: " : "") << search.runs() << " runs and "
              << search.situations() << " situations in " << sim::fixed_text(spent_s, 0) << " s, "
              << runner.count() - search.runs() << " runs to make findings simpler\n";
  }
  return findings.count() == 0 && interrupted == 0 ? kOk : kProgramFailed;
}

}  // namespace playpen
