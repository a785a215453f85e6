// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <string>

namespace playpen {

/// The process that shows a run's window, playpen-view. It is the only program that loads a
/// windowing toolkit; client programs and this command do not need one.
class ViewerProcess {
 public:
  /// Opens the window and waits until it is visible.
  /// @param title  title of the window.
  /// @throws std::runtime_error that says what is missing and how to record a film instead: there
  ///         is no display, no such program beside this one, or the window cannot be opened.
  explicit ViewerProcess(const std::string& title);
  ViewerProcess(const ViewerProcess&) = delete;
  ViewerProcess& operator=(const ViewerProcess&) = delete;
  /// Closes the window and waits for the process; kills it if it does not end within two seconds.
  ~ViewerProcess();

  /// The client program's end of the connection, which it inherits.
  [[nodiscard]] int socket() const noexcept { return socket_; }

 private:
  void wait_for_window();
  void end() noexcept;

  int socket_ = -1;
  pid_t child_ = -1;
};

}  // namespace playpen
