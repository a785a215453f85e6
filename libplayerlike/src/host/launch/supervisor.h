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

struct PrintedCount;

/// How to start a program.
struct SupervisedStart {
  std::vector<std::string> command;  ///< path and arguments; not empty
  EnvironmentChanges environment;
  std::string folder;  ///< working folder of the program; "": that of this process
  sigset_t mask{};     ///< signal mask of the program
  /// If set, the program gets its own process group and no input, and its output goes to this file,
  /// which is overwritten. Otherwise it shares this process's group and streams.
  std::optional<std::string> output_file;
  std::uint64_t output_limit = 0;   ///< bytes of the file; the rest is dropped, and a note says so
  PrintedCount* printed = nullptr;  ///< shared memory that counts the output; may be null
  /// Called in the supervisor if this process ends before the program, after the program and all
  /// processes that it has started have ended.
  std::function<void(const ProgramEnd&)> on_orphaned;
  std::vector<int> kept_descriptors;  ///< needed by on_orphaned; the supervisor closes all others
};

/// A running program with a small process between it and this one: the supervisor.
///
/// The supervisor is the program's parent and adopts orphaned processes of the program
/// (PR_SET_CHILD_SUBREAPER). It ends all of them when the program or this process has ended for any
/// reason. It is in its own process group, so signals to this process's group do not reach it. If
/// the supervisor is killed, the kernel kills the program, and this process ends the other
/// processes.
class SupervisedProgram {
 public:
  /// @throws ProgramError if the program cannot be started or its output file cannot be created.
  explicit SupervisedProgram(const SupervisedStart& start);
  SupervisedProgram(SupervisedProgram&& other) noexcept;
  SupervisedProgram& operator=(SupervisedProgram&& other) noexcept;
  /// Kills the program and all processes that it has started, if they still run.
  ~SupervisedProgram();

  /// Readable when poll() has news.
  [[nodiscard]] int descriptor() const noexcept { return channel_; }
  /// Sends a signal to the program, or to its process group if it has its own. A stopped program is
  /// continued, so that it can end.
  void send_signal(int signal);
  /// Kills the program and all processes that it has started.
  void kill_all();
  /// Handles the supervisor's messages. @return how the program has ended; nullopt while it runs.
  [[nodiscard]] std::optional<ProgramEnd> poll();
  /// Called after the program's end, when this process has done its work. From then on the
  /// supervisor does not call on_orphaned if this process is killed.
  void release();
  /// Whether the program has stopped itself by SIGSTOP since the last call.
  [[nodiscard]] bool take_stopped() noexcept;
  /// The program's process id.
  [[nodiscard]] pid_t program() const noexcept { return program_; }

 private:
  void send(int kind, int value);
  void reap_supervisor();

  pid_t supervisor_ = 0;
  pid_t program_ = 0;
  int channel_ = -1;
  bool stopped_ = false;
  std::optional<ProgramEnd> end_;
  std::set<pid_t> others_;  ///< earlier children of this process
};

}  // namespace playerlike
