// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <string>

namespace playpen {

/// A line on standard error that overwrites itself: how much of a task is done, and the time that
/// is left. Shows nothing unless standard error is a terminal.
class ProgressBar {
 public:
  /// Starts a task, and its time.
  void begin(const std::string& name);
  /// @param ended  what is done, of `all`.
  void show(std::size_t ended, std::size_t all) const;
  /// Removes the line.
  void clear() const;

 private:
  using Clock = std::chrono::steady_clock;

  bool is_terminal_ = isatty(STDERR_FILENO) != 0;
  std::string name_;
  Clock::time_point start_;
};

}  // namespace playpen
