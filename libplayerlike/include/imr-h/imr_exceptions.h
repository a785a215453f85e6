// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace imr {

/// The one exception that the imr-h headers throw.
///
/// It derives from std::exception (by way of std::runtime_error, whose copies don't throw), so a
/// program may catch either. what() is a sentence for a person.
class exception : public std::runtime_error {
 public:
  /// An exception without a particular message.
  exception();

  /// @param message  what() of the exception.
  explicit exception(const std::string& message);

  exception(const exception&) = default;
  exception& operator=(const exception&) = default;
  ~exception() override;
};

namespace detail {

/// Throws imr::exception with the message; "invalid argument" if it is null or empty.
[[noreturn]] void throw_invalid_argument(const char* message);

}  // namespace detail

/// Throws if a condition does not hold; meant for arguments and for objects that must exist.
///
/// @param condition  anything that converts to bool, explicitly or not: a bool, a raw or smart
///                   pointer (null fails), a stream.
/// @param message    what() of the exception.
/// @throws imr::exception if the condition is false.
/// @note The message costs nothing while the condition holds. Safe from many threads.
template <typename Condition>
void assert_argument(const Condition& condition, const char* message) {
  if (!static_cast<bool>(condition)) {
    detail::throw_invalid_argument(message);
  }
}

/// As above, for a message that was put together at run time.
template <typename Condition>
void assert_argument(const Condition& condition, const std::string& message) {
  assert_argument(condition, message.c_str());
}

}  // namespace imr
