// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "companion.h"
#include "sim/core/log.h"

namespace playpen {

/// The options of --page.
struct PageRequest {
  bool wanted = false;
  std::optional<int> port;         ///< 0: any free one; nullopt: 8080, or the next free one
  std::string bind = "127.0.0.1";  ///< an IPv4 or IPv6 address, or a name of this machine
  bool open = false;               ///< on any address, everybody may watch
  std::vector<std::string> names;  ///< by which browsers may call this machine
  std::string token_file;          ///< "": random tokens
};

/// The process that offers a run's page to browsers, playpen-page (docs/page.md). It is the only
/// program that opens a port for them; client programs and this command do not. Its end closes the
/// page.
class PageProcess {
 public:
  /// Opens the page and waits until it can be reached.
  /// @param title  title of the page; need not be valid UTF-8.
  /// @param log  receives warnings about the token file.
  /// @throws sim::ConfigError for a bad token file; std::runtime_error that says what is wrong with
  ///         the address or the port, or that the program is missing.
  PageProcess(const PageRequest& request, const std::string& title, const sim::LogHook& log);
  PageProcess(const PageProcess&) = delete;
  PageProcess& operator=(const PageProcess&) = delete;
  /// Warns if the process has ended before.
  ~PageProcess();

  /// The client program's end of the connection, which it inherits.
  [[nodiscard]] int socket() const noexcept { return companion_->socket(); }

  /// A descriptor of the same end for a host in this process, which closes it.
  [[nodiscard]] int copy_of_socket() const { return companion_->copy_of_socket(); }

  /// The lines for the user: the links for watching and for commanding.
  [[nodiscard]] std::string links() const;

 private:
  void wait_until_ready();

  std::optional<Companion> companion_;
  PageRequest request_;
  std::string command_token_;
  std::string watch_token_;
  int port_ = 0;
  bool is_open_ = false;  ///< watching needs no token
};

}  // namespace playpen
