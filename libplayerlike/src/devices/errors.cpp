// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "devices/errors.h"

#include <cmath>
#include <sstream>

#include "host/end_of_program.h"

namespace playerlike {

using PlayerCc::PlayerError;

PlayerError::Code player_code(SessionError::Code code) noexcept {
  switch (code) {
    case SessionError::Code::kFinished:
      return PlayerError::kRunIsOver;
    case SessionError::Code::kDisconnected:
      return PlayerError::kDisconnected;
    case SessionError::Code::kNoSuchDevice:
      return PlayerError::kNoSuchDevice;
    case SessionError::Code::kNotAvailable:
      return PlayerError::kNotAvailable;
    case SessionError::Code::kBadArgument:
      return PlayerError::kBadArgument;
  }
  return PlayerError::kFailed;
}

void register_end_of_run() noexcept {
  add_end_of_run_test([](const std::exception_ptr& error) {
    try {
      std::rethrow_exception(error);
    } catch (const PlayerError& e) {
      return e.GetErrorCode() == PlayerError::kRunIsOver;
    } catch (...) {
      return false;
    }
  });
}

void require_finite(const char* fun, std::initializer_list<NamedValue> values) {
  for (const NamedValue& v : values) {
    if (std::isfinite(v.value)) continue;
    std::ostringstream text;
    text << v.name << " must be a finite number, but is " << v.value;
    throw PlayerError(fun, text.str(), PlayerError::kBadArgument);
  }
}

}  // namespace playerlike
