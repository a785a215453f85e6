// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "playerlike/host/kept_run.h"

namespace playerlike {

/// Notices, from another process, that a program computes for long while its simulated time stands
/// still, such as in an endless loop. Processor time makes this independent of the machine's load.
/// The time before the first step is StalledTimeWarning's.
class StandstillWatch {
 public:
  /// @param limit_s  processor time of the program between two steps [s], > 0.
  explicit StandstillWatch(double limit_s) : limit_s_(limit_s) {}

  /// Must be called now and then. @return a message for the user, once.
  [[nodiscard]] std::optional<std::string> look(const KeptRun& run);

 private:
  const double limit_s_;
  KeptRun::Progress last_{};
  std::chrono::nanoseconds last_cpu_{0};  ///< the program's processor time when last_ was new
  bool told_ = false;
};

}  // namespace playerlike
