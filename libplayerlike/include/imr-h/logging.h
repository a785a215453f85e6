// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <sstream>
#include <string>

/// @file
/// Log lines on standard error, by the stream macros DEBUG, INFO, WARN and ERROR.
///
///   INFO("robot at " << x << " " << y);      // prints: [INFO] robot at 1.5 2
///
/// Lines below the current level are neither printed nor put together: what stands in the
/// parentheses is evaluated only when the line is on. The level is INFO at first; the environment
/// variable IMR_LOG_LEVEL (debug, info, warn, error or off, in any case) sets another one, and
/// imr::logging::set_level() overrides both.
///
/// Threads: lines may be written from any thread. Each line is one write, so lines never mix.
///
/// The short names and other libraries. The four macros take arguments, so a plain word ERROR or
/// DEBUG in other code (an enumerator, say) is left alone. If another header, or -DDEBUG on the
/// command line, has defined a macro of the same name before, this header takes the name over
/// silently: course programs mean these macros. A header included later that defines the name
/// again gets the compiler's usual redefinition warning, and its meaning holds from there on. A
/// file that needs the other meaning defines IMR_LOGGING_NO_SHORT_NAMES before it includes this
/// header, then no short name is touched; the long names IMR_LOG_DEBUG, IMR_LOG_INFO,
/// IMR_LOG_WARN and IMR_LOG_ERROR always exist.

namespace imr {
namespace logging {

/// Importance of a line, in rising order; kOff as the current level silences all.
enum class Level { kDebug = 0, kInfo = 1, kWarn = 2, kError = 3, kOff = 4 };

/// Sets the least important level that is still printed. Safe from any thread.
void set_level(Level level) noexcept;

/// The level in force. Safe from any thread.
Level current_level() noexcept;

/// Sets the level from IMR_LOG_LEVEL, as happens at the first use; INFO if it is unset or empty.
/// A value that is no level gives INFO too, and a warning. Not while another thread changes the
/// environment.
void set_level_from_environment() noexcept;

/// Understands debug, info, warn, warning, error, off and none, in any case.
///
/// @param text   the word.
/// @param level  receives the level; unchanged if the word is not known.
/// @return whether the word is known.
bool parse_level(const std::string& text, Level& level);

/// Whether a line of this level is printed now. Safe from any thread.
bool enabled(Level level) noexcept;

/// Prints "[LEVEL] text" and a line end on standard error in one write, whatever the current
/// level. Line ends at the end of the text are dropped. A line that can't be written, or for which
/// there is no memory, is lost. Safe from any thread.
void write_line(Level level, const std::string& text) noexcept;

}  // namespace logging

/// @name Loggers with names
/// As course programs set them up and name them (names and signatures: J. Faigl,
/// github.com/comrob/gsoa, crl/src/logging.h). There all lines went through log4cxx; here INFO()
/// and the rest go where they always go, and a name only matters to INFO_M() and the like.
/// @{

/// A logger; it has a name and nothing else.
class CLogger {
 public:
  explicit CLogger(const std::string& name) : name_(name) {}
  const std::string& getName() const noexcept { return name_; }

 private:
  std::string name_;
};

/// Lives until the process ends.
typedef const CLogger* CLoggerPtr;

/// The logger of the program, called "root" until initLogger() names it.
extern CLoggerPtr logger;

/// The logger of a name; the same one each time. Safe from any thread.
CLoggerPtr getLogger(const char* loggerName);

/// Names the logger of the program. Not while other threads use it.
void initLogger(const std::string& loggerName);
/// As above.
void initLogger(const char* loggerName);
/// Also takes the level from a configuration file of log4cxx: that of the line
/// "log4j.rootLogger=LEVEL, ..." (ALL, TRACE, DEBUG, INFO, WARN, ERROR, FATAL, OFF). The rest of
/// the file, which tells where lines go, does not count; nor does the level if IMR_LOG_LEVEL is
/// set. A file that can't be read, or has no such line, is told of in a WARN line, and the level
/// stays.
/// @param configName  null or "": no file.
void initLogger(const char* loggerName, const char* configName);

/// Nothing is left to be done at the end.
void shutdownLogger();
/// @}

}  // namespace imr

/// Common part of the four macros; for their use only.
#define IMR_DETAIL_LOG(level, ...)                            \
  do {                                                        \
    if (::imr::logging::enabled(level)) {                     \
      ::std::ostringstream imr_log_text_;                     \
      imr_log_text_ << __VA_ARGS__;                           \
      ::imr::logging::write_line(level, imr_log_text_.str()); \
    }                                                         \
  } while (false)

/// Logs a line of level DEBUG, put together with <<.
#define IMR_LOG_DEBUG(...) IMR_DETAIL_LOG(::imr::logging::Level::kDebug, __VA_ARGS__)
/// Logs a line of level INFO, put together with <<.
#define IMR_LOG_INFO(...) IMR_DETAIL_LOG(::imr::logging::Level::kInfo, __VA_ARGS__)
/// Logs a line of level WARN, put together with <<.
#define IMR_LOG_WARN(...) IMR_DETAIL_LOG(::imr::logging::Level::kWarn, __VA_ARGS__)
/// Logs a line of level ERROR, put together with <<.
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
/// The same with a logger's name in front: "[DEBUG] name: text".
#define DEBUG_M(logger, ...) IMR_LOG_DEBUG((logger)->getName() << ": " << __VA_ARGS__)
#define INFO_M(logger, ...) IMR_LOG_INFO((logger)->getName() << ": " << __VA_ARGS__)
#define WARN_M(logger, ...) IMR_LOG_WARN((logger)->getName() << ": " << __VA_ARGS__)
#define ERROR_M(logger, ...) IMR_LOG_ERROR((logger)->getName() << ": " << __VA_ARGS__)
#endif
