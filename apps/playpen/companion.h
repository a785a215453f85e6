// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

namespace playpen {

/// A process of another of Playpen's programs, which is installed and built beside this one. Its
/// standard input is a socket, by which it communicates. It ends when the socket's other end is
/// closed.
class Companion {
 public:
  /// Starts the program.
  /// @param name  of the program's file.
  /// @throws std::runtime_error with the reason if it is missing or cannot be started.
  Companion(const std::string& name, std::vector<std::string> arguments);
  Companion(const Companion&) = delete;
  Companion& operator=(const Companion&) = delete;
  /// Closes the socket and waits for the process; kills it if it does not end within two seconds.
  ~Companion();

  /// The end of the connection for a client program, which inherits it.
  [[nodiscard]] int socket() const noexcept { return socket_; }

  /// A descriptor of the same end for a host in this process, which closes it.
  /// @throws std::runtime_error if there are too many descriptors.
  [[nodiscard]] int copy_of_socket() const;

  /// What has come from the process.
  enum class News { kMessage, kEnd, kNothing };
  /// Waits for the first byte from the process, and leaves it in the socket.
  /// @param limit  after which it is kNothing.
  [[nodiscard]] News wait(std::chrono::seconds limit) const;

  /// Whether the process has ended, though the socket is open.
  [[nodiscard]] bool has_ended() noexcept;

 private:
  int socket_ = -1;
  pid_t child_ = -1;  ///< -1: it has ended
};

}  // namespace playpen
