// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include "libplayerc++/playererror.h"

namespace test {

/// The PlayerError that an action throws; a failure if it throws none.
template <typename Action>
PlayerCc::PlayerError error_of(Action action) {
  try {
    action();
  } catch (const PlayerCc::PlayerError& e) {
    return e;
  }
  ADD_FAILURE() << "no error";
  return PlayerCc::PlayerError("", "", 0);
}

/// Code of the PlayerError that an action throws; 0 if it throws none.
template <typename Action>
int error_code_of(Action action) {
  try {
    action();
  } catch (const PlayerCc::PlayerError& e) {
    return e.GetErrorCode();
  }
  return 0;
}

}  // namespace test
