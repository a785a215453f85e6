// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "playerlike/host/program.h"

namespace playpen {

/// Whether a program runs in a sandbox, in a process other than the simulation's.
enum class Isolation {
  kOff,
  kBest,      ///< if this machine can
  kRequired,  ///< or not at all
};

/// What users choose about it.
struct IsolationSettings {
  Isolation level = Isolation::kOff;
  std::vector<std::string> readable;  ///< files and folders that the program may read besides
};

/// What a command decides about isolation before it runs programs: how to call them.
class IsolatedPrograms {
 public:
  /// Tries whether programs can be isolated. With kBest, a message on standard error says so if
  /// not.
  /// @throws std::runtime_error with kRequired if they cannot, or if a readable path does not
  /// exist.
  explicit IsolatedPrograms(const IsolationSettings& settings);

  [[nodiscard]] bool isolated() const noexcept { return !launcher_.empty(); }
  /// The words before the program and its arguments. Empty: programs are not isolated.
  /// @param preloaded  the library that makes time virtual; "": none.
  /// @param hidden     files and folders that programs must not see, such as results and worlds.
  /// @param readable   files and folders that they may read besides those of the settings.
  [[nodiscard]] std::vector<std::string> launcher(
      const std::string& preloaded, const std::vector<std::string>& hidden,
      const std::vector<std::string>& readable = {}) const;
  /// The words before a command that compiles a program in its working folder. Empty: it is not
  /// isolated.
  /// @param readable  files and folders that it may read besides the system's and Playpen's.
  [[nodiscard]] std::vector<std::string> build_launcher(
      const std::vector<std::string>& readable) const;

 private:
  std::vector<std::string> launcher_;
};

/// Arguments of `playpen contain`, the command that IsolatedPrograms::launcher() calls.
struct ContainRequest {
  std::string preloaded;              ///< library to preload; "": none
  std::vector<std::string> readable;  ///< absolute paths
  std::vector<std::string> hidden;    ///< absolute paths
  bool unsized = false;               ///< the opposite of SandboxSettings::sized
  /// Whether the command compiles a program in the current folder, which it may change, with this
  /// Playpen's headers and libraries. It has no run.
  bool build = false;
  std::vector<std::string> command;  ///< program and arguments
};

/// The variables by which compilers and build tools find Playpen's package; a sandbox for a build
/// keeps them.
inline constexpr std::array<const char*, 5> kBuildVariables{"CMAKE_PREFIX_PATH", "PKG_CONFIG_PATH",
                                                            "CPATH", "LIBRARY_PATH", "LD_RUN_PATH"};

/// Simulates the run that this process's environment describes (run_environment()) and runs a
/// program of it in a sandbox; or runs a command that compiles one. To its parent this process
/// looks like the program itself with the simulation in it: it ends with the program's status or
/// signal, and writes the results.
/// @return the program's exit status.
/// @throws std::exception if the program cannot be started.
[[nodiscard]] int contain(const ContainRequest& request);

}  // namespace playpen
