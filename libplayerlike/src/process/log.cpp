// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/process/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace playerlike {

sim::LogHook log_to_stderr(sim::LogLevel least) {
  // A logger of its own, outside spdlog's registry: the client program may use spdlog too.
  auto logger = std::make_shared<spdlog::logger>(
      "playpen", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
  logger->set_pattern("playpen: %^%l%$: %v");
  logger->set_level(spdlog::level::debug);
  return [logger, least](sim::LogLevel level, std::string_view message) {
    if (level < least) return;
    switch (level) {
      case sim::LogLevel::kDebug:
        logger->debug(message);
        break;
      case sim::LogLevel::kInfo:
        logger->info(message);
        break;
      case sim::LogLevel::kWarning:
        logger->warn(message);
        break;
      case sim::LogLevel::kError:
        logger->error(message);
        break;
    }
  };
}

}  // namespace playerlike
