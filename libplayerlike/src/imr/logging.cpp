// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#define IMR_LOGGING_NO_SHORT_NAMES
#include "imr-h/logging.h"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cstdio>
#include <exception>

namespace imr::logging {
namespace {

constexpr Level kDefaultLevel = Level::kInfo;

Level level_from_environment() noexcept {
  try {
    const char* value = std::getenv("IMR_LOG_LEVEL");
    Level level = kDefaultLevel;
    if (value != nullptr && *value != '\0' && !parse_level(value, level)) {
      write_line(Level::kWarn,
                 "IMR_LOG_LEVEL is '" + std::string(value) +
                     "', which is no level (debug, info, warn, error, off); info is used");
    }
    return level;
  } catch (const std::exception&) {
    return kDefaultLevel;  // No memory for the words; logging goes on.
  }
}

// A function's static: lines may be logged while other files' static objects are constructed.
std::atomic<Level>& stored_level() noexcept {
  static std::atomic<Level> level{level_from_environment()};
  return level;
}

const char* tag(Level level) noexcept {
  switch (level) {
    case Level::kDebug:
      return "[DEBUG] ";
    case Level::kInfo:
      return "[INFO] ";
    case Level::kWarn:
      return "[WARN] ";
    case Level::kError:
    case Level::kOff:
      break;
  }
  return "[ERROR] ";
}

}  // namespace

void set_level(Level level) noexcept { stored_level().store(level, std::memory_order_relaxed); }

Level current_level() noexcept { return stored_level().load(std::memory_order_relaxed); }

void set_level_from_environment() noexcept { set_level(level_from_environment()); }

bool parse_level(const std::string& text, Level& level) {
  std::string word = text;
  std::transform(word.begin(), word.end(), word.begin(), [](char character) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(character)));
  });
  if (word == "debug") {
    level = Level::kDebug;
  } else if (word == "info") {
    level = Level::kInfo;
  } else if (word == "warn" || word == "warning") {
    level = Level::kWarn;
  } else if (word == "error") {
    level = Level::kError;
  } else if (word == "off" || word == "none") {
    level = Level::kOff;
  } else {
    return false;
  }
  return true;
}

bool enabled(Level level) noexcept { return level != Level::kOff && level >= current_level(); }

void write_line(Level level, const std::string& text) noexcept {
  try {
    std::string line = tag(level) + text;
    while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) {
      line.pop_back();
    }
    line += '\n';
    // stderr has no buffer and a lock of its own, so this is one uninterrupted write.
    std::fwrite(line.data(), 1, line.size(), stderr);
  } catch (const std::exception&) {
    // No memory for the line: it is lost, as the header says.
  }
}

}  // namespace imr::logging
