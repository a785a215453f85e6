// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "sim/core/number_text.h"
#include "sim/world/view_mode.h"

namespace playerlike {
namespace {

namespace fs = std::filesystem;

std::string in_quotes(const std::string& text) { return "'" + text + "'"; }

/// Why a path can't be run; nullopt if it can.
std::optional<std::string> obstacle_to_running(const std::string& path) {
  struct stat info {};
  if (stat(path.c_str(), &info) != 0) {
    return errno == ENOENT
               ? "there is no program " + in_quotes(path)
               : "the program " + in_quotes(path) + " can't be reached: " + std::strerror(errno);
  }
  if (S_ISDIR(info.st_mode)) return in_quotes(path) + " is a folder, not a program";
  if (!S_ISREG(info.st_mode) || access(path.c_str(), X_OK) != 0) {
    return in_quotes(path) +
           " is no executable file; is it the built program, or is chmod +x missing?";
  }
  return std::nullopt;
}

std::string absolute_path(const std::string& path) {
  return fs::absolute(path).lexically_normal().string();
}

/// "NAME=value" of this process's environment with the changes made.
std::vector<std::string> changed_environment(const EnvironmentChanges& changes) {
  std::vector<std::string> result;
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    if (!changes.contains(std::string(text.substr(0, text.find('='))))) result.emplace_back(text);
  }
  for (const auto& [name, value] : changes) {
    if (value) result.push_back(name + "=" + *value);
  }
  return result;
}

/// Pointers to the texts, ended by a null pointer, as exec wants them.
std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  result.reserve(texts.size() + 1);
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

/// Holds back, in this thread, the signals that matter while a program runs, so that they can be
/// waited for one by one instead of interrupting anything.
class HeldSignals {
 public:
  HeldSignals() {
    // Were SIGCHLD ignored, as some parents leave it, the program's status would be lost.
    struct sigaction by_default {};
    by_default.sa_handler = SIG_DFL;
    sigaction(SIGCHLD, &by_default, &old_child_action_);
    sigemptyset(&held_);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGCHLD}) sigaddset(&held_, signal);
    pthread_sigmask(SIG_BLOCK, &held_, &old_mask_);
  }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;
  ~HeldSignals() {
    // What came too late for the program is dropped: this process ends by itself in a moment.
    const timespec no_time{};
    while (sigtimedwait(&held_, nullptr, &no_time) > 0) {
    }
    sigaction(SIGCHLD, &old_child_action_, nullptr);
    pthread_sigmask(SIG_SETMASK, &old_mask_, nullptr);
  }

  /// The mask as it was, for the program to start with.
  [[nodiscard]] const sigset_t& old_mask() const noexcept { return old_mask_; }

  /// Waits a while for one of the signals.
  /// @return its number if another process sent it and it is to be passed on, else 0.
  [[nodiscard]] int wait_to_forward() const {
    // A bounded wait: SIGCHLD may have gone to another thread of this process, if it has any.
    siginfo_t info{};
    const int signal = wait(std::chrono::milliseconds(200), &info);
    const bool from_a_process = info.si_code == SI_USER || info.si_code == SI_QUEUE;
    return signal > 0 && signal != SIGCHLD && from_a_process ? signal : 0;
  }

  /// Waits for one of the signals, whoever sent it, no longer than told.
  /// @return its number, or -1 if none came.
  [[nodiscard]] int wait(std::chrono::nanoseconds at_most, siginfo_t* info = nullptr) const {
    constexpr long long kNanoseconds = 1'000'000'000;
    const long long count = std::max<long long>(at_most.count(), 0);
    const timespec time{static_cast<time_t>(count / kNanoseconds),
                        static_cast<long>(count % kNanoseconds)};
    return sigtimedwait(&held_, info, &time);
  }

 private:
  sigset_t held_{};
  sigset_t old_mask_{};
  struct sigaction old_child_action_ {};
};

/// What a program is started with besides its command and environment.
class SpawnSettings {
 public:
  /// @param mask  the signal mask of the program.
  explicit SpawnSettings(const sigset_t& mask) {
    posix_spawnattr_init(&attributes_);
    posix_spawn_file_actions_init(&files_);
    posix_spawnattr_setsigmask(&attributes_, &mask);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&files_);
    posix_spawnattr_destroy(&attributes_);
  }

  /// A process group of its own, no input, and this descriptor for what it prints.
  void set_apart(int output) {
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
    posix_spawn_file_actions_addopen(&files_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files_, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files_, output, STDERR_FILENO);
  }

  [[nodiscard]] pid_t start(std::vector<std::string> command,
                            const EnvironmentChanges& changes) const {
    std::vector<std::string> environment = changed_environment(changes);
    pid_t child = 0;
    const int error = posix_spawn(&child, command.front().c_str(), &files_, &attributes_,
                                  pointers(command).data(), pointers(environment).data());
    if (error != 0) {
      throw ProgramError("the program " + in_quotes(command.front()) +
                         " can't be started: " + std::strerror(error));
    }
    return child;
  }

 private:
  posix_spawnattr_t attributes_{};
  posix_spawn_file_actions_t files_{};
};

ProgramEnd program_end(int wait_state) {
  ProgramEnd end;
  if (WIFSIGNALED(wait_state)) {
    end.signal = WTERMSIG(wait_state);
  } else {
    end.status = WEXITSTATUS(wait_state);
  }
  return end;
}

/// Waits for a child that has ended or must. Interruptions do not matter here.
int reap(pid_t child) {
  int state = 0;
  while (waitpid(child, &state, 0) < 0 && errno == EINTR) {
  }
  return state;
}

using Clock = std::chrono::steady_clock;

/// A program that runs in a group of its own. Killed, with all its group, if it is let go.
class GroupedProgram {
 public:
  GroupedProgram(const ProgramJob& job, std::size_t index, const sigset_t& mask) : index_(index) {
    // Closed in the program by exec; dup2 clears that on the copies.
    const int output =
        open(job.output_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (output < 0) {
      throw ProgramError("the file " + in_quotes(job.output_file) +
                         " can't be made: " + std::strerror(errno));
    }
    try {
      SpawnSettings settings(mask);
      settings.set_apart(output);
      child_ = settings.start(job.command, job.environment);
    } catch (...) {
      close(output);
      throw;
    }
    close(output);
  }
  GroupedProgram(GroupedProgram&& other) noexcept
      : index_(other.index_),
        child_(std::exchange(other.child_, 0)),
        start_(other.start_),
        kind_(other.kind_),
        kill_time_(other.kill_time_) {}
  GroupedProgram& operator=(GroupedProgram&& other) noexcept {
    std::swap(index_, other.index_);
    std::swap(child_, other.child_);
    std::swap(start_, other.start_);
    std::swap(kind_, other.kind_);
    std::swap(kill_time_, other.kill_time_);
    return *this;
  }
  ~GroupedProgram() {
    if (child_ == 0) return;
    kill(-child_, SIGKILL);
    reap(child_);
  }

  [[nodiscard]] std::size_t index() const noexcept { return index_; }

  /// How it ended; nullopt while it runs.
  [[nodiscard]] std::optional<JobEnd> poll() {
    siginfo_t info{};
    if (waitid(P_PID, static_cast<id_t>(child_), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
        info.si_pid == 0) {
      return std::nullopt;
    }
    // Before its number is given back, so that the group can be nobody else's.
    kill(-child_, SIGKILL);
    const ProgramEnd program = program_end(reap(std::exchange(child_, 0)));
    return JobEnd{kind_, program, std::chrono::duration<double>(Clock::now() - start_).count()};
  }

  /// Asks it to end, for this reason, and sees to it that it does after the grace.
  void ask_to_end(JobEnd::Kind reason, Clock::duration grace) {
    if (kill_time_) return;
    kind_ = reason;
    kill_time_ = Clock::now() + grace;
    kill(-child_, SIGTERM);
    kill(-child_, SIGCONT);  // one that was stopped could not end
  }

  /// Does what is due by now.
  /// @param timeout  how long it may run.
  /// @return when something is due next.
  Clock::time_point look_after(Clock::duration timeout, Clock::duration grace) {
    const Clock::time_point now = Clock::now();
    if (now - start_ >= timeout) ask_to_end(JobEnd::Kind::kTimedOut, grace);
    if (kill_time_ && now >= *kill_time_) kill(-child_, SIGKILL);
    if (kill_time_) return std::max(*kill_time_, now + std::chrono::milliseconds(10));
    return start_ + timeout;
  }

  void end_grace() { kill_time_ = Clock::now(); }

 private:
  std::size_t index_;
  pid_t child_ = 0;
  Clock::time_point start_ = Clock::now();
  JobEnd::Kind kind_ = JobEnd::Kind::kEnded;
  std::optional<Clock::time_point> kill_time_;  ///< set once it was asked to end
};

}  // namespace

std::string ProgramEnd::text() const {
  if (!signal) return "ended with status " + std::to_string(status);
  return "was ended by signal " + std::to_string(*signal) + " (" + strsignal(*signal) + ")";
}

std::string find_program(const std::string& name) {
  if (name.empty()) throw ProgramError("the program's name is empty");
  if (name.find('/') != std::string::npos) {
    if (const auto obstacle = obstacle_to_running(name)) throw ProgramError(*obstacle);
    return name;
  }
  const char* path = std::getenv("PATH");
  std::string_view rest = path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin";
  for (;;) {
    const std::size_t colon = rest.find(':');
    const std::string folder(rest.substr(0, colon));
    // An empty entry of PATH means the folder we are in.
    std::string candidate = (folder.empty() ? "." : folder) + "/" + name;
    if (!obstacle_to_running(candidate)) return candidate;
    if (colon == std::string_view::npos) break;
    rest.remove_prefix(colon + 1);
  }
  std::string message = "there is no program " + in_quotes(name) + " on the PATH";
  if (!obstacle_to_running("./" + name)) {
    message += "; for the one in this folder write ./" + name;
  }
  throw ProgramError(message);
}

EnvironmentChanges run_environment(const std::string& world_file, const RunSettings& settings) {
  const auto path_or_nothing = [](const std::string& path) {
    return path.empty() ? std::nullopt : std::optional(absolute_path(path));
  };
  EnvironmentChanges changes;
  changes["PLAYPEN_WORLD"] = path_or_nothing(world_file);
  changes["PLAYPEN_OUT"] = path_or_nothing(settings.output_folder);
  changes["PLAYPEN_RECORD"] = path_or_nothing(settings.film);
  changes["PLAYPEN_VIEW"] =
      settings.view_socket ? std::optional(std::to_string(*settings.view_socket)) : std::nullopt;
  changes["PLAYPEN_GRADE"] =
      settings.grading.nonce.empty() ? std::nullopt : std::optional(settings.grading.nonce);
  const RunSettings defaults;
  const auto number_unless = [](double value, double by_default) {
    return value != by_default ? std::optional(sim::shortest_text(value)) : std::nullopt;
  };
  changes["PLAYPEN_RECORD_FPS"] = number_unless(settings.film_fps, defaults.film_fps);
  changes["PLAYPEN_RECORD_SPEED"] = number_unless(settings.film_speed, defaults.film_speed);
  changes["PLAYPEN_SNAPSHOT_EVERY"] =
      settings.snapshot_period_s ? std::optional(sim::shortest_text(*settings.snapshot_period_s))
                                 : std::nullopt;
  changes["PLAYPEN_VIEW_MODE"] =
      settings.view_mode ? std::optional(std::string(sim::to_string(*settings.view_mode)))
                         : std::nullopt;
  changes["PLAYPEN_SEED"] =
      settings.seed ? std::optional(std::to_string(*settings.seed)) : std::nullopt;
  changes["PLAYPEN_DURATION"] =
      settings.duration_s ? std::optional(sim::shortest_text(*settings.duration_s)) : std::nullopt;
  auto& time = changes["PLAYPEN_TIME"];
  if (settings.time_mode == sim::TimeMode::kLockstep) time = "lockstep";
  if (settings.time_mode == sim::TimeMode::kPaced) time = sim::shortest_text(settings.time_factor);
  changes["PLAYPEN_PROGRESS"] = settings.progress ? std::optional<std::string>("1") : std::nullopt;
  changes["PLAYPEN_VIRTUAL_TIME"] =
      settings.virtual_time ? std::optional<std::string>("1") : std::nullopt;
  changes["PLAYPEN_RUN"] = settings.quiet_end ? std::optional<std::string>("1") : std::nullopt;
  return changes;
}

ProgramEnd run_program(const std::vector<std::string>& command,
                       const EnvironmentChanges& environment) {
  const HeldSignals signals;
  const pid_t child = SpawnSettings(signals.old_mask()).start(command, environment);
  int state = 0;
  for (;;) {
    const pid_t ended = waitpid(child, &state, WNOHANG);
    if (ended == child) break;
    if (ended < 0 && errno != EINTR) {
      throw std::system_error(errno, std::generic_category(), "waiting for " + command.front());
    }
    if (const int signal = signals.wait_to_forward(); signal != 0) kill(child, signal);
  }
  return program_end(state);
}

std::vector<JobEnd> run_programs(const std::vector<ProgramJob>& jobs, const JobLimits& limits,
                                 const std::function<void(std::size_t)>& on_start,
                                 const std::function<void(std::size_t, const JobEnd&)>& on_end) {
  constexpr double kForEver_s = 1e9;  // 30 years
  const auto duration = [&](double seconds) {
    return std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(std::min(seconds, kForEver_s)));
  };
  const Clock::duration grace = duration(limits.grace_s);
  const Clock::duration timeout = duration(limits.timeout_s > 0.0 ? limits.timeout_s : kForEver_s);
  const auto at_once = static_cast<std::size_t>(std::max(limits.at_once, 1));

  const HeldSignals signals;
  std::vector<JobEnd> ends(jobs.size());
  std::vector<GroupedProgram> running;
  std::size_t next = 0;
  bool told_to_end = false;
  while (!running.empty() || (next < jobs.size() && !told_to_end)) {
    while (!told_to_end && next < jobs.size() && running.size() < at_once) {
      running.emplace_back(jobs[next], next, signals.old_mask());
      if (on_start) on_start(next);
      ++next;
    }
    // Bounded for the same reason as in wait_to_forward().
    Clock::time_point wake = Clock::now() + std::chrono::milliseconds(200);
    for (GroupedProgram& program : running) {
      wake = std::min(wake, program.look_after(timeout, grace));
    }
    if (const int signal = signals.wait(wake - Clock::now()); signal > 0 && signal != SIGCHLD) {
      for (GroupedProgram& program : running) {
        program.ask_to_end(JobEnd::Kind::kInterrupted, grace);
        if (told_to_end) program.end_grace();
      }
      told_to_end = true;
    }
    for (auto program = running.begin(); program != running.end();) {
      const std::optional<JobEnd> end = program->poll();
      if (!end) {
        ++program;
        continue;
      }
      const std::size_t index = program->index();
      program = running.erase(program);
      ends[index] = *end;
      if (on_end) on_end(index, *end);
    }
  }
  return ends;
}

}  // namespace playerlike
