// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <utility>

#include "playerlike/host/host.h"

namespace test {

/// Host::create() for tests in which clients wait for each other: the silence limit is long unless
/// the test sets one. On a loaded machine, a client may be silent for seconds before it reads.
[[nodiscard]] inline std::shared_ptr<playerlike::Host> patient_host(
    sim::WorldDescription world, playerlike::RunSettings settings = {}, sim::LogHook log = {}) {
  if (settings.silence_limit_s == playerlike::RunSettings{}.silence_limit_s) {
    settings.silence_limit_s = 600.0;
  }
  return playerlike::Host::create(std::move(world), std::move(settings), std::move(log));
}

}  // namespace test
