// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "playerlike/host/kept_run.h"
#include "playerlike/host/run_settings.h"

/// Runs a client program as a separate process, for `playpen run`. The environment passes the
/// settings to the program's embedded simulation (RunSettings::from_environment).
namespace playerlike {

class ProgramDesk;

/// Error for a program that cannot be started, with a text for the user.
class ProgramError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Variables to set (or, with nullopt, to remove) in a program's environment.
using EnvironmentChanges = std::map<std::string, std::optional<std::string>>;

/// End of a program: exit with a status, or termination by a signal.
struct ProgramEnd {
  int status = 0;                   ///< exit status, 0..255; 0 if a signal terminated the program
  std::optional<int> signal;        ///< number of the signal that terminated the program
  std::optional<int> request = {};  ///< run_program(): first signal that requested the end of the
                                    ///< run
  bool forced = false;              ///< run_program(): whether that request killed the program

  /// Whether the program exited with status 0.
  [[nodiscard]] bool success() const noexcept { return status == 0 && !signal; }
  /// Text for the user, e.g. "ended with status 3" or "was ended by signal 11 (Segmentation
  /// fault)".
  [[nodiscard]] std::string text() const;
};

/// Finds a program like a shell: a name with a slash is a path; any other name is searched in the
/// folders of PATH.
/// @return a path that names an executable file.
/// @throws ProgramError with the reason: no such file, a folder, or not executable.
[[nodiscard]] std::string find_program(const std::string& name);

/// Whether a termination signal belongs to the request of an earlier signal and is not a second
/// request. That is so for a copy within half a second (`timeout` signals both the process and its
/// group) and for a SIGHUP after an earlier SIGHUP.
/// @param first  the earlier signal.
/// @param age    time since the earlier signal.
[[nodiscard]] bool is_same_request(int first, int signal, std::chrono::nanoseconds age) noexcept;

/// How much time a process has had, whatever else the machine does: the time in which all its
/// threads slept, and its processor time. Waiting for a processor or a disk does not count, nor
/// does a pause of the whole machine.
class TimeGiven {
 public:
  /// @param process  its id.
  /// @param without  the calling thread, if it is one of that process and does not count; 0: none.
  explicit TimeGiven(pid_t process, pid_t without = 0) noexcept;

  /// Measures the time since the previous call. Must be called often: of a longer interval only
  /// 0.1 s counts.
  void look();
  /// Time given since the construction, until the last look().
  [[nodiscard]] std::chrono::nanoseconds total() const noexcept { return computed_ + slept_; }
  [[nodiscard]] std::chrono::nanoseconds computed() const noexcept { return computed_; }
  /// The time slept since the process last computed for more than some milliseconds, or waited for
  /// a processor or a disk.
  [[nodiscard]] std::chrono::nanoseconds idle() const noexcept { return idle_; }

 private:
  pid_t process_;
  pid_t without_;
  std::chrono::steady_clock::time_point last_look_ = std::chrono::steady_clock::now();
  std::chrono::nanoseconds last_cpu_;
  std::chrono::nanoseconds computed_{0};
  std::chrono::nanoseconds slept_{0};
  std::chrono::nanoseconds idle_{0};
  std::chrono::nanoseconds computed_idly_{0};  ///< processor time since idle() was 0
};

/// Returns the environment that passes settings to a program's embedded simulation; the inverse of
/// RunSettings::from_environment(). Variables of unset settings are removed, so that variables of
/// the shell do not affect the run. The silence limit is passed on unchanged.
/// @param world_file  name of the world file; "" for the default world. Relative paths here and in
///                    the settings are made absolute, because a program may change its working
///                    directory.
[[nodiscard]] EnvironmentChanges run_environment(const std::string& world_file,
                                                 const RunSettings& settings);

/// Data and callbacks that run_program() needs for the simulated run in its program.
struct RunWatch {
  const KeptRun* kept = nullptr;  ///< current data of the program's host
  /// Where programs of the run ask for its world; a conflict ends the run.
  ProgramDesk* desk = nullptr;
  std::function<void(const std::string&)> tell = {};  ///< receives messages for the user
  /// Processor time that the program may use between two steps before tell() says so [s]; infinity:
  /// any.
  double standstill_s = 5.0;
  /// The program is a debugger. The terminal's keys for SIGINT and SIGQUIT are meant for it and do
  /// not request the end of the run.
  bool is_debugger = false;
  /// Called when the program and all its descendants have ended, while signals are still blocked.
  /// It runs in this process or, if this process was killed, in another process that then ends.
  std::function<void(const ProgramEnd&)> on_end = {};
};

/// Runs a program to its end, with this process's terminal and standard streams.
///
/// Signals: SIGINT, SIGTERM, SIGHUP and SIGQUIT that another process sends to this process are
/// forwarded to the program; the terminal's signals reach the program directly. Signals that this
/// process ignores stay ignored. The first signal requests the program to end. If a host in the
/// program has noted it (KeptRun::interrupt_noted()), the program is killed at the second signal,
/// or if the simulated run has not ended after a TimeGiven of 1.5 s. Signals for which
/// is_same_request() is true do not count as a second signal. A program that handles the signal
/// itself is not killed.
///
/// Descendants: processes that the program leaves running get SIGTERM when the program ends, and
/// SIGKILL one second later. If this process is killed, the program and all its descendants are
/// killed too.
///
/// @param command  path (see find_program()) and arguments; not empty.
/// @throws ProgramError if the program cannot be started.
/// @note Changes the calling thread's signal mask while the program runs and the process's
///       disposition of SIGCHLD, and makes the process a child subreaper (PR_SET_CHILD_SUBREAPER).
///       Call it only in the main thread of a process without other threads, for one program at a
///       time.
[[nodiscard]] ProgramEnd run_program(const std::vector<std::string>& command,
                                     const EnvironmentChanges& environment,
                                     const RunWatch& watch = {});

/// A program for run_programs().
struct ProgramJob {
  std::vector<std::string> command;  ///< path (see find_program()) and arguments; not empty
  EnvironmentChanges environment;
  std::string output_file;         ///< receives standard output and standard error; overwritten
  std::string folder = {};         ///< folder whose size is limited; "": none
  std::uint64_t folder_limit = 0;  ///< maximum size of all files in the folder [bytes]
  std::uint64_t output_limit = 10'000'000;  ///< of output_file [bytes]; further output is dropped,
                                            ///< and the file's last line says so
  /// If set, called just before the start; returns further changes of the environment.
  std::function<EnvironmentChanges()> at_start = {};
  /// If set, called after at_start(); returns the memory of the program's host, which then knows
  /// when the program has printed what (see Rerun::printed_bytes()).
  std::function<const KeptRun&()> kept = {};
  std::string working_folder = {};  ///< of the program; "": that of this process
};

/// Result of a ProgramJob.
struct JobEnd {
  enum class Kind {
    kEnded,          ///< the program exited, or a signal from elsewhere terminated it
    kTimedOut,       ///< it was terminated because it took too long
    kInterrupted,    ///< it was terminated because this process was requested to end
    kTooMuchOutput,  ///< it was terminated because its folder became too large
    kNotStarted,     ///< this process was requested to end before the program was started
  };
  Kind kind = Kind::kNotStarted;
  ProgramEnd program;        ///< end of the program; default value for kNotStarted
  double wall_time_s = 0.0;  ///< wall time from start to end [s]
};

/// Limits for run_programs().
struct JobLimits {
  int at_once = 1;         ///< number of programs that run concurrently, >= 1
  double timeout_s = 0.0;  ///< wall-clock limit of a program [s]; 0: no limit
  double grace_s = 5.0;    ///< time from SIGTERM to SIGKILL [s], >= 0
};

/// Runs many programs to their ends, several of them concurrently.
///
/// Each program runs in its own process group with an empty standard input. A program that takes
/// too long gets SIGTERM, at which an embedded simulation writes its results, and SIGKILL after the
/// grace period. Signals are sent to the whole group. Processes that a program leaves running,
/// inside or outside its group, get SIGTERM when it ends, and SIGKILL one second later.
///
/// If this process gets SIGINT, SIGTERM, SIGHUP or SIGQUIT, it terminates all programs in this way
/// and starts no more. A second signal ends the grace period; see is_same_request() for signals
/// that do not count as a second one. If this process is killed, the programs are killed too.
///
/// The size of the folders is checked five times a second. A program whose folder is too large is
/// killed.
///
/// @param on_start  if set, called after the start of each job.
/// @param on_end    if set, called after the end of each job, in the order of the ends. Not called
///                  for jobs that were not started.
/// @return the ends, in the order of the jobs.
/// @throws ProgramError if a program cannot be started or its output file cannot be created.
///         Exceptions of the callbacks are passed on. No program is left running then.
/// @note Call it only in the main thread, one call at a time, as for run_program().
[[nodiscard]] std::vector<JobEnd> run_programs(
    const std::vector<ProgramJob>& jobs, const JobLimits& limits,
    const std::function<void(std::size_t)>& on_start = {},
    const std::function<void(std::size_t, const JobEnd&)>& on_end = {});

}  // namespace playerlike
