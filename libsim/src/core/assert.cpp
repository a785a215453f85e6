// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/assert.h"

#include <iostream>

namespace sim::detail {

void assertion_failed(const char* condition, const char* file, int line) noexcept {
  std::cerr << file << ':' << line << ": internal error, please report it: " << condition
            << std::endl;
  std::abort();
}

}  // namespace sim::detail
