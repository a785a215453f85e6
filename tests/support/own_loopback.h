// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <string>

namespace test_support {

/// A loopback address that other tests hardly use at the same time, for servers on fixed ports. All
/// of 127.0.0.0/8 belongs to this machine. As the name of a host it has no protocol.
[[nodiscard]] inline std::string own_loopback() {
  const auto process = static_cast<unsigned>(getpid());
  return "127." + std::to_string(100 + process % 100) + '.' +
         std::to_string(process / 100 % 250 + 1) + '.' + std::to_string(process / 25'000 % 250 + 1);
}

}  // namespace test_support
