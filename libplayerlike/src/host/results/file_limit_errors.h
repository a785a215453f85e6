// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <signal.h>

namespace playerlike {

/// While an object exists, a write beyond the file size limit (ulimit -f) fails with an error
/// instead of ending the process by SIGXFSZ. If the program handles that signal itself, nothing
/// changes.
class FileLimitErrors {
 public:
  FileLimitErrors() noexcept {
    struct sigaction present = {};
    if (sigaction(SIGXFSZ, nullptr, &present) != 0 || present.sa_handler != SIG_DFL) return;
    struct sigaction ignore = {};
    ignore.sa_handler = SIG_IGN;
    changed_ = sigaction(SIGXFSZ, &ignore, nullptr) == 0;
  }
  FileLimitErrors(const FileLimitErrors&) = delete;
  FileLimitErrors& operator=(const FileLimitErrors&) = delete;
  ~FileLimitErrors() {
    if (!changed_) return;
    struct sigaction by_default = {};
    by_default.sa_handler = SIG_DFL;
    sigaction(SIGXFSZ, &by_default, nullptr);
  }

 private:
  bool changed_ = false;
};

}  // namespace playerlike
