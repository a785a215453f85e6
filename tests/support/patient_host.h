// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <utility>

#include "playerlike/host/host.h"

namespace test {

/// Host::create() for tests in which clients wait for each other: unless the test sets a silence
/// limit, it is long. On a loaded machine a client that is about to read may be silent for seconds.
[[nodiscard]] inline std::shared_ptr<playerlike::Host> patient_host(
    sim::WorldDescription world, playerlike::RunSettings settings = {}, sim::LogHook log = {}) {
  if (settings.silence_limit_s == playerlike::RunSettings{}.silence_limit_s) {
    settings.silence_limit_s = 600.0;
  }
  return playerlike::Host::create(std::move(world), std::move(settings), std::move(log));
}

}  // namespace test
