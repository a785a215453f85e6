// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace imr {

/// The exception that the imr-h headers throw, or the base of those: catching it catches all.
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

/// An imr::exception of a kind of its own, so that a program may catch just this kind.
template <int kKind>
class exception_base : public exception {
 public:
  /// @param message  what() of the exception.
  explicit exception_base(const std::string& message) : exception(message) {}
};

/// @name Kinds of exceptions
/// The names are those of the course's libraries (J. Faigl, github.com/comrob/gsoa,
/// crl/src/exceptions.h).
/// @{
typedef exception_base<0> argument_error;       ///< a wrong argument; of assert_argument()
typedef exception_base<1> io_error;             ///< of files and devices; of assert_io()
typedef exception_base<2> packet_error;         ///< for programs; nothing here throws it
typedef exception_base<3> datagram_error;       ///< for programs; nothing here throws it
typedef exception_base<4> serialization_error;  ///< for programs; nothing here throws it
typedef exception_base<5> delivery_error;       ///< for programs; nothing here throws it
typedef exception_base<6> bad_code;             ///< for programs; nothing here throws it
typedef exception_base<7> bad_usage;            ///< a call in the wrong order; of assert_usage()
/// @}

namespace detail {

/// Throws imr::argument_error with the message; "invalid argument" if it is null or empty.
[[noreturn]] void throw_invalid_argument(const char* message);

}  // namespace detail

/// Throws if a condition does not hold; meant for arguments and for objects that must exist.
///
/// @param condition  anything that converts to bool, explicitly or not: a bool, a raw or smart
///                   pointer (null fails), a stream.
/// @param message    what() of the exception.
/// @throws imr::argument_error if the condition is false.
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
