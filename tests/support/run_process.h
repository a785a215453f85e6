// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "patience.h"

/// Runs built programs from tests, captures their output and limits their run time.
namespace test_support {

/// How a program ended, and its output.
struct ProcessResult {
  std::optional<int> status;  ///< exit status; nullopt: a signal ended it
  std::optional<int> signal;  ///< the signal that ended it
  bool timed_out = false;     ///< it was killed because it exceeded the time limit
  std::string out;            ///< its standard output
  std::string err;            ///< its standard error
};

struct ProcessOptions {
  std::map<std::string, std::string> environment;  ///< variables to set in addition to the test's
  std::string folder;                              ///< working folder; "": the test's
  std::chrono::seconds timeout = patience();
  std::vector<int> ignored_signals = {};  ///< signals that the program ignores from its start
  std::optional<std::uint64_t> file_limit = {};  ///< limit of the size of its files [bytes]
};

/// A running program. Its standard input is a pipe that stays open and empty until the end. It runs
/// in its own process group: killing the group also kills its child processes. If the test is
/// killed, the program dies, too. Start it from a program with one thread.
class Process {
 public:
  /// Starts a program; command[0] is looked up in PATH if it has no slash. If it can't be executed,
  /// its status is 127, as in a shell.
  explicit Process(const std::vector<std::string>& command, const ProcessOptions& options = {})
      : deadline_(std::chrono::steady_clock::now() + options.timeout) {
    const auto [stdin_read, stdin_write] = make_pipe();
    const auto [stdout_read, stdout_write] = make_pipe();
    const auto [stderr_read, stderr_write] = make_pipe();
    child_ = fork();
    if (child_ < 0) throw std::runtime_error("fork failed");
    if (child_ == 0) {
      setpgid(0, 0);
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      dup2(stdin_read, STDIN_FILENO);
      dup2(stdout_write, STDOUT_FILENO);
      dup2(stderr_write, STDERR_FILENO);
      // The test may run in the background, where shells make it ignore SIGINT.
      for (const int signal : {SIGINT, SIGQUIT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
      for (const int signal : options.ignored_signals) std::signal(signal, SIG_IGN);
      if (options.file_limit) {
        const rlimit limit{*options.file_limit, *options.file_limit};
        setrlimit(RLIMIT_FSIZE, &limit);
      }
      for (const auto& [name, value] : options.environment) {
        setenv(name.c_str(), value.c_str(), 1);
      }
      std::vector<char*> arguments;
      for (const std::string& argument : command) {
        arguments.push_back(const_cast<char*>(argument.c_str()));
      }
      arguments.push_back(nullptr);
      if (options.folder.empty() || chdir(options.folder.c_str()) == 0) {
        execvp(arguments[0], arguments.data());
      }
      _exit(127);
    }
    setpgid(child_, child_);  // both processes do this, because either may be first
    close(stdin_read);
    close(stdout_write);
    close(stderr_write);
    stdin_ = stdin_write;
    streams_ = {Stream{stdout_read, &result_.out}, Stream{stderr_read, &result_.err}};
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process() { static_cast<void>(kill_now()); }

  /// Reads until the program's standard output contains the text.
  /// @return false if the program closed its output first, or exceeded the time limit.
  [[nodiscard]] bool read_until(std::string_view text) {
    while (result_.out.find(text) == std::string::npos) {
      if (!pump()) return false;
    }
    return true;
  }

  /// Does this for its standard error.
  [[nodiscard]] bool read_error_until(std::string_view text) {
    while (result_.err.find(text) == std::string::npos) {
      if (!pump()) return false;
    }
    return true;
  }

  /// Its standard output so far.
  [[nodiscard]] const std::string& output() const { return result_.out; }

  /// Writes to its standard input.
  void write_input(std::string_view text) const {
    std::signal(SIGPIPE, SIG_IGN);  // the program may have ended
    while (!text.empty()) {
      const ssize_t count = write(stdin_, text.data(), text.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) throw std::runtime_error("the program does not read its input");
      text.remove_prefix(static_cast<std::size_t>(count));
    }
  }

  /// Ends its standard input.
  void close_input() { close_once(stdin_); }

  /// Its standard error so far.
  [[nodiscard]] const std::string& errors() const { return result_.err; }

  /// Its process id.
  [[nodiscard]] pid_t process() const noexcept { return child_; }
  void send_signal(int signal) const { kill(child_, signal); }
  /// Sends a signal to the program and all processes in its group, as a terminal does.
  void send_signal_to_group(int signal) const { kill(-child_, signal); }

  /// Kills the program and all processes in its group.
  [[nodiscard]] ProcessResult kill_now() {
    kill_group();
    // The pipes end with the last process that holds them, unless one of them joined another group.
    deadline_ = std::min(deadline_, std::chrono::steady_clock::now() + std::chrono::seconds(20));
    return finish();
  }

  /// Waits for the program's end; kills it when its time limit is exceeded.
  [[nodiscard]] ProcessResult finish() {
    while (pump()) {
    }
    if (child_ > 0) {
      // Output has ended, or the time limit was exceeded: then kill the group.
      if (result_.timed_out) kill_group();
      int state = 0;
      while (waitpid(child_, &state, 0) < 0 && errno == EINTR) {
      }
      child_ = -1;
      if (WIFEXITED(state)) result_.status = WEXITSTATUS(state);
      if (WIFSIGNALED(state)) result_.signal = WTERMSIG(state);
    }
    for (Stream& stream : streams_) close_once(stream.descriptor);
    close_once(stdin_);
    return result_;
  }

 private:
  struct Stream {
    int descriptor = -1;
    std::string* text = nullptr;
  };

  static std::pair<int, int> make_pipe() {
    std::array<int, 2> ends{};
    // The child closes these on exec; dup2 clears the flag on the copies.
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("pipe failed");
    return {ends[0], ends[1]};
  }

  /// @pre nobody has waited for the program if child_ > 0, so the group id is still in use.
  void kill_group() const {
    if (child_ > 0) kill(-child_, SIGKILL);
  }

  static void close_once(int& descriptor) {
    if (descriptor >= 0) close(descriptor);
    descriptor = -1;
  }

  /// Waits for output and stores it. @return false at the end of both streams, or of the time.
  bool pump() {
    std::array<pollfd, 2> polls{};
    bool any_open = false;
    for (std::size_t i = 0; i < streams_.size(); ++i) {
      polls[i] = {streams_[i].descriptor, POLLIN, 0};  // a negative descriptor is skipped
      any_open = any_open || streams_[i].descriptor >= 0;
    }
    if (!any_open) return false;
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        deadline_ - std::chrono::steady_clock::now());
    const int ready =
        poll(polls.data(), polls.size(), left.count() > 0 ? static_cast<int>(left.count()) : 0);
    if (ready < 0 && errno == EINTR) return true;
    if (ready <= 0) {
      result_.timed_out = true;
      return false;
    }
    for (std::size_t i = 0; i < streams_.size(); ++i) {
      if (polls[i].revents == 0) continue;
      std::array<char, 4096> buffer{};
      const ssize_t count = read(streams_[i].descriptor, buffer.data(), buffer.size());
      if (count > 0) {
        streams_[i].text->append(buffer.data(), static_cast<std::size_t>(count));
      } else if (count == 0 || errno != EINTR) {
        close_once(streams_[i].descriptor);
      }
    }
    return true;
  }

  std::chrono::steady_clock::time_point deadline_;
  pid_t child_ = -1;
  int stdin_ = -1;
  ProcessResult result_;
  std::array<Stream, 2> streams_;
};

/// Runs a program to its end.
[[nodiscard]] inline ProcessResult run_process(const std::vector<std::string>& command,
                                               const ProcessOptions& options = {}) {
  return Process(command, options).finish();
}

}  // namespace test_support
