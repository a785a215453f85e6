// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <signal.h>
#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "playerlike/host/program.h"

namespace playerlike {

/// What a program is started with.
struct SupervisedStart {
  std::vector<std::string> command;  ///< path and arguments; not empty
  EnvironmentChanges environment;
  sigset_t mask{};  ///< the signal mask of the program
  /// Set: the program gets a process group of its own and no input, and what it prints goes to
  /// this file, which is overwritten. Else it shares this process's group and streams.
  std::optional<std::string> output_file;
  std::uint64_t output_limit = 0;  ///< bytes of the file; what is over is dropped, and told
  /// Called in the supervisor if this process is gone before the program, once the program and all
  /// that it has started are gone, too.
  std::function<void(const ProgramEnd&)> on_orphaned;
  std::vector<int> kept_descriptors;  ///< that on_orphaned needs; the supervisor closes others
};

/// A running program, with a small process between it and this one: the supervisor.
///
/// The supervisor is the program's parent, and adopts what the program's processes leave behind
/// (PR_SET_CHILD_SUBREAPER). It ends all of them when the program has ended, or when this process
/// has gone, however that came about. It lives in a process group of its own, so that signals to
/// this process's group do not reach it. If it is killed itself, the kernel kills the program, and
/// this process ends the rest.
class SupervisedProgram {
 public:
  /// @throws ProgramError if the program cannot be started or its output file cannot be made.
  explicit SupervisedProgram(const SupervisedStart& start);
  SupervisedProgram(SupervisedProgram&& other) noexcept;
  SupervisedProgram& operator=(SupervisedProgram&& other) noexcept;
  /// Kills the program and all that it has started, if that still runs.
  ~SupervisedProgram();

  /// Becomes readable when poll() has news.
  [[nodiscard]] int descriptor() const noexcept { return channel_; }
  /// Sends a signal to the program, or to its process group if that is its own. A program that is
  /// stopped goes on, so that it can end.
  void send_signal(int signal);
  /// Kills the program and all that it has started.
  void kill_all();
  /// Takes news. @return how the program has ended; nullopt while it runs.
  [[nodiscard]] std::optional<ProgramEnd> poll();
  /// After the program's end: this process has done what it had to do, so that the supervisor need
  /// not take its place if it is killed.
  void release();
  /// Whether the program has stopped itself by SIGSTOP since the last call.
  [[nodiscard]] bool take_stopped() noexcept;
  /// The program's number.
  [[nodiscard]] pid_t program() const noexcept { return program_; }

 private:
  void send(int kind, int value);
  void reap_supervisor();

  pid_t supervisor_ = 0;
  pid_t program_ = 0;
  int channel_ = -1;
  bool stopped_ = false;
  std::optional<ProgramEnd> end_;
  std::set<pid_t> others_;  ///< children of this process that were there before
};

}  // namespace playerlike
