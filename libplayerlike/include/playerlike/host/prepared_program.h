// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "playerlike/host/program.h"

namespace playerlike {

/// A client program that was started once and waits before its main(), so that copies of it start
/// in a millisecond. A copy is a fork of the process, with an environment of its own. The program
/// must be linked with Playpen. One copy runs at a time; for more, prepare the program several
/// times.
///
/// The program finds the descriptor of a socket in PLAYPEN_PREPARED. Over it go a magic number from
/// the program, then for each copy the size of the request and the request, and back the copy's
/// process id (0: there is no room for a process) and its wait status; all numbers of 32 bits in
/// the machine's byte order.
class PreparedProgram {
 public:
  /// Starts the program.
  /// @param command  program and arguments; the program is a path, see find_program().
  /// @param environment  of all copies.
  /// @throws ProgramError if it cannot be started or does not become prepared within a time: it may
  ///     not be linked with Playpen.
  PreparedProgram(const std::vector<std::string>& command, const EnvironmentChanges& environment);
  PreparedProgram(const PreparedProgram&) = delete;
  PreparedProgram& operator=(const PreparedProgram&) = delete;
  /// Ends the program and its copy.
  ~PreparedProgram();

  /// Starts a copy. @pre None is running.
  /// @param variables  of its environment, beside those of all copies.
  /// @param output_file  gets what it prints, and is replaced.
  /// @throws ProgramError if the prepared process has died.
  void start(const std::vector<std::pair<std::string, std::string>>& variables,
             const std::string& output_file);
  /// Readable when the copy has ended.
  [[nodiscard]] int descriptor() const noexcept { return socket_; }
  /// How the copy ended; nullopt: it is running. @pre One was started.
  /// @throws ProgramError as start().
  [[nodiscard]] std::optional<ProgramEnd> poll();
  /// Kills the copy and the processes that it has started.
  void kill_copy() noexcept;
  /// Processor time of the copy so far [s].
  [[nodiscard]] double processor_time_s() const noexcept;

 private:
  int socket_ = -1;
  pid_t process_ = -1;
  pid_t copy_ = 0;  ///< 0: none
};

/// What both sides must know.
namespace prepared {
inline constexpr std::uint32_t kMagic = 0x31505050;           ///< "PPP1"
inline constexpr std::uint32_t kGreatestRequest = 1U << 16U;  ///< [bytes]
inline constexpr std::uint64_t kGreatestFile = 256U << 20U;   ///< that a copy can write [bytes]
/// A variable that a copy does not get: the file for its output.
inline constexpr const char* kOutputVariable = "PLAYPEN_PREPARED_OUTPUT";
}  // namespace prepared

}  // namespace playerlike
