// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "companion.h"

namespace playpen {

/// The process that shows a run's window, playpen-view. It is the only program that loads a
/// windowing toolkit; client programs and this command do not need one. Its end closes the window.
class ViewerProcess {
 public:
  /// Opens the window and waits until it is visible.
  /// @param title  title of the window.
  /// @throws std::runtime_error that says what is missing and how to record a film instead: there
  ///         is no display, no such program beside this one, or the window cannot be opened.
  explicit ViewerProcess(const std::string& title);

  /// The client program's end of the connection, which it inherits.
  [[nodiscard]] int socket() const noexcept { return companion_->socket(); }

  /// A descriptor of the same end for a host in this process, which closes it.
  [[nodiscard]] int copy_of_socket() const { return companion_->copy_of_socket(); }

 private:
  std::optional<Companion> companion_;
};

}  // namespace playpen
