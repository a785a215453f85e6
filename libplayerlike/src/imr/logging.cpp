// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#define IMR_LOGGING_NO_SHORT_NAMES
#include "imr-h/logging.h"

#include <atomic>
#include <cstdio>
#include <exception>
#include <map>
#include <mutex>
#include <sstream>

#include "sim/core/file.h"
#include "text.h"

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
    return kDefaultLevel;  // Out of memory: use the default level, so that logging works.
  }
}

// A static variable of the function, since static objects of other files may log while they are
// constructed.
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
  const std::string word = detail::lower_case(text);
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
    // stderr is unbuffered and has its own lock, so this is one uninterrupted write.
    std::fwrite(line.data(), 1, line.size(), stderr);
  } catch (const std::exception&) {
    // Out of memory: the line is lost, as the header says.
  }
}

}  // namespace imr::logging

namespace imr {
namespace {

// Converts a log4cxx level name.
bool parse_log4cxx_level(const std::string& word, logging::Level& level) {
  const std::string lower = detail::lower_case(word);
  if (lower == "all" || lower == "trace") return logging::parse_level("debug", level);
  if (lower == "fatal") return logging::parse_level("error", level);
  return logging::parse_level(lower, level);
}

// Reads the root logger's level from a log4cxx properties file; sets `problem` if there is none.
bool read_level(const std::string& file, logging::Level& level, std::string& problem) {
  std::string text;
  if (const auto error = sim::read_whole_file(file, {.pipes = true}, text)) {
    problem = "it can't be read: " + error->found;
    return false;
  }
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos) continue;
    const std::string key = detail::trimmed(line.substr(0, equals));
    if (key != "log4j.rootLogger" && key != "log4j.rootCategory") continue;
    const std::string value = line.substr(equals + 1);
    const std::string word = detail::trimmed(value.substr(0, value.find(',')));
    if (parse_log4cxx_level(word, level)) return true;
    problem = "its " + key + " begins with '" + word + "', which is no level";
    return false;
  }
  problem = "it has no line that begins with log4j.rootLogger=";
  return false;
}

}  // namespace

CLoggerPtr logger = getLogger("root");

CLoggerPtr getLogger(const char* loggerName) {
  // Never destroyed: programs may log until the process ends.
  static std::mutex* const mutex = new std::mutex;
  static auto* const loggers = new std::map<std::string, CLogger>;
  const std::string name = loggerName == nullptr ? "" : loggerName;
  const std::lock_guard<std::mutex> lock(*mutex);
  return &loggers->try_emplace(name, name).first->second;
}

void initLogger(const std::string& loggerName) { logger = getLogger(loggerName.c_str()); }

void initLogger(const char* loggerName) { logger = getLogger(loggerName); }

void initLogger(const char* loggerName, const char* configName) {
  initLogger(loggerName);
  const char* const chosen = std::getenv("IMR_LOG_LEVEL");
  if (configName == nullptr || *configName == '\0' || (chosen != nullptr && *chosen != '\0'))
    return;
  logging::Level level = logging::current_level();
  std::string problem;
  if (read_level(configName, level, problem)) {
    logging::set_level(level);
  } else {
    IMR_LOG_WARN("the level of the log is not taken from " << configName << ": " << problem);
  }
}

void shutdownLogger() {}

}  // namespace imr
