// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/program.h"

#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>

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

/// The shortest text that reads back as the same number, whatever the locale.
std::string number_text(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return std::string(buffer.data(), end.ptr);
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
    const timespec a_while{0, 200'000'000};
    siginfo_t info{};
    const int signal = sigtimedwait(&held_, &info, &a_while);
    const bool from_a_process = info.si_code == SI_USER || info.si_code == SI_QUEUE;
    return signal > 0 && signal != SIGCHLD && from_a_process ? signal : 0;
  }

 private:
  sigset_t held_{};
  sigset_t old_mask_{};
  struct sigaction old_child_action_ {};
};

pid_t start(std::vector<std::string> command, const EnvironmentChanges& changes,
            const sigset_t& mask) {
  std::vector<std::string> environment = changed_environment(changes);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigmask(&attributes, &mask);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  pid_t child = 0;
  const int error = posix_spawn(&child, command.front().c_str(), nullptr, &attributes,
                                pointers(command).data(), pointers(environment).data());
  posix_spawnattr_destroy(&attributes);
  if (error != 0) {
    throw ProgramError("the program " + in_quotes(command.front()) +
                       " can't be started: " + std::strerror(error));
  }
  return child;
}

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
  changes["PLAYPEN_SEED"] =
      settings.seed ? std::optional(std::to_string(*settings.seed)) : std::nullopt;
  changes["PLAYPEN_DURATION"] =
      settings.duration_s ? std::optional(number_text(*settings.duration_s)) : std::nullopt;
  auto& time = changes["PLAYPEN_TIME"];
  if (settings.time_mode == sim::TimeMode::kLockstep) time = "lockstep";
  if (settings.time_mode == sim::TimeMode::kPaced) time = number_text(settings.time_factor);
  changes["PLAYPEN_PROGRESS"] = settings.progress ? std::optional<std::string>("1") : std::nullopt;
  changes["PLAYPEN_RUN"] = settings.quiet_end ? std::optional<std::string>("1") : std::nullopt;
  return changes;
}

ProgramEnd run_program(const std::vector<std::string>& command,
                       const EnvironmentChanges& environment) {
  const HeldSignals signals;
  const pid_t child = start(command, environment, signals.old_mask());
  int state = 0;
  for (;;) {
    const pid_t ended = waitpid(child, &state, WNOHANG);
    if (ended == child) break;
    if (ended < 0 && errno != EINTR) {
      throw std::system_error(errno, std::generic_category(), "waiting for " + command.front());
    }
    if (const int signal = signals.wait_to_forward(); signal != 0) kill(child, signal);
  }
  ProgramEnd end;
  if (WIFSIGNALED(state)) {
    end.signal = WTERMSIG(state);
  } else {
    end.status = WEXITSTATUS(state);
  }
  return end;
}

}  // namespace playerlike
