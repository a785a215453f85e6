// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace playpen {

/// Limits of all processes of a sandbox together, unless they say otherwise.
struct SandboxLimits {
  std::size_t tasks = 256;                     ///< processes and threads
  std::uint64_t memory_bytes = 2'000'000'000;  ///< of their own, not shared with others
  std::uint64_t files_bytes = 64'000'000;      ///< in each of /tmp and /dev/shm
  std::uint64_t processor_s = 3600;            ///< of one process
};

/// A program and what it can see.
struct SandboxSettings {
  std::vector<std::string> command;  ///< absolute path, and arguments
  std::string socket;                ///< the server's socket; the program sees it as kSandboxSocket
  std::vector<std::string> readable;  ///< absolute paths of further files and folders
  std::vector<std::string> writable;  ///< absolute paths of folders that it may change
  /// Absolute paths of files and folders that look empty, where they are in visible folders.
  std::vector<std::string> hidden;
  std::string folder;                              ///< the working directory
  std::map<std::string, std::string> environment;  ///< the whole of it
  SandboxLimits limits;
  /// Whether bubblewrap limits folders in memory (0.7 and newer). Otherwise excess() finds out.
  bool sized = true;
};

inline constexpr const char* kSandboxSocket = "/run/playpen/robots";

/// A program that a signal has ended has the signal's number and this as its status, as in a shell.
inline constexpr int kSignalStatus = 128;

/// The command line that runs a program in bubblewrap: with user, process, network, host name and
/// IPC namespaces of its own (for root, instead of the first, as a user of its own); the system's
/// programs and libraries, the program's folder and what the settings name, all of it read-only
/// but for the writable folders; and folders in memory as home and for temporary files.
/// @param filter  descriptor from which bubblewrap reads syscall_filter().
/// @param info    descriptor to which it writes the number of the first process in the sandbox.
[[nodiscard]] std::vector<std::string> sandbox_command(const SandboxSettings& settings, int filter,
                                                       int info);

/// A program that runs in a sandbox. All of its processes end with it, with this object, and with
/// the thread that made it.
class SandboxedProgram {
 public:
  /// Starts the program. Its standard streams are those of this process.
  /// @param mask   its signal mask.
  /// @param error  descriptor for its standard error; -1: that of this process.
  /// @throws std::runtime_error if bubblewrap cannot be started.
  SandboxedProgram(const SandboxSettings& settings, const sigset_t& mask, int error = -1);
  SandboxedProgram(const SandboxedProgram&) = delete;
  SandboxedProgram& operator=(const SandboxedProgram&) = delete;
  ~SandboxedProgram();

  /// A descriptor that becomes readable when the program has ended.
  [[nodiscard]] int descriptor() const noexcept { return pidfd_; }
  /// How the program ended, in the form of a shell: its exit status, or 128 and the number of the
  /// signal; nullopt while it runs.
  [[nodiscard]] std::optional<int> poll();
  /// Kills all of its processes. Any thread may call it.
  void kill_all() noexcept;
  /// Which limit its processes exceed, for the user: "at least 256 processes and threads"; empty:
  /// none. Call it some times a second.
  [[nodiscard]] std::string excess();

 private:
  [[nodiscard]] std::string folder_of_sandbox();

  SandboxLimits limits_;
  bool sized_;
  pid_t process_ = -1;
  int pidfd_ = -1;
  int info_ = -1;
  std::string root_;  ///< the sandbox's root, seen from here; "": not known yet
  std::atomic<bool> killed_{false};
  bool ended_ = false;
};

/// What this machine can do to isolate programs.
struct IsolationAbility {
  std::string obstacle;  ///< why it cannot, with what to do about it; empty: it can
  bool sized = true;     ///< see SandboxSettings::sized
};

/// Tries it.
[[nodiscard]] IsolationAbility try_isolation();

}  // namespace playpen
