// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "core/warnings.h"

#include "playerlike/process/log.h"
#include "virtual_time/virtual_time.h"

namespace playerlike {

void warn(const std::string& text) {
  // The log reads the clock, which must not count as the program's look at it.
  const virtual_time::Inside inside;
  // Never destroyed: proxies at namespace scope may still warn during static destruction.
  static const auto* const log = new sim::LogHook(log_to_stderr(sim::LogLevel::kWarning));
  (*log)(sim::LogLevel::kWarning, text);
}

}  // namespace playerlike
