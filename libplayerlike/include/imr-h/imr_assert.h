// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <sstream>
#include <string>

#include "imr-h/imr_exceptions.h"

/// @file
/// Checks for course code. A failed check throws imr::exception with the source file and line.
///
/// Unlike the C library's assert(), these checks are never compiled out and never abort the
/// process. A program can catch the exception, log it and stop the robot. A condition is evaluated
/// exactly once. A message is composed with <<, and only if the check fails.
///
///   IMR_ASSERT(left < right);
///   IMR_ASSERT_MSG(count > 0, "scan of " << count << " beams");
///   ASSERT_ARGUMENT(speed_mps >= 0.0, "negative speed " << speed_mps);

namespace imr {
namespace detail {

/// The kind of a check.
enum class Check { kAssertion, kArgument, kIo };

/// Throws the exception of a failed check: "file:line: kind 'condition' failed: message".
///
/// @param file       source file, as the compiler names it.
/// @param line       line of the check.
/// @param check      the kind, printed as "assertion", "argument check" or "i/o check".
/// @param condition  text of the condition.
/// @param message    may be empty; the text then ends after "failed".
/// @throws imr::exception always: argument_error for kArgument, io_error for kIo.
[[noreturn]] void throw_failed_check(const char* file, int line, Check check, const char* condition,
                                     const std::string& message);

}  // namespace detail

/// Throws an Exception, constructed from the message, unless the condition holds.
template <typename Exception>
void assert_exception(bool condition, const std::string& message) {
  if (!condition) throw Exception(message);
}

/// Throws imr::bad_usage unless the condition holds.
inline void assert_usage(bool condition, const std::string& message) {
  assert_exception<bad_usage>(condition, message);
}

/// Throws imr::io_error unless the condition holds.
inline void assert_io(bool condition, const std::string& message) {
  assert_exception<io_error>(condition, message);
}

}  // namespace imr

/// Implementation of the checks with a message; for the macros below only.
#define IMR_DETAIL_CHECK(check, condition, ...)                                          \
  do {                                                                                   \
    if (!static_cast<bool>(condition)) {                                                 \
      ::std::ostringstream imr_check_text_;                                              \
      imr_check_text_ << __VA_ARGS__;                                                    \
      ::imr::detail::throw_failed_check(__FILE__, __LINE__, ::imr::detail::Check::check, \
                                        #condition, imr_check_text_.str());              \
    }                                                                                    \
  } while (false)

/// Throws imr::exception unless the condition holds. The condition may contain commas.
#define IMR_ASSERT(...)                                                                       \
  do {                                                                                        \
    if (!static_cast<bool>(__VA_ARGS__)) {                                                    \
      ::imr::detail::throw_failed_check(__FILE__, __LINE__, ::imr::detail::Check::kAssertion, \
                                        #__VA_ARGS__, "");                                    \
    }                                                                                         \
  } while (false)

/// Throws imr::exception with a message unless the condition holds.
#define IMR_ASSERT_MSG(condition, ...) IMR_DETAIL_CHECK(kAssertion, condition, __VA_ARGS__)

/// Checks an argument: throws imr::argument_error with a message unless the condition holds.
#define ASSERT_ARGUMENT(condition, ...) IMR_DETAIL_CHECK(kArgument, condition, __VA_ARGS__)

/// Checks a file or a device: throws imr::io_error with a message unless the condition holds.
#define ASSERT_IO(condition, ...) IMR_DETAIL_CHECK(kIo, condition, __VA_ARGS__)
