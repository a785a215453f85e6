// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <initializer_list>
#include <string>

#include "libplayerc++/playererror.h"
#include "playerlike/messages/messages.h"
#include "sim/core/error.h"

namespace playerlike {

/// The code under which a client sees a session's error.
[[nodiscard]] PlayerCc::PlayerError::Code player_code(SessionError::Code code) noexcept;

/// From now on a PlayerError that nobody catches is printed on standard error before the program
/// aborts; one that says the run is over ends `playpen run` as the SessionError would.
void prepare_for_uncaught_errors() noexcept;

/// Does something, and turns what sessions throw into PlayerError in the name of `fun`. Anything
/// else, as what a program's own callback throws, passes.
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

/// The same for any std::exception, e.g. while a world is loaded.
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

/// Refuses NaN and infinity: throws PlayerError kBadArgument, naming the value.
struct NamedValue {
  const char* name;
  double value;
};
void require_finite(const char* fun, std::initializer_list<NamedValue> values);

}  // namespace playerlike
