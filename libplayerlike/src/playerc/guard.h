// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <string>
#include <type_traits>

#include "libplayerc++/playererror.h"

namespace playerlike::clib {

/// Stores why a function of the C library failed, for playerc_error_str() in this thread.
void set_error(const char* fun, const std::string& why);
/// Also prints the error on standard error, each text once: many programs ignore errors, or only
/// end with a status.
void report_error(const char* fun, const std::string& why);

/// Runs the body of a function of the C library and converts exceptions to its error results.
/// @param note  receives the text of an error, except for the end of the run.
/// @return the action's result, 0 if it returns nothing. If it throws: null for a pointer, else -1.
template <typename Action>
auto guarded(const char* fun, Action action,
             void (*note)(const char*, const std::string&) = set_error) {
  using Result = decltype(action());
  try {
    if constexpr (std::is_void_v<Result>) {
      action();
      return 0;
    } else {
      return action();
    }
  } catch (const PlayerCc::PlayerError& e) {
    const bool run_is_over = e.GetErrorCode() == PlayerCc::PlayerError::kRunIsOver;
    (run_is_over ? set_error : note)(fun, e.GetErrorStr());
  } catch (const std::exception& e) {
    note(fun, e.what());
  }
  if constexpr (std::is_pointer_v<Result>) {
    return Result{nullptr};
  } else {
    return -1;
  }
}

/// As guarded(), for calls that a program depends on, such as connecting, subscribing and
/// commanding: errors go to report_error().
template <typename Action>
auto reported(const char* fun, Action action) {
  return guarded(fun, action, report_error);
}

/// Throws PlayerError kBadArgument, which guarded() converts.
[[noreturn]] void refuse(const std::string& why);

}  // namespace playerlike::clib
