// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace imr {

/// Base class of all exceptions that the imr-h headers throw.
///
/// It derives from std::runtime_error, whose copy constructor does not throw, and thus from
/// std::exception. what() is a message for the user.
class exception : public std::runtime_error {
 public:
  /// Creates an exception with a general message.
  exception();

  /// @param message  what() of the exception.
  explicit exception(const std::string& message);

  exception(const exception&) = default;
  exception& operator=(const exception&) = default;
  ~exception() override;
};

/// A distinct exception class for each kind, so that a program can catch one kind only.
template <int kKind>
class exception_base : public exception {
 public:
  /// @param message  what() of the exception.
  explicit exception_base(const std::string& message) : exception(message) {}
};

/// @name Kinds of exceptions
/// The names come from the course's libraries (J. Faigl, github.com/comrob/gsoa,
/// crl/src/exceptions.h).
/// @{
typedef exception_base<0> argument_error;       ///< a wrong argument; by assert_argument()
typedef exception_base<1> io_error;             ///< a failed file or device; by assert_io()
typedef exception_base<2> packet_error;         ///< for programs; the library never throws it
typedef exception_base<3> datagram_error;       ///< for programs; the library never throws it
typedef exception_base<4> serialization_error;  ///< for programs; the library never throws it
typedef exception_base<5> delivery_error;       ///< for programs; the library never throws it
typedef exception_base<6> bad_code;             ///< for programs; the library never throws it
typedef exception_base<7> bad_usage;            ///< a wrong order of calls; by assert_usage()
/// @}

namespace detail {

/// Throws imr::argument_error with the message, or with "invalid argument" if it is null or empty.
[[noreturn]] void throw_invalid_argument(const char* message);

}  // namespace detail

/// Throws if a condition does not hold. Use it for arguments and for objects that must exist.
///
/// @param condition  anything that converts to bool, explicitly or not: a bool, a raw or smart
///                   pointer (null fails), a stream.
/// @param message    what() of the exception.
/// @throws imr::argument_error if the condition is false.
/// @note A literal message costs nothing while the condition holds. May be called from any thread.
template <typename Condition>
void assert_argument(const Condition& condition, const char* message) {
  if (!static_cast<bool>(condition)) {
    detail::throw_invalid_argument(message);
  }
}

/// Overload for a message that is composed at run time.
template <typename Condition>
void assert_argument(const Condition& condition, const std::string& message) {
  assert_argument(condition, message.c_str());
}

}  // namespace imr
