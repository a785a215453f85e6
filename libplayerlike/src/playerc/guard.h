// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <string>
#include <type_traits>

#include "libplayerc++/playererror.h"

namespace playerlike::clib {

/// Notes why a function of the C library fails, for playerc_error_str() in this thread.
void set_error(const char* fun, const std::string& why);
/// Also tells the user on standard error, once for each text: many programs only end with a status
/// then, or go on.
void report_error(const char* fun, const std::string& why);

/// Does what a function of the C library is for, and turns errors into its way to tell them.
/// @param note  what is done with the text of an error that is not the end of the run.
/// @return what the action returns, 0 for one that returns nothing. If it throws, null where that
///         is a pointer, else -1.
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

/// The same for what a program cannot do without, as connecting, subscribing and commanding: the
/// user is told, see report_error().
template <typename Action>
auto reported(const char* fun, Action action) {
  return guarded(fun, action, report_error);
}

/// Throws PlayerError kBadArgument, for guarded().
[[noreturn]] void refuse(const std::string& why);

}  // namespace playerlike::clib
