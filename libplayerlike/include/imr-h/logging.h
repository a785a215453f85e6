// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <sstream>
#include <string>

/// @file
/// The stream macros DEBUG, INFO, WARN and ERROR write log lines to standard error.
///
///   INFO("robot at " << x << " " << y);      // prints: [INFO] robot at 1.5 2
///
/// The macro arguments are evaluated only if the line's level is enabled. The initial level is
/// INFO. The environment variable IMR_LOG_LEVEL (debug, info, warn, error or off, in upper or lower
/// case) sets another one; imr::logging::set_level() overrides both.
///
/// Threads: any thread may write lines. Each line is a single write, so lines never interleave.
///
/// Conflicts of the short names with other libraries. The four macros take arguments, so they do
/// not affect a plain identifier ERROR or DEBUG in other code, such as an enumerator. If an earlier
/// header, or -DDEBUG on the command line, has defined a macro with one of these names, this header
/// replaces it silently. If a later header defines such a macro, the compiler prints its usual
/// redefinition warning and uses the later definition. To keep the other definitions, define
/// IMR_LOGGING_NO_SHORT_NAMES before including this header: it then defines only the long names
/// IMR_LOG_DEBUG, IMR_LOG_INFO, IMR_LOG_WARN and IMR_LOG_ERROR.

namespace imr {
namespace logging {

/// Severity of a line, in ascending order. kOff as the current level disables all lines.
enum class Level { kDebug = 0, kInfo = 1, kWarn = 2, kError = 3, kOff = 4 };

/// Sets the lowest level that is printed. May be called from any thread.
void set_level(Level level) noexcept;

/// Returns the current level. May be called from any thread.
Level current_level() noexcept;

/// Sets the level from IMR_LOG_LEVEL, as the first use of the log does. The level is INFO if the
/// variable is unset or empty. An unknown value also gives INFO, with a warning. Do not call it
/// while another thread changes the environment.
void set_level_from_environment() noexcept;

/// Parses one of the words debug, info, warn, warning, error, off and none, in upper or lower case.
///
/// @param text   the word.
/// @param level  receives the level; unchanged if the word is unknown.
/// @return whether the word is known.
bool parse_level(const std::string& text, Level& level);

/// Returns whether lines of this level are currently printed. May be called from any thread.
bool enabled(Level level) noexcept;

/// Prints "[LEVEL] text" and a line end to standard error in a single write, regardless of the
/// current level. Line ends at the end of the text are removed. If the write fails or memory runs
/// out, the line is lost. May be called from any thread.
void write_line(Level level, const std::string& text) noexcept;

}  // namespace logging

/// @name Named loggers
/// These functions let course programs create and name loggers (names and signatures: J. Faigl,
/// github.com/comrob/gsoa, crl/src/logging.h). The original library sent all lines through log4cxx.
/// Here all lines go to standard error, and only DEBUG_M(), INFO_M(), WARN_M() and ERROR_M() print
/// the logger's name.
/// @{

/// A logger. Its name is its only property.
class CLogger {
 public:
  explicit CLogger(const std::string& name) : name_(name) {}
  const std::string& getName() const noexcept { return name_; }

 private:
  std::string name_;
};

/// Pointer to a logger. The logger lives until the process ends.
typedef const CLogger* CLoggerPtr;

/// The program's logger. Its name is "root" until initLogger() sets another one.
extern CLoggerPtr logger;

/// Returns the logger of this name; repeated calls return the same logger. May be called from any
/// thread.
CLoggerPtr getLogger(const char* loggerName);

/// Sets the name of the program's logger. Do not call it while other threads use that logger.
void initLogger(const std::string& loggerName);
/// Overload for string literals.
void initLogger(const char* loggerName);
/// Also reads the level from a log4cxx configuration file: the line "log4j.rootLogger=LEVEL, ..."
/// (ALL, TRACE, DEBUG, INFO, WARN, ERROR, FATAL, OFF). The rest of the file, which configures
/// log4cxx's output, is ignored. If IMR_LOG_LEVEL is set, the file is not read. If the file cannot
/// be read or has no such line, a WARN line says so and the level does not change.
/// @param configName  path of the file; null or "" for none.
void initLogger(const char* loggerName, const char* configName);

/// Does nothing; it exists for programs that call it.
void shutdownLogger();
/// @}

}  // namespace imr

/// Implementation of the four macros below; for their use only.
#define IMR_DETAIL_LOG(level, ...)                            \
  do {                                                        \
    if (::imr::logging::enabled(level)) {                     \
      ::std::ostringstream imr_log_text_;                     \
      imr_log_text_ << __VA_ARGS__;                           \
      ::imr::logging::write_line(level, imr_log_text_.str()); \
    }                                                         \
  } while (false)

/// Logs a line of level DEBUG, composed with <<.
#define IMR_LOG_DEBUG(...) IMR_DETAIL_LOG(::imr::logging::Level::kDebug, __VA_ARGS__)
/// Logs a line of level INFO, composed with <<.
#define IMR_LOG_INFO(...) IMR_DETAIL_LOG(::imr::logging::Level::kInfo, __VA_ARGS__)
/// Logs a line of level WARN, composed with <<.
#define IMR_LOG_WARN(...) IMR_DETAIL_LOG(::imr::logging::Level::kWarn, __VA_ARGS__)
/// Logs a line of level ERROR, composed with <<.
#define IMR_LOG_ERROR(...) IMR_DETAIL_LOG(::imr::logging::Level::kError, __VA_ARGS__)

#ifndef IMR_LOGGING_NO_SHORT_NAMES
#undef DEBUG
#undef INFO
#undef WARN
#undef ERROR
#undef DEBUG_M
#undef INFO_M
#undef WARN_M
#undef ERROR_M
/// Short for IMR_LOG_DEBUG.
#define DEBUG(...) IMR_LOG_DEBUG(__VA_ARGS__)
/// Short for IMR_LOG_INFO.
#define INFO(...) IMR_LOG_INFO(__VA_ARGS__)
/// Short for IMR_LOG_WARN.
#define WARN(...) IMR_LOG_WARN(__VA_ARGS__)
/// Short for IMR_LOG_ERROR.
#define ERROR(...) IMR_LOG_ERROR(__VA_ARGS__)
/// Logs a line with the logger's name before the text: "[DEBUG] name: text". INFO_M(), WARN_M() and
/// ERROR_M() do so for their levels.
#define DEBUG_M(logger, ...) IMR_LOG_DEBUG((logger)->getName() << ": " << __VA_ARGS__)
#define INFO_M(logger, ...) IMR_LOG_INFO((logger)->getName() << ": " << __VA_ARGS__)
#define WARN_M(logger, ...) IMR_LOG_WARN((logger)->getName() << ": " << __VA_ARGS__)
#define ERROR_M(logger, ...) IMR_LOG_ERROR((logger)->getName() << ": " << __VA_ARGS__)
#endif
