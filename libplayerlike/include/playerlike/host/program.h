// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

/// Running a client program as a process of its own, as `playpen run` does. What the program's
/// embedded simulation must know is passed in the environment (RunSettings::from_environment).
namespace playerlike {

/// A program that can't be started, in a sentence for the user.
class ProgramError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Variables to set (or, with nullopt, to remove) in a program's environment.
using EnvironmentChanges = std::map<std::string, std::optional<std::string>>;

/// How a program ended: by itself with a status, or by a signal.
struct ProgramEnd {
  int status = 0;                   ///< exit status, 0..255; 0 if a signal ended it
  std::optional<int> signal;        ///< number of the signal that ended it
  std::optional<int> request = {};  ///< run_program(): the first signal by which this process was
                                    ///< asked to end the run
  bool forced = false;              ///< run_program(): it was killed because of that

  /// Whether it ended by itself with status 0.
  [[nodiscard]] bool success() const noexcept { return status == 0 && !signal; }
  /// What to tell a user, e.g. "ended with status 3" or "was ended by signal 11 (Segmentation
  /// fault)".
  [[nodiscard]] std::string text() const;
};

/// Finds a program as a shell does: a name with a slash is a path, another one is looked up in the
/// folders of PATH.
/// @return a path that names an executable file.
/// @throws ProgramError saying what is wrong: no such file, a folder, not executable.
[[nodiscard]] std::string find_program(const std::string& name);

/// Whether a signal that asks for the end belongs to the request that an earlier one has made, and
/// is no second request: a copy of it within half a second, as `timeout` sends them to a process
/// and to its group, or a further SIGHUP after a first one.
/// @param first  the earlier signal.
/// @param age    how long ago it came.
[[nodiscard]] bool is_same_request(int first, int signal, std::chrono::nanoseconds age) noexcept;

/// The environment by which a program's embedded simulation learns of its run; the inverse of
/// RunSettings::from_environment(). Settings that are left out are removed from the environment, so
/// that a run means what it was told and not what the shell happens to hold. The silence limit is
/// passed on as it is.
/// @param world_file  "": the default world. Relative names here and in the settings are made
///                    absolute: a program may change its folder.
[[nodiscard]] EnvironmentChanges run_environment(const std::string& world_file,
                                                 const RunSettings& settings);

/// What run_program() knows of the simulated run in its program, and whom it tells.
struct RunWatch {
  const KeptRun* kept = nullptr;                      ///< what the program's host keeps up to date
  std::function<void(const std::string&)> tell = {};  ///< takes a sentence for the user
  /// Called once the program and all that it has started are gone, while signals are still held: in
  /// this process or, if this one was killed, in another one that then ends.
  std::function<void(const ProgramEnd&)> on_end = {};
};

/// Runs a program to its end, with this process's terminal and standard streams.
///
/// While it runs, SIGINT, SIGTERM, SIGHUP and SIGQUIT that another process sends to this one are
/// passed on to it; those that the terminal sends reach it anyway. Signals that this process
/// ignores stay ignored. The first signal asks the program to end. If a host in the program has
/// noted it (KeptRun::interrupt_noted()), the program is killed on the second signal, or if the
/// simulated run has not ended after 1.5 s of wall time. Copies of the first signal within half a
/// second (`timeout` sends two), and every further SIGHUP after a first one, do not count. A
/// program that handles the signal itself is not killed.
///
/// What the program leaves running gets SIGTERM when the program ends, and SIGKILL a second later.
/// If this process is killed, so are the program and all that it has started.
///
/// @param command  path (see find_program()) and arguments; not empty.
/// @throws ProgramError if the program can't be started.
/// @note Changes the calling thread's signal mask while the program runs, and the process's
///       disposition of SIGCHLD; makes the process a reaper of orphans (PR_SET_CHILD_SUBREAPER).
///       For a command's main thread, one program at a time, and a process without other threads.
[[nodiscard]] ProgramEnd run_program(const std::vector<std::string>& command,
                                     const EnvironmentChanges& environment,
                                     const RunWatch& watch = {});

/// A program to be run beside others by run_programs().
struct ProgramJob {
  std::vector<std::string> command;  ///< path (see find_program()) and arguments; not empty
  EnvironmentChanges environment;
  std::string output_file;         ///< gets its standard output and standard error, overwritten
  std::string folder = {};         ///< that must not become too large; "": none
  std::uint64_t folder_limit = 0;  ///< bytes of all its files
  std::uint64_t output_limit = 10'000'000;  ///< bytes of that; what is over is dropped, and told in
                                            ///< the file's last line
};

/// What became of a ProgramJob.
struct JobEnd {
  enum class Kind {
    kEnded,          ///< by itself, or by a signal that others sent
    kTimedOut,       ///< it was ended because it took too long
    kInterrupted,    ///< it was ended because this process was told to end
    kTooMuchOutput,  ///< it was ended because its folder had become too large
    kNotStarted,     ///< this process was told to end before its turn came
  };
  Kind kind = Kind::kNotStarted;
  ProgramEnd program;        ///< how it ended in the end; of kNotStarted: nothing
  double wall_time_s = 0.0;  ///< from its start to its end by the clock on the wall [s]
};

/// How run_programs() goes about it.
struct JobLimits {
  int at_once = 1;         ///< programs that run side by side, >= 1
  double timeout_s = 0.0;  ///< wall time that a program may take [s]; 0: no limit
  double grace_s = 5.0;    ///< from the polite signal to the one that can't be refused [s], >= 0
};

/// Runs many programs, several side by side, to their ends.
///
/// Each runs in a process group of its own with an empty standard input. One that takes too long
/// gets SIGTERM, on which an embedded simulation writes its results, and SIGKILL after the grace;
/// signals go to the whole group. What a program leaves running, in its group or not, gets SIGTERM
/// when it ends, and SIGKILL a second later. On SIGINT, SIGTERM, SIGHUP or SIGQUIT to this process
/// all are ended in the same way and no more are started; a second one of these signals ends the
/// grace (see run_program() for what counts as one). If this process is killed, so are the
/// programs. A program whose folder has become too large is killed; that is looked at five times a
/// second.
///
/// @param on_start  called as a job has started, if set.
/// @param on_end    called as a job has ended, in the order in which they end, if set. Not called
///                  for jobs that were not started.
/// @return the ends, in the order of the jobs.
/// @throws ProgramError if a program can't be started or its output file can't be made, and what
///         the callbacks throw; nothing is left running then.
/// @note As for run_program(): for a command's main thread, one call at a time.
[[nodiscard]] std::vector<JobEnd> run_programs(
    const std::vector<ProgramJob>& jobs, const JobLimits& limits,
    const std::function<void(std::size_t)>& on_start = {},
    const std::function<void(std::size_t, const JobEnd&)>& on_end = {});

}  // namespace playerlike
