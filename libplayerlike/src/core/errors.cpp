// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "core/errors.h"

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <sstream>

#include "process/end_of_program.h"
#include "sim/core/number_text.h"

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

namespace {

std::terminate_handler previous_handler = nullptr;

[[noreturn]] void describe_and_terminate() {
  if (const std::exception_ptr error = std::current_exception()) {
    try {
      std::rethrow_exception(error);
    } catch (const PlayerError& e) {
      std::cerr << "PlayerError that nobody catches: " << e << std::endl;
    } catch (...) {
      // Another type of exception: the previous handler describes it.
    }
  }
  if (previous_handler != nullptr) previous_handler();
  std::abort();
}

bool is_end_of_run(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const PlayerError& e) {
    return e.GetErrorCode() == PlayerError::kRunIsOver;
  } catch (...) {
    return false;
  }
}

}  // namespace

void prepare_for_uncaught_errors() noexcept {
  static std::once_flag once;
  std::call_once(once, [] {
    add_end_of_run_test(is_end_of_run);
    previous_handler = std::set_terminate(describe_and_terminate);
  });
}

void require_finite(const char* fun, std::initializer_list<NamedValue> values) {
  for (const NamedValue& v : values) {
    if (std::isfinite(v.value)) continue;
    throw PlayerError(
        fun,
        std::string(v.name) + " must be a finite number, but is " + sim::rounded_text(v.value, 6),
        PlayerError::kBadArgument);
  }
}

}  // namespace playerlike
