// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <initializer_list>
#include <string>

#include "libplayerc++/playererror.h"
#include "playerlike/messages/messages.h"
#include "sim/core/error.h"

namespace playerlike {

/// Converts a session's error code to the client's.
[[nodiscard]] PlayerCc::PlayerError::Code player_code(SessionError::Code code) noexcept;

/// Installs a terminate handler. An uncaught PlayerError is printed on standard error before the
/// program aborts. If it says that the run is over, it ends the program like the SessionError, see
/// end_of_program.h.
void prepare_for_uncaught_errors() noexcept;

/// Runs an action and converts SessionError to PlayerError in the name of `fun`. Other exceptions,
/// such as those of a program's callback, pass through.
template <typename Action>
auto translated(const char* fun, Action action) -> decltype(action()) {
  try {
    return action();
  } catch (const SessionError& e) {
    throw PlayerCc::PlayerError(fun, e.what(), player_code(e.code()));
  } catch (const sim::ConfigError& e) {
    throw PlayerCc::PlayerError(fun, e.what(), PlayerCc::PlayerError::kBadWorld);
  }
}

/// As translated(), but converts every std::exception, e.g. while a world is loaded.
template <typename Action>
auto translated_all(const char* fun, Action action) -> decltype(action()) {
  try {
    return translated(fun, action);
  } catch (const PlayerCc::PlayerError&) {
    throw;
  } catch (const std::exception& e) {
    throw PlayerCc::PlayerError(fun, e.what(), PlayerCc::PlayerError::kFailed);
  }
}

/// Throws PlayerError kBadArgument.
[[noreturn]] inline void refuse(const std::string& fun, const std::string& text) {
  throw PlayerCc::PlayerError(fun, text, PlayerCc::PlayerError::kBadArgument);
}

/// Throws PlayerError kBadArgument for NaN and infinity; the error names the value.
struct NamedValue {
  const char* name;
  double value;
};
void require_finite(const char* fun, std::initializer_list<NamedValue> values);

}  // namespace playerlike
