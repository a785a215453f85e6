// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/process/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <string>

#include "sim/core/utf8.h"

namespace playerlike {

sim::LogHook log_to_stderr(sim::LogLevel least) {
  // A logger of its own, outside spdlog's registry: the client program may use spdlog too.
  auto logger = std::make_shared<spdlog::logger>(
      "playpen", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
  logger->set_pattern("playpen: %^%l%$: %v");
  logger->set_level(spdlog::level::debug);
  return [logger, least](sim::LogLevel level, std::string_view message) {
    if (level < least) return;
    // Names of programs, files and clients may contain any bytes.
    const std::string text = sim::escape_invalid_utf8(message);
    switch (level) {
      case sim::LogLevel::kDebug:
        logger->debug(text);
        break;
      case sim::LogLevel::kInfo:
        logger->info(text);
        break;
      case sim::LogLevel::kWarning:
        logger->warn(text);
        break;
      case sim::LogLevel::kError:
        logger->error(text);
        break;
    }
  };
}

}  // namespace playerlike
